#include "bake/relief/transfer/transfer.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/transfer/finish_maps.h"
#include "bake/relief/transfer/gauss_legendre.h"
#include "bake/relief/transfer/map_frame.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int block = 4; ///< texels wide and high that are cast together, as one packet
static_assert(block * block == packet_size);
constexpr float wider_front = 2, wider_back = 3; ///< reaches of the second try, as multiples of the first

/// Texels that are cast together.
struct Packet {
    std::array<TexelHit, packet_size> at;
    std::array<int, packet_size> x, y;
    std::array<Cast, packet_size> cast;
    std::array<Ray, packet_size> rays;
    std::array<Hit, packet_size> hits;
    std::array<float, packet_size> start; ///< of the ray, above the low-poly mesh
    PacketMask used = 0;
    int count = 0;
    const TransferSource* source = nullptr; ///< of all of them
};

Ray ray_of(const Cast& cast, float front, float back) noexcept {
    Ray ray{cast.start - (front - 1) * cast.reach.front * cast.inward, cast.inward};
    ray.t_max = front * cast.reach.front + back * cast.reach.back;
    return ray;
}

/// Sums over the samples of texels, until they are averaged.
class Bake {
public:
    Bake(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options, Transfer& out)
        : target_(target), sources_(sources), options_(options), facets_(target, options.width, options.height),
          out_(out), weights_(options.rays > 1 && !out.details.empty() ? Image<float>(options.width, options.height, 1)
                                                                       : Image<float>()) {
        for (const TransferSource& source : sources.sources) details_.emplace_back(*source.high, options.details);
    }

    /// One ray for each texel of the raster. `centres`: it is the raster of the centres, with the texels at borders, and texels that
    /// have had a ray are left out.
    void cast_all(const UvRaster& raster, float weight, bool centres, Progress* progress);
    /// The farthest texel of each band, ordered.
    std::vector<FarTexel> far() const;
    const Image<float>& weights() const noexcept { return weights_; }

private:
    struct Counts {
        std::int64_t rays = 0, wider = 0, degenerate = 0;
        double nearest = INFINITY, farthest = -INFINITY;
        std::array<std::int64_t, std::tuple_size_v<decltype(TransferReport::lengths)>> lengths{};
        double parallax = 0, most_parallax = 0;
        std::int64_t landed = 0;
        FarTexel far;
        void add(const Cast& cast, double height, double parallax_here, int x, int y) noexcept;
    };
    void clear(int y) noexcept;
    void cast_block(const UvRaster& raster, int x, int y, int rows, float weight, bool centres, Counts& counts);
    void retry_inside(Packet& packet, Counts& counts) const noexcept;
    const TransferSource* source_of(const TexelHit& at) const noexcept {
        return sources_.of(target_.surface.triangles[at.triangle].face);
    }
    void trace(Packet& packet, Counts& counts) const noexcept;
    Vec3f beyond_border(const TransferSource& source, const TexelHit& edge, int x, int y, const Vec3f& at_edge,
                        Counts& counts) const noexcept;
    void add(const Packet& packet, int lane, float weight, bool centres, Counts& counts) noexcept;

    const BakeTarget& target_;
    const TransferSources& sources_;
    const TransferOptions& options_;
    std::vector<DetailProbe> details_; ///< per source
    Facets facets_;
    Transfer& out_;
    Image<float> weights_; ///< with several rays
    bool cleared_ = false;
    int pass_ = 0;
    double parallax_ = 0;
    std::int64_t landed_ = 0;
    std::vector<FarTexel> far_; ///< per band
};

void Bake::Counts::add(const Cast& cast, double height, double parallax_here, int x, int y) noexcept {
    nearest = std::min(nearest, height), farthest = std::max(farthest, height);
    const double length = double(cast.reach.front) + double(cast.reach.back);
    const double at = length > 0 ? (double(cast.reach.front) - height) / length * double(lengths.size()) : 0;
    ++lengths[std::size_t(std::clamp(at, 0.0, double(lengths.size() - 1)))];
    parallax += parallax_here, most_parallax = std::max(most_parallax, parallax_here), ++landed;
    if (std::abs(height) > std::abs(far.height)) far = {height, x, y};
}

void Bake::clear(int y) noexcept {
    std::fill(out_.map.row(y), out_.map.row(y + 1), 0.0f);
    for (Image<float>& map : out_.details) std::fill(map.row(y), map.row(y + 1), 0.0f);
    std::fill(out_.states.row(y), out_.states.row(y + 1), TexelState::outside);
    if (!weights_.empty()) std::fill(weights_.row(y), weights_.row(y + 1), 0.0f);
}

