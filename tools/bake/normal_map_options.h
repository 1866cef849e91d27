// Options of normal-map, which explain has too.
#pragma once
#include "bake/relief/map/normal_map.h"
#include "high_options.h"
#include "options.h"

namespace bake {

struct NormalMapArgs {
    std::string mesh, out;
    std::string displaced; ///< --residual-of
    std::optional<Vec2d> extent;
    std::optional<std::pair<int, int>> size;
    MeshOptions read;
    HeightInput height;
    HighArgs high; ///< instead of a height
    NormalMethod method = NormalMethod::exact;
    Space space = Space::tangent;
    bool directx = false;
    int padding = NormalMapOptions{}.padding, tile = 0;
    Depth depth = Depth::automatic;
};

/// The options that the normal of one texel depends on.
void add_normal_options(CLI::App& sub, NormalMapArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other, before anything is read. A lone picture is the
/// height of a flat rectangle.
void complete(NormalMapArgs& args, const std::string& verb);
/// What an amplitude in per cent refers to: the mesh's diagonal, or the width of the picture without a mesh.
Whole whole_of(const NormalMapArgs& args, const Mesh& mesh);
/// The library's options: size from the height unless given, a per cent turned into units.
NormalMapOptions resolve_options(const NormalMapArgs& args, const HeightTexture& height, const Mesh& mesh);

} // namespace bake
