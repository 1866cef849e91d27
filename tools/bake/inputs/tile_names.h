// <UDIM> in the name of a map: one file for each tile of the uvs.
#pragma once
#include "bake/mesh/mesh.h"
#include "verb.h"
#include <vector>

namespace bake {

/// Whether the name has <UDIM> in it.
bool names_tiles(const std::string& path);
/// The name with the number of the tile in the place of <UDIM>.
std::string file_of_tile(const std::string& path, int tile);
/// The UDIM numbers of the tiles in which the mesh has charts, ascending. Throws Error{Refusal::unsuitable}, which names `path`,
/// for a mesh without uvs, and for charts in tiles that UDIM does not number.
std::vector<int> udim_tiles(const Mesh& mesh, const std::string& path);
/// Throws Error{Refusal::usage} if the name has <UDIM> in it: for outputs of which there is one.
void expect_one_file(const std::string& flag, const std::string& path, const std::string& why);
/// Throws Error{Refusal::usage} if --tile chose a tile (0: it did not) and the name has <UDIM> in it, which asks for
/// all tiles. `what` has the name, for the message: "the map".
void expect_tile_or_all(const std::string& what, const std::string& path, int tile);

} // namespace bake
