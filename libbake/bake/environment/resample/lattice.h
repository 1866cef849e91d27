// The texels of an environment as cells on the sphere: their corners and centroids.
#pragma once
#include "bake/environment/sky/environment.h"
#include <glm/mat3x3.hpp>
#include <vector>

namespace bake {

/// A rectangular array of texels on the sphere, a face or a picture of the whole sky. `turn` is applied to every direction.
class Lattice {
public:
    Lattice(CubeFace face, int size, bool edge_samples, const glm::dmat3& turn);
    Lattice(Projection projection, int width, int height, const glm::dmat3& turn);

    /// Applies another linear map after the turn.
    void turn_further(const glm::dmat3& map) noexcept { turn_ = map * turn_; }

    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }

    /// Start of texel i along x or y: i, clamped to the centres of the outer texels if these lie on the edges. i may lie
    /// between texels.
    double border_x(double i) const noexcept { return edges_ ? clamped(i, width_) : i; }
    double border_y(double j) const noexcept { return edges_ ? clamped(j, height_) : j; }

    /// Directions, turned, through the lattice points (x0 + k / parts, y), k = 0 ... count - 1.
    void points(int x0, int parts, double y, int count, Vec3d* directions) const noexcept;

    /// Centroid of the solid angle of texel (x, y), relative to the centre of the texel, in texels.
    Vec2d centroid(int x, int y) const noexcept;
    /// Approximate angle that a texel spans.
    double texel_angle() const noexcept;
    /// Number of parts into which a texel is cut along x and along y, so that the sides of the parts, which are treated as
    /// great circles, are correct to 2e-4 of a result's texel, and no part spans more than 4 degrees.
    int parts(double result_angle) const noexcept;

private:
    static double clamped(double i, int n) noexcept { return i < 0.5 ? 0.5 : i > n - 0.5 ? n - 0.5 : i; }
    Vec3d point(double x, double y) const noexcept;

    bool face_lattice_, edges_;
    CubeFace face_ = CubeFace::pz;
    Projection projection_ = Projection::latlong;
    int width_, height_;
    glm::dmat3 turn_;
    std::vector<Vec2d> meridians_;     ///< of a lat-long: sin phi, cos phi at column borders
    std::vector<Vec2d> parallels_;     ///< of a lat-long: sin theta, cos theta at row borders
    std::vector<double> row_centroid_; ///< of a lat-long: y of the centroids of each row
};

} // namespace bake
