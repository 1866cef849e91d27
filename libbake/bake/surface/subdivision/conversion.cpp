#include "bake/surface/subdivision/conversion.h"
#include <cassert>
#include <cmath>
#include <utility>

namespace bake {
namespace {

using namespace OpenSubdiv;

// Exponents of a and b in the order of LimitPatches, and one interpolation point in the leaf per term.
struct Terms {
    std::vector<std::pair<int, int>> exponents;
    std::vector<Vec2d> samples;
    explicit Terms(bool triangles) {
        const int degree = triangles ? 4 : 3;
        for (int n = 0; n <= degree; ++n)
            for (int m = 0; m <= (triangles ? degree - n : degree); ++m) {
                exponents.emplace_back(m, n);
                samples.emplace_back(double(m) / degree, double(n) / degree);
            }
    }
    int count() const noexcept { return int(exponents.size()); }
};

// Replaces the values of polynomials at the samples (samples x points) by their coefficients, by Gaussian elimination.
void interpolate(const Terms& terms, std::vector<double>& values, int points) {
    const int n = terms.count();
    std::vector<double> a(std::size_t(n * n));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            a[std::size_t(i * n + j)] =
                std::pow(terms.samples[std::size_t(i)].x, terms.exponents[std::size_t(j)].first) *
                std::pow(terms.samples[std::size_t(i)].y, terms.exponents[std::size_t(j)].second);
    const auto at = [n](int i, int j) { return std::size_t(i * n + j); };
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (std::abs(a[at(i, k)]) > std::abs(a[at(pivot, k)])) pivot = i;
        for (int j = 0; j < n; ++j) std::swap(a[at(k, j)], a[at(pivot, j)]);
        for (int j = 0; j < points; ++j)
            std::swap(values[std::size_t(k * points + j)], values[std::size_t(pivot * points + j)]);
        for (int i = 0; i < n; ++i) {
            if (i == k) continue;
            const double factor = a[at(i, k)] / a[at(k, k)];
            for (int j = k; j < n; ++j) a[at(i, j)] -= factor * a[at(k, j)];
            for (int j = 0; j < points; ++j)
                values[std::size_t(i * points + j)] -= factor * values[std::size_t(k * points + j)];
        }
    }
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < points; ++j) values[std::size_t(k * points + j)] /= a[at(k, k)];
}

// B-splines and box splines, from Far's weights at the samples. Their coefficients are multiples of 1/36 and 1/12; rounding
// to these multiples removes the noise of the elimination.
Conversion spline_conversion(const Terms& terms, bool triangles, const Far::PatchTable& table,
                             const Far::PatchTable::PatchHandle& handle, const Far::PatchParam& param,
                             bool face_varying) {
    Conversion conversion{triangles ? 12 : 16, {}};
    for (const Vec2d& sample : terms.samples) {
        double s = sample.x, t = sample.y, weights[20] = {};
        if (triangles) param.UnnormalizeTriangle(s, t);
        else param.Unnormalize(s, t);
        if (face_varying) table.EvaluateBasisFaceVarying(handle, s, t, weights);
        else table.EvaluateBasis(handle, s, t, weights);
        conversion.weight.insert(conversion.weight.end(), weights, weights + conversion.points);
    }
    interpolate(terms, conversion.weight, conversion.points);
    const double whole = triangles ? 12 : 36;
    for (double& weight : conversion.weight) {
        assert(std::abs(weight * whole - std::round(weight * whole)) < 1e-6);
        weight = std::round(weight * whole) / whole;
    }
    return conversion;
}

// Uvs that are interpolated linearly.
Conversion linear_conversion(const Terms& terms, bool triangles) {
    Conversion conversion{triangles ? 3 : 4, {}};
    for (const auto& exponent : terms.exponents) {
        std::vector<double> row(std::size_t(conversion.points), 0.0);
        if (exponent == std::pair(0, 0)) row[0] = 1;
        if (exponent == std::pair(1, 0)) row[0] = -1, row[1] = 1;
        if (exponent == std::pair(0, 1)) row[0] = -1, row.back() = 1;
        if (exponent == std::pair(1, 1) && !triangles) row = {1, -1, 1, -1};
        conversion.weight.insert(conversion.weight.end(), row.begin(), row.end());
    }
    return conversion;
}

