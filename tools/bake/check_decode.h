// bake check --decode: normal maps, and the meshes that they were baked for.
#pragma once
#include "check_results.h"

namespace bake {

struct DecodeArgs {
    std::vector<std::pair<std::string, std::string>> maps; ///< and their meshes; <UDIM> in the name: one for each tile
    int tile = 0;                                          ///< of the maps; 0: all charts, modulo 1
};

void add_decode_options(CLI::App& sub, DecodeArgs& args);
/// Throws Error{Refusal::usage} for a tile and maps of all tiles at once.
void check_usage(const DecodeArgs& args);
/// `directx`: green that points down is right.
void check_decode(CheckResults& results, const DecodeArgs& args, bool directx, const InspectOptions& options,
                  const CommonArgs& common);

} // namespace bake
