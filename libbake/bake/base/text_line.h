// Lines of a text file in memory, whole and in parallel pieces.
#pragma once
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// `text` as an error message shows it: in quotes, one line, at most 40 characters.
std::string shown(std::string_view text);

/// Number of the line that `at` is in, the first being 1.
std::size_t line_number(const char* begin, const char* at) noexcept;

/// Boundaries of pieces of about `grain` bytes of the text [begin, end): pieces + 1 pointers, each at the start of a
/// line that does not continue another. A piece may be empty. end[-1] must be '\n'.
std::vector<const char*> split_lines(const char* begin, const char* end, std::size_t grain);

/// The current line and where the next one starts. Lines that end in a backslash continue in the next line, unless
/// they are comments (# C:\meshes\ is a comment, not a continuation).
struct LineCursor {
    const char* next = nullptr;  ///< start of the next line
    const char* stop = nullptr;  ///< end of the text, behind a '\n'
    const char* at = nullptr;    ///< where the line starts in the file
    const char* begin = nullptr; ///< its text, with continuations joined
    const char* end = nullptr;   ///< the '\n' behind it
    std::string joined;
};

namespace detail {
bool continues(const char* begin, const char* newline) noexcept;
void join_lines(LineCursor& cursor);
} // namespace detail

/// Moves to the next line; false at the end.
inline bool next_line(LineCursor& cursor) {
    if (cursor.next == cursor.stop) return false;
    const auto length = std::size_t(cursor.stop - cursor.next);
    const char* const newline = static_cast<const char*>(std::memchr(cursor.next, '\n', length));
    cursor.at = cursor.begin = cursor.next;
    cursor.end = newline;
    cursor.next = newline + 1;
    // A backslash or a carriage return: the last character of no other line that goes on.
    if (newline != cursor.begin && (newline[-1] == '\\' || newline[-1] == '\r') &&
        detail::continues(cursor.begin, newline))
        detail::join_lines(cursor);
    return true;
}

} // namespace bake
