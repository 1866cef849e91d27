// Corners of a mesh that are equal.
#pragma once
#include "bake/base/parallel.h"
#include "bake/mesh/mesh.h"
#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace bake {

/// Equal corners have the same number.
struct DistinctCorners {
    std::vector<std::uint32_t> corner; ///< corners: the number of each
    std::vector<std::uint32_t> first;  ///< numbers: the first corner that has it
};

namespace detail {

constexpr std::int64_t corner_grain = 1 << 15;

/// Writes the place of the first corner of `group` that equals it for each corner of one position; places are counted
/// among the first corners only. `number` has one entry per corner of `group`, which is in ascending order. Returns how
/// many corners are first.
template <class Key, class Same>
std::uint32_t number_group(std::span<const std::uint32_t> group, std::uint32_t* number, Key&& key, Same&& same) {
    constexpr std::size_t few = 32;     // in larger groups, comparing all pairs takes longer than sorting
    std::vector<std::uint32_t> leaders; // places in the group
    if (group.size() <= few) {
        for (std::uint32_t i = 0; i < group.size(); ++i) {
            std::uint32_t k = 0;
            while (k < leaders.size() && !same(group[leaders[k]], group[i])) ++k;
            if (k == leaders.size()) leaders.push_back(i);
            number[i] = k;
        }
        return std::uint32_t(leaders.size());
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(group.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {key(group[i]), i};
    std::sort(order.begin(), order.end());
    for (std::size_t from = 0, to; from < order.size(); from = to) {
        const std::size_t before = leaders.size();
        for (to = from; to < order.size() && order[to].first == order[from].first; ++to) {
            const std::uint32_t i = order[to].second;
            std::size_t k = before;
            while (k < leaders.size() && !same(group[leaders[k]], group[i])) ++k;
            if (k == leaders.size()) leaders.push_back(i);
            number[i] = leaders[k];
        }
    }
    std::sort(leaders.begin(), leaders.end());
    for (std::uint32_t i = 0; i < group.size(); ++i)
        number[i] = std::uint32_t(std::lower_bound(leaders.begin(), leaders.end(), number[i]) - leaders.begin());
    return std::uint32_t(leaders.size());
}

/// Per position its lowest corner, no_index for a position without corners.
template <class Position>
std::vector<std::uint32_t> lowest_corners(std::int64_t corners, std::size_t positions, const Position& position) {
    std::vector<std::uint32_t> lowest(positions, no_index);
    bake::for_rows(corners, corner_grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const std::atomic_ref<std::uint32_t> first(lowest[position(c)]);
            std::uint32_t known = first.load(std::memory_order_relaxed);
            while (c < known && !first.compare_exchange_weak(known, c, std::memory_order_relaxed)) {
            }
        }
    });
    return lowest;
}

/// Corners that differ from the lowest corner of their position, sorted by position.
struct OtherCorners {
    std::vector<std::uint32_t> corner;
    std::vector<std::uint32_t>
        end; ///< positions, or none if there are no such corners: where the position's corners end
    std::pair<std::size_t, std::size_t> range(std::size_t position) const noexcept {
        if (end.empty()) return {0, 0};
        return {position == 0 ? 0 : end[position - 1], end[position]};
    }
};

template <class Position, class Same>
OtherCorners other_corners(std::int64_t corners, const std::vector<std::uint32_t>& lowest, const Position& position,
                           const Same& same) {
    std::vector<std::vector<std::uint32_t>> found(std::size_t((corners + corner_grain - 1) / corner_grain));
    bake::for_rows(corners, corner_grain, [&](std::int64_t begin, std::int64_t end) {
        auto& here = found[std::size_t(begin / corner_grain)];
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const std::uint32_t l = lowest[position(c)];
            if (l != c && !same(l, c)) here.push_back(c);
        }
    });
    std::size_t count = 0;
    for (const auto& here : found) count += here.size();
    OtherCorners out;
    if (count == 0) return out;
    // A counting sort, which moves the beginning of each position's corners to their end.
    out.corner.resize(count);
    out.end.resize(lowest.size());
    for (const auto& here : found)
        for (const std::uint32_t c : here) ++out.end[position(c)];
    std::uint32_t sum = 0;
    for (std::uint32_t& e : out.end) e = std::exchange(sum, sum + e);
    for (const auto& here : found)
        for (const std::uint32_t c : here) out.corner[out.end[position(c)]++] = c;
    return out;
}

} // namespace detail

/// Two of the corners [0, corners) are equal if position(c) is the same for both and same(a, b) is true. Numbers are in
/// the order of the positions, then of the first corners. position(c) is below `positions`. key(c) is a std::uint64_t
/// that is the same for equal corners; it limits the comparisons at a position with many corners. Corners equal to the
/// lowest one of their position are not sorted, which is fast because most positions have one kind of corner.
template <class Position, class Key, class Same>
DistinctCorners distinct_corners(std::size_t corners, std::size_t positions, Position&& position, Key&& key,
                                 Same&& same) {
    const auto rows = std::int64_t(corners);
    const std::vector<std::uint32_t> lowest = detail::lowest_corners(rows, positions, position);
    const detail::OtherCorners others = detail::other_corners(rows, lowest, position, same);

    std::vector<std::uint32_t> number(others.corner.size()); // of each other corner, from 0 on at each position
    std::vector<std::uint32_t> base(positions + 1);          // the number of the position's lowest corner
    for_rows(std::int64_t(positions), detail::corner_grain, [&](std::int64_t first, std::int64_t last) {
        for (auto p = std::size_t(first); p < std::size_t(last); ++p) {
            const auto [from, to] = others.range(p);
            base[p] = lowest[p] == no_index ? 0 : 1;
            if (from == to) continue;
            base[p] +=
                detail::number_group(std::span(others.corner).subspan(from, to - from), &number[from], key, same);
        }
    });
    std::uint32_t numbers = 0;
    for (std::uint32_t& b : base) b = std::exchange(numbers, numbers + b);

    DistinctCorners out;
    out.corner.resize(corners);
    out.first.assign(numbers, no_index);
    for_rows(rows, detail::corner_grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c) out.corner[c] = base[position(c)];
    });
    for_rows(std::int64_t(positions), detail::corner_grain, [&](std::int64_t first, std::int64_t last) {
        for (auto p = std::size_t(first); p < std::size_t(last); ++p) {
            if (lowest[p] != no_index) out.first[base[p]] = lowest[p];
            for (auto [i, to] = others.range(p); i < to; ++i) {
                std::uint32_t& leads = out.first[out.corner[others.corner[i]] = base[p] + 1 + number[i]];
                leads = std::min(leads, others.corner[i]);
            }
        }
    });
    return out;
}

} // namespace bake
