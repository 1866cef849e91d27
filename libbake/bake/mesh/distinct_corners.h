// Which corners of a mesh are one and the same.
#pragma once
#include "bake/base/parallel.h"
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace bake {

/// Numbers equal corners alike.
struct DistinctCorners {
    std::vector<std::uint32_t> corner; ///< corners: the number of each
    std::vector<std::uint32_t> first;  ///< per number: the first corner that has it
};

namespace detail {

/// Gives each corner of one position the place of the first that equals it, counted among those that are first.
/// `number` has one entry per corner of `group`, which ascends. Returns how many are first.
template <class Key, class Same>
std::uint32_t number_group(std::span<const std::uint32_t> group, std::uint32_t* number, Key&& key, Same&& same) {
    constexpr std::size_t few = 32;     // beyond, comparing all with all takes longer than sorting
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

} // namespace detail

/// Two of the corners [0, corners) are equal where position(c) is, and same(a, b) says so. Numbers are in order of
/// position, then of first appearance. position(c) is below `positions`; key(c) is a std::uint64_t, equal for corners
/// that are the same, so that many at one position need not be compared all with all. Most positions being of one kind
/// of corner, the others alone are sorted.
template <class Position, class Key, class Same>
DistinctCorners distinct_corners(std::size_t corners, std::size_t positions, Position&& position, Key&& key,
                                 Same&& same) {
    constexpr std::uint32_t none = 0xffffffffu;
    constexpr std::int64_t grain = 1 << 15;
    const auto rows = std::int64_t(corners);
    std::vector<std::uint32_t> leader(positions, none); // per position, its first corner
    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const std::atomic_ref<std::uint32_t> first(leader[position(c)]);
            std::uint32_t known = first.load(std::memory_order_relaxed);
            while (c < known && !first.compare_exchange_weak(known, c, std::memory_order_relaxed)) {
            }
        }
    });

    // Corners that differ from the first of their position, in order.
    std::vector<std::vector<std::uint32_t>> found(std::size_t((rows + grain - 1) / grain));
    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
        auto& here = found[std::size_t(begin / grain)];
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const std::uint32_t l = leader[position(c)];
            if (l != c && !same(l, c)) here.push_back(c);
        }
    });
    std::size_t differ = 0;
    for (const auto& here : found) differ += here.size();

    // Those of one position side by side, each numbered from 1 on within it.
    std::vector<std::uint32_t> others(differ), number(differ), begin_of(differ > 0 ? positions + 1 : 0);
    std::vector<std::uint32_t> base(positions + 1);
    for (std::size_t p = 0; p < positions; ++p) base[p] = leader[p] == none ? 0 : 1;
    if (differ > 0) {
        for (const auto& here : found)
            for (const std::uint32_t c : here) ++begin_of[position(c)];
        std::uint32_t sum = 0;
        for (std::uint32_t& b : begin_of) b = std::exchange(sum, sum + b);
        for (const auto& here : found)
            for (const std::uint32_t c : here) others[begin_of[position(c)]++] = c;
        // The sort has moved each beginning to its end, which is the next one's beginning.
        for_rows(std::int64_t(positions), grain, [&](std::int64_t first, std::int64_t last) {
            for (auto p = std::size_t(first); p < std::size_t(last); ++p) {
                const std::size_t from = p == 0 ? 0 : begin_of[p - 1], to = begin_of[p];
                if (from == to) continue;
                base[p] += detail::number_group(std::span(others).subspan(from, to - from), &number[from], key, same);
            }
        });
    }
    std::uint32_t numbers = 0;
    for (std::uint32_t& b : base) b = std::exchange(numbers, numbers + b);

    DistinctCorners out;
    out.corner.resize(corners);
    out.first.assign(numbers, none);
    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c) out.corner[c] = base[position(c)];
    });
    for_rows(std::int64_t(positions), grain, [&](std::int64_t first, std::int64_t last) {
        for (auto p = std::size_t(first); p < std::size_t(last); ++p) {
            if (leader[p] != none) out.first[base[p]] = leader[p];
            const std::size_t from = differ == 0 || p == 0 ? 0 : begin_of[p - 1], to = differ == 0 ? 0 : begin_of[p];
            for (std::size_t i = from; i < to; ++i) {
                std::uint32_t& leads = out.first[out.corner[others[i]] = base[p] + 1 + number[i]];
                leads = std::min(leads, others[i]);
            }
        }
    });
    return out;
}

} // namespace bake