std::vector<FarTexel> Bake::far() const {
    std::vector<FarTexel> out;
    for (const FarTexel& texel : far_)
        if (texel.height != 0) out.push_back(texel);
    std::stable_sort(out.begin(), out.end(),
                     [](const FarTexel& a, const FarTexel& b) { return std::abs(a.height) > std::abs(b.height); });
    return out;
}

void Bake::cast_all(const UvRaster& raster, float weight, bool centres, Progress* progress) {
    const int bands = (options_.height + block - 1) / block;
    far_.resize(std::size_t(bands));
    std::vector<Counts> counts(std::size_t(bands), Counts{});
    for_rows(
        bands, 2,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto band = int(begin); band < int(end); ++band) {
                const int y = band * block, rows = std::min(block, options_.height - y);
                for (int i = 0; i < rows && !cleared_; ++i) clear(y + i);
                for (int x = 0; x < options_.width; x += block)
                    cast_block(raster, x, y, rows, weight, centres, counts[std::size_t(band)]);
            }
        },
        progress);
    cleared_ = true, ++pass_;
    TransferReport& report = out_.report;
    for (std::size_t band = 0; band < counts.size(); ++band) {
        const Counts& c = counts[band];
        report.rays += c.rays, report.wider += c.wider, report.degenerate += c.degenerate;
        report.nearest = std::min(report.nearest, c.nearest), report.farthest = std::max(report.farthest, c.farthest);
        for (std::size_t i = 0; i < c.lengths.size(); ++i) report.lengths[i] += c.lengths[i];
        parallax_ += c.parallax, landed_ += c.landed;
        report.parallax_max = std::max(report.parallax_max, c.most_parallax);
        if (std::abs(c.far.height) > std::abs(far_[band].height)) far_[band] = c.far;
    }
    report.parallax_mean = landed_ > 0 ? parallax_ / double(landed_) : 0;
}

/// Texels of one source at a time.
void Bake::cast_block(const UvRaster& raster, int x, int y, int rows, float weight, bool centres, Counts& counts) {
    const int columns = std::min(block, options_.width - x), all = rows * columns;
    PacketMask done = 0;
    for (int first = 0; first < all && done != (PacketMask(1) << all) - 1; ++first) {
        Packet packet;
        for (int i = first; i < all; ++i) {
            const int at_x = x + i % columns, at_y = y + i / columns;
            const TexelHit& at = raster.hits.at(at_x, at_y);
            TexelState& state = out_.states.at(at_x, at_y);
            if (done >> i & 1) continue;
            const bool wanted = at.triangle != no_index && !(centres && state != TexelState::outside);
            const TransferSource* const source = wanted ? source_of(at) : nullptr;
            if (!source) {
                if (wanted) state = TexelState::unmatched;
                done |= PacketMask(1) << i;
                continue;
            }
            if (packet.count > 0 && source != packet.source) continue;
            done |= PacketMask(1) << i;
            packet.source = source;
            const auto lane = std::size_t(packet.count++);
            packet.at[lane] = at, packet.x[lane] = at_x, packet.y[lane] = at_y;
            packet.cast[lane] = source->casting->at(at);
            packet.rays[lane] = ray_of(packet.cast[lane], 1, 1);
            packet.start[lane] = packet.cast[lane].reach.front;
        }
        if (packet.count == 0) break;
        packet.used = (PacketMask(1) << packet.count) - 1;
        trace(packet, counts);
        if (centres) retry_inside(packet, counts);
        for (int lane = 0; lane < packet.count; ++lane) add(packet, lane, weight, centres, counts);
    }
}

void Bake::trace(Packet& packet, Counts& counts) const noexcept {
    const HighSurface& high = *packet.source->high;
    high.land(packet.rays, packet.used, packet.hits);
    counts.rays += packet.count;
    if (!options_.try_wider) return;
    PacketMask missed = 0;
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        if (packet.hits[lane]) continue;
        missed |= PacketMask(1) << lane;
        packet.rays[lane] = ray_of(packet.cast[lane], wider_front, wider_back);
        packet.start[lane] *= wider_front;
    }
    if (missed == 0) return;
    std::array<Hit, packet_size> found;
    high.land(packet.rays, missed, found);
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        if (!(missed >> lane & 1)) continue;
        ++counts.rays;
        packet.hits[lane] = found[lane];
        counts.wider += bool(found[lane]);
    }
}

/// Where both meshes end at the same place, a ray on the border of a chart can pass beside the high-poly mesh by a rounding. It is
/// cast again a ten-thousandth of the triangle farther inside.
void Bake::retry_inside(Packet& packet, Counts& counts) const noexcept {
    constexpr float inward = 1e-4f;
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        TexelHit at = packet.at[lane];
        if (packet.hits[lane] || !is_on_edge(at)) continue;
        at.b1 += inward * (1 / 3.f - at.b1), at.b2 += inward * (1 / 3.f - at.b2);
        const Cast cast = packet.source->casting->at(at);
        const Hit hit = packet.source->high->land(ray_of(cast, 1, 1));
        ++counts.rays;
        if (!hit) continue;
        packet.at[lane] = at, packet.cast[lane] = cast, packet.hits[lane] = hit, packet.start[lane] = cast.reach.front;
    }
}