double binomial(int n, int k) noexcept {
    double value = 1;
    for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
    return value;
}

// Far's Gregory points in the order of Bezier points, row after row along a. The two points of a pair are averaged.
constexpr int gregory_quad[16][2] = {{0, 0},   {1, 1},   {7, 7},   {5, 5},   {2, 2},   {3, 4},   {8, 9},   {6, 6},
                                     {16, 16}, {18, 19}, {13, 14}, {12, 12}, {15, 15}, {17, 17}, {11, 11}, {10, 10}};
constexpr int gregory_triangle[15][2] = {{0, 0}, {1, 1},   {15, 15}, {7, 7},   {5, 5},   {2, 2},   {3, 4},  {8, 9},
                                         {6, 6}, {17, 17}, {13, 14}, {16, 16}, {11, 11}, {12, 12}, {10, 10}};

Conversion gregory_conversion(const Terms& terms, bool triangles) {
    Conversion conversion{triangles ? 18 : 20, {}};
    conversion.weight.assign(std::size_t(terms.count() * conversion.points), 0.0);
    const int degree = triangles ? 4 : 3;
    for (int at = 0, j = 0; j <= degree; ++j)
        for (int i = 0; i <= (triangles ? degree - j : degree); ++i, ++at) {
            const int* pair = triangles ? gregory_triangle[at] : gregory_quad[at];
            for (int term = 0; term < terms.count(); ++term) {
                // Bernstein polynomial (i, j) in the power basis.
                const auto [m, n] = terms.exponents[std::size_t(term)];
                if (m < i || n < j) continue;
                const double sign = (m - i + n - j) % 2 ? -1 : 1;
                const double weight = triangles ? sign * binomial(degree, i) * binomial(degree - i, j) *
                                                      binomial(degree - i - j, m - i) * binomial(degree - m - j, n - j)
                                                : sign * binomial(3, i) * binomial(3 - i, m - i) * binomial(3, j) *
                                                      binomial(3 - j, n - j);
                for (int k = 0; k < 2; ++k)
                    conversion.weight[std::size_t(term * conversion.points + pair[k])] += weight / 2;
            }
        }
    return conversion;
}

} // namespace

Conversions::Conversions(const Far::PatchTable& table, bool triangles)
    : table_(table), triangles_(triangles), gregory_(gregory_conversion(Terms(triangles), triangles)),
      linear_(linear_conversion(Terms(triangles), triangles)) {}

const Conversion& Conversions::of(int array, int patch, int index, bool face_varying) {
    const Far::PatchDescriptor own = table_.GetPatchArrayDescriptor(array);
    const Far::PatchParam param =
        face_varying ? table_.GetPatchFVarPatchParam(array, patch, 0) : table_.GetPatchParam(array, patch);
    const Far::PatchDescriptor of = !face_varying       ? own
                                    : param.IsRegular() ? table_.GetFVarPatchDescriptorRegular(0)
                                                        : table_.GetFVarPatchDescriptorIrregular(0);
    switch (of.GetType()) {
    case Far::PatchDescriptor::GREGORY_BASIS:
    case Far::PatchDescriptor::GREGORY_TRIANGLE: return gregory_;
    case Far::PatchDescriptor::QUADS:
    case Far::PatchDescriptor::TRIANGLES: return linear_;
    default: break;
    }
    Conversion& spline = spline_[param.GetBoundary()];
    if (spline.points > 0) return spline;
    Far::PatchTable::PatchHandle handle;
    handle.arrayIndex = array;
    handle.patchIndex = index;
    handle.vertIndex = patch * own.GetNumControlVertices();
    return spline = spline_conversion(Terms(triangles_), triangles_, table_, handle, param, face_varying);
}

} // namespace bake
