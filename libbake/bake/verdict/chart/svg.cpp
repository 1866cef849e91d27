#include "bake/verdict/chart/svg.h"
#include "bake/base/printable.h"
#include "bake/base/text.h"

namespace bake {
namespace {

/// Whether a byte starts a character of UTF-8.
bool starts_character(char c) noexcept { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

/// Advance of the character that starts with this byte over the font size. Each is at least that of DejaVu Sans and of
/// Verdana, the widest sans-serif fonts in general use. What is not ASCII may be an ideograph, which is square.
double advance(char c) noexcept {
    if (static_cast<unsigned char>(c) >= 0x80) return 1;
    if (std::string_view("ijl!|'.,:;I ").find(c) != std::string_view::npos) return 0.43;
    if (std::string_view("mwMW%@").find(c) != std::string_view::npos) return 1.08;
    if ((c >= 'A' && c <= 'Z') || std::string_view("+=<>~^#&_").find(c) != std::string_view::npos) return 0.84;
    return 0.66;
}

} // namespace

std::string xml_text(std::string_view text) {
    std::string out;
    for (const char c : printable(text)) switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        case '\'': out += "&#39;"; break;
        default: out += c;
        }
    // U+FFFE and U+FFFF are valid UTF-8 that no XML document may contain.
    for (const char* forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
        for (std::size_t at = out.find(forbidden); at != std::string::npos; at = out.find(forbidden, at))
            out.replace(at, 3, "?");
    return out;
}

std::string px(double value) {
    std::string text = format("%.2f", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

double text_width(std::string_view text, double size) {
    double width = 0;
    for (const char c : printable(text))
        if (starts_character(c)) width += advance(c) * size;
    return width;
}

std::string fitted(std::string_view text, double size, double width) {
    std::string shown = printable(text);
    if (text_width(shown, size) <= width) return shown;
    const double room = width - size; // of the ellipsis, which is not ASCII
    double used = 0;
    std::size_t end = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!starts_character(shown[i])) continue;
        end = i;
        used += advance(shown[i]) * size;
        if (used > room) break;
    }
    return shown.substr(0, end) + "\xE2\x80\xA6";
}

std::string svg_text(double x, double y, std::string_view text, const TextStyle& style) {
    const char* const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    std::string out = "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" font-size=\"" + px(style.size) + "\" fill=\"" +
                      style.colour + "\"" + anchors[int(style.anchor)];
    if (style.bold) out += " font-weight=\"bold\"";
    if (style.upwards) out += " transform=\"rotate(-90 " + px(x) + " " + px(y) + ")\"";
    return out + ">" + xml_text(text) + "</text>\n";
}

std::string svg_line(double x0, double y0, double x1, double y1, std::string_view style) {
    return "<line x1=\"" + px(x0) + "\" y1=\"" + px(y0) + "\" x2=\"" + px(x1) + "\" y2=\"" + px(y1) + "\" " +
           std::string(style) + "/>\n";
}

std::string svg_start(double width, double height, std::string_view title) {
    const std::string w = px(width), h = px(height), name = xml_text(title);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w +
           " " + h + "\" role=\"img\" aria-label=\"" + name + "\" font-family=\"system-ui, sans-serif\">\n<title>" +
           name + "</title>\n<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#fff\"/>\n";
}

} // namespace bake
