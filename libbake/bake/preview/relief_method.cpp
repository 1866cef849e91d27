#include "bake/preview/relief_method.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/text.h"
#include "bake/preview/widen.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/residual_map.h"
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <string_view>

namespace bake {
namespace {

constexpr int most_levels = 10;
constexpr std::pair<std::string_view, Shade> words[] = {
    {"plain", Shade::plain},
    {"roughness", Shade::roughness},
    {"constant-scale", Shade::constant_scale},
    {"blinn", Shade::blinn},
    {"exact", Shade::exact},
    {"bump", Shade::bump},
    {"bump+roughness", Shade::bump_roughness},
    {"normal", Shade::normal},
    {"displace", Shade::displace},
    {"displace+normal", Shade::displace_normal},
    {"high", Shade::high},
};

/// Tables and maps of slopes per unit of u and v.
BumpTableOptions table_options(const ReliefOptions& options) {
    BumpTableOptions table;
    table.filter = options.filter;
    table.wrap_u = options.height.wrap_u, table.wrap_v = options.height.wrap_v;
    table.amplitude = options.height.amplitude;
    return table;
}

/// Variance of the slope along u and v, in object units, averaged over the two axes and all texels.
double slope_variance(const HeightTexture& height, const ReliefOptions& options, const ConstantScale<float>& scale) {
    const Image<float> slopes = bump_table(height, table_options(options));
    double sum = 0;
    for (std::size_t i = 0; i < slopes.size(); i += 2) {
        const double u = slopes.data()[i] / scale.u, v = slopes.data()[i + 1] / scale.v;
        sum += 0.5 * (u * u + v * v);
    }
    return sum / (double(slopes.size()) / 2);
}

/// See widen.h.
void widen(Material& material, double variance) {
    using Model = Reflectance::Model;
    Reflectance& r = material.reflectance;
    if (r.model == Model::dielectric) return;
    const LobeKind kind = highlight(r.model);
    const Lobe lobe = widened({.kind = kind, .weight = r.specular, .exponent = r.shininess, .roughness = r.roughness},
                              float(variance));
    r.specular = lobe.weight, r.shininess = lobe.exponent, r.roughness = lobe.roughness;
}

/// Of the slopes that the cubic spline has.
std::shared_ptr<const Mips> spline_mips(const HeightTexture& height, const ReliefOptions& options) {
    BumpTableOptions table = table_options(options);
    table.filter = Filter::c2;
    return slope_mips(bump_table(height, table), options.height.wrap_u == Wrap::repeat);
}

NormalMapOptions map_options(const ReliefOptions& options, const HeightTexture& height) {
    NormalMapOptions map;
    map.width = height.values.width(), map.height = height.values.height();
    map.height_options = options.height;
    map.filter = options.filter;
    return map;
}

/// Texels of two faces that a note is worth, as a share of all that are covered.
constexpr double noted_overlap = 0.001;

/// A face that shares its texels with another one, or has none, is shaded wrongly by a map that is baked for this mesh.
void note_shared_texels(const NormalMapReport& report, const ReliefOptions& options, std::vector<std::string>& notes) {
    const double overlap = double(report.overlapped) / double(std::max<std::int64_t>(1, report.covered));
    if (overlap <= noted_overlap && report.outside_faces == 0) return;
    notes.push_back(format("%s: %.2g %% of the texels of its map lie in more than one face, and %lld faces outside the "
                           "unit square of uvs have none; their normals are those of other faces. Unwrap the mesh, or "
                           "take a method without a map of normals, such as \"bump\"",
                           name(options.method).c_str(), 100 * overlap, static_cast<long long>(report.outside_faces)));
}

/// Tangent-space normals of the height on a mesh; relative to `displaced`, if given.
Texture baked_normals(const Mesh& mesh, const HeightTexture& height, const ReliefOptions& options,
                      std::vector<std::string>& notes, const Mesh* displaced = nullptr) {
    const NormalMapOptions map = map_options(options, height);
    const auto target_of = [&](const Mesh& of) { return make_bake_target(of, "the mesh", map.width, map.height); };
    const BakeTarget target = target_of(mesh);
    const HeightField field(height, map.height_options, map.filter, map.width, map.height);
    NormalMapReport report;
    Image<float> normals = displaced ? residual_map(field, target, target_of(*displaced), map, report)
                                     : normal_map(field, target, map, report);
    note_shared_texels(report, options, notes);
    for (std::size_t i = 0; i < normals.size(); ++i) normals.data()[i] = 2 * normals.data()[i] - 1;
    return std::make_shared<const Image<float>>(std::move(normals));
}

/// Memory for a displaced mesh in a scene, beside the mesh: normals of its corners, two triangles per face, their copy in
/// world space and Embree's tree.
std::uint64_t scene_bytes(const DisplaceCount& count) noexcept {
    const std::uint64_t per_corner = sizeof(Vec3f), per_triangle = 12 + 16 + tree_bytes_per_triangle;
    return count.corners * per_corner + (count.corners - 2 * count.faces) * per_triangle + count.points * 12;
}

/// The same with tangents, and what baking a map for it takes.
std::uint64_t mapped_bytes(const DisplaceCount& count) noexcept {
    const std::uint64_t per_corner = 2 * sizeof(Vec4f) + 3 * sizeof(Vec3f);
    return scene_bytes(count) + count.corners * per_corner + (count.corners - 2 * count.faces) * 16;
}

std::unique_ptr<Shape> displaced_shape(const Shape& shape, const HeightTexture& height, const ReliefOptions& options,
                                       int levels) {
    std::shared_ptr<const BaseSurface> base = shape.smooth;
    if (!base) base = std::make_shared<const BaseSurface>(Mesh(shape.mesh));
    Relief relief{.values = Image<float>(height.values.width(), height.values.height(), 1), .vector = {}};
    std::copy_n(height.values.data(), height.values.size(), relief.values.data());
    relief.height = options.height;
    DisplaceOptions displacement;
    displacement.rates.levels = levels;
    displacement.taken = process_memory().resident;
    const bool mapped = options.method.shade == Shade::displace_normal;
    if (mapped) displacement.seam = Seam::average; // the map does not know of blended heights
    displacement.later.push_back({"", mapped ? mapped_bytes : scene_bytes});
    // A map of normals stands for all of them: facets are not seen.
    return make_shape(displace(*base, relief, displacement).mesh,
                      {.flat = shape.surface.flat && !mapped, .derivatives = false});
}

/// By levels, or by as many as memory allows.
void displace_shape(ReliefModel& model, const Shape& shape, const HeightTexture& height, const ReliefOptions& options) {
    int levels = options.method.levels;
    for (const bool most = levels < 0; !model.shape; --levels) {
        if (most && levels < 0) levels = most_levels;
        try {
            model.shape = displaced_shape(shape, height, options, levels);
            model.segments = 1 << levels;
        } catch (const Error& error) {
            if (!most || levels == 0 || error.refusal != Refusal::unsuitable) throw;
        }
    }
}

} // namespace

std::optional<ShadeMethod> parse_shade(const std::string& word) {
    const std::size_t colon = word.find(':');
    const std::string_view name = word == "lecture" ? "constant-scale" : std::string_view(word).substr(0, colon);
    for (const auto& [known, shade] : words) {
        if (known != name || shade == Shade::high) continue; // of meshes, not of heights
        ShadeMethod method{shade};
        if (displaces(shade) != (colon != std::string::npos)) return {};
        if (colon == std::string::npos) return method;
        const std::string_view rate = std::string_view(word).substr(colon + 1);
        if (rate == "max") return ShadeMethod{shade, -1};
        unsigned segments = 0;
        const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), segments);
        if (error != std::errc() || end != rate.data() + rate.size()) return {};
        if (!std::has_single_bit(segments) || segments > 1u << most_levels) return {};
        method.levels = std::countr_zero(segments);
        return method;
    }
    return {};
}

