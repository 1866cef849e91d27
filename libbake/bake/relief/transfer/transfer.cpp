#include "bake/relief/transfer/transfer.h"
#include "bake/base/parallel.h"
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

/// How many times larger than the error of the second the difference between two rules in turn is, at least, for a wave in any
/// direction: for radon_rule() and the centre if the wave is a texel long, for the others if it is 1.5 texels long.
constexpr double differences_of_centre = 15, differences_of_rules = 2.5;

/// How many times larger the error of one ray is than second differences of its neighbours tell, at most, for waves that are two
/// texels long.
constexpr float curvature_safety = 2.2f;

constexpr unsigned char all_rays = 2; ///< of an open texel: it needs the rays of the last rule

/// Length of the chord of an angle between unit vectors; it keeps the digits of small angles.
double chord_of(double degrees) noexcept { return 2 * std::sin(std::min(180.0, degrees) * std::numbers::pi / 360); }

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

/// Seven points, exact for polynomials of the degree 5. Radon, Zur mechanischen Kubatur, Monatshefte für Mathematik 52, 1948.
std::vector<Place> radon_rule() {
    const double far = std::sqrt(14.0 / 15) / 2, wide = std::sqrt(3.0 / 5) / 2, narrow = std::sqrt(1.0 / 3) / 2;
    std::vector<Place> rule{{{0.5, 0.5}, 2 / 7.f}};
    for (const double side : {-1, 1}) {
        rule.push_back({{0.5, 0.5 + side * far}, 5 / 63.f});
        for (const double other : {-1, 1}) rule.push_back({{0.5 + side * wide, 0.5 + other * narrow}, 5 / 36.f});
    }
    return rule;
}

/// What follows on one ray for each texel: nothing, the rule of all texels, or with an error that is asked for rules of more and
/// more rays, each for the texels on which the two rules before it do not agree.
std::vector<std::vector<Place>> rules_of(const TransferOptions& options) {
    std::vector<std::vector<Place>> rules;
    if (options.max_error_deg > 0) {
        if (options.rays > 2) rules.push_back(radon_rule());
        for (const int rays : {4, 8})
            if (rays < options.rays) rules.push_back(rule_of(rays));
    }
    if (options.rays > 1) rules.push_back(rule_of(options.rays));
    return rules;
}

/// Texels of a band of rows, while it is cast.
struct Band {
    int y = 0, rows = 0;        ///< the first of them, and how many
    std::vector<Vec3f> mean;    ///< per texel: of the rule before; zero where it has none
    std::vector<TexelHit> hits; ///< per place of a rule and texel
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
          caster_(target, sources, options, out, weights_), slots_(static_cast<std::size_t>(slot_count())) {
        if (rules_.empty()) return;
        charts_.emplace(place_charts(*target.surface.mesh, target.surface.triangles, options.tile,
                                     std::max(options.width, options.height), path));
        raster_.emplace(*charts_->mesh, *charts_->triangles, options.width, options.height);
        open_ = Image<unsigned char>(options.width, options.height, 1);
        for (std::size_t i = 0; i < open_.size(); ++i)
            open_.data()[i] = target.raster.hits.data()[i].triangle != no_index;
    }
    void run(TransferProgress* progress);

private:
    template <class Work> void for_bands(Work&& work, TransferProgress* progress);
    void cast_rules(Band& band);
    void cast_rule(const std::vector<Place>& rule, int first_number, Band& band);
    void cast_centres(Band& band);
    bool is_at_border(int x, int y) const noexcept;
    void open_by_centres();
    void reopen(Band& band, std::size_t rules);

    const BakeTarget& target_;
    const TransferOptions& options_;
    Transfer& out_;
    std::vector<std::vector<Place>> rules_;
    Image<float> weights_; ///< sums of the rays' weights, for other maps than the normal map
    TexelCaster caster_;
    std::optional<PlacedCharts> charts_;
    std::optional<PlaceRaster> raster_;
    Image<unsigned char> open_; ///< not 0: texels that need the rays of the next rule
    std::vector<Band> slots_;
    double parallax_ = 0; ///< sum over the rays that landed
    std::int64_t landed_ = 0;
};

