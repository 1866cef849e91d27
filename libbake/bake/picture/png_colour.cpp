// W3C, "Portable Network Graphics", third edition, 11.3.2: colour space information.
#include "bake/picture/png_colour.h"
#include "bake/picture/icc.h"
#include <cmath>
#include <cstring>

namespace bake {
namespace {

/// Code points of ITU-T H.273: primaries, then the transfer.
ColourTag read_cicp(png_structp png, png_infop info) {
    png_unknown_chunkp chunks = nullptr;
    for (int i = png_get_unknown_chunks(png, info, &chunks); i-- > 0;) {
        if (std::memcmp(chunks[i].name, "cICP", 4) != 0 || chunks[i].size != 4) continue;
        ColourTag tag{.source = "cICP chunk"};
        const int transfer = chunks[i].data[1];
        if (transfer == 13) tag.curves = {srgb_curve()};
        else if (transfer == 8) tag.curves = {ToneCurve{}};
        else if (transfer == 4) tag.curves = {power_curve(2.2)};
        else if (transfer == 5) tag.curves = {power_curve(2.8)};
        else tag.note = "has a cICP chunk with transfer " + std::to_string(transfer) + ", which is not applied";
        if (chunks[i].data[0] != 1 && tag.note.empty())
            tag.note = "has other primaries than sRGB: its curve is applied, its colours are not converted";
        return tag;
    }
    return {};
}

bool has_other_primaries(png_structp png, png_infop info) {
    double white_x, white_y, x[3], y[3];
    if (!png_get_cHRM(png, info, &white_x, &white_y, &x[0], &y[0], &x[1], &y[1], &x[2], &y[2])) return false;
    constexpr double srgb_x[] = {0.64, 0.3, 0.15}, srgb_y[] = {0.33, 0.6, 0.06};
    for (int i = 0; i < 3; ++i)
        if (std::hypot(x[i] - srgb_x[i], y[i] - srgb_y[i]) > 0.01) return true;
    return false;
}

} // namespace

void keep_unknown_chunks(png_structp png) {
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>("cICP\0acTL"), 2);
}

bool is_animation(png_structp png, png_infop info) {
    png_unknown_chunkp chunks = nullptr;
    for (int i = png_get_unknown_chunks(png, info, &chunks); i-- > 0;)
        if (std::memcmp(chunks[i].name, "acTL", 4) == 0) return true;
    return false;
}

ColourTag read_png_colour(png_structp png, png_infop info) {
    if (ColourTag tag = read_cicp(png, info); !tag.source.empty()) return tag;
    if (png_get_valid(png, info, PNG_INFO_sRGB)) return {.source = "sRGB chunk", .curves = {srgb_curve()}};
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    int compression = 0;
    png_uint_32 size = 0;
    if (png_get_iCCP(png, info, &name, &compression, &profile, &size))
        return read_icc({reinterpret_cast<const char*>(profile), size});
    ColourTag tag;
    if (double gamma = 0; png_get_gAMA(png, info, &gamma) && gamma > 0.01 && gamma < 100) {
        tag.source = "gAMA chunk";
        // The value that the standard prescribes beside sRGB, for programs that know no other chunk.
        const bool is_srgb = std::abs(gamma - 0.45455) < 0.0001;
        tag.curves = {is_srgb ? srgb_curve() : power_curve(1 / gamma)};
    }
    if (has_other_primaries(png, info))
        tag.note = "has a cHRM chunk with other primaries than sRGB: its colours are not converted";
    return tag;
}

} // namespace bake