std::string name(const ShadeMethod& method) {
    for (const auto& [known, shade] : words)
        if (shade == method.shade)
            return std::string(known) + (!displaces(shade)   ? ""
                                         : method.levels < 0 ? ":max"
                                                             : ":" + std::to_string(1 << method.levels));
    return {};
}

ReliefModel with_relief(const Material& material, const Shape& shape, const HeightTexture& height,
                        const ReliefOptions& options) {
    ReliefModel model{material, nullptr};
    Material& m = model.material;
    const auto by_height = [&](NormalMethod method) {
        m.height = std::make_shared<const HeightSampler<float>>(height.values, Interpolation::c2, options.height);
        m.height_method = method;
        if (options.mips && options.height.wrap_u == options.height.wrap_v && options.height.wrap_u != Wrap::mirror)
            m.height_mips = spline_mips(height, options);
    };
    switch (options.method.shade) {
    case Shade::plain:
    case Shade::high: break;
    case Shade::roughness: widen(m, slope_variance(height, options, mean_scale(shape.surface))); break;
    case Shade::constant_scale:
        by_height(NormalMethod::constant_scale);
        m.height_scale = mean_scale(shape.surface);
        break;
    case Shade::blinn: by_height(NormalMethod::blinn); break;
    case Shade::exact: by_height(NormalMethod::exact); break;
    case Shade::bump:
    case Shade::bump_roughness:
        m.always_moments = options.method.shade == Shade::bump_roughness;
        m.bump_table = std::make_shared<const Image<float>>(bump_table(height, table_options(options)));
        break;
    case Shade::normal: m.normal_map = baked_normals(shape.mesh, height, options, model.notes); break;
    case Shade::displace: displace_shape(model, shape, height, options); break;
    case Shade::displace_normal:
        displace_shape(model, shape, height, options);
        m.normal_map = baked_normals(shape.mesh, height, options, model.notes, &model.shape->mesh);
    }
    return model;
}

} // namespace bake
