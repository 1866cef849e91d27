// The reference job of the accuracy figures: a torus R = 1, r = 0.4 under a relief A sin(2 pi k u) sin(2 pi m v),
// baked to a tangent-space map, decoded as a shader does, and compared with the closed form.
#pragma once
#include "bake/relief/map/error_budget.h"
#include "bake/relief/map/normal_map.h"
#include "oracle/surfaces.h"

namespace oracle {

struct TorusRelief {
    double A = 0.01;
    int k = 24, m = 12;
};

/// Height and slopes at (u, v) in [0,1]^2.
inline Height<double> relief(const TorusRelief& r, double u, double v) {
    const double a = 2 * pi * r.k, b = 2 * pi * r.m;
    return {r.A * sin(a * u) * sin(b * v), r.A * a * cos(a * u) * sin(b * v), r.A * b * sin(a * u) * cos(b * v)};
}

/// The torus's jet over uv in [0,1]^2.
inline Jet<double> unit_torus(double u, double v) {
    Jet<double> s = torus(1, 0.4, 2 * pi * u, 2 * pi * v);
    s.p_u *= 2 * pi, s.p_v *= 2 * pi, s.n_u *= 2 * pi, s.n_v *= 2 * pi;
    return s;
}

/// A point of the displaced torus with its derivatives along u and v.
struct ReliefPoint {
    Vec3d p, p_u, p_v;

    Vec3d normal() const { return glm::normalize(glm::cross(p_u, p_v)); }
};

inline ReliefPoint relief_point(const TorusRelief& r, double u, double v) {
    const Jet<double> s = unit_torus(u, v);
    const Height<double> h = relief(r, u, v);
    return {s.p + h.b * s.n, s.p_u + h.b_u * s.n + h.b * s.n_u, s.p_v + h.b_v * s.n + h.b * s.n_v};
}

/// The exact normal of the displaced torus.
inline Vec3d relief_normal(const TorusRelief& r, double u, double v) { return relief_point(r, u, v).normal(); }

/// The relief as a texture: value = b / (2 A) + 0.5, so that amplitude 2 A and midlevel 0.5 give it back; rounded to
/// `bits` where bits > 0.
inline bake::HeightTexture relief_texture(const TorusRelief& r, int size, int bits = 0) {
    bake::HeightTexture height;
    height.values = bake::Image<float>(size, size, 1);
    const double largest = std::exp2(bits) - 1;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double value = relief(r, (x + 0.5) / size, 1 - (y + 0.5) / size).b / (2 * r.A) + 0.5;
            height.values.at(x, y) = float(bits > 0 ? std::round(value * largest) / largest : value);
        }
    height.levels = bits > 0 && bits <= 8 ? 1 << bits : 257;
    height.step = bits > 0 ? 1 / largest : 0;
    return height;
}

inline bake::NormalMapOptions relief_options(const TorusRelief& r, int size, bake::Filter filter,
                                             bake::NormalMethod method = bake::NormalMethod::exact) {
    bake::NormalMapOptions options;
    options.width = options.height = size;
    options.filter = filter;
    options.method = method;
    options.height_options = {.amplitude = 2 * r.A, .midlevel = 0.5};
    return options;
}

/// Angle of every texel between the map, decoded in the target's frames, and `truth(u, v)`, in degrees. `bits` rounds
/// the map as a file of that depth does; 0 keeps floats.
template <class Truth>
std::vector<double> map_errors(const bake::Image<float>& map, const bake::BakeTarget& target, int bits,
                               const Truth& truth) {
    std::vector<double> errors;
    errors.reserve(map.size() / 3);
    const auto largest = float(std::exp2(bits) - 1);
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) {
            const bake::TexelHit& hit = target.raster.hits.at(x, y);
            if (hit.triangle == bake::no_index) continue;
            bake::Vec3f rgb(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2));
            if (bits > 0)
                for (int c = 0; c < 3; ++c) rgb[c] = std::floor(rgb[c] * largest + 0.5f) / largest;
            const Vec3d t = 2.0 * Vec3d(rgb) - 1.0;
            Vec3d T(0), N(0);
            const double b[3] = {1.0 - hit.b1 - hit.b2, hit.b1, hit.b2};
            const auto& corner = target.surface.triangles[hit.triangle].corner;
            for (int i = 0; i < 3; ++i) {
                T += b[i] * Vec3d(bake::Vec3f(target.tangents[corner[i]]));
                N += b[i] * Vec3d(target.surface.n[corner[i]]);
            }
            const Vec3d B = double(target.tangents[corner[0]].w) * glm::cross(N, T);
            errors.push_back(
                angle_deg(t.x * T + t.y * B + t.z * N, truth((x + 0.5) / map.width(), 1 - (y + 0.5) / map.height())));
        }
    return errors;
}

} // namespace oracle
