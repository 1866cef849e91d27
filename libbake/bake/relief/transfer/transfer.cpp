#include "bake/relief/transfer/transfer.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/pad_texels.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/gauss_legendre.h"
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
    PacketMask used = 0;
    int count = 0;
};

Ray ray_of(const Cast& cast, float front, float back) noexcept {
    Ray ray{cast.start - (front - 1) * cast.reach.front * cast.inward, cast.inward};
    ray.t_max = front * cast.reach.front + back * cast.reach.back;
    return ray;
}

/// Sums over the samples of texels, until they are averaged.
class Bake {
public:
    Bake(const BakeTarget& target, const HighSurface& high, const Casting& casting, const TransferOptions& options,
         Transfer& out)
        : target_(target), high_(high), casting_(casting), options_(options), out_(out),
          weights_(options.rays > 1 ? Image<float>(options.width, options.height, 1) : Image<float>()) {}

    /// One ray for each texel of the raster, of those that have none yet if `rest`.
    void cast_all(const UvRaster& raster, float weight, bool rest, Progress* progress);
    void average();

private:
    struct Counts {
        std::int64_t rays = 0, wider = 0, degenerate = 0;
        double nearest = INFINITY, farthest = -INFINITY;
    };
    void clear(int y) noexcept;
    void cast_block(const UvRaster& raster, int x, int y, int rows, float weight, bool rest, Counts& counts);
    void trace(Packet& packet, Counts& counts) const noexcept;
    void add(const Packet& packet, int lane, float weight, Counts& counts) noexcept;

    const BakeTarget& target_;
    const HighSurface& high_;
    const Casting& casting_;
    const TransferOptions& options_;
    Transfer& out_;
    Image<float> weights_; ///< with several rays
    bool cleared_ = false;
};

void Bake::clear(int y) noexcept {
    std::fill(out_.map.row(y), out_.map.row(y + 1), 0.0f);
    std::fill(out_.heights.row(y), out_.heights.row(y + 1), 0.0f);
    std::fill(out_.states.row(y), out_.states.row(y + 1), TexelState::outside);
    if (!weights_.empty()) std::fill(weights_.row(y), weights_.row(y + 1), 0.0f);
}

void Bake::cast_all(const UvRaster& raster, float weight, bool rest, Progress* progress) {
    const int bands = (options_.height + block - 1) / block;
    std::vector<Counts> counts(std::size_t(bands), Counts{});
    for_rows(
        bands, 2,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto band = int(begin); band < int(end); ++band) {
                const int y = band * block, rows = std::min(block, options_.height - y);
                for (int i = 0; i < rows && !cleared_; ++i) clear(y + i);
                for (int x = 0; x < options_.width; x += block)
                    cast_block(raster, x, y, rows, weight, rest, counts[std::size_t(band)]);
            }
        },
        progress);
    cleared_ = true;
    TransferReport& report = out_.report;
    for (const Counts& c : counts) {
        report.rays += c.rays, report.wider += c.wider, report.degenerate += c.degenerate;
        report.nearest = std::min(report.nearest, c.nearest), report.farthest = std::max(report.farthest, c.farthest);
    }
}

void Bake::cast_block(const UvRaster& raster, int x, int y, int rows, float weight, bool rest, Counts& counts) {
    Packet packet;
    const int columns = std::min(block, options_.width - x);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const TexelHit& at = raster.hits.at(x + i, y + j);
            if (at.triangle == no_index || (rest && out_.states.at(x + i, y + j) != TexelState::outside)) continue;
            const auto lane = std::size_t(packet.count++);
            packet.at[lane] = at, packet.x[lane] = x + i, packet.y[lane] = y + j;
            packet.cast[lane] = casting_.at(at);
            packet.rays[lane] = ray_of(packet.cast[lane], 1, 1);
        }
    if (packet.count == 0) return;
    packet.used = (PacketMask(1) << packet.count) - 1;
    trace(packet, counts);
    for (int lane = 0; lane < packet.count; ++lane) add(packet, lane, weight, counts);
}

void Bake::trace(Packet& packet, Counts& counts) const noexcept {
    high_.bvh().intersect(packet.rays, packet.used, packet.hits);
    counts.rays += packet.count;
    if (!options_.try_wider) return;
    PacketMask missed = 0;
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        if (packet.hits[lane]) continue;
        missed |= PacketMask(1) << lane;
        packet.rays[lane] = ray_of(packet.cast[lane], wider_front, wider_back);
    }
    if (missed == 0) return;
    std::array<Hit, packet_size> found;
    high_.bvh().intersect(packet.rays, missed, found);
    for (std::size_t lane = 0; lane < std::size_t(packet.count); ++lane) {
        if (!(missed >> lane & 1)) continue;
        ++counts.rays;
        packet.hits[lane] = found[lane];
        counts.wider += bool(found[lane]);
    }
}