/// Adds up what the bands count, in order.
template <class Work> void Bake::for_bands(Work&& work, TransferProgress* progress) {
    TransferReport& report = out_.report;
    in_order((options_.height + band_rows - 1) / band_rows,
             [&](std::int64_t b, int slot) {
                 Band& band = slots_[std::size_t(slot)];
                 band.y = int(b) * band_rows, band.rows = std::min(band_rows, options_.height - band.y);
                 band.counts = {};
                 work(band);
             },
             [&](std::int64_t, int slot) {
                 const CastCounts& c = slots_[std::size_t(slot)].counts;
                 report.rays += c.rays, report.wider += c.wider, report.degenerate += c.degenerate;
                 report.nearest = std::min(report.nearest, c.nearest);
                 report.farthest = std::max(report.farthest, c.farthest);
                 for (std::size_t i = 0; i < c.lengths.size(); ++i) report.lengths[i] += c.lengths[i];
                 parallax_ += c.parallax, landed_ += c.landed;
                 report.parallax_max = std::max(report.parallax_max, c.most_parallax);
                 if (!progress) return;
                 const int rows = slots_[std::size_t(slot)].rows;
                 progress->rows += rows, progress->rays += c.rays;
                 progress->watched.add(rows);
             });
}

void Bake::run(TransferProgress* progress) {
    const bool adaptive = options_.max_error_deg > 0 && !rules_.empty();
    if (progress) {
        progress->passes = adaptive ? 2 : 1;
        progress->watched.start("bake", std::int64_t(progress->passes) * options_.height);
    }
    for_bands(
        [&](Band& band) {
            for (int y = band.y; y < band.y + band.rows; ++y)
                for (int x = 0; x < options_.width; ++x) caster_.clear(x, y);
            if (!adaptive) cast_rules(band);
            cast_centres(band);
        },
        progress);
    if (adaptive) {
        open_by_centres();
        for_bands(
            [&](Band& band) {
                cast_rules(band);
                cast_centres(band);
            },
            progress);
    }
    TransferReport& report = out_.report;
    report.parallax_mean = landed_ > 0 ? parallax_ / double(landed_) : 0;
    if (landed_ == 0) report.nearest = report.farthest = 0;
    out_.far = caster_.far();
    finish_maps(out_, weights_, options_);
}

void Bake::cast_rules(Band& band) {
    const bool adaptive = options_.max_error_deg > 0;
    if (adaptive) band.mean.assign(std::size_t(band.rows) * std::size_t(options_.width), Vec3f(0));
    int number = 1;
    for (std::size_t i = 0; i < rules_.size(); ++i) {
        if (adaptive) reopen(band, i);
        cast_rule(rules_[i], number, band);
        number += int(rules_[i].size());
    }
}

/// Rays to the open texels, in packets of neighbours.
void Bake::cast_rule(const std::vector<Place>& rule, int first_number, Band& band) {
    const std::size_t width = std::size_t(options_.width), texels = width * std::size_t(band.rows);
    const unsigned char* const open = open_.row(band.y);
    if (std::all_of(open, open + texels, [](unsigned char needed) { return needed == 0; })) return;
    band.hits.resize(texels * std::min<std::size_t>(rule.size(), packet_size));
    for (std::size_t begin = 0; begin < rule.size(); begin += packet_size) {
        const std::size_t places = std::min<std::size_t>(packet_size, rule.size() - begin);
        for (std::size_t i = 0; i < places; ++i)
            raster_->band(band.y / band_rows, rule[begin + i].at, {band.hits.data() + i * texels, texels});
        const auto cast_texel = [&](int x, int y) {
            const std::size_t texel = std::size_t(y) * width + std::size_t(x);
            if (!open[texel]) return;
            for (std::size_t i = 0; i < places; ++i) {
                TexelHit at = band.hits[i * texels + texel];
                if (at.triangle == no_index) continue;
                if (!charts_->source.empty()) at.triangle = charts_->source[at.triangle];
                caster_.add({x, band.y + y, rule[begin + i].weight, first_number + int(begin + i), false}, at,
                            band.packet, band.counts);
            }
        };
        for_blocks(options_.width, band.rows, places <= 4 ? 2 : 1, cast_texel);
    }
    caster_.flush(band.packet, band.counts);
}

