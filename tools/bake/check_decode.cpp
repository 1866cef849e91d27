#include "check_decode.h"
#include "bake/mesh/file/mesh_io.h"
#include "inputs/file_kind.h"
#include "inputs/tile_names.h"

namespace bake {

void add_decode_options(CLI::App& sub, DecodeArgs& args) {
    CLI::Option* const maps =
        sub.add_option(
               "--decode", args.maps,
               "A normal map and the mesh that it was baked for: what viewers that decode it in other ways make "
               "of it, in degrees; <UDIM> in its name: of each tile; may be given again")
            ->allow_extra_args(false)
            ->type_name("NORMAL MESH");
    add_tile_option(sub, args.tile);
    sub.get_option("--tile")->needs(maps);
}

void check_usage(const DecodeArgs& args) {
    for (const auto& [map, mesh] : args.maps) expect_tile_or_all("the map", map, args.tile);
}

void check_decode(CheckResults& results, const DecodeArgs& args, bool directx, const InspectOptions& options,
                  const CommonArgs& common) {
    const auto check = [&](const std::string& map, const std::string& mesh, int tile) {
        add_result(results, map, common, [&] {
            expect_picture(map);
            expect_mesh(mesh);
            return inspect_decoding(map, mesh, directx, options, tile);
        });
    };
    for (const auto& [map, mesh] : args.maps) {
        if (!names_tiles(map)) {
            check(map, mesh, args.tile);
            continue;
        }
        std::vector<int> tiles;
        is_accepted(results, map, [&, &path = mesh] {
            expect_mesh(path);
            tiles = udim_tiles(read_mesh(path, options.read), path);
        });
        for (const int tile : tiles) check(file_of_tile(map, tile), mesh, tile);
    }
}

} // namespace bake
