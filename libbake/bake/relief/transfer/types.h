// What a bake of high-poly detail is given, and what it returns.
#pragma once
#include "bake/relief/map/bake_target.h"
#include "bake/relief/transfer/detail_maps.h"
#include <array>

namespace bake {

struct TransferOptions {
    int width = 0, height = 0; ///< of the map in texels
    Space space = Space::tangent;
    bool directx = false; ///< green points down
    int padding = 16;     ///< texels filled beyond the charts' borders
    int tile = 0;         ///< as NormalMapOptions
    int rays = 1;         ///< along each side of a texel, from 1 to 16
    /// Above 0: texels get fewer rays than these where a few of them give the mean to within so many degrees. The error of one ray
    /// is estimated from the neighbours, that of several from how far rules of ever more rays differ. Detail that is shorter than
    /// two texels and lies between the rays can be missed. Only the normals are judged, not the other maps.
    double max_error_deg = 0;
    bool alpha = false; ///< whether Transfer::alpha is wanted
    DetailOptions details;
    /// A ray that finds nothing is cast again from twice as far out, three times as far in; and if that finds nothing and the ray
    /// sees the low-poly mesh from behind, from the front.
    bool try_wider = true;
};

enum class TexelState : unsigned char {
    outside,   ///< of the charts, or without a tangent space
    hit,       ///< a normal of its own
    missed,    ///< its rays find nothing
    unmatched, ///< of a part of the low-poly mesh that no high-poly part belongs to: flat, and not padded
    behind,    ///< its rays find nothing but the back of triangles
};

inline bool is_missed(TexelState state) noexcept { return state == TexelState::missed || state == TexelState::behind; }

/// How many texels and rays found what. Under max_error_deg, rays count whose mean more rays replaced.
struct TransferReport {
    std::int64_t rays = 0;      ///< cast, with those of the second try
    std::int64_t hit = 0;       ///< texels in charts with a normal of their own
    std::int64_t missed = 0;    ///< texels whose rays find nothing, or nothing but backs
    std::int64_t behind = 0;    ///< of these, texels whose rays find the back of triangles
    std::int64_t unmatched = 0; ///< texels of parts without a counterpart
    std::int64_t wider = 0;     ///< rays that found something in the second try only
    std::int64_t outward = 0;   ///< texels whose normal points into the low-poly mesh: out of range in tangent space
    std::int64_t border = 0, degenerate = 0, padded = 0, empty = 0; ///< as NormalMapReport
    /// Of the rays that land, by where they do: from the envelope (0) to where they end (the last). Those of the second try count in
    /// the first and the last.
    std::array<std::int64_t, 16> lengths{};
    double parallax_mean = 0,
           parallax_max = 0;          ///< texels by which detail moves sideways, as the cast leans from the facet
    double nearest = 0, farthest = 0; ///< of the heights of hits over the low-poly mesh, object units
};

struct FarTexel {
    double height = 0;
    int x = 0, y = 0;
};

struct Transfer {
    Image<float> map;                  ///< three channels, encoded
    std::vector<Image<float>> details; ///< options.details.maps, padded like the map; 0 elsewhere
    Image<float> alpha; ///< 1 where the map was filled, padding included; 0 for misses, and beyond the padding
    Image<TexelState> states;
    TransferReport report;
    std::vector<FarTexel> far; ///< of each four rows the texel with the largest height or depth, ordered by that
};

/// What a part of the low-poly mesh is baked from.
struct TransferSource {
    const HighSurface* high;
    const Casting* casting;
};
struct TransferSources {
    std::vector<TransferSource> sources;
    std::vector<std::uint32_t>
        of_face; ///< faces of the low-poly mesh: the source, no_index for none; empty: the first for all

    /// Null for a face without a source.
    const TransferSource* of(std::uint32_t face) const noexcept {
        const std::uint32_t i = of_face.empty() ? 0 : of_face[face];
        return i == no_index ? nullptr : &sources[i];
    }
};

} // namespace bake
