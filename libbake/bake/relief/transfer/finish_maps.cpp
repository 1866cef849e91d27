#include "bake/relief/transfer/finish_maps.h"
#include "bake/base/parallel.h"
#include "bake/picture/pad_texels.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/chart_ring.h"

namespace bake {
namespace {

/// The row of another map; `weights`: its row, or null.
void average(DetailMap map, const float* weights, const TransferOptions& options, float* row) noexcept {
    if (map == DetailMap::id) return;
    const int count = channels(map);
    for (int x = 0; x < options.width; ++x, row += count) {
        if (map == DetailMap::bent_normal) {
            const Vec3f n = unit_or_zero(Vec3f(row[0], row[1], row[2]));
            const Vec3f code = encode_normal(n == Vec3f(0) ? Vec3f(0, 0, 1) : n, options.directx);
            for (int c = 0; c < 3; ++c) row[c] = code[c];
        } else if (weights && weights[x] > 0) {
            for (int c = 0; c < count; ++c) row[c] /= weights[x];
        }
    }
}

void average(Transfer& out, const Image<float>& weights, const TransferOptions& options) {
    for_rows(options.height, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* rgb = out.map.row(y);
            for (int x = 0; x < options.width; ++x, rgb += 3) {
                const Vec3f n = unit_or_zero(Vec3f(rgb[0], rgb[1], rgb[2]));
                if (n == Vec3f(0) && out.states.at(x, y) == TexelState::hit) out.states.at(x, y) = TexelState::missed;
                const Vec3f code = encode_normal(n == Vec3f(0) ? Vec3f(0, 0, 1) : n, options.directx);
                for (int c = 0; c < 3; ++c) rgb[c] = code[c];
            }
            for (std::size_t m = 0; m < out.details.size(); ++m)
                average(options.details.maps[m], weights.empty() ? nullptr : weights.row(y), options,
                        out.details[m].row(y));
        }
    });
}

void count_states(Transfer& out, bool tangent) {
    for (int y = 0; y < out.map.height(); ++y)
        for (int x = 0; x < out.map.width(); ++x) switch (out.states.at(x, y)) {
            case TexelState::outside: break;
            case TexelState::unmatched: ++out.report.unmatched; break;
            case TexelState::hit:
                ++out.report.hit;
                out.report.outward += tangent && out.map.at(x, y, 2) <= 0.5f;
                break;
            case TexelState::behind: ++out.report.behind; [[fallthrough]];
            case TexelState::missed: ++out.report.missed; break;
            }
}

/// Whether padding leaves the texel as it is.
bool is_kept(TexelState state) noexcept { return state == TexelState::hit || state == TexelState::unmatched; }

void pad(Transfer& out, int padding) {
    Image<unsigned char> owned(out.map.width(), out.map.height(), 1);
    for (std::size_t i = 0; i < owned.size(); ++i) owned.data()[i] = is_kept(out.states.data()[i]);
    for (Image<float>& map : out.details) pad_texels(map, owned, padding);
    if (!out.alpha.empty()) {
        for (std::size_t i = 0; i < owned.size(); ++i) out.alpha.data()[i] = owned.data()[i];
        pad_texels(out.alpha, owned, padding);
        for (std::size_t i = 0; i < owned.size(); ++i)
            if (is_missed(out.states.data()[i]) || out.states.data()[i] == TexelState::unmatched)
                out.alpha.data()[i] = 0;
    }
    if (padding > 0) out.report.padded = continue_charts(out.map, owned);
    out.report.padded += pad_texels(out.map, owned, padding - 1);
    out.report.empty = std::int64_t(owned.size()) - out.report.hit - out.report.padded;
}

} // namespace

void finish_maps(Transfer& out, const Image<float>& weights, const TransferOptions& options) {
    average(out, weights, options);
    count_states(out, options.space == Space::tangent);
    pad(out, options.padding);
}

} // namespace bake
