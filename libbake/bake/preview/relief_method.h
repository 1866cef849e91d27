// How a scene shows the relief of a height: by which model, from none at all to true displacement.
#pragma once
#include "bake/preview/material.h"
#include "bake/relief/height/height.h"
#include "bake/relief/height/slope_filter.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

enum class Shade {
    plain,           ///< no relief
    roughness,       ///< no relief, but a highlight as wide as its slopes make it
    constant_scale,  ///< at each hit from the height: NormalMethod::constant_scale
    blinn,           ///< NormalMethod::blinn
    exact,           ///< NormalMethod::exact
    bump,            ///< looks up a table of slopes: bump_table()
    bump_roughness,  ///< the same; what lookups average away widens the highlight, whatever filter the scene has
    normal,          ///< looks up a tangent-space map of exact normals: normal_map()
    displace,        ///< a displaced mesh: displace()
    displace_normal, ///< a displaced mesh with a map of the exact normals relative to it: residual_map()
    high,            ///< the high-poly mesh itself, of an object that has one (high_entry.h); of no height
};

/// Whether the mesh itself is displaced.
constexpr bool displaces(Shade shade) noexcept { return shade == Shade::displace || shade == Shade::displace_normal; }

struct ShadeMethod {
    Shade shade = Shade::exact;
    int levels = 4; ///< displace: every edge becomes 2^levels; negative: as many as memory allows
};

/// "plain", "roughness", "constant-scale", "lecture" (the same), "blinn", "exact", "bump",
/// "bump+roughness", "normal", "displace:N" and "displace+normal:N" with N segments per edge, a power of two up to 1024, or "max". Nothing for any other word.
std::optional<ShadeMethod> parse_shade(const std::string& word);
std::string name(const ShadeMethod& method);
/// For messages.
inline constexpr const char* shade_names = "\"plain\", \"roughness\", \"constant-scale\", \"blinn\", \"exact\", "
                                           "\"bump\", \"bump+roughness\", \"normal\", \"displace:16\" or another "
                                           "power of two, \"displace:max\", \"displace+normal:16\"";

/// Of Embree's tree with its copy of the corners, as measured.
inline constexpr int tree_bytes_per_triangle = 86;

/// What the values of a height mean on one shape.
struct ReliefOptions {
    ShadeMethod method;
    HeightOptions height;
    Filter filter = Filter::automatic; ///< of bump and normal; the others take slopes from the cubic spline
    bool mips = true;                  ///< whether methods that take slopes from the height need them for filtering
};

/// A material with the relief, and the shape that it belongs on.
struct ReliefModel {
    Material material;
    std::unique_ptr<Shape> shape; ///< displaced; null: the shape as it was
    int segments = 0;             ///< of displaced edges
    std::vector<std::string> notes;
};

/// Bakes what the method, which is not Shade::high, needs, by the functions that the commands call. Throws their errors: Error{Refusal::unsuitable} for
/// a shape without uvs, and for a displacement that does not fit in memory.
ReliefModel with_relief(const Material& material, const Shape& shape, const HeightTexture& height,
                        const ReliefOptions& options);

} // namespace bake
