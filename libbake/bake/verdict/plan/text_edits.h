// Changes of a text at places that a TOML parser names, which leave all else as it is.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// The first and the last byte, exclusive, of a part of a text.
struct Span {
    std::size_t begin = 0, end = 0;
};

/// A line and a character in it, both counted from 1, as parsers count them.
struct Place {
    std::size_t line = 1, column = 1;
};

class TextEdits {
public:
    explicit TextEdits(std::string_view text);

    /// The offset of a place.
    std::size_t offset(const Place& place) const;
    std::size_t line_begin(std::size_t at) const;
    /// Behind the last character of the line, before its newline.
    std::size_t line_end(std::size_t at) const;
    /// "\n", or "\r\n" where the line of `at` ends so.
    std::string newline(std::size_t at) const;
    std::string_view text() const noexcept { return text_; }

    /// Spans do not overlap. Insertions at one place keep their order.
    void replace(const Span& span, std::string by);
    void insert(std::size_t at, std::string what) { replace({at, at}, std::move(what)); }
    std::string apply() const;
    /// The same for a part of the text; edits that reach beyond it are left out.
    std::string apply(const Span& part) const;

private:
    struct Edit {
        Span span;
        std::string by;
    };
    std::string_view text_;
    std::vector<std::size_t> lines_; ///< offsets of their first bytes
    std::vector<Edit> edits_;
};

} // namespace bake