void Bake::add(const Packet& packet, int lane, float weight, Counts& counts) noexcept {
    const auto i = std::size_t(lane);
    const TexelHit& at = packet.at[i];
    const Hit& hit = packet.hits[i];
    TexelState& state = out_.states.at(packet.x[i], packet.y[i]);
    if (!hit) {
        if (state != TexelState::outside) return;
        state = high_.bvh().occluded(packet.rays[i]) ? TexelState::behind : TexelState::missed;
        return;
    }
    Vec3f t = high_.normal(hit);
    if (options_.space == Space::tangent) {
        const auto& corner = target_.surface.triangles[at.triangle].corner;
        const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
        Vec3f T(0), N(0);
        for (std::size_t k = 0; k < 3; ++k)
            T += b[k] * Vec3f(target_.tangents[corner[k]]), N += b[k] * target_.surface.n[corner[k]];
        t = to_tangent_space(t, T, N, target_.tangents[corner[0]].w);
    }
    if (t == Vec3f(0)) {
        ++counts.degenerate;
        return;
    }
    const Cast& cast = packet.cast[i];
    const float height = glm::dot(cast.start + cast.reach.front * cast.inward - high_.position(hit), cast.inward);
    counts.nearest = std::min(counts.nearest, double(height)),
    counts.farthest = std::max(counts.farthest, double(height));
    state = TexelState::hit;
    float* sum = &out_.map.at(packet.x[i], packet.y[i]);
    for (int c = 0; c < 3; ++c) sum[c] += weight * t[c];
    out_.heights.at(packet.x[i], packet.y[i]) += weight * height;
    if (!weights_.empty()) weights_.at(packet.x[i], packet.y[i]) += weight;
}

void Bake::average() {
    for_rows(options_.height, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* rgb = out_.map.row(y);
            for (int x = 0; x < options_.width; ++x, rgb += 3) {
                const Vec3f n = unit_or_zero(Vec3f(rgb[0], rgb[1], rgb[2]));
                if (n == Vec3f(0) && out_.states.at(x, y) == TexelState::hit) out_.states.at(x, y) = TexelState::missed;
                const Vec3f code = encode_normal(n == Vec3f(0) ? Vec3f(0, 0, 1) : n, options_.directx);
                for (int c = 0; c < 3; ++c) rgb[c] = code[c];
                if (!weights_.empty() && weights_.at(x, y) > 0) out_.heights.at(x, y) /= weights_.at(x, y);
            }
        }
    });
}

void count_states(Transfer& out, bool tangent) {
    for (int y = 0; y < out.map.height(); ++y)
        for (int x = 0; x < out.map.width(); ++x) switch (out.states.at(x, y)) {
            case TexelState::outside: break;
            case TexelState::hit:
                ++out.report.hit;
                out.report.outward += tangent && out.map.at(x, y, 2) <= 0.5f;
                break;
            case TexelState::behind: ++out.report.behind; [[fallthrough]];
            case TexelState::missed: ++out.report.missed; break;
            }
}

void pad(Transfer& out, int padding) {
    Image<unsigned char> owned(out.map.width(), out.map.height(), 1);
    for (std::size_t i = 0; i < owned.size(); ++i) owned.data()[i] = out.states.data()[i] == TexelState::hit;
    out.report.padded = pad_texels(out.map, owned, padding);
    out.report.empty = std::int64_t(owned.size()) - out.report.hit - out.report.padded;
}

} // namespace

Transfer transfer(const BakeTarget& target, const HighSurface& high, const Casting& casting,
                  const TransferOptions& options, const std::string& path, Progress* progress) {
    Transfer out;
    out.map = Image<float>(options.width, options.height, 3);
    out.heights = Image<float>(options.width, options.height, 1);
    out.states = Image<TexelState>(options.width, options.height, 1);
    out.report.nearest = INFINITY, out.report.farthest = -INFINITY;
    Bake bake(target, high, casting, options, out);
    if (options.rays > 1) {
        const std::vector<QuadraturePoint> rule = gauss_legendre(options.rays);
        for (const QuadraturePoint& v : rule)
            for (const QuadraturePoint& u : rule) {
                const UvRaster samples = chart_raster(*target.surface.mesh, target.surface.triangles, options.width,
                                                      options.height, options.tile, path, {{u.at, v.at}, false});
                bake.cast_all(samples, float(u.weight * v.weight), false, progress);
            }
    }
    // Texels of which no sample lies in a chart have a triangle at their border.
    bake.cast_all(target.raster, 1, options.rays > 1, progress);
    bake.average();
    if (out.report.farthest < out.report.nearest) out.report.nearest = out.report.farthest = 0;
    count_states(out, options.space == Space::tangent);
    out.report.border = target.raster.border;
    pad(out, options.padding);
    return out;
}

} // namespace bake
