// OpenSubdiv's Far splits the cage round its features and gives control points of B-spline, box-spline and Gregory
// patches, in double. Here each becomes one polynomial in powers (limit_patches.h), so that one kernel serves all.
//
// Gregory patches stand in for the surface where the splitting ends. Their four or three pairs of inner points are
// averaged, which makes them polynomials with the same corners, tangents and borders.
#include "bake/surface/subdivision.h"
#include "bake/base/error.h"
#include "bake/surface/limit_patches.h"
#include "bake/surface/subdivision_refiner.h"
#include <cassert>
#include <cmath>
#include <new>
#include <limits>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>

namespace bake {
namespace {

using namespace OpenSubdiv;

constexpr std::int32_t missing = std::numeric_limits<std::int32_t>::min();

// From control points to coefficients: terms x points.
struct Conversion {
    int points = 0;
    std::vector<double> weight;
};

// Exponents of a and b in the order of LimitPatches, and as many places in the leaf that determine a polynomial.
struct Terms {
    std::vector<std::pair<int, int>> exponents;
    std::vector<Vec2d> places;
    explicit Terms(bool triangles) {
        const int degree = triangles ? 4 : 3;
        for (int m = 0; m <= degree; ++m)
            for (int n = 0; n <= (triangles ? degree - m : degree); ++n) {
                exponents.emplace_back(m, n);
                places.emplace_back(double(m) / degree, double(n) / degree);
            }
    }
    int count() const noexcept { return int(exponents.size()); }
};

// The polynomials whose values at the places are given: Gauss's elimination, in place. values: places x points.
void interpolate(const Terms& terms, std::vector<double>& values, int points) {
    const int n = terms.count();
    std::vector<double> a(std::size_t(n * n));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            a[std::size_t(i * n + j)] = std::pow(terms.places[std::size_t(i)].x, terms.exponents[std::size_t(j)].first) *
                                        std::pow(terms.places[std::size_t(i)].y, terms.exponents[std::size_t(j)].second);
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

// B-splines and box-splines, from Far's own weights at the places. Their coefficients are whole multiples of 1/36 and
// 1/12: rounding to those takes away the elimination's noise.
Conversion spline_conversion(const Terms& terms, bool triangles, const Far::PatchTable& table,
                             const Far::PatchTable::PatchHandle& handle, const Far::PatchParam& param, bool face_varying) {
    Conversion conversion{triangles ? 12 : 16, {}};
    for (const Vec2d& place : terms.places) {
        double s = place.x, t = place.y, weights[20] = {};
        if (triangles)
            param.UnnormalizeTriangle(s, t);
        else
            param.Unnormalize(s, t);
        if (face_varying)
            table.EvaluateBasisFaceVarying(handle, s, t, weights);
        else
            table.EvaluateBasis(handle, s, t, weights);
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

// Faces of uvs that are not smoothed.
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

// Far's Gregory points in the order of Bezier's, pairs where two are averaged: row after row along a.
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
                // Bernstein's polynomial (i, j) in powers.
                const auto [m, n] = terms.exponents[std::size_t(term)];
                if (m < i || n < j) continue;
                const double sign = (m - i + n - j) % 2 ? -1 : 1;
                const double weight =
                    triangles ? sign * binomial(degree, i) * binomial(degree - i, j) * binomial(degree - i - j, m - i) *
                                    binomial(degree - m - j, n - j)
                              : sign * binomial(3, i) * binomial(3 - i, m - i) * binomial(3, j) * binomial(3 - j, n - j);
                for (int k = 0; k < 2; ++k) conversion.weight[std::size_t(term * conversion.points + pair[k])] += weight / 2;
            }
        }
    return conversion;
}

// Control points of every level, and the ends' own after them.
template <class V>
std::vector<Weighed<V>> refine_points(const Far::TopologyRefiner& refiner, std::vector<Weighed<V>> base,
                                      const Far::StencilTableReal<double>* ends, bool face_varying) {
    const int total = face_varying ? refiner.GetNumFVarValuesTotal(0) : refiner.GetNumVerticesTotal();
    const int own = ends ? ends->GetNumStencils() : 0;
    std::vector<Weighed<V>> points = std::move(base);
    points.resize(std::size_t(total + own));
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    Weighed<V>* from = points.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        const Far::TopologyLevel& above = refiner.GetLevel(level - 1);
        Weighed<V>* to = from + (face_varying ? above.GetNumFVarValues(0) : above.GetNumVertices());
        if (face_varying)
            primvars.InterpolateFaceVarying(level, from, to, 0);
        else
            primvars.Interpolate(level, from, to);
        from = to;
    }
    if (own > 0) ends->UpdateValues(points.data(), points.data() + total);
    return points;
}

template <class V>
void convert(const Conversion& conversion, const std::vector<Weighed<V>>& points, const Far::ConstIndexArray& index,
             std::size_t terms, double* out) noexcept {
    constexpr int size = V::length();
    const double* weight = conversion.weight.data();
    for (std::size_t term = 0; term < terms; ++term) {
        V sum(0);
        for (int i = 0; i < conversion.points; ++i, ++weight)
            if (*weight != 0) sum += *weight * points[std::size_t(index[i])].value;
        for (int k = 0; k < size; ++k) *out++ = sum[k];
    }
}

// Where a leaf lies, and how deep.
struct LeafPlace {
    LimitLeaf leaf;
    int depth;
    Vec2d centre; ///< in the patch
};

LeafPlace place_of(const Far::PatchParam& param, bool triangles) {
    LeafPlace place;
    place.depth = param.GetDepth() - param.NonQuadRoot();
    const double parts = double(1 << place.depth);
    const bool turned = triangles && param.IsTriangleRotated();
    if (turned)
        place.leaf = {-parts, Vec2d(parts - param.GetU(), parts - param.GetV())};
    else
        place.leaf = {parts, Vec2d(-double(param.GetU()), -double(param.GetV()))};
    place.centre = (Vec2d(triangles ? 1.0 / 3 : 0.5) - place.leaf.origin) / place.leaf.scale;
    return place;
}

void insert_leaf(LimitPatches& limit, std::int32_t& root, const LeafPlace& place, std::int32_t leaf) {
    std::int32_t node = -1; // where the link to the next one is kept; -1 for the root's own
    int child = 0;
    double s = place.centre.x, t = place.centre.y;
    const auto link = [&]() -> std::int32_t& { return node < 0 ? root : limit.nodes[std::size_t(4 * node + child)]; };
    for (int depth = 0; depth < place.depth; ++depth) {
        if (link() == missing) {
            const auto added = std::int32_t(limit.nodes.size() / 4);
            link() = added;
            limit.nodes.insert(limit.nodes.end(), 4, missing);
        }
        node = link();
        child = step_into_child(limit.triangles, s, t);
    }
    link() = ~leaf;
}

bool is_complete(const LimitPatches& limit, std::int32_t root) noexcept {
    if (root == missing) return false;
    if (root < 0) return true;
    for (int child = 0; child < 4; ++child)
        if (!is_complete(limit, limit.nodes[std::size_t(4 * root + child)])) return false;
    return true;
}

// One patch per quad or triangle, n for other faces of n corners under Catmull-Clark: Far's ptex faces, in its order.
std::vector<LimitPatch> list_patches(const Mesh& cage, bool triangles) {
    std::vector<LimitPatch> patches;
    for (std::uint32_t f = 0; f < cage.faces(); ++f) {
        const std::uint32_t size = cage.face_begin[f + 1] - cage.face_begin[f];
        const bool whole = triangles || size == 4;
        for (std::uint32_t corner = 0; corner < (whole ? 1 : size); ++corner) patches.push_back({f, corner, missing});
    }
    return patches;
}

// Where Far's control points become coefficients. Spline conversions differ by which sides are borders.
class Conversions {
public:
    Conversions(const Far::PatchTable& table, bool triangles)
        : terms_(triangles), triangles_(triangles), table_(table), gregory_(gregory_conversion(terms_, triangles)),
          linear_(linear_conversion(terms_, triangles)) {}

