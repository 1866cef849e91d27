#include "bake/relief/transfer/texel_caster.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr float wider_front = 2, wider_back = 3; ///< reaches of the second try, as multiples of the first
constexpr int far_rows = 4;                      ///< so many rows have one texel in TexelCaster::far()
static_assert(PlaceRaster::band_rows % far_rows == 0, "two threads would write to one element");

Ray ray_of(const Cast& cast, float front, float back) noexcept {
    Ray ray{cast.start - (front - 1) * cast.reach.front * cast.inward, cast.inward};
    ray.t_max = front * cast.reach.front + back * cast.reach.back;
    return ray;
}

/// Calls work(begin, end) for the lanes that stand on one triangle in turn.
template <class Work> void for_runs(const RayPacket& packet, Work&& work) {
    const auto count = std::size_t(packet.count);
    for (std::size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && packet.at[end].triangle == packet.at[begin].triangle;) ++end;
        work(begin, end);
    }
}

} // namespace

TexelCaster::TexelCaster(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
                         Transfer& out, Image<float>& weights)
    : target_(target), sources_(sources), options_(options), facets_(target, options.width, options.height), out_(out),
      weights_(weights), far_(std::size_t(options.height + far_rows - 1) / far_rows) {
    for (const TransferSource& source : sources.sources) details_.emplace_back(*source.high, options.details);
}

std::vector<FarTexel> TexelCaster::far() const {
    std::vector<FarTexel> out;
    for (const FarTexel& texel : far_)
        if (texel.height != 0) out.push_back(texel);
    std::stable_sort(out.begin(), out.end(),
                     [](const FarTexel& a, const FarTexel& b) { return std::abs(a.height) > std::abs(b.height); });
    return out;
}

void TexelCaster::clear(int x, int y) noexcept {
    std::fill_n(&out_.map.at(x, y), 3, 0.0f);
    for (Image<float>& map : out_.details) std::fill_n(&map.at(x, y), map.channels(), 0.0f);
    if (!weights_.empty()) weights_.at(x, y) = 0;
    out_.states.at(x, y) = TexelState::outside;
}

void TexelCaster::add(const TexelSample& sample, const TexelHit& at, RayPacket& packet, CastCounts& counts) noexcept {
    const TransferSource* const source = sources_.of(target_.surface.triangles[at.triangle].face);
    if (!source) {
        TexelState& state = out_.states.at(sample.x, sample.y);
        if (state == TexelState::outside) state = TexelState::unmatched;
        return;
    }
    if (packet.count == packet_size || (packet.count > 0 && source != packet.source)) flush(packet, counts);
    packet.source = source;
    packet.sample[std::size_t(packet.count)] = sample, packet.at[std::size_t(packet.count)] = at;
    ++packet.count;
}

void TexelCaster::flush(RayPacket& packet, CastCounts& counts) noexcept {
    if (packet.count == 0) return;
    const auto count = std::size_t(packet.count);
    for_runs(packet, [&](std::size_t begin, std::size_t end) {
        packet.source->casting->at({&packet.at[begin], end - begin}, {&packet.cast[begin], end - begin});
    });
    for (std::size_t lane = 0; lane < count; ++lane) {
        packet.rays[lane] = ray_of(packet.cast[lane], 1, 1);
        packet.start[lane] = packet.cast[lane].reach.front;
    }
    trace(packet, counts);
    retry_inside(packet, counts);
    Lanes3 normals;
    packet.source->high->normals(packet.hits, count, normals);
    for_runs(packet, [&](std::size_t begin, std::size_t end) {
        const MapFrame frame(target_, packet.at[begin].triangle, options_.space);
        Lanes3 in_map = normals;
        frame.in_map(in_map, packet.at, begin, end);
        for (std::size_t lane = begin; lane < end; ++lane)
            land(packet, lane, frame, normals[lane], in_map[lane], counts);
    });
    packet.count = 0;
}

void TexelCaster::trace(RayPacket& packet, CastCounts& counts) const noexcept {
    const HighSurface& high = *packet.source->high;
    high.land(packet.rays, (PacketMask(1) << packet.count) - 1, packet.hits);
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
        if (!found[lane]) turn_to_facet(packet, lane, counts);
    }
}

/// A ray that finds nothing in the second try because it sees the low-poly mesh from behind is cast again from the front, as far.
void TexelCaster::turn_to_facet(RayPacket& packet, std::size_t lane, CastCounts& counts) const noexcept {
    const std::optional<Cast> cast = packet.source->casting->facing(packet.at[lane]);
    if (!cast) return;
    const Ray ray = ray_of(*cast, wider_front, wider_back);
    const Hit hit = packet.source->high->land(ray);
    ++counts.rays;
    if (!hit) return;
    ++counts.wider;
    packet.cast[lane] = *cast, packet.rays[lane] = ray, packet.hits[lane] = hit;
    packet.start[lane] = wider_front * cast->reach.front;
}