/// Whether a chart may end in the texel: one of its neighbours is empty, or its centre lies in no triangle. Charts that fill the map
/// end at its edge.
bool Bake::is_at_border(int x, int y) const noexcept {
    for (int j = std::max(0, y - 1); j <= std::min(y + 1, options_.height - 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, options_.width - 1); ++i) {
            const TexelHit& at = target_.raster.hits.at(i, j);
            if (at.triangle == no_index || is_on_edge(at)) return true;
        }
    return false;
}

/// Leaves open the texels whose mean may be far from what one ray has found, by the second differences of the normals of
/// neighbours, those with a neighbour that has found nothing, and those at borders of charts.
void Bake::open_by_centres() {
    const auto allowed = float(chord_of(options_.max_error_deg));
    const auto normal = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= options_.width || y >= options_.height) return Vec3f(0);
        const float* const n = &out_.map.at(x, y);
        return out_.states.at(x, y) == TexelState::hit ? Vec3f(n[0], n[1], n[2]) : Vec3f(0);
    };
    for_rows(options_.height, 16, [&](std::int64_t begin, std::int64_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < options_.width; ++x) {
                if (!open_.at(x, y)) continue;
                if (is_at_border(x, y)) {
                    open_.at(x, y) = all_rays;
                    continue;
                }
                const Vec3f here = normal(x, y);
                float error = 0;
                for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}}) {
                    const Vec3f before = normal(x - dx, y - dy), after = normal(x + dx, y + dy);
                    const bool known = here != Vec3f(0) && before != Vec3f(0) && after != Vec3f(0);
                    error += known ? glm::length(before + after - 2.0f * here) / 24 : INFINITY;
                }
                open_.at(x, y) = !(error * curvature_safety <= allowed);
            }
    });
}

/// Of the open texels, closes those on which the last two of `rules` rules agree, the ray of the centre being the first. The others
/// are then as if they had no ray yet.
void Bake::reopen(Band& band, std::size_t rules) {
    const double differences = rules == 1 ? differences_of_centre : differences_of_rules;
    const auto agreed = float(chord_of(differences * options_.max_error_deg));
    for (int y = 0; y < band.rows; ++y)
        for (int x = 0; x < options_.width; ++x) {
            unsigned char& open = open_.at(x, band.y + y);
            if (!open) continue;
            const float* const sum = &out_.map.at(x, band.y + y);
            const bool beyond = rules == 0 && open == all_rays; // the centre may lie outside of the chart
            const Vec3f mean = beyond ? Vec3f(0) : unit_or_zero(Vec3f(sum[0], sum[1], sum[2]));
            Vec3f& before = band.mean[std::size_t(y) * std::size_t(options_.width) + std::size_t(x)];
            const bool agree = mean != Vec3f(0) && before != Vec3f(0) && glm::length(mean - before) <= agreed;
            if (agree && open != all_rays) open = 0;
            else caster_.clear(x, band.y + y);
            before = mean;
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
                  const TransferOptions& options, const std::string& path, TransferProgress* progress) {
    return transfer(target, {{{&high, &casting}}, {}}, options, path, progress);
}

Transfer transfer(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
                  const std::string& path, TransferProgress* progress) {
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
