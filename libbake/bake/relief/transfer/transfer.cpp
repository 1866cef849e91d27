#include "bake/relief/transfer/transfer.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/transfer/finish_maps.h"
#include "bake/relief/transfer/gauss_legendre.h"
#include "bake/relief/transfer/texel_caster.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace bake {
namespace {

constexpr int band_rows = PlaceRaster::band_rows;

/// Of a rule of Gauss and Legendre in turn with the next, for one wave that is at least a texel long: the difference between the
/// two is at least five times the error of the second. A fifth part of safety is kept.
constexpr double differences_per_error = 4;

struct Place {
    Vec2d at; ///< in the texel
    float weight;
};

/// Gauss and Legendre's points in both directions.
std::vector<Place> rule_of(int rays) {
    std::vector<Place> rule;
    const std::vector<QuadraturePoint> points = gauss_legendre(rays);
    for (const QuadraturePoint& v : points)
        for (const QuadraturePoint& u : points) rule.push_back({{u.at, v.at}, float(u.weight * v.weight)});
    return rule;
}

/// With an error that is asked for, rules of more and more rays; else one; none for one ray, which is that of the centres.
std::vector<std::vector<Place>> rules_of(const TransferOptions& options) {
    std::vector<std::vector<Place>> rules;
    if (options.max_error_deg > 0)
        for (const int rays : {1, 2, 3, 4, 6, 8, 12})
            if (rays < options.rays) rules.push_back(rule_of(rays));
    if (options.rays > 1) rules.push_back(rule_of(options.rays));
    return rules;
}

/// Texels of a band of rows, while it is cast.
struct Band {
    int y = 0, rows = 0;             ///< the first of them, and how many
    std::vector<unsigned char> open; ///< per texel: it needs the rays of the next rule
    std::vector<Vec3f> mean;         ///< per texel: of the rule before; zero where it has none
    std::vector<TexelHit> hits;      ///< per place of a rule and texel
    CastCounts counts;
    RayPacket packet;
};

/// Calls work(x, y) for each texel of the band, y from its first row on, block by block.
template <class Work> void for_blocks(int width, int rows, int block, Work&& work) {
    for (int top = 0; top < rows; top += block)
        for (int left = 0; left < width; left += block)
            for (int y = top; y < std::min(top + block, rows); ++y)
                for (int x = left; x < std::min(left + block, width); ++x) work(x, y);
}

class Bake {
public:
    Bake(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
         const std::string& path, Transfer& out)
        : target_(target), options_(options), out_(out), rules_(rules_of(options)),
          weights_(!rules_.empty() && !options.details.maps.empty() ? Image<float>(options.width, options.height, 1)
                                                                    : Image<float>()),
          caster_(target, sources, options, out, weights_) {
        if (rules_.empty()) return;
        charts_.emplace(place_charts(*target.surface.mesh, target.surface.triangles, options.tile,
                                     std::max(options.width, options.height), path));
        raster_.emplace(*charts_->mesh, *charts_->triangles, options.width, options.height);
    }
    void run(Progress* progress);

private:
    void cast_band(Band& band);
    void cast_rule(const std::vector<Place>& rule, int first_number, Band& band);
    void cast_centres(Band& band);
    void reopen(Band& band);

