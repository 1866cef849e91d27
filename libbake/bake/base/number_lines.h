// Small text files of numbers: profiles and patches.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace bake {

struct NumberLine {
    std::size_t line = 0; ///< in the file, the first being 1
    std::vector<double> values;
};

/// The lines of a file that hold numbers, apart by blanks or commas; # starts a comment. Throws
/// Error{Refusal::unreadable} for anything else, infinities and NaN included.
std::vector<NumberLine> read_number_lines(const std::string& path);

} // namespace bake
