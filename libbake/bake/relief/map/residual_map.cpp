#include "bake/relief/map/residual_map.h"
#include "bake/base/parallel.h"
#include <atomic>

namespace bake {
namespace {

/// The frame of a point of a mesh, as interpolated for normal maps.
struct Frame {
    Vec3f tangent{0}, n{0};
    float sign = 1;
};

Frame frame_at(const BakeTarget& target, const TexelHit& hit) noexcept {
    const auto& corner = target.surface.triangles[hit.triangle].corner;
    const float b[3] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
    Frame frame{.sign = target.tangents[corner[0]].w};
    for (int k = 0; k < 3; ++k) {
        frame.tangent += b[k] * Vec3f(target.tangents[corner[k]]);
        frame.n += b[k] * target.surface.n[corner[k]];
    }
    return frame;
}

} // namespace

Image<float> residual_map(const HeightField& field, const BakeTarget& base, const BakeTarget& displaced,
                          const NormalMapOptions& options, NormalMapReport& report, Progress* progress) {
    NormalMapOptions in_object = options;
    in_object.space = Space::object;
    in_object.directx = false;
    Image<unsigned char> owned(field.width(), field.height(), 1);
    Image<float> map = bake_texels(field, base, in_object, owned, report, progress);
    std::atomic<std::int64_t> uncovered{0};
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t missing = 0;
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < map.width(); ++x) {
                float* rgb = &map.at(x, y);
                const TexelHit& hit = displaced.raster.hits.at(x, y);
                missing += owned.at(x, y) && hit.triangle == no_index;
                Vec3f t(0);
                if (owned.at(x, y) && hit.triangle != no_index) {
                    const Frame frame = frame_at(displaced, hit);
                    t = to_tangent_space(decode_normal({rgb[0], rgb[1], rgb[2]}, false), frame.tangent, frame.n,
                                         frame.sign);
                }
                owned.at(x, y) = t != Vec3f(0);
                const Vec3f encoded = encode_normal(owned.at(x, y) ? t : Vec3f(0, 0, 1), options.directx);
                for (int c = 0; c < 3; ++c) rgb[c] = encoded[c];
            }
        uncovered += missing;
    });
    report.uncovered = uncovered;
    pad_rest(map, owned, options.padding, report);
    return map;
}

} // namespace bake
