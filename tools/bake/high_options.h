// Options of normal-map for the detail of high-poly meshes.
#pragma once
#include "bake/relief/transfer/transfer.h"
#include "inputs/number_option.h"

namespace bake {

struct HighArgs {
    std::vector<std::string> paths;
    std::string cage, cage_out;
    std::optional<Length> extrude, max_distance;
    std::optional<int> rays;             ///< along each side of a texel
    std::optional<double> max_error_deg; ///< of the mean over a texel
    HighNormals normals = HighNormals::smooth;
    std::optional<Length> smooth; ///< of the normals, before the bake
    CastBy cast = CastBy::blend;
    bool strict = false, alpha = false, match_names = false;
    std::string debug_rays, report_map;
    std::vector<DetailMap> maps;
    std::string maps_out;
    int sky_rays = DetailOptions{}.sky_rays;
    std::optional<Length> sky_distance;

    bool given() const noexcept { return !paths.empty(); }
};

inline constexpr int default_rays = 1, most_rays_by_default = 8; ///< without and with an error that is asked for

void add_high_options(CLI::App& sub, HighArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other.
/// `asset`: occlusion goes into a glTF file, and needs no name.
void complete(const HighArgs& args, bool asset = false);
/// Throws Error{Refusal::usage} for an option of a height beside `instead`, as in --high.
void refuse_height_options(const CLI::App& sub, const std::string& instead);

} // namespace bake
