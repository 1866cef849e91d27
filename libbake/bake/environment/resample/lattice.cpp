#include "bake/environment/resample/lattice.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>

namespace bake {

Lattice::Lattice(CubeFace face, int size, bool edge_samples, const glm::dmat3& turn)
    : face_lattice_(true), edges_(edge_samples), face_(face), width_(size), height_(size), turn_(turn) {}

Lattice::Lattice(Projection projection, int width, int height, const glm::dmat3& turn)
    : face_lattice_(false), edges_(projection == Projection::latlong_edges), projection_(projection), width_(width),
      height_(height), turn_(turn) {
    if (!is_latlong(projection)) return;
    for (int i = 0; i <= width; ++i) {
        const Vec3d d = picture_direction(projection, width, height, i, 0.5 * height);
        meridians_.emplace_back(d.x, d.z);
    }
    for (int j = 0; j <= height; ++j) {
        const Vec3d d = picture_direction(projection, width, height, 0.5 * width, j);
        parallels_.emplace_back(d.y, std::sqrt(d.x * d.x + d.z * d.z));
    }
    // Solid angle is proportional to cos theta, so the centroid is nearer to the equator than the centre is.
    const double rows = edges_ ? height - 1 : height, h = pi / rows;
    for (int y = 0; y < height; ++y) {
        const double theta = pi * (0.5 - (edges_ ? y : y + 0.5) / rows), c = std::cos(theta);
        const double up = 2 * (std::sin(h / 2) / (h * h) - std::cos(h / 2) / (2 * h)), all = 2 * std::sin(h / 2) / h;
        row_centroid_.push_back(c > 1e-9 ? std::sin(theta) * up / (c * all) : 0.0);
    }
}

Vec3d Lattice::point(double x, double y) const noexcept {
    if (!face_lattice_) return picture_direction(projection_, width_, height_, x, y);
    const double s = edges_ ? (border_x(x) - 0.5) / std::max(1, width_ - 1) : x / width_;
    const double t = edges_ ? (border_y(y) - 0.5) / std::max(1, height_ - 1) : y / height_;
    return cube_direction(CubePoint<double>{face_, s, t});
}

void Lattice::points(int x0, int parts, double y, int count, Vec3d* directions) const noexcept {
    const auto row = int(std::ceil(y)); // outer half rows of edge samples begin at .5; the direction is that at 0
    if (!meridians_.empty() && parts == 1 && (row == y || row <= 1 || row >= height_)) {
        const Vec2d parallel = parallels_[row == y ? row : row <= 1 ? 0 : height_];
        // turn_ * (sin phi cos theta, sin theta, cos phi cos theta), with the factors of the row computed once
        const Vec3d right = turn_[0] * parallel.y, up = turn_[1] * parallel.x, ahead = turn_[2] * parallel.y;
        for (int k = 0; k < count; ++k)
            directions[k] = right * meridians_[x0 + k].x + up + ahead * meridians_[x0 + k].y;
        return;
    }
    for (int k = 0; k < count; ++k) directions[k] = turn_ * point(x0 + double(k) / parts, y);
}

Vec2d Lattice::centroid(int x, int y) const noexcept {
    if (!row_centroid_.empty()) return {0, row_centroid_[y]};
    if (!face_lattice_) return {0, 0}; // equal-area
    const double n = edges_ ? width_ - 1 : width_, off = edges_ ? 0 : 0.5;
    const double sc = 2 * (x + off) / n - 1, tc = 2 * (y + off) / n - 1,
                 slope = -3 / (1 + sc * sc + tc * tc) * (2 / n) / 12;
    return {slope * sc, slope * tc};
}

double Lattice::texel_angle() const noexcept {
    if (face_lattice_) return 2.0 / width_;
    if (is_latlong(projection_)) return pi / height_;
    return std::sqrt(4 * pi / (double(width_) * height_));
}

int Lattice::parts(double result_angle) const noexcept {
    const double h = texel_angle();
    return std::clamp(int(std::ceil(std::max(h / std::sqrt(16 * 2e-4 * result_angle), h / 0.07))), 1, 64);
}

} // namespace bake
