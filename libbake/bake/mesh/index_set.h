// A set of small numbers whose next member is found in a few steps.
#pragma once
#include "bake/mesh/mesh.h"
#include <bit>

namespace bake {

/// A subset of the numbers 0 to count - 1: one bit per number, and above each level one bit per word that is not 0.
class IndexSet {
public:
    /// Removes all members.
    void reset(std::uint32_t count) {
        std::size_t depth = 0;
        std::size_t bits = count;
        do {
            bits = (bits + 63) / 64;
            if (levels_.size() == depth) levels_.emplace_back();
            levels_[depth++].assign(bits, 0);
        } while (bits > 1);
        levels_.resize(depth);
    }
    void insert(std::uint32_t i) noexcept {
        for (auto& level : levels_) {
            const std::uint64_t before = level[i / 64];
            level[i / 64] |= std::uint64_t(1) << i % 64;
            if (before != 0) return;
            i /= 64;
        }
    }
    void erase(std::uint32_t i) noexcept {
        for (auto& level : levels_) {
            level[i / 64] &= ~(std::uint64_t(1) << i % 64);
            if (level[i / 64] != 0) return;
            i /= 64;
        }
    }
    /// The lowest member from i on; no_index if there is none. i may be `count`.
    std::uint32_t next(std::uint32_t i) const noexcept {
        for (std::size_t depth = 0; depth < levels_.size(); ++depth) {
            if (i / 64 >= levels_[depth].size()) return no_index;
            const std::uint64_t from = levels_[depth][i / 64] >> i % 64;
            if (from == 0) {
                i = i / 64 + 1;
                continue;
            }
            i += std::uint32_t(std::countr_zero(from));
            while (depth-- > 0) i = i * 64 + std::uint32_t(std::countr_zero(levels_[depth][i]));
            return i;
        }
        return no_index;
    }

private:
    std::vector<std::vector<std::uint64_t>> levels_; ///< the last one has a single word
};

} // namespace bake
