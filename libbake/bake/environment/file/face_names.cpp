#include "bake/environment/file/face_names.h"
#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace bake {
namespace {

/// For each face, words in lower case between blanks. Axes and numbers are spelled by rule instead.
using Table = std::array<const char*, 6>;
constexpr std::array<Table, int(FaceWords::count)> tables = {{
    {"px", "nx", "py", "ny", "pz", "nz"},
    {"right rgt", "left lft", "up top upper above ceiling zenith", "down bottom bot btm lower below floor ground nadir",
     "front forward fwd frt fore ahead", "back backward bwd bck rear behind"},
    {"rt", "lf lt", "up", "dn", "bk", "ft"},
    {"rt rgt", "lf lt lft", "up tp top", "dn dw dwn bt bot btm", "fr frt fnt fw fwd", "bk bck ba"},
    {"r", "l", "u t", "d", "f", "b"},
    {"east e", "west w", "up top u t", "down bottom d b", "north n", "south s"},
    {"0", "1", "2", "3", "4", "5"},
    {"1", "2", "3", "4", "5", "6"},
}};

bool has_word(std::string_view words, std::string_view word) noexcept {
    for (std::size_t begin = 0; begin < words.size();) {
        const std::size_t end = std::min(words.find(' ', begin), words.size());
        if (words.substr(begin, end - begin) == word) return true;
        begin = end + 1;
    }
    return false;
}

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
bool is_separator(char c) noexcept { return c == '_' || c == ' ' || c == '.'; }

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Without the separators and, if something else remains, without the digits at both ends.
std::string_view trimmed(std::string_view text) noexcept {
    const auto outside = [](char c) { return is_digit(c) || is_separator(c); };
    while (!text.empty() && outside(text.front())) text.remove_prefix(1);
    while (!text.empty() && outside(text.back())) text.remove_suffix(1);
    return text;
}

std::string without(std::string_view text, bool (*dropped)(char)) {
    std::string kept;
    for (const char c : text)
        if (!dropped(c)) kept += c;
    return kept;
}

int face_in(const Table& table, std::string_view word) noexcept {
    for (int face = 0; face < 6; ++face)
        if (has_word(table[face], word)) return face;
    return -1;
}

/// A word for the sign of an axis, with a '-' that joins it to the axis: +1, -1, or 0 for another word.
int sign_of(std::string_view word) {
    if (word == "-") return -1;
    const std::string bare = without(word, [](char c) { return c == '-'; });
    if (has_word("p pos positive plus +", bare)) return 1;
    return has_word("n m neg negative minus", bare) ? -1 : 0;
}

int axis_of(char c) noexcept { return c >= 'x' && c <= 'z' ? c - 'x' : -1; }

int face_of_axis(std::string_view text) {
    const std::string word = without(text, is_separator);
    if (word.size() < 2) return -1;
    const std::string_view whole = word;
    const auto face = [](int axis, int sign) { return axis < 0 || sign == 0 ? -1 : 2 * axis + (sign < 0); };
    if (const int last = face(axis_of(whole.back()), sign_of(whole.substr(0, whole.size() - 1))); last >= 0)
        return last;
    if (const int first = face(axis_of(whole.front()), sign_of(whole.substr(1))); first >= 0) return first;
    // The direction and the axis: front+z, right_posx.
    for (std::size_t length = 2; length < whole.size(); ++length)
        if (face_in(tables[int(FaceWords::words)], whole.substr(0, length)) >= 0)
            if (const int rest = face_of_axis(whole.substr(length)); rest >= 0) return rest;
    return -1;
}

/// The number in a part that has nothing else but a short word for "face" before it; -1 for other parts.
int number_in(std::string_view text) {
    const std::string word = without(text, [](char c) { return is_separator(c) || c == '-'; });
    const auto digits = std::find_if(word.begin(), word.end(), is_digit);
    const bool plain = digits == word.begin() || has_word("c f face side", std::string(word.begin(), digits));
    if (!plain || digits == word.end() || word.end() - digits > 4 || !std::all_of(digits, word.end(), is_digit))
        return -1;
    return std::stoi(std::string(digits, word.end()));
}

} // namespace

int face_named(FaceWords kind, const std::string& part) {
    const std::string text = lower(part);
    if (kind == FaceWords::from_zero || kind == FaceWords::from_one) {
        const int number = number_in(text), face = number - (kind == FaceWords::from_one);
        return number >= 0 && face >= 0 && face < 6 ? face : -1;
    }
    const std::string_view word = trimmed(text);
    if (kind == FaceWords::axes) return face_of_axis(word);
    return face_in(tables[int(kind)], without(word, [](char c) { return is_separator(c) || c == '-'; }));
}

std::string word_of(FaceWords kind, int face) {
    const std::string_view words = tables[int(kind)][face];
    return std::string(words.substr(0, words.find(' ')));
}

} // namespace bake
