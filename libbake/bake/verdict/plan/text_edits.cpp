#include "bake/verdict/plan/text_edits.h"
#include <algorithm>

namespace bake {
namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool begins_character(char c) noexcept { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

} // namespace

TextEdits::TextEdits(std::string_view text) : text_(text) {
    lines_.push_back(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n') lines_.push_back(i + 1);
}

std::size_t TextEdits::offset(const Place& place) const {
    if (place.line > lines_.size()) return text_.size();
    std::size_t at = lines_[place.line - 1];
    for (std::size_t column = place.column; column > 1 && at < text_.size(); --column) do
            ++at;
        while (at < text_.size() && !begins_character(text_[at]));
    return at;
}

std::size_t TextEdits::line_begin(std::size_t at) const {
    const auto next = std::upper_bound(lines_.begin(), lines_.end(), at);
    return next == lines_.begin() ? 0 : *(next - 1);
}

std::size_t TextEdits::line_end(std::size_t at) const {
    const std::size_t end = std::min(text_.find('\n', at), text_.size());
    return end > at && end < text_.size() && text_[end - 1] == '\r' ? end - 1 : end;
}

std::string TextEdits::newline(std::size_t at) const {
    return line_end(at) < std::min(text_.find('\n', at), text_.size()) ? "\r\n" : "\n";
}

void TextEdits::replace(const Span& span, std::string by) { edits_.push_back({span, std::move(by)}); }

std::string TextEdits::apply() const { return apply({0, text_.size()}); }

std::string TextEdits::apply(const Span& part) const {
    std::vector<Edit> edits;
    for (const Edit& edit : edits_)
        if (edit.span.begin >= part.begin && edit.span.end <= part.end) edits.push_back(edit);
    std::stable_sort(edits.begin(), edits.end(),
                     [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    std::string out;
    std::size_t at = part.begin;
    for (const Edit& edit : edits) {
        out.append(text_, at, edit.span.begin - at);
        out += edit.by;
        at = edit.span.end;
    }
    return out.append(text_, at, part.end - at);
}

} // namespace bake
