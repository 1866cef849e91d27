// International Color Consortium, "Image technology colour management", ICC.1:2022.
#include "bake/picture/icc.h"
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace bake {
namespace {

/// Big-endian numbers; 0 beyond the end.
struct Bytes {
    std::string_view data;

    std::uint32_t u32(std::size_t at) const noexcept { return std::uint32_t(u16(at)) << 16 | u16(at + 2); }
    std::uint16_t u16(std::size_t at) const noexcept {
        return std::uint16_t(std::uint16_t(byte(at)) << 8 | byte(at + 1));
    }
    double fixed(std::size_t at) const noexcept { return std::int32_t(u32(at)) / 65536.0; } // s15Fixed16Number
    unsigned char byte(std::size_t at) const noexcept {
        return at < data.size() ? static_cast<unsigned char>(data[at]) : 0;
    }
};

/// The data of a tag; empty when the profile does not have the tag.
Bytes find_tag(const Bytes& profile, std::string_view name) {
    const std::uint32_t count = profile.u32(128);
    for (std::uint32_t i = 0; i < count && i < 100; ++i) {
        const std::size_t entry = 132 + 12 * std::size_t(i);
        if (entry + 12 > profile.data.size() || profile.data.substr(entry, 4) != name) continue;
        const std::size_t offset = profile.u32(entry + 4), size = profile.u32(entry + 8);
        if (offset > profile.data.size() || size > profile.data.size() - offset) return {};
        return {profile.data.substr(offset, size)};
    }
    return {};
}

std::optional<ToneCurve> sampled_curve(const Bytes& tag) {
    const std::size_t count = tag.u32(8);
    if (count > (tag.data.size() - 12) / 2) return {};
    if (count == 0) return ToneCurve{};
    if (count == 1) return power_curve(tag.u16(12) / 256.0);
    ToneCurve curve;
    for (std::size_t i = 0; i < count; ++i) curve.samples.push_back(float(tag.u16(12 + 2 * i)) / 65535);
    return curve;
}

std::optional<ToneCurve> parametric_curve(const Bytes& tag) {
    constexpr int counts[] = {1, 3, 4, 5, 7};
    const unsigned kind = tag.u16(8);
    if (kind > 4 || tag.data.size() < 12 + 4 * std::size_t(counts[kind])) return {};
    std::array<double, 7> p{};
    for (int i = 0; i < counts[kind]; ++i) p[std::size_t(i)] = tag.fixed(12 + 4 * std::size_t(i));
    const auto [g, a, b, c, d, e, f] = p;
    const double start = a != 0 ? -b / a : 0; // of the power in kinds 1 and 2
    switch (kind) {
    case 0: return power_curve(g);
    case 1: return ToneCurve{.g = g, .a = a, .b = b, .d = start};
    case 2: return ToneCurve{.g = g, .a = a, .b = b, .d = start, .e = c, .f = c};
    case 3: return ToneCurve{.g = g, .a = a, .b = b, .c = c, .d = d};
    default: return ToneCurve{.g = g, .a = a, .b = b, .c = c, .d = d, .e = e, .f = f};
    }
}

std::optional<ToneCurve> read_curve(const Bytes& tag) {
    if (tag.data.size() < 12) return {};
    const std::string_view type = tag.data.substr(0, 4);
    return type == "curv" ? sampled_curve(tag) : type == "para" ? parametric_curve(tag) : std::nullopt;
}

// Red, green and blue of sRGB, adapted to the white point D50 of profiles.
constexpr double srgb_primaries[3][3] = {
    {0.43607, 0.22249, 0.01392}, {0.38515, 0.71687, 0.09708}, {0.14307, 0.06061, 0.7141}};
constexpr const char* primary_names[] = {"rXYZ", "gXYZ", "bXYZ"};

bool has_srgb_primaries(const Bytes& profile) {
    for (int p = 0; p < 3; ++p) {
        const Bytes tag = find_tag(profile, primary_names[p]);
        if (tag.data.size() < 20) continue;
        for (int c = 0; c < 3; ++c)
            if (std::abs(tag.fixed(8 + 4 * std::size_t(c)) - srgb_primaries[p][c]) > 0.01) return false;
    }
    return true;
}

} // namespace

ColourTag read_icc(std::string_view bytes) {
    const Bytes profile{bytes};
    ColourTag tag{.source = "ICC profile"};
    if (bytes.size() < 132 || bytes.substr(36, 4) != "acsp") {
        tag.note = "its ICC profile is damaged and is ignored";
        return tag;
    }
    for (const char* name : {"rTRC", "gTRC", "bTRC"})
        if (auto curve = read_curve(find_tag(profile, name))) tag.curves.push_back(std::move(*curve));
    if (tag.curves.size() != 3) tag.curves.clear();
    if (auto grey = read_curve(find_tag(profile, "kTRC")); grey && tag.curves.empty())
        tag.curves.push_back(std::move(*grey));
    if (tag.curves.empty()) tag.note = "its ICC profile has no curves that could be applied and is ignored";
    else if (!has_srgb_primaries(profile))
        tag.note = "its ICC profile has other primaries than sRGB: its curve is applied, its colours are not converted";
    return tag;
}

namespace {

void append(std::string& to, std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) to += char(value >> shift);
}
void append_fixed(std::string& to, double value) {
    append(to, std::uint32_t(std::int32_t(std::lround(value * 65536))));
}

std::string xyz_tag(double x, double y, double z) {
    std::string tag("XYZ \0\0\0\0", 8);
    for (const double value : {x, y, z}) append_fixed(tag, value);
    return tag;
}

/// Text in one language.
std::string text_tag(const std::string& text) {
    std::string tag("mluc\0\0\0\0\0\0\0\1\0\0\0\14enUS", 20);
    append(tag, std::uint32_t(2 * text.size()));
    append(tag, 28);
    for (const char c : text) tag += '\0', tag += c;
    tag.resize((tag.size() + 3) / 4 * 4);
    return tag;
}

std::string curve_tag(bool srgb) {
    if (!srgb) return std::string("curv\0\0\0\0\0\0\0\0", 12);
    std::string tag("para\0\0\0\0\0\3\0\0", 12);
    const ToneCurve curve = srgb_curve();
    for (const double value : {curve.g, curve.a, curve.b, curve.c, curve.d}) append_fixed(tag, value);
    return tag;
}

} // namespace

