#include "bake/relief/transfer/bevel.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/transfer/finish_maps.h"
#include "bake/relief/transfer/map_frame.h"
#include "bake/relief/transfer/rolling_ball.h"
#include <atomic>

namespace bake {
namespace {

constexpr float alike = 0.87f; ///< cosine of 30 degrees: where normals turn faster, a border is not continued

struct Counts {
    std::int64_t tilted = 0, narrow = 0, degenerate = 0;
};

class Rows {
public:
    Rows(const BakeTarget& target, const RollingBall& ball, const BevelOptions& options, Transfer& out)
        : target_(target), ball_(ball), options_(options), out_(out) {}

    void bake(int y, Counts& counts) const noexcept {
        for (int x = 0; x < options_.width; ++x) {
            float* const rgb = &out_.map.at(x, y);
            const TexelHit& at = target_.raster.hits.at(x, y);
            Vec3f t(0);
            if (at.triangle != no_index) {
                const RollingBall::Rounded here = ball_.at(at.triangle, at.b1, at.b2);
                counts.tilted += here.tilted, counts.narrow += !here.fits;
                t = beyond_border(at, x, y, in_map(at, here));
                counts.degenerate += t == Vec3f(0);
            }
            out_.states.at(x, y) = t == Vec3f(0) ? TexelState::outside : TexelState::hit;
            for (int c = 0; c < 3; ++c) rgb[c] = t[c];
        }
    }

private:
    Vec3f in_map(const TexelHit& at, const RollingBall::Rounded& rounded) const noexcept {
        return MapFrame(target_, at.triangle, options_.space).in_map(Vec3f(rounded.normal), at);
    }
    /// As in a bake from high-poly meshes: what a bilinear filter reads on the border is then right on both sides of a seam.
    Vec3f beyond_border(const TexelHit& edge, int x, int y, const Vec3f& at_edge) const noexcept {
        const auto inside = mirrored_at_border(target_, edge, x, y, options_.width, options_.height);
        if (!inside) return at_edge;
        const Vec3f t = in_map(*inside, ball_.at(inside->triangle, inside->b1, inside->b2));
        return glm::dot(t, at_edge) > alike ? unit_or_zero(2.0f * at_edge - t) : at_edge;
    }

    const BakeTarget& target_;
    const RollingBall& ball_;
    const BevelOptions& options_;
    Transfer& out_;
};

} // namespace

Bevel bevel(const BakeTarget& target, const BevelOptions& options, Progress* progress) {
    const SmoothPatches patches(target.surface);
    const RollingBall ball(target.surface, patches, options.radius);
    Transfer out;
    out.map = Image<float>(options.width, options.height, 3);
    out.states = Image<TexelState>(options.width, options.height, 1);
    const Rows rows(target, ball, options, out);
    std::atomic<std::int64_t> tilted{0}, narrow{0}, degenerate{0};
    for_rows(
        options.height, 4,
        [&](std::int64_t begin, std::int64_t end) {
            Counts counts;
            for (auto y = int(begin); y < int(end); ++y) rows.bake(y, counts);
            tilted += counts.tilted, narrow += counts.narrow, degenerate += counts.degenerate;
        },
        progress);
    TransferOptions finish;
    finish.width = options.width, finish.height = options.height;
    finish.space = options.space, finish.directx = options.directx, finish.padding = options.padding;
    finish_maps(out, {}, finish);
    Bevel result{.map = std::move(out.map), .report = {}};
    BevelReport& report = result.report;
    for (const HardEdge& edge : patches.edges()) ++(edge.convex ? report.convex : report.concave);
    report.kept = std::int64_t(patches.kept());
    report.tilted = tilted, report.narrow = narrow;
    report.texels = out.report;
    report.texels.degenerate = degenerate, report.texels.border = target.raster.border;
    return result;
}

} // namespace bake
