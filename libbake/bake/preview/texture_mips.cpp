#include "bake/preview/texture_mips.h"
#include "bake/base/parallel.h"
#include "bake/relief/map/bump_table.h"
#include <cmath>

namespace bake {
namespace {

/// Means over the unit square around each texel centre of what bilinear interpolation shows there.
///
/// Along one axis it is a straight line from the centre of one texel to that of the next. Integrated over half a texel on
/// both sides, a line has the mean (f- + 6 f0 + f+) / 8, and a product of two has
/// (f- g- + f+ g+) / 24 + 7/12 f0 g0 + (f- g0 + f0 g- + f+ g0 + f0 g+) / 12. The plane is the product of two axes.
class BoxMeans {
public:
    BoxMeans(const Image<float>& table, bool repeats)
        : around_{Image<float>(table.width() + 2, table.height() + 2, 1),
                  Image<float>(table.width() + 2, table.height() + 2, 1)} {
        const Wrap wrap = repeats ? Wrap::repeat : Wrap::clamp;
        for_rows(table.height() + 2, 16, [&](std::int64_t begin, std::int64_t end) {
            for (int y = int(begin); y < int(end); ++y) {
                const float* from = table.row(wrap_index(y - 1, table.height(), wrap));
                for (int x = 0; x < table.width() + 2; ++x) {
                    const int column = wrap_index(x - 1, table.width(), wrap);
                    for (int c = 0; c < 2; ++c) around_[c].at(x, y) = from[2 * column + c];
                }
            }
        });
    }

    /// The mean of channel a, as an image of one channel.
    Image<float> mean(int a) const {
        Image<float> out = empty();
        for_rows(out.height(), 16, [&](std::int64_t begin, std::int64_t end) {
            for (int y = int(begin); y < int(end); ++y) {
                const float *above = row(a, y - 1), *here = row(a, y), *below = row(a, y + 1);
                const auto along = [](const float* f, int x) { return (f[x] + 6 * f[x + 1] + f[x + 2]) / 8; };
                for (int x = 0; x < out.width(); ++x)
                    out.at(x, y) = (along(above, x) + 6 * along(here, x) + along(below, x)) / 8;
            }
        });
        return out;
    }

    /// The same of the product of channels a and b.
    Image<float> product(int a, int b) const {
        Image<float> out = empty();
        for_rows(out.height(), 16, [&](std::int64_t begin, std::int64_t end) {
            // Products of a row with itself, and with the next one, are of use to several rows.
            std::vector<float> same[3], cross[2];
            for (auto* rows : {&same[0], &same[1], &same[2], &cross[0], &cross[1]}) rows->resize(out.width());
            same_rows(int(begin) - 1, a, b, same[0].data()), same_rows(int(begin), a, b, same[1].data());
            cross_rows(int(begin) - 1, a, b, cross[0].data());
            for (int y = int(begin); y < int(end); ++y) {
                same_rows(y + 1, a, b, same[2].data()), cross_rows(y, a, b, cross[1].data());
                float* to = out.row(y);
                for (int x = 0; x < out.width(); ++x)
                    to[x] = (same[0][x] + same[2][x]) / 24 + 7 * same[1][x] / 12 + (cross[0][x] + cross[1][x]) / 12;
                same[0].swap(same[1]), same[1].swap(same[2]), cross[0].swap(cross[1]);
            }
        });
        return out;
    }

private:
    Image<float> empty() const { return {around_[0].width() - 2, around_[0].height() - 2, 1}; }
    /// Row y of a channel, from the texel before the first one on.
    const float* row(int c, int y) const noexcept { return around_[c].row(y + 1); }

    static float along(const float* f, const float* g, int x) noexcept {
        const float side = f[x] + f[x + 2], other = g[x] + g[x + 2];
        return (f[x] * g[x] + f[x + 2] * g[x + 2]) / 24 + 7 * f[x + 1] * g[x + 1] / 12 +
               (side * g[x + 1] + f[x + 1] * other) / 12;
    }
    void same_rows(int y, int a, int b, float* out) const noexcept {
        const float *f = row(a, y), *g = row(b, y);
        for (int x = 0; x < around_[0].width() - 2; ++x) out[x] = along(f, g, x);
    }
    void cross_rows(int y, int a, int b, float* out) const noexcept {
        const float *f = row(a, y), *g = row(b, y), *f_next = row(a, y + 1), *g_next = row(b, y + 1);
        for (int x = 0; x < around_[0].width() - 2; ++x) out[x] = along(f, g_next, x) + along(f_next, g, x);
    }

