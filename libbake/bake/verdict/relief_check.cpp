#include "bake/verdict/relief_check.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/relief/displace/relief_surface.h"
#include "bake/relief/height/height_notes.h"
#include "bake/relief/height/tiling.h"
#include "bake/relief/map/bake_budget.h"
#include "bake/relief/map/relief_points.h"
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

namespace bake {
namespace {

/// Side of the raster that finds the surface under a texel; finer ones change a mean little.
constexpr int raster_size = 512;
/// Texels of a border that are looked at.
constexpr int border_samples = 256;

struct Sums {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    double area = 0, height = 0, folded = 0;
    double margin = 1, b = 0; ///< at the place that is nearest to a fold
    Vec2d uv{0};
};

void add(const MethodSample& at, double area, Sums& sums) {
    const double b = at.h.b, margin = fold_margin(at.jet, b);
    sums.least = std::min(sums.least, b), sums.most = std::max(sums.most, b);
    sums.area += area, sums.height += area * b;
    if (margin <= 0) sums.folded += area;
    if (margin < sums.margin) sums.margin = margin, sums.b = b, sums.uv = at.uv;
}

void merge(const Sums& part, Sums& sums) {
    sums.least = std::min(sums.least, part.least), sums.most = std::max(sums.most, part.most);
    sums.area += part.area, sums.height += part.height, sums.folded += part.folded;
    if (part.margin < sums.margin) sums.margin = part.margin, sums.b = part.b, sums.uv = part.uv;
}

void measure_heights(const ReliefPoints& points, ReliefCheck& check) {
    constexpr std::int64_t block = 1024;
    std::vector<Sums> blocks((points.count() + block - 1) / block);
    for_rows(std::int64_t(blocks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin * block; i < std::min(end * block, points.count()); ++i)
            if (const auto at = points.at(i)) add(*at, points.area(i), blocks[i / block]);
    });
    Sums sums;
    for (const Sums& part : blocks) merge(part, sums);
    if (!(sums.area > 0)) return;
    check.least = sums.least, check.most = sums.most, check.mean = sums.height / sums.area;
    check.folded = sums.folded / sums.area;
    check.fold_margin = sums.margin, check.fold_uv = sums.uv;
    if (sums.margin < 1) check.focal = std::abs(sums.b) / (1 - sums.margin);
}

/// The tilt, rms over the texels of the first and the last column (rows with `v`), by a step of `step` values across the
/// border: the slope there is off by the sum of the filter's taps, all of which reach across it.
double ridge_deg(const BudgetInput& in, double step, bool v) {
    const Stencil taps = stencil(in.filter);
    double sum = 0;
    for (const double tap : taps.taps) sum += tap;
    const Image<float>& values = *in.values;
    const int texels = v ? values.height() : values.width();
    const double slope = in.options.amplitude * step * sum * texels;
    double squares = 0;
    int count = 0;
    for (int i = 0; i < border_samples; ++i)
        for (const double across : {0.5 / texels, 1 - 0.5 / texels}) {
            const double along = (i + 0.5) / border_samples;
            const auto jet = in.jet(v ? along : across, v ? across : along);
            if (!jet || jet->sigma == 0) continue;
            const Height<double> ridge{0, v ? 0 : slope, v ? slope : 0};
            const double angle = angle_between(displaced_normal(*jet, ridge, NormalMethod::exact), jet->n);
            squares += angle * angle, ++count;
        }
    return count > 0 ? glm::degrees(std::sqrt(squares / count)) : 0;
}

/// The terms that depend on the texels, as those of a normal map.
void measure_texels(const Mesh& mesh, const HeightTexture& height, const HeightOptions& options, ReliefCheck& check) {
    std::optional<BakeTarget> target;
    try {
        target = make_bake_target(mesh, "", raster_size, raster_size);
    } catch (const Error& error) { // charts in several tiles, or without area
        if (error.refusal != Refusal::unsuitable) throw;
        return;
    }
    const NormalMapOptions map{.width = height.values.width(),
                               .height = height.values.height(),
                               .height_options = options,
                               .filter = check.filter};
    const HeightField field(height, options, check.filter, map.width, map.height);
    const BudgetInput input = mesh_budget(height, field, map, *target, Depth::float32);
    check.budget = error_budget(input);
    check.better_filter = better_filter(input, *check.budget);
    const Tiling tiling = measure_tiling(height.values);
    if (options.wrap_u == Wrap::repeat && tiling.x.breaks())
        check.ridge_u_deg = ridge_deg(input, tiling.x.border, false);
    if (options.wrap_v == Wrap::repeat && tiling.y.breaks())
        check.ridge_v_deg = ridge_deg(input, tiling.y.border, true);
}

} // namespace

ReliefCheck check_relief(const Mesh& mesh, const HeightTexture& height, Filter filter, const HeightOptions& options) {
    ReliefCheck check;
    check.diagonal = diagonal(bounds(mesh));
    check.filter = resolve_filter(filter, height);
    check.doubts = height_notes(height, Wrap::clamp, Wrap::clamp); // the border has a measure of its own
    const MeshSurface surface = make_mesh_surface(mesh);
    const ReliefPoints points(surface, height, check.filter, options);
    measure_heights(points, check);
    const auto sample = [&](std::int64_t i) { return points.at(i); };
    const ConstantScale<float> scale = mean_scale(surface);
    check.blinn = method_error(NormalMethod::blinn, {}, points.count(), sample);
    check.constant_scale = method_error(NormalMethod::constant_scale, {scale.u, scale.v}, points.count(), sample);
    measure_texels(mesh, height, options, check);
    return check;
}

ReliefReport inspect_relief(const std::string& path, const Mesh& mesh, const std::string& height_path,
                            const HeightTexture& height, Filter filter, const HeightOptions& options) {
    if (mesh.corner_uv.empty()) throw Error(Refusal::unsuitable, path + ": has no uvs; unwrap the mesh first");
    ReliefReport report{.file = path, .height_file = height_path, .options = options, .check = {}, .findings = {}};
    report.check = check_relief(mesh, height, filter, options);
    report.findings = judge(report);
    return report;
}

} // namespace bake
