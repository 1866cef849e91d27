#include "bake/verdict/chart/frame.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include <algorithm>

namespace bake {
namespace {

constexpr double tick_size = 11, label_size = 12, title_size = 15, note_size = 11, strip_width = 30;
constexpr double title_base = 24, plot_top = 36, beneath_plot = 48;
constexpr const char* grey = "#555";

int width_of(const FrameText& text) { return std::max(200, text.width); }
int height_of(const FrameText& text) { return std::max(200, text.height); }

int wanted_x(const Frame& frame) { return std::max(2, int((frame.plot.right - frame.plot.left) / 80)); }
int wanted_y(const Frame& frame) { return std::max(2, int((frame.plot.bottom - frame.plot.top) / 45)); }

std::string strip_line(double x0, double y0, double x1, double y1) {
    return svg_line(x0, y0, x1, y1, "stroke=\"#999\" stroke-dasharray=\"3 3\"");
}

std::string draw_x_axis(const Frame& f) {
    std::string out;
    const double base = f.plot.bottom + 15;
    double used = -1e9; // the right end of the last number: numbers that would touch it are left out
    for (const Tick& tick : ticks(f.x, wanted_x(f))) {
        out += svg_line(tick.at, f.plot.top, tick.at, f.plot.bottom,
                        tick.text.empty() ? "stroke=\"#f0f0f0\"" : "stroke=\"#ddd\"");
        const double half = text_width(tick.text, tick_size) / 2;
        if (tick.text.empty() || tick.at - half < used + 4) continue;
        out += svg_text(tick.at, base, tick.text, {.size = tick_size, .anchor = Anchor::middle, .colour = grey});
        used = tick.at + half;
    }
    if (f.x.strip) {
        out += strip_line(f.x.start_px, f.plot.top, f.x.start_px, f.plot.bottom);
        out += svg_text(f.x.strip_px, base, "0", {.size = tick_size, .anchor = Anchor::middle, .colour = grey});
    }
    return out;
}

std::string draw_y_axis(const FrameText& text, const Frame& f) {
    std::string out;
    const auto number = [&](double y, const std::string& shown) {
        return svg_text(f.plot.left - 6, y + 4, shown, {.size = tick_size, .anchor = Anchor::end, .colour = grey});
    };
    double used = 1e9;
    for (const Tick& tick : ticks(f.y, wanted_y(f))) {
        out += svg_line(f.plot.left, tick.at, f.plot.right, tick.at,
                        tick.text.empty() ? "stroke=\"#f0f0f0\"" : "stroke=\"#ddd\"");
        if (tick.text.empty() || tick.at > used - tick_size - 1) continue;
        out += number(tick.at, tick.text);
        used = tick.at;
    }
    if (f.y.strip) {
        out += strip_line(f.plot.left, f.y.start_px, f.plot.right, f.y.start_px);
        out += number(f.y.strip_px, text.strip_text);
    }
    return out;
}

} // namespace

Frame frame_of(const FrameText& text, Axis x, Axis y, double above) {
    Frame frame;
    frame.plot = {0, plot_top + above, double(width_of(text)) - 14, double(height_of(text)) - beneath_plot};
    lay_axis(y, frame.plot.bottom, frame.plot.top, strip_width);
    frame.y = y;
    double widest = y.strip ? text_width(text.strip_text, tick_size) : 0;
    for (const Tick& tick : ticks(y, wanted_y(frame))) widest = std::max(widest, text_width(tick.text, tick_size));
    frame.plot.left = 30 + std::min(widest, double(width_of(text)) / 3);
    lay_axis(x, frame.plot.left, frame.plot.right, strip_width);
    frame.x = x;
    return frame;
}

double notes_top(const FrameText& text) { return height_of(text) + 8; }

std::string draw_frame(const FrameText& text, const Frame& f, double beneath) {
    const double width = width_of(text), across = f.plot.right - f.plot.left, down = f.plot.bottom - f.plot.top;
    std::string out = svg_start(width, height_of(text) + beneath, text.title);
    out += svg_text(width / 2, title_base, fitted(text.title, title_size * 1.1, width - 16),
                    {.size = title_size, .anchor = Anchor::middle, .bold = true});
    out += draw_x_axis(f) + draw_y_axis(text, f);
    out += "<rect x=\"" + px(f.plot.left) + "\" y=\"" + px(f.plot.top) + "\" width=\"" + px(across) + "\" height=\"" +
           px(down) + "\" fill=\"none\" stroke=\"#888\"/>\n";
    out += svg_text(f.plot.left + across / 2, f.plot.bottom + 35, fitted(text.x_label, label_size, across),
                    {.size = label_size, .anchor = Anchor::middle});
    out += svg_text(15, f.plot.top + down / 2, fitted(text.y_label, label_size, down),
                    {.size = label_size, .anchor = Anchor::middle, .upwards = true});
    return out;
}

std::string draw_notes(const FrameText& text, const std::vector<std::string>& notes) {
    std::string out;
    double base = notes_top(text);
    for (const std::string& note : notes) {
        out += svg_text(14, base, fitted(note, note_size, width_of(text) - 28), {.size = note_size, .colour = grey});
        base += note_height;
    }
    return out;
}

std::string short_number(double value) {
    std::string text = format("%.4g", value);
    // "1e-05" is "1e-5".
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    std::size_t digits = e + 1;
    if (text[digits] == '+') text.erase(digits, 1);
    else ++digits;
    while (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);
    return text;
}

} // namespace bake
