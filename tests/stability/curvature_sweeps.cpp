// Height times curvature: to the focal radius and past it, and what a constant offset does.
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/displaced_normal.h"
#include "oracle/surfaces.h"
#include "stability/themes.h"
#include "stability/worst_angle.h"
#include <algorithm>

using namespace bake;

namespace stability {
namespace {

/// A surface point with principal curvatures a and c along x and y.
Jet<double> bent(double a, double c) {
    Jet<double> s{};
    s.p_u = {1, 0, 0}, s.p_v = {0, 1, 0}, s.n = {0, 0, 1};
    s.n_u = {a, 0, 0}, s.n_v = {0, c, 0};
    return s;
}

double worst_of(const Jet<double>& s, double b, NormalMethod method) {
    return worst_angle([&](const Vec2d& slope) {
        const Height<double> h{b, slope.x, slope.y};
        return oracle::angle_deg(displaced_normal(s, h, method), displaced_normal(s, h, NormalMethod::exact));
    });
}

/// asin((largest - smallest) / (largest + smallest)) over 1 and the two factors.
double wrong_slope_deg(double m1, double m2) {
    const double most = std::max({1.0, m1, m2}), least = std::min({1.0, m1, m2});
    return least <= 0 ? 180 : glm::degrees(std::asin((most - least) / (most + least)));
}

std::vector<Row> blinn_rows(int steps) {
    struct Shape {
        const char* name;
        double a, c; // curvatures times height, per unit of x
    };
    std::vector<Row> rows;
    for (const auto& [name, a, c] :
         {Shape{"sphere raised", 1, 1}, {"sphere dented", -1, -1}, {"cylinder raised", 1, 0}, {"saddle", 1, -1}})
        for (const double x : geometric_steps(1e-3, 0.99, steps))
            rows.push_back(
                {name, x, worst_of(bent(a, c), x, NormalMethod::blinn), wrong_slope_deg(1 + x * a, 1 + x * c),
                 "exact is the default; for blinn normal-map and render note the error at the height's slopes"});
    return rows;
}

/// The smallest factor by which displacement by `b` stretches a short step on the surface, measured between displaced
/// points: along its own direction, so that it is negative where the step turns round.
double measured_margin(const std::function<Jet<double>(double, double)>& surface, double b) {
    double least = 10;
    const double step = 1e-4;
    const auto moved = [&](double u, double v) {
        const Jet<double> s = surface(u, v);
        return s.p + b * s.n;
    };
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j <= 16; ++j) {
            const double u = 0.3 + 0.1 * i, v = j * pi / 16;
            for (const auto& [du, dv] : {std::pair(step, 0.0), {0.0, step}}) {
                const Vec3d before = surface(u + du, v + dv).p - surface(u - du, v - dv).p;
                if (glm::length(before) < 1e-3 * step) continue;
                const Vec3d after = moved(u + du, v + dv) - moved(u - du, v - dv);
                least = std::min(least, glm::dot(before, after) / glm::dot(before, before));
            }
        }
    return least;
}

/// What bake displace does to a shape under the constant height b: counts of its report.
std::string displaced_report(const std::string& shape, double b) {
    const BaseSurface base(ParametricSurface(shape), 16, 8);
    Relief relief;
    relief.values = Image<float>(1, 1, 1);
    relief.values.at(0, 0) = 1;
    relief.height = {.amplitude = b, .midlevel = 0};
    DisplaceOptions options;
    options.rates.levels = 1;
    const DisplaceReport report = displace(base, relief, options).report;
    return report.folded == 0 ? "exit 0, no note" : "exit 0, folded points counted, a note with the smallest 1 + b a";
}

std::vector<Row> focal_rows(int steps) {
    const auto sphere = [](double u, double v) { return oracle::sphere(1, u, 0.9 * (v - pi / 2)); };
    const auto torus = [](double u, double v) { return oracle::torus(2, 0.7, u, v); };
    std::vector<Row> rows;
    for (const double x : linear_steps(0, 2, steps)) // past the second focal radius of the sphere all is inside out
        rows.push_back({"sphere inward", x, measured_margin(sphere, -x), 1 - x, displaced_report("sphere:R=1", -x)});
    for (const double x : linear_steps(0, 2, steps))
        rows.push_back({"torus inward; x r", x, measured_margin(torus, -0.7 * x), 1 - x,
                        displaced_report("torus:R=2,r=0.7", -0.7 * x)});
    for (const double x : linear_steps(0, 2, steps)) // in the hole, where the ring's curvature is negative
        rows.push_back({"torus outward; x (R - r)", x, measured_margin(torus, 1.3 * x), 1 - x,
                        displaced_report("torus:R=2,r=0.7", 1.3 * x)});
    return rows;
}

/// A tilt of a sphere whose relief has a constant offset: what blinn makes of the slope, over what it is.
std::vector<Row> offset_rows(int steps) {
    std::vector<Row> rows;
    const Jet<double> s = oracle::sphere(1, 0.2, 0);
    for (const double c : geometric_steps(1e-3, 10, steps)) {
        const Height<double> h{c, 0, 0.5};
        const auto slope = [&](NormalMethod method) {
            const Vec3d n = displaced_normal(s, h, method);
            return -glm::dot(n, glm::normalize(s.p_v)) / glm::dot(n, s.n);
        };
        // A raised sphere of radius 1 + c is a sphere, and the relief on it the same relief on a larger one.
        const auto error = [&](NormalMethod method) {
            const double off = std::abs(slope(method) / (0.5 / (1 + c)) - 1);
            return off < 1e-12 ? 0 : off;
        };
        const char* rule = "exact takes the offset into account, blinn cannot; its note is that of blinn_curvature";
        rows.push_back({"blinn", c, error(NormalMethod::blinn), c, rule});
        rows.push_back({"exact", c, error(NormalMethod::exact), 0, rule});
    }
    return rows;
}

} // namespace

std::vector<Sweep> curvature_sweeps() {
    return {
        {.name = "blinn_curvature",
         .construction = "blinn against exact: the worst angle over all slopes; x = height times curvature",
         .x_label = "|height x curvature|",
         .y_label = "worst angle, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.318,
         .closed_form = "asin((max - min) / (max + min)) over 1 and 1 + b a, above .318 deg",
         .test = "stability/curvature_test",
         .rows = blinn_rows},
        {.name = "focal_radius",
         .construction = "a constant height on a sphere and a torus; smallest stretch of a short step",
         .x_label = "height over the focal radius",
         .y_label = "smallest 1 + b a",
         .limit = 0,
         .falls = true,
         .closed_form = "1 + b a = 0",
         .test = "stability/curvature_test",
         .rows = focal_rows},
        {.name = "height_offset",
         .construction = "a slope of .5 on a sphere under a constant offset; x = offset over radius",
         .x_label = "offset over radius",
         .y_label = "slope, relative error",
         .log_x = true,
         .log_y = true,
         .limit = 0.05,
         .closed_form = "blinn is off by c / R: 5 %",
         .test = "stability/curvature_test",
         .rows = offset_rows},
    };
}

} // namespace stability
