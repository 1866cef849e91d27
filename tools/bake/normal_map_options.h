// Options of normal-map, which explain has too.
#pragma once
#include "bake/relief/map/normal_map.h"
#include "options.h"

namespace bake {

struct NormalMapArgs {
    std::string mesh, out, amplitude, extent, size;
    MeshOptions read;
    HeightArgs height;
    double midlevel = 0.5;
    NormalMethod method = NormalMethod::exact;
    Space space = Space::tangent;
    bool directx = false;
    int padding = 16, tile = 0;
    Depth depth = Depth::automatic;
};

/// All options but the mesh, --out and --depth.
void add_normal_map_options(CLI::App& sub, NormalMapArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other, before anything is read.
void check_usage(const NormalMapArgs& args);
/// The library's options: size from the height unless given, a per cent of the mesh's diagonal turned into units.
NormalMapOptions resolve_options(const NormalMapArgs& args, const HeightTexture& height, const Mesh& mesh);

} // namespace bake