void Bake::add(const Packet& packet, int lane, float weight, bool centres, Counts& counts) noexcept {
    const auto i = std::size_t(lane);
    const HighSurface& high = *packet.source->high;
    const TexelHit& at = packet.at[i];
    const Hit& hit = packet.hits[i];
    TexelState& state = out_.states.at(packet.x[i], packet.y[i]);
    if (!hit) {
        if (state != TexelState::outside) return;
        state = high.bvh().occluded(packet.rays[i]) ? TexelState::behind : TexelState::missed;
        return;
    }
    const Vec3f normal = high.normal(hit);
    const MapFrame frame(target_, at, options_.space);
    Vec3f t = frame.in_map(normal);
    if (t == Vec3f(0)) {
        ++counts.degenerate;
        return;
    }
    if (centres) t = beyond_border(*packet.source, at, packet.x[i], packet.y[i], t, counts);
    const Cast& cast = packet.cast[i];
    const double height = double(packet.start[i] - hit.t);
    counts.add(cast, height, std::abs(height) * facets_.texels_per_height(at.triangle, cast.inward), packet.x[i],
               packet.y[i]);
    const bool first = state != TexelState::hit;
    state = TexelState::hit;
    float* sum = &out_.map.at(packet.x[i], packet.y[i]);
    for (int c = 0; c < 3; ++c) sum[c] += weight * t[c];
    if (out_.details.empty()) return;
    if (!weights_.empty()) weights_.at(packet.x[i], packet.y[i]) += weight;
    const std::uint64_t seed =
        std::uint64_t(pass_) << 40 ^ std::uint64_t(packet.y[i]) << 20 ^ std::uint64_t(packet.x[i]);
    std::array<float, 4 * std::size(all_detail_maps)> values;
    details_[std::size_t(packet.source - sources_.sources.data())].at({cast, hit, normal, seed}, values);
    for (std::size_t m = 0; m < out_.details.size(); ++m) {
        const DetailMap map = options_.details.maps[m];
        float* to = &out_.details[m].at(packet.x[i], packet.y[i]);
        const float* from = &values[4 * m];
        if (map == DetailMap::id) { // colours of several meshes have no mean
            if (first) std::copy_n(from, 3, to);
            continue;
        }
        Vec3f value(from[0], channels(map) == 3 ? from[1] : 0, channels(map) == 3 ? from[2] : 0);
        if (map == DetailMap::bent_normal) value = frame.in_map(value);
        for (int c = 0; c < channels(map); ++c) to[c] += weight * value[c];
    }
}

/// The value for a texel whose centre lies beyond the border of a chart, continued linearly from the nearest point of the chart and
/// from the point as far inside: what a bilinear filter reads on the border is then what was hit there, on both sides of a seam.
Vec3f Bake::beyond_border(const TransferSource& source, const TexelHit& edge, int x, int y, const Vec3f& at_edge,
                          Counts& counts) const noexcept {
    constexpr float alike = 0.87f; // cosine: beyond 30 degrees there is something else inside
    const auto inside = mirrored_at_border(target_, edge, x, y, options_.width, options_.height);
    if (!inside) return at_edge;
    const Hit hit = source.high->land(ray_of(source.casting->at(*inside), 1, 1));
    ++counts.rays;
    if (!hit) return at_edge;
    const Vec3f t = MapFrame(target_, *inside, options_.space).in_map(source.high->normal(hit));
    return glm::dot(t, at_edge) > alike ? unit_or_zero(2.0f * at_edge - t) : at_edge;
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
    Bake bake(target, sources, options, out);
    if (options.rays > 1) {
        const std::vector<QuadraturePoint> rule = gauss_legendre(options.rays);
        for (const QuadraturePoint& v : rule)
            for (const QuadraturePoint& u : rule) {
                const UvRaster samples = chart_raster(*target.surface.mesh, target.surface.triangles, options.width,
                                                      options.height, options.tile, path, {{u.at, v.at}, false});
                bake.cast_all(samples, float(u.weight * v.weight), false, progress);
            }
    }
    // With several rays, what is left are texels of which no sample lies in a chart.
    bake.cast_all(target.raster, 1, true, progress);
    if (out.report.farthest < out.report.nearest) out.report.nearest = out.report.farthest = 0;
    out.far = bake.far();
    out.report.border = target.raster.border;
    finish_maps(out, bake.weights(), options);
    return out;
}

} // namespace bake