    const Conversion& of(Far::PatchDescriptor::Type type, const Far::PatchTable::PatchHandle& handle,
                         const Far::PatchParam& param, bool face_varying) {
        switch (type) {
        case Far::PatchDescriptor::GREGORY_BASIS:
        case Far::PatchDescriptor::GREGORY_TRIANGLE: return gregory_;
        case Far::PatchDescriptor::QUADS:
        case Far::PatchDescriptor::TRIANGLES: return linear_;
        default: break;
        }
        Conversion& spline = spline_[param.GetBoundary()];
        if (spline.points == 0) spline = spline_conversion(terms_, triangles_, table_, handle, param, face_varying);
        return spline;
    }
    int terms() const noexcept { return terms_.count(); }

private:
    Terms terms_;
    bool triangles_;
    const Far::PatchTable& table_;
    Conversion gregory_, linear_;
    Conversion spline_[32];
};

std::unique_ptr<Far::PatchTable> make_patch_table(Far::TopologyRefiner& refiner, bool uvs, int isolation) {
    Far::PatchTableFactory::Options options(isolation);
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    options.SetFVarPatchPrecision<double>();
    options.useInfSharpPatch = true;
    options.generateVaryingTables = false;
    options.generateFVarTables = uvs;
    options.generateFVarLegacyLinearPatches = false;
    options.generateLegacySharpCornerPatches = false; // or smooth corners of the border would be taken for sharp ones
    refiner.RefineAdaptive(options.GetRefineAdaptiveOptions());
    return std::unique_ptr<Far::PatchTable>(Far::PatchTableFactory::Create(refiner, options));
}

void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit) {
    limit.triangles = options.scheme == Scheme::loop;
    UvValues uvs = uv_values(cage);
    limit.has_uv = !uvs.corner.empty();
    const std::unique_ptr<Far::TopologyRefiner> refiner = make_refiner(cage, uvs, options);
    const std::unique_ptr<Far::PatchTable> table = make_patch_table(*refiner, limit.has_uv, options.isolation);

    std::vector<Weighed<Vec3d>> base(cage.positions.size());
    for (std::size_t i = 0; i < base.size(); ++i) base[i].value = Vec3d(cage.positions[i]);
    const auto points = refine_points(*refiner, std::move(base), table->GetLocalPointStencilTable<double>(), false);
    std::vector<Weighed<Vec2d>> uv_points;
    if (limit.has_uv)
        uv_points = refine_points(*refiner, std::move(uvs.values), table->GetLocalPointFaceVaryingStencilTable<double>(0), true);

    limit.patches = list_patches(cage, limit.triangles);
    Conversions conversions(*table, limit.triangles);
    const auto terms = std::size_t(conversions.terms());
    limit.leaves.reserve(std::size_t(table->GetNumPatchesTotal()));
    limit.position.resize(std::size_t(table->GetNumPatchesTotal()) * terms * 3);
    limit.uv.resize(limit.has_uv ? std::size_t(table->GetNumPatchesTotal()) * terms * 2 : 0);
    for (int array = 0; array < table->GetNumPatchArrays(); ++array) {
        const Far::PatchDescriptor::Type type = table->GetPatchArrayDescriptor(array).GetType();
        for (int i = 0; i < table->GetNumPatches(array); ++i) {
            const std::size_t leaf = limit.leaves.size();
            const Far::PatchParam param = table->GetPatchParam(array, i);
            Far::PatchTable::PatchHandle handle;
            handle.arrayIndex = array;
            handle.patchIndex = int(leaf); // counted through all arrays
            handle.vertIndex = i * table->GetPatchArrayDescriptor(array).GetNumControlVertices();
            convert(conversions.of(type, handle, param, false), points, table->GetPatchVertices(array, i), terms,
                    &limit.position[leaf * terms * 3]);
            if (limit.has_uv) {
                const Far::PatchParam uv_param = table->GetPatchFVarPatchParam(array, i, 0);
                const Far::PatchDescriptor::Type uv_type =
                    (uv_param.IsRegular() ? table->GetFVarPatchDescriptorRegular(0) : table->GetFVarPatchDescriptorIrregular(0))
                        .GetType();
                convert(conversions.of(uv_type, handle, uv_param, true), uv_points, table->GetPatchFVarValues(array, i, 0),
                        terms, &limit.uv[leaf * terms * 2]);
            }
            const LeafPlace place = place_of(param, limit.triangles);
            limit.leaves.push_back(place.leaf);
            insert_leaf(limit, limit.patches[std::size_t(param.GetFaceId())].root, place, std::int32_t(leaf));
        }
    }
    // Faces at a border that is not followed have no surface.
    std::erase_if(limit.patches, [&](const LimitPatch& patch) { return !is_complete(limit, patch.root); });
}

} // namespace

