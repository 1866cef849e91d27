#include "bake/relief/map/method_error.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/surface/point/curvature.h"
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace bake {
namespace {

constexpr int lattice = 384;

double factor_between(double a, double b) noexcept { return a > 0 && b > 0 ? std::max(a / b, b / a) : 1; }

void add_sample(NormalMethod method, const ConstantScale<double>& scale, const MethodSample& at, MethodError& out) {
    const Jet<double>& jet = at.jet;
    const Height<double>& h = at.h;
    if (folds(jet, h.b)) return;
    const Vec3d n = displaced_normal(jet, h, method, scale), truth = displaced_normal(jet, h, NormalMethod::exact);
    if (n == Vec3d(0) || truth == Vec3d(0)) return;
    ++out.samples;
    const double angle = glm::degrees(angle_between(n, truth));
    if (angle > out.largest_deg) out.largest_deg = angle, out.uv = at.uv;
    const Curvature<double> bent = curvature(jet);
    out.bend = std::max({out.bend, std::abs(h.b * bent.a1), std::abs(h.b * bent.a2)});
    if (method != NormalMethod::constant_scale) {
        out.bound_deg = std::max(out.bound_deg, wrong_slope_bound_deg(1 + h.b * bent.a1, 1 + h.b * bent.a2));
        return;
    }
    const double u = glm::length(jet.p_u), v = glm::length(jet.p_v);
    out.stretch = std::max({out.stretch, factor_between(u, scale.u), factor_between(v, scale.v)});
    out.skew_deg = std::max(out.skew_deg, std::abs(90 - glm::degrees(angle_between(jet.p_u, jet.p_v))));
}

void merge(const MethodError& row, MethodError& out) {
    if (row.largest_deg > out.largest_deg) out.largest_deg = row.largest_deg, out.uv = row.uv;
    out.bound_deg = std::max(out.bound_deg, row.bound_deg);
    out.bend = std::max(out.bend, row.bend);
    out.stretch = std::max(out.stretch, row.stretch);
    out.skew_deg = std::max(out.skew_deg, row.skew_deg);
    out.samples += row.samples;
}

} // namespace

double wrong_slope_bound_deg(double d1, double d2) noexcept {
    const double most = std::max({1.0, d1, d2}), least = std::min({1.0, d1, d2});
    return least > 0 ? glm::degrees(std::asin((most - least) / (most + least))) : 180;
}

MethodError method_error(NormalMethod method, const ConstantScale<double>& scale, std::int64_t count,
                         const std::function<std::optional<MethodSample>(std::int64_t)>& sample) {
    MethodError error;
    if (method == NormalMethod::exact) return error;
    constexpr std::int64_t block = 1024;
    std::vector<MethodError> of_block((count + block - 1) / block);
    for_rows(std::int64_t(of_block.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin * block; i < std::min(end * block, count); ++i)
            if (const auto at = sample(i); at && at->jet.sigma != 0)
                add_sample(method, scale, *at, of_block[i / block]);
    });
    for (const MethodError& part : of_block) merge(part, error);
    return error;
}

MethodError method_error(const BudgetInput& in) {
    if (in.method == NormalMethod::exact) return {};
    const Image<float>& values = *in.values;
    const int width = values.width(), height = values.height();
    const SlopeFilter<float> slopes(values, in.filter, in.options.wrap_u, in.options.wrap_v);
    const Vec2d scale = in.options.amplitude * Vec2d(width, height);
    const std::int64_t rows = std::min(lattice, height), columns = std::min(lattice, width);
    return method_error(in.method, in.scale, rows * columns, [&](std::int64_t k) -> std::optional<MethodSample> {
        const int x = int((2 * (k % columns) + 1) * width / (2 * columns));
        const int y = int((2 * (k / columns) + 1) * height / (2 * rows));
        const Vec2d uv((x + 0.5) / width, 1 - (y + 0.5) / height);
        const auto jet = in.jet(uv.x, uv.y);
        if (!jet) return {};
        const auto [b_u, b_v] = slopes.at(x, y, float(scale.x), float(scale.y));
        return MethodSample{
            *jet, {in.options.amplitude * (double(values.at(x, y)) - in.options.midlevel), b_u, b_v}, uv};
    });
}

std::string describe(const MethodError& e, NormalMethod method) {
    if (e.largest_deg <= smallest_seen_deg) return "";
    std::string text = format("%s is off by up to %.2g deg here: ", std::string(name(method)).c_str(), e.largest_deg);
    if (method == NormalMethod::constant_scale)
        text +=
            format("the chart is stretched by a factor of up to %.3g against its mean, its axes are up to %.2g deg off "
                   "90, and max |height x curvature| = %.2g",
                   e.stretch, e.skew_deg, e.bend);
    else text += format("max |height x curvature| = %.2g", e.bend);
    return text;
}

} // namespace bake
