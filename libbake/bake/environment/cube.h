// Six-face environment maps.
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
// The world is right-handed. world_to_cube is the only place where the two meet, so that pictures, and text in them,
// are never mirrored.
#pragma once
#include "bake/asset/image_io.h"
#include "bake/base/vec.h"
#include <array>
#include <string>

namespace bake {

enum class CubeFace { px, nx, py, ny, pz, nz };
inline constexpr std::array<const char*, 6> cube_face_names = {"px", "nx", "py", "ny", "pz", "nz"};

/// A place on a face: s right, t down, both in [0, 1].
template <class T> struct CubePoint {
    CubeFace face = CubeFace::pz;
    T s = T(0.5), t = T(0.5);
};

/// The one flip between world and cube space: x changes sign. It is its own inverse.
template <class T> Vec3<T> world_to_cube(const Vec3<T>& d) noexcept { return {-d.x, d.y, d.z}; }

/// Where a direction in cube space, of any length, leaves the cube. Equal magnitudes: z before y before x. A zero
/// vector gives the centre of pz; a NaN component counts as zero, and beside an infinite one finite ones count as zero.
template <class T> CubePoint<T> cube_point(const Vec3<T>& d) noexcept;

/// The direction in cube space through a point of a face, not unit: its major component is 1 or -1.
template <class T> Vec3<T> cube_direction(const CubePoint<T>& point) noexcept;

/// Six square faces of one size, three channels (RGB, linear), in the order of CubeFace. Empty: no environment.
struct Cube {
    std::array<Image<float>, 6> faces;
    int size() const noexcept { return faces[0].width(); } ///< texels along an edge
    bool empty() const noexcept { return faces[0].empty(); }
};

/// How the values of a colour picture are stored.
enum class ColourSpace { automatic, srgb, linear }; ///< automatic: sRGB for 8-bit and sRGB-tagged files
/// Whether a file read by this rule must be decoded.
bool is_srgb(ColourSpace space, const ImageInfo& info) noexcept;

/// Reads six files in the order of CubeFace. Throws Error naming the file: unreadable; unsuitable for a face that is
/// not square, not as large as the first, has fewer than three channels, or holds NaN or Inf.
Cube read_cube(const std::array<std::string, 6>& files, ColourSpace space = ColourSpace::automatic);
/// The six names a pattern stands for: `%s` is replaced by px, nx, py, ny, pz, nz. Throws Error{Refusal::usage} when it
/// does not hold exactly one `%s`.
std::array<std::string, 6> cube_files(const std::string& pattern);

/// Radiance from a direction in cube space: bilinear, seamless across the edges. At a corner, where only three texels
/// meet, the fourth is their mean.
Vec3f lookup(const Cube& cube, const Vec3f& d) noexcept;

} // namespace bake
