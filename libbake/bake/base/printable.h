// Text from elsewhere, such as names of files, for the lines that are printed.
#pragma once
#include <string>
#include <string_view>

namespace bake {

/// `text` as one line of a terminal can show it. Control characters, line separators, characters that reorder their
/// neighbours, and bytes that are not UTF-8 become \n, \t, \r or \x1b, byte by byte; all others stay, backslashes too, so
/// that printable(printable(text)) is printable(text).
std::string printable(std::string_view text);
/// The same for several lines: newlines stay.
std::string printable_lines(std::string_view text);

} // namespace bake