    Image<float> around_[2]; ///< the channels, and one texel beyond them on every side
};

void put_channel(const Image<float>& from, int channel, Image<float>& to) {
    for_rows(to.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < to.width(); ++x) to.at(x, y, channel) = from.at(x, y);
    });
}

/// The levels from the first one down.
std::shared_ptr<const Mips> from_level(Image<float>&& first, int width, int height, bool repeats) {
    auto mips = std::make_shared<Mips>();
    mips->width = width, mips->height = height, mips->repeats = repeats;
    mips->levels.push_back(std::move(first));
    while (mips->levels.back().width() > 1 || mips->levels.back().height() > 1)
        mips->levels.push_back(halve(mips->levels.back()));
    return mips;
}

} // namespace

std::shared_ptr<const Mips> colour_mips(const Image<float>& image) {
    return from_level(halve(image), image.width(), image.height(), true);
}

std::shared_ptr<const Mips> slope_mips(const Image<float>& table, bool repeats) {
    const BoxMeans means(table, repeats);
    // One channel at a time, so that the full resolution is never in memory with all five.
    Image<float> first(std::max(1, table.width() / 2), std::max(1, table.height() / 2), 5);
    put_channel(halve(means.mean(0)), 0, first);
    put_channel(halve(means.mean(1)), 1, first);
    put_channel(halve(means.product(0, 0)), 2, first);
    put_channel(halve(means.product(1, 1)), 3, first);
    put_channel(halve(means.product(0, 1)), 4, first);
    return from_level(std::move(first), table.width(), table.height(), repeats);
}

std::shared_ptr<const Mips> normal_mips(const Image<float>& normals) {
    Image<float> slopes(normals.width(), normals.height(), 2);
    for_rows(normals.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < normals.width(); ++x) {
                const float* t = &normals.at(x, y);
                const Vec2f s = slopes_of({t[0], t[1], t[2]});
                slopes.at(x, y, 0) = s.x, slopes.at(x, y, 1) = s.y;
            }
    });
    return slope_mips(slopes);
}

Vec2f slopes_of(const Vec3f& t) noexcept {
    constexpr float steepest = 10;
    const Vec2f across(-t.x, -t.y);
    const float most = std::max(std::abs(t.x), std::abs(t.y));
    if (most == 0) return Vec2f(0);
    return across / std::max(t.z, most / steepest);
}

Taps taps_of(const Mips& mips, const Vec2f& uv, const Footprint& footprint) noexcept {
    constexpr float sharp = 0.5f; // texels: a narrower footprint is a point
    Taps taps{.first = uv};
    const Vec2f texels(float(mips.width), float(mips.height));
    const float a = glm::length(footprint.major * texels), b = glm::length(footprint.minor * texels);
    const float longest = std::max(a, b), shortest = std::max(sharp, std::min(a, b));
    if (!(longest > sharp) || !std::isfinite(longest)) return taps;
    taps.count = int(std::clamp(std::ceil(longest / shortest), 1.0f, float(Taps::most)));
    taps.step = (a > b ? footprint.major : footprint.minor) / float(taps.count);
    taps.first = uv - 0.5f * float(taps.count - 1) * taps.step;
    const float width = std::max(shortest, longest / float(taps.count));
    if (width < 2) {
        // The variance of slopes within a footprint grows with the square of its width.
        taps.next = (width * width - sharp * sharp) / (4 - sharp * sharp);
        return taps;
    }
    const float level = std::log2(width) - 1, last = float(mips.levels.size() - 1);
    taps.level = int(std::min(level, last));
    taps.next = level < last ? level - float(taps.level) : 0;
    return taps;
}

} // namespace bake
