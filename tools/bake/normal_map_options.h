// Options of normal-map, which explain has too.
#pragma once
#include "bake/relief/map/normal_map.h"
#include "high_options.h"
#include "inputs/engine.h"
#include "inputs/output_folder.h"
#include "options.h"

namespace bake {

/// How the map's file stores its samples.
enum class MapDepth { automatic, u8, u16, half, float32, bc5 };

/// Texels of a map that takes no size from a height.
inline constexpr int default_map_size = 1024;

struct NormalMapArgs {
    std::string mesh, out;
    std::string displaced; ///< --residual-of
    std::optional<Vec2d> extent;
    std::optional<std::pair<int, int>> size;
    MeshOptions read;
    HeightInput height;
    HighArgs high;               ///< instead of a height
    std::optional<Length> bevel; ///< radius of rounded edges, instead of both
    EngineChoice engine = nullptr;
    std::shared_ptr<OutputFolder> folder; ///< made for --for; goes again if nothing comes into it
    std::string like;                     ///< a normal map whose amplitude and green are taken
    double like_amplitude = 0;            ///< of that map, in widths of the picture; set by take_likeness()
    std::vector<std::string> like_notes;  ///< on that map; likewise
    NormalMethod method = NormalMethod::exact;
    Space space = Space::tangent;
    bool directx = false;
    int padding = NormalMapOptions{}.padding, tile = 0;
    MapDepth depth = MapDepth::automatic;
    bool dither = false; ///< for 8 bits
    int skip_mips = 0;   ///< largest levels that textures leave out
    std::string roughness_map;
    double roughness = 0.5; ///< of the material that the map is for
    std::string preview;    ///< picture of the map on its mesh, or on a rectangle
    int preview_size = 512; ///< pixels along its edges
    std::string material;   ///< whose faces alone are baked; empty: all
};

/// The options that the normal of one texel depends on.
void add_normal_options(CLI::App& sub, NormalMapArgs& args);
/// --for and --like, after the options that they stand for.
void add_target_options(CLI::App& sub, NormalMapArgs& args);
/// --padding, --depth, --dither, --skip-mips, --roughness-map and --roughness.
void add_texture_options(CLI::App& sub, NormalMapArgs& args);
/// Takes green, depth and the file's name from --for, where the user gave no others. Throws Error{Refusal::usage} for a
/// folder without --for.
void complete_engine(NormalMapArgs& args);
/// Whether the map goes into a file with a material: glTF and USD, with the mesh, or MaterialX.
bool writes_asset(const NormalMapArgs& args);
/// How the mesh of --residual-of is read, so that its uvs are those of the map: the copy that bake displace writes of a glTF
/// file has the file's sets of uvs and its v, other files have the uvs of the mesh as it was read.
MeshOptions displaced_reading(const NormalMapArgs& args);
/// The depth of the map's file. For a texture it is u8, u16, or float32, which stands for bc5: what its blocks lose is measured
/// in the file. Throws Error{Refusal::usage} for what the files of the map and of its roughness cannot hold.
Depth resolve_map_depth(const NormalMapArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other, before anything is read. A lone picture is the
/// height of a flat rectangle.
void complete(NormalMapArgs& args, const std::string& verb);
/// Takes amplitude, green and inversion from the normal map `like`, as bake check --pair finds them; green only where the
/// map may have it down. Throws Error{Refusal::unsuitable} if the two do not show the same relief.
void take_likeness(NormalMapArgs& args);
/// The arguments of each map: those given, or one for each tile of the mesh if the name of the map has <UDIM> in it.
std::vector<NormalMapArgs> args_of_tiles(const NormalMapArgs& args, const Mesh& mesh);
/// What an amplitude in per cent refers to: the mesh's diagonal, or the width of the picture without a mesh.
Whole whole_of(const NormalMapArgs& args, const Mesh& mesh);
/// The library's options: size from the height unless given, a per cent turned into units.
NormalMapOptions resolve_options(const NormalMapArgs& args, const HeightTexture& height, const Mesh& mesh);

} // namespace bake