struct SubdivisionSurface::Limit {
    LimitPatches patches;
};

SubdivisionSurface::SubdivisionSurface(const Mesh& cage, const SubdivisionOptions& options)
    : limit_(std::make_unique<Limit>()) {
    assert(options.isolation >= 1 && options.isolation <= 10);
    try {
        make_patches(cage, options, limit_->patches);
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, "the subdivision surface needs more memory than there is; use a smaller cage or "
                                         "fewer semi-sharp creases");
    }
}
SubdivisionSurface::~SubdivisionSurface() = default;
SubdivisionSurface::SubdivisionSurface(SubdivisionSurface&&) noexcept = default;

std::uint32_t SubdivisionSurface::patches() const noexcept { return std::uint32_t(limit_->patches.patches.size()); }
std::uint32_t SubdivisionSurface::face(std::uint32_t patch) const noexcept { return limit_->patches.patches[patch].face; }
std::uint32_t SubdivisionSurface::corner(std::uint32_t patch) const noexcept { return limit_->patches.patches[patch].corner; }
bool SubdivisionSurface::has_uv() const noexcept { return limit_->patches.has_uv; }

void SubdivisionSurface::evaluate(std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
                                  std::span<LimitPoint> out) const noexcept {
    bake::evaluate(limit_->patches, patch, st, order, out);
}

void SubdivisionSurface::evaluate_lattice(std::uint32_t patch, int rate, Derivatives order,
                                          std::span<LimitPoint> out) const noexcept {
    evaluate_rows(patch, rate, 0, rate + 1, order, out);
}

void SubdivisionSurface::evaluate_rows(std::uint32_t patch, int rate, int row_begin, int row_end, Derivatives order,
                                       std::span<LimitPoint> out) const noexcept {
    bake::evaluate_rows(limit_->patches, patch, rate, row_begin, row_end, order, out);
}

} // namespace bake
