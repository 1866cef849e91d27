#include "bake/environment/filter/radiance_tree.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace bake {
namespace {

// A node is stored as omega, h, rho, Q, d, then F and D of each channel.
constexpr int fixed_values = 7;

void store(const SkyNode& node, int channels, float* to) noexcept {
    const float fixed[fixed_values] = {node.omega, node.h, node.rho, node.Q, node.d.x, node.d.y, node.d.z};
    to = std::copy(fixed, fixed + fixed_values, to);
    to = std::copy(node.F, node.F + channels, to);
    for (int c = 0; c < channels; ++c)
        for (int i = 0; i < 3; ++i) *to++ = node.D[c][i];
}

SkyNode load(const float* from, int channels) noexcept {
    SkyNode node;
    node.omega = from[0], node.h = from[1], node.rho = from[2], node.Q = from[3];
    node.d = {from[4], from[5], from[6]};
    const float *F = from + fixed_values, *D = F + channels;
    for (int c = 0; c < channels; ++c) node.F[c] = F[c], node.D[c] = {D[3 * c], D[3 * c + 1], D[3 * c + 2]};
    return node;
}

/// The parent of one to four nodes.
SkyNode parent_of(const SkyNode* children, int count, int channels) noexcept {
    double omega = 0;
    Vec3d d(0.0);
    for (int i = 0; i < count; ++i) {
        omega += double(children[i].omega);
        d += double(children[i].omega) * Vec3d(children[i].d);
    }
    d /= omega;
    SkyNode node;
    node.omega = float(omega);
    // Moments are taken about the rounded centre that is stored, so that the rounding has no effect. Vectorising for x86-64,
    // GCC 12 leaves out the rounding of a pair of numbers to float and back; that to a volatile number it keeps.
    for (int k = 0; k < 3; ++k) {
        const volatile float rounded = float(d[k]);
        d[k] = double(node.d[k] = rounded);
    }
    double h = 0, rho = 0, Q = 0, uneven = 0, second[4];
    for (int i = 0; i < count; ++i) {
        const Vec3d off = Vec3d(children[i].d) - d;
        second[i] = glm::dot(off, off) + 2 * double(children[i].h);
        h += double(children[i].omega) * second[i] / 2;
        rho = std::max(rho, glm::length(off) + double(children[i].rho));
        Q += double(children[i].Q);
    }
    for (int c = 0; c < channels; ++c) {
        double F = 0, spread = 0;
        Vec3d D(0.0);
        for (int i = 0; i < count; ++i) {
            F += double(children[i].F[c]);
            D += Vec3d(children[i].D[c]) + double(children[i].F[c]) * (Vec3d(children[i].d) - d);
        }
        for (int i = 0; i < count; ++i)
            spread += std::abs(double(children[i].F[c]) - F / omega * double(children[i].omega)) * second[i];
        uneven = std::max(uneven, spread);
        node.F[c] = float(F);
        node.D[c] = Vec3f(D);
    }
    node.h = float(h / omega), node.rho = float(rho), node.Q = float(Q + uneven);
    return node;
}

/// Sum of term(L) omega over a channel, row by row, so that it does not depend on the number of threads.
template <class Term>
double sum_over_texels(const Cube& sky, int channel, const std::vector<double>& omega, Term&& term) {
    const int n = sky.size(), channels = sky.channels();
    std::vector<double> rows(std::size_t(6) * n);
    for_rows(std::int64_t(6) * n, 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row) {
            const float* values = sky.faces[row / n].row(int(row % n)) + channel;
            const double* weights = &omega[std::size_t(row % n) * n];
            for (int x = 0; x < n; ++x) rows[row] += weights[x] * term(double(values[std::size_t(x) * channels]));
        }
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return sum;
}

constexpr double sphere = 4 * pi;

} // namespace

int RadianceTree::size(int level) const noexcept { return level == 0 ? sky_.size() : levels_[level - 1].size; }

