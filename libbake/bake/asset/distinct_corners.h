// Which corners of a mesh are one and the same.
#pragma once
#include <cstdint>
#include <vector>

namespace bake {

/// Numbers equal corners alike.
struct DistinctCorners {
    std::vector<std::uint32_t> corner; ///< corners: the number of each
    std::vector<std::uint32_t> first;  ///< per number: the first corner that has it
};

/// Two corners are equal where `position` is and `key` is. Numbers are in order of position, then of first appearance.
/// Every entry of `position` (one per corner) is below `positions`; `key` has one entry per corner, or none.
DistinctCorners distinct_corners(const std::vector<std::uint32_t>& position, std::size_t positions,
                                 const std::vector<std::uint64_t>& key);

} // namespace bake
