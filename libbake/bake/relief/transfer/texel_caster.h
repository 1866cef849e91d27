// Casts rays from texels in packets, and adds what they find to the sums of their texels.
#pragma once
#include "bake/relief/transfer/map_frame.h"
#include "bake/relief/transfer/types.h"

namespace bake {

/// What the rays of a few rows of the map find; those of all rows are added up in order.
struct CastCounts {
    std::int64_t rays = 0, wider = 0, degenerate = 0, landed = 0;
    double nearest = INFINITY, farthest = -INFINITY;
    double parallax = 0, most_parallax = 0; ///< sum and largest, in texels
    std::array<std::int64_t, std::tuple_size_v<decltype(TransferReport::lengths)>> lengths{};
};

/// What a ray in a texel stands for.
struct TexelSample {
    int x, y;
    float weight;
    int number;  ///< of the sample in its texel
    bool centre; ///< the only one, whose place may lie beyond the border of the chart
};

/// Rays that are cast together, all to the same source.
struct RayPacket {
    std::array<TexelSample, packet_size> sample;
    std::array<TexelHit, packet_size> at;
    std::array<Cast, packet_size> cast;
    std::array<Ray, packet_size> rays;
    std::array<Hit, packet_size> hits;
    std::array<float, packet_size> start; ///< of the ray, above the low-poly mesh
    int count = 0;
    const TransferSource* source = nullptr;
};

/// Rows can be cast by several threads at once, each with a packet and counts of its own.
class TexelCaster {
public:
    /// Sums go to out.map, out.details and out.states, and with `weights` those of the weights there. All must outlive it.
    TexelCaster(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options, Transfer& out,
                Image<float>& weights);
    /// Casts the packet first if it is full or has another source. Marks texels without a source.
    void add(const TexelSample& sample, const TexelHit& at, RayPacket& packet, CastCounts& counts) noexcept;
    /// Casts what is in the packet.
    void flush(RayPacket& packet, CastCounts& counts) noexcept;
    /// The texel is as if no ray had been cast.
    void clear(int x, int y) noexcept;
    /// Of each few rows the texel with the largest height or depth, ordered by that.
    std::vector<FarTexel> far() const;

private:
    void trace(RayPacket& packet, CastCounts& counts) const noexcept;
    void turn_to_facet(RayPacket& packet, std::size_t lane, CastCounts& counts) const noexcept;
    void retry_inside(RayPacket& packet, CastCounts& counts) const noexcept;
    Vec3f beyond_border(const RayPacket& packet, std::size_t lane, const MapFrame& frame, const Vec3f& at_edge,
                        CastCounts& counts) const noexcept;
    void land(const RayPacket& packet, std::size_t lane, const MapFrame& frame, const Vec3f& normal, Vec3f t,
              CastCounts& counts) noexcept;
    void add_details(const RayPacket& packet, std::size_t lane, const Vec3f& normal, const MapFrame& frame,
                     bool first) noexcept;
    void count(const RayPacket& packet, std::size_t lane, CastCounts& counts) noexcept;

    const BakeTarget& target_;
    const TransferSources& sources_;
    const TransferOptions& options_;
    std::vector<DetailProbe> details_; ///< per source
    Facets facets_;
    Transfer& out_;
    Image<float>& weights_;
    std::vector<FarTexel> far_; ///< per far_rows rows of the map
};

} // namespace bake