SkyNode RadianceTree::node(int level, int face, int x, int y) const noexcept {
    if (level == 0) return texel(face, x, y);
    if (level < finest_) return from_children(level, face, x, y);
    const std::size_t n = std::size_t(size(level));
    return load(&levels_[level - 1].values[((face * n + y) * n + x) * stride_], channels_);
}

SkyNode RadianceTree::texel(int face, int x, int y) const noexcept {
    const int n = sky_.size();
    SkyNode texel;
    texel.omega = omega_[std::size_t(y) * n + x];
    texel.h = texel.rho = texel.Q = 0;
    const Vec3d d = cube_direction(CubePoint<double>{static_cast<CubeFace>(face), (x + 0.5) / n, (y + 0.5) / n});
    texel.d = Vec3f(glm::normalize(d));
    const float* values = sky_.faces[face].row(y) + std::size_t(x) * channels_;
    for (int c = 0; c < channels_; ++c) texel.F[c] = values[c] * texel.omega, texel.D[c] = Vec3f(0.0f);
    return texel;
}

SkyNode RadianceTree::from_children(int level, int face, int x, int y) const noexcept {
    const int n = size(level - 1);
    SkyNode children[4];
    int count = 0;
    for (int j = 2 * y; j < std::min(2 * y + 2, n); ++j)
        for (int i = 2 * x; i < std::min(2 * x + 2, n); ++i) children[count++] = node(level - 1, face, i, j);
    return parent_of(children, count, channels_);
}

float RadianceTree::texel_at(const Vec3f& d, int channel) const noexcept {
    const CubePoint<float> at = cube_point(d);
    const int n = sky_.size();
    const auto index = [n](float s) { return std::clamp(int(s * float(n)), 0, n - 1); };
    return sky_.faces[int(at.face)].at(index(at.s), index(at.t), channel);
}

RadianceTree::RadianceTree(const Cube& sky, int finest)
    : sky_(sky), channels_(sky.channels()), stride_(fixed_values + 4 * channels_), finest_(finest) {
    assert(!sky.empty() && channels_ >= 1 && channels_ <= max_sky_channels);
    const int n = sky.size();
    const std::vector<double> omega = texel_solid_angles(n);
    omega_.assign(omega.begin(), omega.end());

    for (int c = 0; c < channels_; ++c) {
        const auto sum = [&](auto&& term) { return sum_over_texels(sky, c, omega, term); };
        const double mean = sum([](double L) { return std::abs(L); }) / sphere;
        assert(std::isfinite(mean));
        mean_ = std::max(mean_, mean);
        const double even_area = sum([=](double L) { return std::abs(L) <= 4 * mean ? 1.0 : 0.0; });
        even_level_[c] = sum([=](double L) { return std::abs(L) <= 4 * mean ? L : 0.0; }) / even_area;
    }

    std::fill(least_, least_ + channels_, std::numeric_limits<float>::max());
    std::fill(most_, most_ + channels_, std::numeric_limits<float>::lowest());
    for (const Image<float>& face : sky.faces)
        for (std::size_t i = 0; i < face.size(); i += channels_)
            for (int c = 0; c < channels_; ++c) {
                least_[c] = std::min(least_[c], face.data()[i + c]);
                most_[c] = std::max(most_[c], face.data()[i + c]);
            }

    while (size(last_level()) > 1) {
        const int level = last_level() + 1, m = (size(last_level()) + 1) / 2;
        levels_.push_back({m, {}});
        if (level < finest_) continue;
        std::vector<float> values(std::size_t(6) * m * m * stride_);
        for_rows(std::int64_t(6) * m, 4, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t row = begin; row < end; ++row)
                for (int x = 0; x < m; ++x)
                    store(from_children(level, int(row / m), x, int(row % m)), channels_,
                          &values[(row * m + x) * stride_]);
        });
        levels_.back().values = std::move(values);
    }
    assert(finest_ <= last_level());
}

} // namespace bake
