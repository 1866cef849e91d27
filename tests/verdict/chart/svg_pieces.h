// What tests of charts read from an SVG picture.
#pragma once
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace bake::test {

/// A tag: its name, and what is between it and the next tag.
struct SvgPiece {
    std::string tag, text;

    /// The value of an attribute, "" if there is none.
    std::string value(const std::string& name) const {
        const std::string start = " " + name + "=\"";
        const std::size_t at = tag.find(start);
        if (at == std::string::npos) return {};
        const std::size_t from = at + start.size();
        return tag.substr(from, tag.find('"', from) - from);
    }
    double number(const std::string& name) const { return std::strtod(value(name).c_str(), nullptr); }
    bool is(const std::string& name) const {
        return tag.compare(0, name.size(), name) == 0 && (tag.size() == name.size() || tag[name.size()] == ' ');
    }
};

/// The tags in order, "circle ..." or "/g", without their brackets.
inline std::vector<SvgPiece> svg_pieces(const std::string& svg) {
    std::vector<SvgPiece> out;
    for (std::size_t at = svg.find('<'); at != std::string::npos;) {
        const std::size_t end = svg.find('>', at);
        if (end == std::string::npos) break;
        const std::size_t next = svg.find('<', end);
        out.push_back(
            {svg.substr(at + 1, end - at - 1), svg.substr(end + 1, next == std::string::npos ? next : next - end - 1)});
        at = next;
    }
    return out;
}

/// Whether the tags are nested, attributes are quoted, and each & starts one of the five entities or a number's.
inline bool is_well_formed(const std::string& svg) {
    std::vector<std::string> open;
    for (const SvgPiece& piece : svg_pieces(svg)) {
        for (std::size_t at = piece.text.find('&'); at != std::string::npos; at = piece.text.find('&', at + 1)) {
            const std::string entity = piece.text.substr(at, piece.text.find(';', at) - at);
            if (entity != "&amp" && entity != "&lt" && entity != "&gt" && entity != "&quot" && entity != "&#39")
                return false;
        }
        std::size_t quotes = 0;
        for (const char c : piece.tag) {
            quotes += c == '"';
            if (static_cast<unsigned char>(c) < ' ') return false;
        }
        if (quotes % 2 != 0 || piece.tag.empty()) return false;
        const std::string name = piece.tag.substr(0, piece.tag.find(' '));
        if (name[0] == '/') {
            if (open.empty() || "/" + open.back() != name) return false;
            open.pop_back();
        } else if (piece.tag.back() != '/') {
            open.push_back(name);
        }
    }
    return open.empty() && svg.compare(0, 5, "<svg ") == 0;
}

/// Pieces of one name, such as "circle".
inline std::vector<SvgPiece> svg_all(const std::string& svg, const std::string& name) {
    std::vector<SvgPiece> out;
    for (const SvgPiece& piece : svg_pieces(svg))
        if (piece.is(name)) out.push_back(piece);
    return out;
}

} // namespace bake::test
