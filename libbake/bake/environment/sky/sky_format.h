// The table of sky formats: everything that the reader, the writer and the command line must know of a format. A new
// format is one enumerator and one entry here. A new projection needs an enumerator in projection.h and its two functions
// in projection.cpp as well. A field or function that is forgotten does not compile. What is wrong in an entry or in the two
// functions, projection_test finds by laws over all entries: each function is the inverse of the other, a texel in the middle
// of a picture or disc is square and shows an axis, every direction is in a disc and discs touch where they show the same
// direction (columns, rows, discs), no part of the picture is mirrored, and width_per_edge gives as many texels as the cube has,
// as nearly as a whole number can. How the whole picture is turned about its axis, and which disc comes first, are
// conventions that no law can check.
#pragma once
#include "bake/environment/sky/layout.h"
#include "bake/environment/sky/projection.h"
#include "bake/picture/image_types.h"
#include <array>
#include <optional>

namespace bake {

enum class SkyFormat {
    automatic,
    faces,
    latlong,
    hcross,
    vcross,
    strip,
    ball,
    probe,
    octahedral,
    openexr_cube,
    openexr_latlong,
    count ///< number of formats, not a format
};

/// Fields with the value -1 must be given; the static_assert below names a forgotten one.
struct SkyFormatEntry {
    SkyFormat format;
    const char* name;                          ///< on the command line and in reports
    std::optional<CubeLayout> layout = {};     ///< of six faces in one picture
    std::optional<Projection> projection = {}; ///< of a picture of the whole sky
    int columns = -1, rows = -1;               ///< width : height of the picture
    /// Ratio of the picture's width to the face edge of a cube of equal resolution, 1 for six faces in any layout.
    /// 0: the format can be read but not written.
    int width_per_edge = -1;
    int discs = -1; ///< of a projection: discs side by side that hold the sky; 0: the sky fills the picture
    bool known_by_shape = false; ///< a picture of this shape is read as this format, unless the caller names another
    bool mips = false;           ///< can be written with a mip chain
    /// Of OpenEXR's own formats, whose outer samples lie on the edges and whose faces are in OpenEXR's order.
    EnvironmentTag tag = EnvironmentTag::none;

    constexpr bool is_cube() const noexcept { return layout || format == SkyFormat::faces; }
    constexpr bool is_openexr() const noexcept { return tag != EnvironmentTag::none; }
    constexpr FaceOrder order() const noexcept { return is_openexr() ? FaceOrder::openexr : FaceOrder::gl; }
    /// Whether the caller may choose the order of the faces.
    constexpr bool has_order() const noexcept {
        return is_cube() && layout.value_or(CubeLayout::strip) == CubeLayout::strip;
    }
};

// clang-format off
inline constexpr std::array<SkyFormatEntry, int(SkyFormat::count)> sky_formats = {{
    {.format = SkyFormat::automatic, .name = "auto"},
    {.format = SkyFormat::faces, .name = "faces", .columns = 1, .rows = 1, .width_per_edge = 1, .mips = true},
    {.format = SkyFormat::latlong, .name = "latlong", .projection = Projection::latlong, .columns = 2, .rows = 1,
     .width_per_edge = 4, .discs = 0, .known_by_shape = true, .mips = true},
    {.format = SkyFormat::hcross, .name = "hcross", .layout = CubeLayout::hcross, .columns = 4, .rows = 3,
     .width_per_edge = 1, .known_by_shape = true},
    {.format = SkyFormat::vcross, .name = "vcross", .layout = CubeLayout::vcross, .columns = 3, .rows = 4,
     .width_per_edge = 1, .known_by_shape = true},
    {.format = SkyFormat::strip, .name = "strip", .layout = CubeLayout::strip, .columns = 1, .rows = 6,
     .width_per_edge = 1, .known_by_shape = true, .mips = true},
    {.format = SkyFormat::ball, .name = "ball", .projection = Projection::ball, .columns = 1, .rows = 1,
     .width_per_edge = 0, .discs = 1},
    {.format = SkyFormat::probe, .name = "probe", .projection = Projection::probe, .columns = 1, .rows = 1,
     .width_per_edge = 0, .discs = 1},
    {.format = SkyFormat::octahedral, .name = "octahedral", .projection = Projection::octahedral, .columns = 1, .rows = 1,
     .width_per_edge = 2, .discs = 0},
    {.format = SkyFormat::openexr_cube, .name = "openexr-cube", .layout = CubeLayout::strip, .columns = 1, .rows = 6,
     .width_per_edge = 1, .mips = true, .tag = EnvironmentTag::cube},
    {.format = SkyFormat::openexr_latlong, .name = "openexr-latlong", .projection = Projection::latlong_edges,
     .columns = 2, .rows = 1, .width_per_edge = 4, .discs = 0, .mips = true, .tag = EnvironmentTag::latlong},
}};
// clang-format on

namespace detail {
consteval bool is_complete(const SkyFormatEntry& entry, SkyFormat expected) {
    if (entry.format != expected || !entry.name) return false;
    if (expected == SkyFormat::automatic) return true;
    const bool one_picture = expected != SkyFormat::faces;
    return (entry.layout.has_value() != entry.projection.has_value()) == one_picture && entry.columns > 0 &&
           entry.rows > 0 && entry.width_per_edge >= 0 && entry.projection.has_value() == (entry.discs >= 0);
}
consteval bool are_complete() {
    for (std::size_t i = 0; i < sky_formats.size(); ++i)
        if (!is_complete(sky_formats[i], SkyFormat(i))) return false;
    return true;
}
static_assert(are_complete(),
              "sky_formats: one entry for each SkyFormat, in the order of the enum, with a name, a layout "
              "or a projection, columns, rows, width_per_edge and, for a projection, discs");
} // namespace detail

constexpr const SkyFormatEntry& entry_of(SkyFormat format) noexcept { return sky_formats[std::size_t(format)]; }
/// The first format of a projection.
constexpr const SkyFormatEntry& entry_of(Projection projection) noexcept {
    for (const SkyFormatEntry& entry : sky_formats)
        if (entry.projection == projection) return entry;
    return sky_formats[0];
}
constexpr const char* name(SkyFormat format) noexcept { return entry_of(format).name; }
constexpr const char* name(Projection projection) noexcept { return entry_of(projection).name; }

} // namespace bake
