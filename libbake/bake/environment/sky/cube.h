// Cube maps: the faces, the mapping between directions and faces, and interpolation.
//
// Faces as in the OpenGL table (Vulkan and Direct3D agree), seen from inside, in cube space: left-handed, +Z ahead,
// +X right, +Y up.
//
//             +------+
//             |  py  |                each face: s runs right, t runs down, row 0 is t = 0
//             |      |
//      +------+------+------+------+  major  face    sc    tc    ma
//      |  nx  |  pz  |  px  |  nz  |   +rx    px    -rz   -ry    rx
//      |      |      |      |      |   -rx    nx    +rz   -ry    rx
//      +------+------+------+------+   +ry    py    +rx   +rz    ry
//             |  ny  |                 -ry    ny    +rx   -rz    ry
//             |      |                 +rz    pz    +rx   -ry    rz
//             +------+                 -rz    nz    -rx   -ry    rz
//
//      s = (sc / |ma| + 1) / 2         t = (tc / |ma| + 1) / 2
//
// The world is right-handed. world_to_cube is the only conversion between the two, so that pictures, and text in them, are
// never mirrored.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image.h"
#include <array>

namespace bake {

enum class CubeFace { px, nx, py, ny, pz, nz };
inline constexpr std::array<const char*, 6> cube_face_names = {"px", "nx", "py", "ny", "pz", "nz"};
inline constexpr std::array<CubeFace, 6> all_cube_faces = {CubeFace::px, CubeFace::nx, CubeFace::py,
                                                           CubeFace::ny, CubeFace::pz, CubeFace::nz};

/// A point on a face: s right, t down, both in [0, 1].
template <class T> struct CubePoint {
    CubeFace face = CubeFace::pz;
    T s = T(0.5), t = T(0.5);
};

/// Conversion between world and cube space: x changes sign. The function is its own inverse.
template <class T> Vec3<T> world_to_cube(const Vec3<T>& d) noexcept { return {-d.x, d.y, d.z}; }

/// The point where a ray from the centre in a direction in cube space, of any length, leaves the cube. For components of
/// equal magnitude z takes precedence over y, and y over x. A zero vector gives the centre of pz. A NaN component counts as
/// zero; if a component is infinite, finite components count as zero.
template <class T> CubePoint<T> cube_point(const Vec3<T>& d) noexcept;

/// The direction in cube space through a point of a face, not unit: its major component is 1 or -1.
template <class T> Vec3<T> cube_direction(const CubePoint<T>& point) noexcept;

/// Six square faces of equal size with one to four channels (colour is linear), in the order of CubeFace. Texel (x, y) of
/// n covers s in [x, x + 1] / n, t in [y, y + 1] / n. Empty: no environment.
struct Cube {
    std::array<Image<float>, 6> faces;
    int size() const noexcept { return faces[0].width(); } ///< texels along an edge
    int channels() const noexcept { return faces[0].channels(); }
    bool empty() const noexcept { return faces[0].empty(); }
    Image<float>& operator[](CubeFace face) noexcept { return faces[int(face)]; }
    const Image<float>& operator[](CubeFace face) const noexcept { return faces[int(face)]; }
};
/// Six faces with uninitialised values.
Cube make_cube(int size, int channels);

/// One texel of a cube.
struct CubeTexel {
    CubeFace face;
    int x, y;
};
/// The neighbour across an edge of a face of `size` texels: exactly one of x and y is -1 or size.
CubeTexel texel_across(int size, CubeFace face, int x, int y) noexcept;

/// Value in a direction in cube space, by bilinear interpolation across edges. At a corner of the cube only three texels
/// touch, and the fourth is their mean. Degenerate directions are treated as in cube_point. Writes channels() values.
void lookup(const Cube& cube, const Vec3d& d, float* value) noexcept;
/// The same for a cube of three channels or more.
Vec3f lookup(const Cube& cube, const Vec3f& d) noexcept;

} // namespace bake
