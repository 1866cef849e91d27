// The sky of a scene: what rays see that hit nothing, and a light whose directions are drawn where it is bright.
//
// Directions are drawn from a table of texels whose weights are radiance times solid angle (Pharr, Jakob, Humphreys,
// Physically Based Rendering, section 12.5): a row in proportion to its sum, a texel in proportion to its weight, a point
// uniformly in the texel. A weight is the mean over 3 x 3 texels, because the interpolated radiance of a dark texel beside a
// bright one is not 0, less twice the mean of the sky: what is darker is left to the directions that are drawn for the surface
// (Karlik, Sik, Vevoda, Skrivan, Krivanek, MIS Compensation, SIGGRAPH Asia 2019).
#pragma once
#include "bake/environment/sky/cube.h"
#include <cstdint>
#include <vector>

namespace bake {

/// Rotation of a sky about the vertical axis: it moves the sky ahead to the right, as `bake cubemap --yaw` does.
struct SkyYaw {
    float cosine = 1, sine = 0;
    SkyYaw() = default;
    explicit SkyYaw(double deg) noexcept
        : cosine(float(std::cos(deg * (pi / 180)))), sine(float(std::sin(deg * (pi / 180)))) {}

    /// From a world-space direction to the cube space in which the faces are looked up, and back.
    Vec3f to_cube(const Vec3f& world) const noexcept {
        return {-cosine * world.x - sine * world.z, world.y, cosine * world.z - sine * world.x};
    }
    Vec3f to_world(const Vec3f& cube) const noexcept {
        return {-cosine * cube.x - sine * cube.z, cube.y, cosine * cube.z - sine * cube.x};
    }
};

/// Radiance of rays that hit nothing.
struct Sky {
    Cube cube;       ///< three channels; if empty, the background is used
    float scale = 1; ///< factor on the radiance of the cube
    SkyYaw yaw;
    Vec3f background{0};        ///< radiance, linear RGB; the background is seen and mirrored, but it does not light
    std::vector<Cube> halvings; ///< of the cube: see add_halvings(); empty: lookups are at a point
};

/// Makes the mips of the cube, each half as large as the one before, down to one texel; replaces those that are there.
void add_halvings(Sky& sky);

/// lookup() of a cube of three channels, in float.
Vec3f fast_lookup(const Cube& cube, const Vec3f& d) noexcept;

/// Radiance of the sky along a world-space direction.
Vec3f sky_radiance(const Sky& sky, const Vec3f& direction) noexcept;
/// Its mean over a cone around a unit direction, of an angle of about `spread` from side to side: interpolated between the
/// two halvings whose texels are as large there. Where texels are larger than the cone it is the radiance along the
/// direction. After Akenine-Moeller et al., Texture Level of Detail Strategies for Real-Time Ray Tracing, Ray Tracing Gems,
/// 2019, section 20.3.4.
Vec3f sky_radiance(const Sky& sky, const Vec3f& direction, float spread) noexcept;

struct SkySample {
    Vec3f l{0};    ///< unit, world space
    float pdf = 0; ///< per solid angle; 0: no direction
};

/// Draws directions of a sky in proportion to its radiance above twice the mean. To be combined, by multiple importance sampling,
/// with directions that are drawn for the surface.
class SkyLight {
public:
    /// A sky that is black.
    SkyLight() = default;
    /// Faces of more than 512 texels are drawn from their means over blocks of texels.
    explicit SkyLight(const Sky& sky);

    bool is_black() const noexcept { return black_; }
    /// The direction for a point of the unit square. None (pdf 0) if no part of the sky is brighter than that.
    SkySample sample(const Vec2f& u) const noexcept;
    /// The probability per solid angle with which sample() draws a world-space direction. 0 where the sky is
    /// darker.
    float pdf(const Vec3f& direction) const noexcept;

private:
    float density(int row, int column, float s, float t) const noexcept;

    bool black_ = true;
    int size_ = 0; ///< texels along an edge of a face of the table; 0: no directions
    SkyYaw yaw_;
    std::vector<float> rows_;  ///< sums of weights up to and with each row, of all faces in their order; the last is 1
    std::vector<float> cells_; ///< in each row: the same up to each texel
    /// Where to begin the search in rows_, and in each row of cells_: the first sum above k / n, for every k of n.
    std::vector<std::uint16_t> row_starts_, cell_starts_;
};

} // namespace bake
