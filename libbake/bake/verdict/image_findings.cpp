// Warnings and notes of the reports on pictures.
#include "bake/relief/height/sample_type.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/inspect.h"
#include <algorithm>

namespace bake {
namespace {

constexpr int few_levels = 100; // with fewer levels terraces are visible at useful amplitudes

bool printable(const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](char ch) { return ch >= ' ' && ch <= '~'; });
}

void judge_channels(const ImageCheck& c, Findings& out) {
    for (const std::string& channel : c.info.channels)
        if (!printable(channel))
            out.warnings.push_back("a channel has a name that cannot be printed: the file is damaged");
    for (const ChannelCheck& channel : c.channels) {
        add_if(out.warnings, channel.nan, "NaN", "in channel " + channel.name);
        add_if(out.warnings, channel.inf, "infinite value", "in channel " + channel.name);
    }
}

void judge_depth(const ImageCheck& c, Findings& out) {
    const ChannelCheck& first = c.channels.front();
    const int stored = c.info.bits;
    if (is_cut(c.info))
        out.warnings.push_back("the samples have " + std::to_string(stored) +
                               " bits, and the reader of this format gives " + std::to_string(c.true_bits) +
                               " of them; convert the file to PNG, TIFF or EXR");
    // Content of up to 4 bits is usually a palette or a mask, not an export that lost its depth.
    else if (c.kind.looks != Looks::constant && c.true_bits > 4 && c.true_bits < stored)
        out.warnings.push_back(std::to_string(stored) + "-bit file with " + std::to_string(c.true_bits) +
                               "-bit content: " + counted(std::size_t(first.levels), "level"));
    const bool whole = c.info.type == SampleType::u8 || c.info.type == SampleType::u16;
    if (c.kind.looks == Looks::grey && whole && c.grey.levels > 16 && c.grey.levels < few_levels)
        out.warnings.push_back(
            "only " + std::to_string(c.grey.levels) + " levels in use, in [" + number(c.grey.min) + ", " +
            number(c.grey.max) +
            "]: slopes are quantised; export the height normalised, with 16 bits, or use `dequantise`");
}

void judge_normals(const ImageCheck& c, Findings& out) {
    const NormalStats& n = c.kind.normals;
    const NormalValues& values = c.kind.normal_values;
    const std::string unusual = describe(values);
    const bool srgb =
        values.encoding == NormalEncoding::srgb_encoded || values.encoding == NormalEncoding::srgb_decoded;
    if (!unusual.empty())
        (srgb ? out.warnings : out.notes)
            .push_back(unusual +
                       (srgb ? "; export them as data, not as colour: bakes and renders read them as stored" : ""));
    if (n.not_unit > 0.1)
        out.warnings.push_back(percent(n.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                               number(n.length) + "); normalise them before use");
    add_if(out.warnings, std::size_t(n.inward * c.info.width * c.info.height + 0.5),
           "normal|that point into the surface", "blue below half");
}

void judge_height(const ImageCheck& c, Findings& out) {
    if (c.kind.tint > 0)
        out.notes.push_back("grey, but its channels differ by up to " + number(c.kind.tint) +
                            " of 255 levels: the mean of the channels is used");
    if (is_lossy(c.info))
        out.notes.push_back("lossy compression: its blocks are visible in slopes; use the original if possible");
    const bool x = c.tiling.x.breaks(), y = c.tiling.y.breaks();
    if (x || y)
        out.notes.push_back(std::string("does not tile in ") +
                            (x && y ? "x and y"
                             : x    ? "x"
                                    : "y") +
                            ": as a height use `" +
                            (x && y ? "wrap"
                             : x    ? "wrap_u"
                                    : "wrap_v") +
                            "` clamp");
}

void judge_alpha(const ImageCheck& c, Findings& out) {
    if (c.info.alpha_channel < 0 || std::size_t(c.info.alpha_channel) >= c.channels.size()) return;
    const ChannelCheck& alpha = c.channels[c.info.alpha_channel];
    if (alpha.min == alpha.max && alpha.min == 1) out.notes.push_back("alpha is 1 everywhere");
    else if (alpha.levels > 16 && c.channels.size() > 2 && c.kind.normal_values.x != c.info.alpha_channel)
        out.notes.push_back("alpha has " + (alpha.levels > most_levels ? "many" : std::to_string(alpha.levels)) +
                            " levels: perhaps packed data, such as a height (`grey` a)");
}

} // namespace

Findings judge(const ImageReport& report) {
    Findings out;
    const ImageCheck& c = report.check;
    judge_channels(c, out);
    if (c.kind.looks == Looks::constant)
        out.warnings.push_back("every texel has the same value, " + number(c.channels.front().min));
    judge_depth(c, out);
    if (c.kind.looks == Looks::normal_map) judge_normals(c, out);
    if (c.kind.looks == Looks::grey) judge_height(c, out);
    judge_alpha(c, out);
    out.notes.insert(out.notes.end(), c.info.notes.begin(), c.info.notes.end());
    return out;
}

bool PairReport::unexpected() const noexcept {
    return directx && (check.flat || check.corr < pair_tells || !check.green_decided || check.directx != *directx);
}

Findings judge(const PairReport& report) {
    Findings out;
    const PairCheck& c = report.check;
    if (c.flat) {
        out.warnings.push_back("the height or the normal map is flat: there is nothing to compare");
        return out;
    }
    if (c.corr < pair_tells)
        out.warnings.push_back("the two do not show the same relief (correlation " + number(c.corr) + ")");
    else if (c.corr < pair_agrees)
        out.warnings.push_back("the two agree only roughly (correlation " + number(c.corr) + ")");
    if (c.inverted)
        out.warnings.push_back("inverted height: the normal map is that of the negative height; bake with `invert`");
    if (report.directx && c.corr >= pair_tells && c.green_decided && c.directx != *report.directx)
        out.warnings.push_back(std::string("green points ") +
                               (c.directx ? "down (DirectX), where OpenGL" : "up (OpenGL), where DirectX") +
                               " is expected; flip the green channel");
    else if (c.directx && !report.directx)
        out.warnings.push_back(
            "DirectX green: y points down in the normal map; bake with `directx` to match, or flip its green");
    if (c.corr >= pair_tells && !c.green_decided)
        out.notes.push_back(c.height_decided
                                ? "the relief is along x alone, which does not tell where green points"
                                : std::string("the relief is along y alone, which tells either the height or green: ") +
                                      (c.corr_y > 0 ? "white is high and green points up, or both are turned"
                                                    : "the height is inverted, or green points down"));
    if (const std::string unusual = describe(report.normal_values); !unusual.empty()) out.notes.push_back(unusual);
    if (report.normal_values.z >= 0 && c.not_unit > 0.1)
        out.warnings.push_back(percent(c.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                               number(c.normal_length) + "): normalised before use");
    if (report.normal_values.z >= 0)
        add_if(out.warnings, std::size_t(c.inward * report.normal_width * report.normal_height + 0.5),
               "normal|that point into the surface", "blue at or below half, which has no slope");
    if (report.height_width != report.normal_width || report.height_height != report.normal_height)
        out.warnings.push_back("sizes differ: compared at " + std::to_string(c.width) + " x " +
                               std::to_string(c.height));
    const double gap = std::abs(std::abs(c.scale_x) - std::abs(c.scale_y));
    if (c.height_decided && c.green_decided && c.corr >= pair_agrees && gap > 0.15 * c.scale)
        out.notes.push_back("the slopes along x and y have different scales: the texels may not be square");
    return out;
}

} // namespace bake
