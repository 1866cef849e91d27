#include "bake/relief/map/error_budget.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace bake {

double angle_between(const Vec3d& a, const Vec3d& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

float as_half(float value) noexcept {
    const float size = std::abs(value);
    if (!(size > 0)) return value;
    // The spacing of halves near the value: 10 bits below its leading one, 2^-24 at the least.
    const float spacing = std::max(std::exp2(std::floor(std::log2(size)) - 10), std::exp2(-24.0f));
    return std::nearbyint(value / spacing) * spacing;
}

namespace {

struct Squares {
    double filter = 0, filter_noise = 0, quantisation = 0, encoding = 0, method = 0;
    int samples = 0;
};

/// Angle per unit of b_u and of b_v at a jet, by central differences: slopes move the normal smoothly.
Vec2d sensitivity(const BudgetInput& in, const Jet<double>& jet, const Height<double>& h) {
    const auto turned = [&](double du, double dv) {
        const Height<double> moved{h.b, h.b_u + du, h.b_v + dv};
        return displaced_normal(jet, moved, in.method, in.scale);
    };
    const double du = 1e-4 * (glm::length(jet.p_u) + std::abs(h.b_u)),
                 dv = 1e-4 * (glm::length(jet.p_v) + std::abs(h.b_v));
    if (!(du > 0) || !(dv > 0)) return Vec2d(0);
    return {angle_between(turned(du, 0), turned(-du, 0)) / (2 * du),
            angle_between(turned(0, dv), turned(0, -dv)) / (2 * dv)};
}

void add_sample(const BudgetInput& in, const Jet<double>& jet, const Height<double>& h, const Height<double>& sharp,
                const Vec2d& noise, const Vec2d& difference_noise, Squares& sum) {
    const Vec3d n = displaced_normal(jet, h, in.method, in.scale);
    const Vec3d reference = displaced_normal(jet, sharp, in.method, in.scale);
    if (n == Vec3d(0) || reference == Vec3d(0)) return;
    const auto square = [](double a) { return a * a; };
    const Vec2d turn = sensitivity(in, jet, h);
    sum.filter += square(angle_between(n, reference));
    sum.filter_noise += square(turn.x * difference_noise.x) + square(turn.y * difference_noise.y);
    sum.quantisation += square(turn.x * noise.x) + square(turn.y * noise.y);
    sum.encoding += square(in.encoding_angle(jet, h, glm::normalize(n)));
    sum.method += square(angle_between(n, displaced_normal(jet, h, NormalMethod::exact)));
    ++sum.samples;
}

} // namespace

ErrorBudget error_budget(const BudgetInput& in) {
    const Image<float>& values = *in.values;
    const int width = values.width(), height = values.height();
    const Stencil own = stencil(in.filter), sharp = sharp_stencil();
    const SlopeFilter<float> own_slopes(values, own, in.options.wrap_u, in.options.wrap_v);
    const SlopeFilter<float> sharp_slopes(values, sharp, in.options.wrap_u, in.options.wrap_v);
    const Vec2d scale = in.options.amplitude * Vec2d(width, height);
    const double sigma = in.step / std::sqrt(12.0);
    const Vec2d noise = glm::abs(scale) * (sigma * own.noise()),
                difference_noise = glm::abs(scale) * (sigma * noise_of_difference(own, sharp));

    const int rows = std::min(in.lattice, height), columns = std::min(in.lattice, width);
    std::vector<Squares> of_row(rows);
    for_rows(rows, 4, [&](std::int64_t begin, std::int64_t end) {
        for (auto j = begin; j < end; ++j) {
            const int y = int((2 * j + 1) * height / (2 * rows));
            for (int i = 0; i < columns; ++i) {
                // Columns shift from row to row, so that no period of the texture hides between them.
                const int x = int((std::int64_t(2 * i + 1) * width / (2 * columns) + 7 * j) % width);
                const auto jet = in.jet((x + 0.5) / width, 1 - (y + 0.5) / height);
                if (!jet || jet->sigma == 0) continue;
                const double b = in.options.amplitude * (double(values.at(x, y)) - in.options.midlevel);
                const auto [own_u, own_v] = own_slopes.at(x, y, float(scale.x), float(scale.y));
                const auto [sharp_u, sharp_v] = sharp_slopes.at(x, y, float(scale.x), float(scale.y));
                add_sample(in, *jet, {b, own_u, own_v}, {b, sharp_u, sharp_v}, noise, difference_noise, of_row[j]);
            }
        }
    });
    Squares sum;
    for (const Squares& row : of_row) {
        sum.filter += row.filter, sum.filter_noise += row.filter_noise, sum.quantisation += row.quantisation;
        sum.encoding += row.encoding, sum.method += row.method, sum.samples += row.samples;
    }
    ErrorBudget budget;
    budget.samples = sum.samples;
    budget.lossy = in.lossy;
    if (sum.samples == 0) return budget;
    const auto rms_deg = [&](double squares) {
        return std::min(180.0, glm::degrees(std::sqrt(std::max(0.0, squares) / sum.samples)));
    };
    budget.filter_deg = rms_deg(sum.filter - sum.filter_noise);
    budget.quantisation_deg = rms_deg(sum.quantisation);
    budget.encoding_deg = rms_deg(sum.encoding);
    budget.method_deg = rms_deg(sum.method);
    budget.total_deg = std::min(180.0, 1.5 * std::hypot(std::hypot(budget.filter_deg, budget.quantisation_deg),
                                                        std::hypot(budget.encoding_deg, budget.method_deg)));
    return budget;
}

std::optional<FilterAdvice> better_filter(const BudgetInput& input, const ErrorBudget& own) {
    if (input.lossy || !own.judged()) return {};
    // A coarse lattice is enough to rank them; the best is measured again as its own bake would be.
    BudgetInput other = input;
    other.lattice = 24;
    FilterAdvice best{input.filter, error_budget(other).total_deg};
    for (const Filter filter : all_filters) {
        other.filter = filter;
        const double total_deg = error_budget(other).total_deg;
        if (total_deg < best.total_deg) best = {filter, total_deg};
    }
    if (best.filter == input.filter) return {};
    other.filter = best.filter, other.lattice = input.lattice;
    best.total_deg = error_budget(other).total_deg;
    if (best.total_deg < 0.75 * own.total_deg) return best;
    return {};
}

} // namespace bake
