#include "high_options.h"
#include "inputs/choice.h"
#include "inputs/file_kind.h"

namespace bake {

void add_high_options(CLI::App& sub, HighArgs& args) {
    sub.add_option("--high", args.paths,
                   "Meshes whose detail is cast onto the uvs of the first mesh, instead of the relief of --height")
        ->type_name("HIGH.ply...");
    sub.add_option("--cage", args.cage,
                   "The first mesh with its faces pushed out: rays start there [automatic, from the meshes' distance]")
        ->type_name("MESH");
    add_length_option(sub, "--extrude", args.extrude, "Rays start this far outside of the first mesh [automatic]");
    add_length_option(sub, "--max-distance", args.max_distance,
                      "Length of the rays [with --extrude twice that, else automatic]");
    add_integer_option(sub, "--rays", args.rays, 1, 16, "Rays along each side of a texel, K x K in all")
        ->default_str(std::to_string(args.rays));
    add_choice<HighNormals>(sub, "--high-normals", args.normals,
                            {{"smooth", HighNormals::smooth}, {"facet", HighNormals::facet}},
                            "Normals of the meshes of --high");
    add_choice<CastBy>(
        sub, "--cast", args.cast, {{"blend", CastBy::blend}, {"averaged", CastBy::averaged}, {"face", CastBy::face}},
        "Directions of rays: averaged at hard edges and perpendicular elsewhere, averaged, or of facets");
    sub.add_flag("--strict", args.strict, "Exit code 1 if a texel finds no detail");
}

void complete(const HighArgs& args) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (!args.given()) {
        if (!args.cage.empty() || args.extrude || args.max_distance || args.strict)
            throw usage("--cage, --extrude, --max-distance and --strict: belong to --high; name the high-poly mesh");
        return;
    }
    for (const std::string& path : args.paths) expect_mesh(path);
    if (!args.cage.empty()) expect_mesh(args.cage);
    if (!args.cage.empty() && (args.extrude || args.max_distance))
        throw usage("--cage: brings its own distances; leave out --extrude and --max-distance");
    if (args.max_distance && !args.extrude)
        throw usage("--max-distance: counts from where rays start; give --extrude too");
}

} // namespace bake
