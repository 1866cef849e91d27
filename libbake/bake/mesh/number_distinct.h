// Equal items found by hashing: each item gets the number of its kind.
#pragma once
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/mesh.h"
#include <bit>
#include <cstdint>
#include <vector>

namespace bake {

/// Kinds are numbered from 0 on in the order of their first items.
struct Numbered {
    std::vector<std::uint32_t> number; ///< items: the number of the item's kind
    std::vector<std::uint32_t> first;  ///< kinds: the first item of the kind
};

/// Adds a word to a hash that is built word by word; start with any constant. The lower 32 bits are well mixed.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}
/// The bits of a float, those of 0 for -0.
inline std::uint32_t float_bits(float value) noexcept { return std::bit_cast<std::uint32_t>(value + 0.0f); }
inline std::uint64_t float_bits(float a, float b) noexcept {
    return std::uint64_t(float_bits(a)) << 32 | float_bits(b);
}

namespace detail {
struct HashSlot {
    std::uint32_t hash = 0, number = no_index; ///< of a kind; no_index: the slot is not used
};
} // namespace detail

/// `items` are fewer than 2^32 - 1. The lower 32 bits of hash(i), which is called on all threads, are equal where
/// equal(i, j) holds.
template <class Hash, class Equal> Numbered number_distinct(std::size_t items, const Hash& hash, const Equal& equal) {
    using detail::HashSlot;
    Numbered out;
    // out.number contains the hashes until the numbers replace them.
    resize_in_pages(out.number, items);
    for_rows(std::int64_t(items), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = std::uint32_t(begin); i < std::uint32_t(end); ++i) out.number[i] = std::uint32_t(hash(i));
    });
    // Open addressing with linear probing, at most half of the slots used. There is room for six items per kind, as for
    // the corners at a vertex of a closed triangle mesh; the table grows if there are fewer.
    std::vector<HashSlot> table;
    resize_in_pages(table, std::bit_ceil(items / 3 + 16));
    const auto grow = [&table] {
        std::vector<HashSlot> larger(table.size() * 2);
        for (const HashSlot& slot : table) {
            if (slot.number == no_index) continue;
            std::size_t at = slot.hash & (larger.size() - 1);
            while (larger[at].number != no_index) at = (at + 1) & (larger.size() - 1);
            larger[at] = slot;
        }
        table.swap(larger);
    };
    for (std::uint32_t i = 0; i < items; ++i) {
        if (i % 65536 == 0) throw_if_interrupted();
        const std::size_t mask = table.size() - 1;
        if (i + 16 < items) __builtin_prefetch(&table[out.number[i + 16] & mask]);
        const std::uint32_t own = out.number[i];
        std::size_t at = own & mask;
        while (table[at].number != no_index && !(table[at].hash == own && equal(out.first[table[at].number], i)))
            at = (at + 1) & mask;
        if (table[at].number == no_index) {
            table[at] = {own, std::uint32_t(out.first.size())};
            out.first.push_back(i);
        }
        out.number[i] = table[at].number;
        if (out.first.size() * 2 > table.size()) grow();
    }
    return out;
}

} // namespace bake