std::string make_icc(bool srgb, bool grey) {
    std::vector<std::pair<std::string, std::string>> tags = {{"desc", text_tag(srgb ? "sRGB" : "linear sRGB")},
                                                             {"cprt", text_tag("no copyright, use freely")},
                                                             {"wtpt", xyz_tag(0.9642, 1, 0.8249)}};
    if (grey) tags.emplace_back("kTRC", curve_tag(srgb));
    for (int p = 0; p < 3 && !grey; ++p) {
        const double* const xyz = srgb_primaries[p];
        tags.emplace_back(primary_names[p], xyz_tag(xyz[0], xyz[1], xyz[2]));
        tags.emplace_back(std::string(1, primary_names[p][0]) + "TRC", curve_tag(srgb));
    }
    std::string table, data;
    append(table, std::uint32_t(tags.size()));
    for (const auto& [name, value] : tags) {
        table += name;
        append(table, std::uint32_t(132 + 12 * tags.size() + data.size()));
        append(table, std::uint32_t(value.size()));
        data += value;
    }
    std::string header;
    append(header, std::uint32_t(128 + table.size() + data.size()));
    header += std::string("\0\0\0\0\4\x40\0\0mntr", 12) + (grey ? "GRAY" : "RGB ") + "XYZ ";
    header += std::string("\7\262\0\1\0\1\0\0\0\0\0\0acsp", 16); // the first of January 1970
    header.resize(68);
    for (const double value : {0.9642, 1.0, 0.8249}) append_fixed(header, value);
    header.resize(128);
    return header + table + data;
}

} // namespace bake
