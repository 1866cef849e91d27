#include "high_options.h"
#include "bake/base/text.h"
#include "inputs/choice.h"
#include "inputs/file_kind.h"
#include "inputs/name_list.h"
#include "inputs/tile_names.h"

namespace bake {
namespace {

std::vector<std::string> map_names() {
    std::vector<std::string> names;
    for (const DetailMap map : all_detail_maps) names.emplace_back(name(map));
    return names;
}

} // namespace

void add_high_options(CLI::App& sub, HighArgs& args) {
    CLI::Option* const high =
        sub.add_option("--high", args.paths,
                       "Meshes whose detail is cast onto the uvs of the first mesh, instead of the relief of --height")
            ->type_name("HIGH.ply");
    sub.add_option("--cage", args.cage,
                   "The first mesh with its faces pushed out: rays start there [automatic, from the meshes' distance]")
        ->type_name("MESH");
    sub.add_option("--cage-out", args.cage_out,
                   "The automatic envelope as such a mesh, to be edited and given to --cage")
        ->type_name("OUT.ply");
    add_choice<bool>(sub, "--match-names", args.match_names, {{"yes", true}, {"no", false}},
                     "Parts take detail from the parts of their name alone: low_wheel from high_wheel");
    add_length_option(sub, "--extrude", args.extrude, "Rays start this far outside of the first mesh [automatic]");
    add_length_option(sub, "--max-distance", args.max_distance,
                      "Length of the rays [with --extrude twice that, else automatic]");
    add_integer_option(
        sub, "--rays", args.rays, 1, 16,
        format("Rays along each side of a texel; with --max-error-deg the most [%d; %d with --max-error-deg]",
               default_rays, most_rays_by_default));
    add_number_option(sub, "--max-error-deg", args.max_error_deg, 1e-4, 180,
                      "Rays are added to a texel until its mean is known to so many degrees [all texels get K x K]");
    add_choice<HighNormals>(
        sub, "--high-normals", args.normals,
        {{"smooth", HighNormals::smooth}, {"curved", HighNormals::curved}, {"facet", HighNormals::facet}},
        "Normals of the meshes of --high: as they are shaded, with the curvature between corners, or of "
        "facets");
    add_length_option(sub, "--high-smooth", args.smooth,
                      "Smooths the normals of --high over this length, as stairs of voxels need");
    add_choice<CastBy>(
        sub, "--cast", args.cast, {{"blend", CastBy::blend}, {"averaged", CastBy::averaged}, {"face", CastBy::face}},
        "Directions of rays: averaged at hard edges and perpendicular elsewhere, averaged, or of facets");
    std::string names;
    for (const std::string& each : map_names()) names += (names.empty() ? "" : ",") + each;
    sub.add_option_function<std::string>(
           "--maps",
           [&args](const std::string& text) {
               for (const std::size_t i : parse_names("--maps", text, "map", map_names()))
                   args.maps.push_back(all_detail_maps[i]);
           },
           "Further maps of the detail: " + names)
        ->type_name("LIST");
    sub.add_option("--maps-out", args.maps_out, "What their names begin with: PREFIX_height.exr and so on")
        ->type_name("PREFIX");
    add_integer_option(sub, "--sky-rays", args.sky_rays, 1, 4096, "Rays of ambient-occlusion and bent-normal")
        ->default_str(std::to_string(args.sky_rays));
    add_length_option(sub, "--sky-distance", args.sky_distance, "Nothing farther away occludes [no limit]");
    sub.add_option("--debug-rays", args.debug_rays, "Mesh of the envelope, some rays and the misses, to look at")
        ->type_name("OUT.glb");
    sub.add_option("--report-map", args.report_map,
                   "Picture of the texels: red misses, grey by how far the normal bends within a texel")
        ->type_name("OUT.png");
    sub.add_flag("--alpha", args.alpha, "A fourth channel: 0 where a texel found no detail or lies beyond the padding");
    sub.add_flag("--strict", args.strict, "Exit code 1 if a texel finds no detail");
    for (const char* flag : {"--cage", "--cage-out", "--match-names", "--extrude", "--max-distance", "--rays",
                             "--max-error-deg", "--high-normals", "--high-smooth", "--cast", "--maps", "--maps-out",
                             "--sky-rays", "--sky-distance", "--debug-rays", "--report-map", "--alpha", "--strict"})
        sub.get_option(flag)->needs(high);
}

void complete(const HighArgs& args, bool asset) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (!args.given()) return;
    const bool occlusion_alone = args.maps == std::vector{DetailMap::ambient_occlusion};
    if (args.maps.empty() != args.maps_out.empty() && !(asset && occlusion_alone))
        throw usage("--maps, --maps-out: belong together; name the maps and what their names begin with");
    for (const std::string& path : args.paths) expect_mesh(path);
    if (!args.cage.empty()) expect_mesh(args.cage);
    if (args.max_error_deg && args.rays == 1)
        throw usage(
            "--max-error-deg: adds rays to texels, and --rays 1 allows one alone; leave out --rays or give more");
    if (args.smooth && args.normals == HighNormals::facet)
        throw usage("--high-smooth, --high-normals facet: facets have one normal each; leave one of the two out");
    if (!args.cage.empty() && (args.extrude || args.max_distance))
        throw usage("--cage: brings its own distances; leave out --extrude and --max-distance");
    if (!args.cage_out.empty()) {
        if (!args.cage.empty() || args.extrude)
            throw usage("--cage-out: writes the automatic envelope; leave out --cage and --extrude");
        const MeshFormat format = mesh_format(args.cage_out);
        if (format != MeshFormat::obj && format != MeshFormat::ply)
            throw usage(
                "--cage-out: name a file that ends in .ply or .obj; glTF has no faces of more than three corners");
        expect_one_file("--cage-out", args.cage_out, "all tiles share one cage");
    }
    if (args.max_distance && !args.extrude)
        throw usage("--max-distance: counts from where rays start; give --extrude too");
}

void refuse_height_options(const CLI::App& sub, const std::string& instead) {
    for (const char* flag :
         {"--amplitude", "--midlevel", "--method", "--filter", "--wrap", "--wrap-u", "--wrap-v", "--channel",
          "--invert", "--dequantise", "--extent", "--residual-of", "--like", "--repeat"})
        if (sub.count(flag) > 0)
            throw Error(Refusal::usage, std::string(flag) + ": belongs to a height; leave it out with " + instead);
}

} // namespace bake
