// How far a mistyped word is from another one.
#pragma once
#include <cstddef>
#include <string_view>

namespace bake {

/// Letters to insert, delete, replace or swap with their neighbour so that one word becomes the other: the optimal string
/// alignment distance, in which no letter is changed twice (Damerau, A technique for computer detection and correction of
/// spelling errors, 1964).
std::size_t edit_distance(std::string_view a, std::string_view b);

} // namespace bake
