#include "bake/relief/map/normal_map.h"
#include "bake/base/parallel.h"
#include "bake/relief/map/texel_row.h"
#include <algorithm>
#include <atomic>
#include <cmath>

namespace bake {

namespace {

constexpr Vec3f flat_normal(0, 0, 1);

bool matches(const Image<float>& values, int width, int height) {
    return values.width() == width && values.height() == height;
}

bool shrinks(const Image<float>& values, int width, int height) {
    return values.width() >= 2 * width || values.height() >= 2 * height;
}

} // namespace

HeightField::HeightField(const HeightTexture& height, const HeightOptions& options, Filter filter, int width,
                         int height_texels)
    : width_(width), map_height_(height_texels), options_(options),
      minified_(shrinks(height.values, width, height_texels) ? box_minify(height.values, width, height_texels)
                                                             : Image<float>()),
      values_(minified_.empty() ? &height.values : &minified_),
      slopes_(*values_, resolve_filter(filter, height), options.wrap_u, options.wrap_v),
      spline_(resolve_filter(filter, height) == Filter::c2) {
    if (matches(*values_, width, height_texels)) return;
    if (spline_) {
        value_sampler_.emplace(*values_, Interpolation::c2, options);
        return;
    }
    Image<float> along_u(values_->width(), values_->height(), 1), along_v(values_->width(), values_->height(), 1);
    const auto scale_u = float(options.amplitude * values_->width()),
               scale_v = float(options.amplitude * values_->height());
    for_rows(values_->height(), 16, [&](std::int64_t begin, std::int64_t end) {
        SlopeFilter<float>::Scratch scratch;
        std::vector<float> pairs(2 * std::size_t(values_->width()));
        for (auto y = int(begin); y < int(end); ++y) {
            slopes_.row(y, scale_u, scale_v, pairs.data(), scratch);
            for (int x = 0; x < values_->width(); ++x) {
                along_u.at(x, y) = pairs[2 * x];
                along_v.at(x, y) = pairs[2 * x + 1];
            }
        }
    });
    const HeightOptions as_is{.amplitude = 1, .midlevel = 0, .wrap_u = options.wrap_u, .wrap_v = options.wrap_v};
    value_sampler_.emplace(*values_, Interpolation::catmull_rom, options);
    u_sampler_.emplace(along_u, Interpolation::catmull_rom, as_is);
    v_sampler_.emplace(along_v, Interpolation::catmull_rom, as_is);
}

void HeightField::row(int y, Height<float>* out, SlopeFilter<float>::Scratch& scratch) const {
    if (!value_sampler_) {
        // The pairs are written over the tail of the row of triples, ahead of where they are read.
        float* const pairs = reinterpret_cast<float*>(out) + width_;
        slopes_.row(y, float(options_.amplitude * width_), float(options_.amplitude * map_height_), pairs, scratch);
        const float* values = values_->row(y);
        for (int x = 0; x < width_; ++x) {
            const float b_u = pairs[2 * x], b_v = pairs[2 * x + 1];
            out[x] = {float(options_.amplitude) * (values[x] - float(options_.midlevel)), b_u, b_v};
        }
        return;
    }
    const float v = 1 - (float(y) + 0.5f) / float(map_height_);
    for (int x = 0; x < width_; ++x) {
        const float u = (float(x) + 0.5f) / float(width_);
        out[x] = value_sampler_->at(u, v);
        if (spline_) continue;
        out[x].b_u = u_sampler_->at(u, v).b;
        out[x].b_v = v_sampler_->at(u, v).b;
    }
}

Image<float> normal_map(const HeightField& field, const Vec2d& extent, const NormalMapOptions& options,
                        Progress* progress) {
    Jet<float> plane{};
    plane.p_u = Vec3f(float(extent.x), 0, 0);
    plane.p_v = Vec3f(0, float(extent.y), 0);
    plane.n = flat_normal;
    const ConstantScale<float> scale{float(extent.x), float(extent.y)};
    Image<float> map(field.width(), field.height(), 3);
    for_rows(
        field.height(), 16,
        [&](std::int64_t begin, std::int64_t end) {
            SlopeFilter<float>::Scratch scratch;
            std::vector<Height<float>> heights(field.width());
            for (auto y = int(begin); y < int(end); ++y) {
                field.row(y, heights.data(), scratch);
                float* to = map.row(y);
                for (int x = 0; x < field.width(); ++x, to += 3) {
                    const Vec3f n = unit_or_zero(displaced_normal(plane, heights[x], options.method, scale));
                    const Vec3f rgb = encode_normal(n, options.directx);
                    to[0] = rgb.x, to[1] = rgb.y, to[2] = rgb.z;
                }
            }
        },
        progress);
    return map;
}

Image<float> bake_texels(const HeightField& field, const BakeTarget& target, const NormalMapOptions& options,
                         Image<unsigned char>& owned, NormalMapReport& report, Progress* progress) {
    const int width = field.width(), height = field.height();
    Image<float> map(width, height, 3);
    std::atomic<std::int64_t> degenerate{0}, folded{0};
    for_rows(
        height, 16,
        [&](std::int64_t begin, std::int64_t end) {
            SlopeFilter<float>::Scratch scratch;
            std::vector<Height<float>> heights(width);
            TexelRow texels(target, options);
            for (auto y = int(begin); y < int(end); ++y) {
                field.row(y, heights.data(), scratch);
                texels.bake(y, heights.data(), map.row(y), owned.row(y));
            }
            degenerate += texels.counts().degenerate;
            folded += texels.counts().folded;
        },
        progress);
    const UvRaster& raster = target.raster;
    report = {raster.covered,       raster.border,         raster.overlapped,
              raster.outside_faces, raster.crossing_faces, raster.tiles};
    report.flat_triangles = raster.degenerate;
    for (const Triangle& t : target.surface.triangles)
        for (const std::uint32_t corner : t.corner)
            if (target.surface.mesh->corner_uv[corner] == no_index) {
                ++report.triangles_without_uv;
                break;
            }
    report.degenerate = degenerate;
    report.folded = folded;
    return map;
}

void pad_rest(Image<float>& map, const Image<unsigned char>& owned, int padding, NormalMapReport& report) {
    const std::int64_t texels = std::int64_t(map.width()) * map.height();
    const auto own =
        std::int64_t(std::count_if(owned.data(), owned.data() + owned.size(), [](unsigned char o) { return o != 0; }));
    report.padded = own == texels ? 0 : pad_texels(map, owned, padding);
    report.empty = texels - own - report.padded;
}

Image<float> normal_map(const HeightField& field, const BakeTarget& target, const NormalMapOptions& options,
                        NormalMapReport& report, Progress* progress) {
    Image<unsigned char> owned(field.width(), field.height(), 1);
    Image<float> map = bake_texels(field, target, options, owned, report, progress);
    pad_rest(map, owned, options.padding, report);
    return map;
}

} // namespace bake