/// Where both meshes end at the same place, a ray on the border of a chart can pass beside the high-poly mesh by a rounding. It is
/// cast again a ten-thousandth of the triangle farther inside.
void TexelCaster::retry_inside(RayPacket& packet, CastCounts& counts) const noexcept {
    constexpr float inward = 1e-4f;
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        TexelHit at = packet.at[lane];
        if (packet.hits[lane] || !packet.sample[lane].centre || !is_on_edge(at)) continue;
        at.b1 += inward * (1 / 3.f - at.b1), at.b2 += inward * (1 / 3.f - at.b2);
        const Cast cast = packet.source->casting->at(at);
        const Hit hit = packet.source->high->land(ray_of(cast, 1, 1));
        ++counts.rays;
        if (!hit) continue;
        packet.at[lane] = at, packet.cast[lane] = cast, packet.hits[lane] = hit;
        packet.start[lane] = cast.reach.front;
    }
}

/// `normal`: of the high-poly mesh; `t`: the same in the map.
void TexelCaster::land(const RayPacket& packet, std::size_t lane, const MapFrame& frame, const Vec3f& normal, Vec3f t,
                       CastCounts& counts) noexcept {
    const TexelSample& sample = packet.sample[lane];
    const HighSurface& high = *packet.source->high;
    TexelState& state = out_.states.at(sample.x, sample.y);
    if (!packet.hits[lane]) {
        if (state == TexelState::outside)
            state = high.bvh().occluded(packet.rays[lane]) ? TexelState::behind : TexelState::missed;
        return;
    }
    if (t == Vec3f(0)) {
        ++counts.degenerate;
        return;
    }
    if (sample.centre) t = beyond_border(packet, lane, frame, t, counts);
    count(packet, lane, counts);
    float* sum = &out_.map.at(sample.x, sample.y);
    for (int c = 0; c < 3; ++c) sum[c] += sample.weight * t[c];
    if (!weights_.empty()) weights_.at(sample.x, sample.y) += sample.weight;
    if (!out_.details.empty()) add_details(packet, lane, normal, frame, state != TexelState::hit);
    state = TexelState::hit;
}

/// `first`: no ray of the texel has landed before.
void TexelCaster::add_details(const RayPacket& packet, std::size_t lane, const Vec3f& normal, const MapFrame& frame,
                              bool first) noexcept {
    const TexelSample& sample = packet.sample[lane];
    const std::uint64_t seed =
        std::uint64_t(sample.number) << 40 ^ std::uint64_t(sample.y) << 20 ^ std::uint64_t(sample.x);
    std::array<float, 4 * std::size(all_detail_maps)> values;
    details_[std::size_t(packet.source - sources_.sources.data())].at(
        {packet.cast[lane], packet.hits[lane], normal, seed}, values);
    for (std::size_t m = 0; m < out_.details.size(); ++m) {
        const DetailMap map = options_.details.maps[m];
        float* to = &out_.details[m].at(sample.x, sample.y);
        const float* from = &values[4 * m];
        if (map == DetailMap::id) { // colours of several meshes have no mean
            if (first) std::copy_n(from, 3, to);
            continue;
        }
        Vec3f value(from[0], channels(map) == 3 ? from[1] : 0, channels(map) == 3 ? from[2] : 0);
        if (map == DetailMap::bent_normal) value = frame.in_map(value, packet.at[lane]);
        for (int c = 0; c < channels(map); ++c) to[c] += sample.weight * value[c];
    }
}

void TexelCaster::count(const RayPacket& packet, std::size_t lane, CastCounts& counts) noexcept {
    const TexelSample& sample = packet.sample[lane];
    const Cast& cast = packet.cast[lane];
    const double height = double(packet.start[lane] - packet.hits[lane].t);
    const double aside = std::abs(height) * facets_.texels_per_height(packet.at[lane].triangle, cast.inward);
    counts.nearest = std::min(counts.nearest, height), counts.farthest = std::max(counts.farthest, height);
    const double length = double(cast.reach.front) + double(cast.reach.back), bins = double(counts.lengths.size());
    const double at = length > 0 ? (double(cast.reach.front) - height) / length * bins : 0;
    ++counts.lengths[std::size_t(std::clamp(at, 0.0, bins - 1))];
    counts.parallax += aside, counts.most_parallax = std::max(counts.most_parallax, aside), ++counts.landed;
    FarTexel& far = far_[std::size_t(sample.y / far_rows)];
    if (std::abs(height) > std::abs(far.height)) far = {height, sample.x, sample.y};
}

/// The value for a texel whose centre lies beyond the border of a chart, continued linearly from the nearest point of the chart and
/// from the point as far inside: what a bilinear filter reads on the border is then what was hit there, on both sides of a seam.
Vec3f TexelCaster::beyond_border(const RayPacket& packet, std::size_t lane, const MapFrame& frame, const Vec3f& at_edge,
                                 CastCounts& counts) const noexcept {
    constexpr float alike = 0.87f; // cosine: beyond 30 degrees there is something else inside
    const TexelSample& sample = packet.sample[lane];
    const auto inside =
        mirrored_at_border(target_, packet.at[lane], sample.x, sample.y, options_.width, options_.height);
    if (!inside) return at_edge;
    const HighSurface& high = *packet.source->high;
    const Hit hit = high.land(ray_of(packet.source->casting->at(*inside), 1, 1));
    ++counts.rays;
    if (!hit) return at_edge;
    const Vec3f t = frame.in_map(high.normal(hit), *inside);
    return glm::dot(t, at_edge) > alike ? unit_or_zero(2.0f * at_edge - t) : at_edge;
}

} // namespace bake