    const BakeTarget& target_;
    const TransferOptions& options_;
    Transfer& out_;
    std::vector<std::vector<Place>> rules_;
    Image<float> weights_; ///< sums of the rays' weights, for other maps than the normal map
    TexelCaster caster_;
    std::optional<PlacedCharts> charts_;
    std::optional<PlaceRaster> raster_;
};

void Bake::run(Progress* progress) {
    TransferReport& report = out_.report;
    double parallax = 0;
    std::int64_t landed = 0;
    std::vector<Band> slots(static_cast<std::size_t>(slot_count()));
    in_order((options_.height + band_rows - 1) / band_rows,
             [&](std::int64_t b, int slot) {
                 Band& band = slots[std::size_t(slot)];
                 band.y = int(b) * band_rows, band.rows = std::min(band_rows, options_.height - band.y);
                 cast_band(band);
             },
             [&](std::int64_t, int slot) {
                 const CastCounts& c = slots[std::size_t(slot)].counts;
                 report.rays += c.rays, report.wider += c.wider, report.degenerate += c.degenerate;
                 report.nearest = std::min(report.nearest, c.nearest);
                 report.farthest = std::max(report.farthest, c.farthest);
                 for (std::size_t i = 0; i < c.lengths.size(); ++i) report.lengths[i] += c.lengths[i];
                 parallax += c.parallax, landed += c.landed;
                 report.parallax_max = std::max(report.parallax_max, c.most_parallax);
                 if (progress) progress->add(1);
             });
    report.parallax_mean = landed > 0 ? parallax / double(landed) : 0;
    if (landed == 0) report.nearest = report.farthest = 0;
    out_.far = caster_.far();
    finish_maps(out_, weights_, options_);
}

void Bake::cast_band(Band& band) {
    for (int y = band.y; y < band.y + band.rows; ++y)
        for (int x = 0; x < options_.width; ++x) caster_.clear(x, y);
    const std::size_t texels = std::size_t(band.rows) * std::size_t(options_.width);
    const TexelHit* const centres = target_.raster.hits.row(band.y);
    if (!rules_.empty()) band.open.resize(texels);
    for (std::size_t i = 0; i < band.open.size(); ++i) band.open[i] = centres[i].triangle != no_index;
    if (rules_.size() > 1) band.mean.assign(texels, Vec3f(0));
    band.counts = {};
    int number = 0;
    for (const std::vector<Place>& rule : rules_) {
        if (&rule != rules_.data()) reopen(band);
        cast_rule(rule, number, band);
        number += int(rule.size());
    }
    cast_centres(band);
}

/// Rays to the open texels, in packets of neighbours.
void Bake::cast_rule(const std::vector<Place>& rule, int first_number, Band& band) {
    const std::size_t width = std::size_t(options_.width), texels = band.open.size();
    if (std::find(band.open.begin(), band.open.end(), 1) == band.open.end()) return;
    band.hits.resize(texels * std::min<std::size_t>(rule.size(), packet_size));
    for (std::size_t begin = 0; begin < rule.size(); begin += packet_size) {
        const std::size_t places = std::min<std::size_t>(packet_size, rule.size() - begin);
        for (std::size_t i = 0; i < places; ++i)
            raster_->band(band.y / band_rows, rule[begin + i].at, {band.hits.data() + i * texels, texels});
        const int block = places == 1 ? 4 : places <= 4 ? 2 : 1; // texels along its sides
        const auto cast_texel = [&](int x, int y) {
            const std::size_t texel = std::size_t(y) * width + std::size_t(x);
            if (!band.open[texel]) return;
            for (std::size_t i = 0; i < places; ++i)
                if (const TexelHit& at = band.hits[i * texels + texel]; at.triangle != no_index) {
                    TexelHit given = at;
                    if (!charts_->source.empty()) given.triangle = charts_->source[at.triangle];
                    caster_.add({x, band.y + y, rule[begin + i].weight, first_number + int(begin + i), false}, given,
                                band.packet, band.counts);
                }
        };
        for_blocks(options_.width, band.rows, block, cast_texel);
    }
    caster_.flush(band.packet, band.counts);
}

/// Leaves open what the last two rules do not agree on, as if it had no ray yet.
void Bake::reopen(Band& band) {
    const double angle = std::min(180.0, differences_per_error * options_.max_error_deg) * std::numbers::pi / 180;
    const auto agreed = float(2 * std::sin(angle / 2)); // as a chord, which keeps the digits of small angles
    for (std::size_t i = 0; i < band.open.size(); ++i) {
        if (!band.open[i]) continue;
        const int x = int(i) % options_.width, y = band.y + int(i) / options_.width;
        const float* const sum = &out_.map.at(x, y);
        const Vec3f mean = unit_or_zero(Vec3f(sum[0], sum[1], sum[2]));
        band.open[i] = !(mean != Vec3f(0) && band.mean[i] != Vec3f(0) && glm::length(mean - band.mean[i]) <= agreed);
        band.mean[i] = mean;
        if (band.open[i]) caster_.clear(x, y);
    }
}

void Bake::cast_centres(Band& band) {
    for_blocks(options_.width, band.rows, 4, [&](int x, int y) {
        const TexelHit& at = target_.raster.hits.at(x, band.y + y);
        if (at.triangle != no_index && out_.states.at(x, band.y + y) == TexelState::outside)
            caster_.add({x, band.y + y, 1, 0, true}, at, band.packet, band.counts);
    });
    caster_.flush(band.packet, band.counts);
}

} // namespace

Transfer transfer(const BakeTarget& target, const HighSurface& high, const Casting& casting,
                  const TransferOptions& options, const std::string& path, Progress* progress) {
    return transfer(target, {{{&high, &casting}}, {}}, options, path, progress);
}

Transfer transfer(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
                  const std::string& path, Progress* progress) {
    Transfer out;
    out.map = Image<float>(options.width, options.height, 3);
    for (const DetailMap map : options.details.maps)
        out.details.emplace_back(options.width, options.height, channels(map));
    if (options.alpha) out.alpha = Image<float>(options.width, options.height, 1);
    out.states = Image<TexelState>(options.width, options.height, 1);
    out.report.nearest = INFINITY, out.report.farthest = -INFINITY;
    out.report.border = target.raster.border;
    Bake(target, sources, options, path, out).run(progress);
    return out;
}

} // namespace bake
