// Options that several verbs share.
#pragma once
#include "bake/base/text.h"
#include "bake/mesh/file/mesh_io.h"
#include "budget_text.h"
#include "inputs/choice.h"
#include "inputs/depth_option.h"
#include "inputs/height_input.h"
#include "inputs/number_option.h"
#include "inputs/output_name.h"
#include "inputs/size_option.h"
#include "inputs/stopwatch.h"

namespace bake {

/// How a mesh is read, given the same way by every verb that reads one.
void add_mesh_options(CLI::App& sub, MeshOptions& options);
/// The UDIM tile whose charts are baked; 0 unless given.
void add_tile_option(CLI::App& sub, int& tile);
/// Prints the notes of reading `path`.
void note_all(const CommonArgs& common, const std::string& path, const std::vector<std::string>& notes);

} // namespace bake
