// Which parts of high-poly meshes belong to which parts of a low-poly mesh, by their names: low_wheel and high_wheel.
#pragma once
#include "bake/relief/transfer/high_surface.h"

namespace bake {

/// A part is named by the group of its faces (of glTF the node), without one by their material, without one by the file. "low",
/// "high", "lp" or "hp" at the beginning or the end of a name, apart by _ - . or a space, do not count, nor do capitals.
std::string part_key(const std::string& name);

struct NameMatch {
    std::vector<std::string> names; ///< keys of the parts that were found in both
    std::vector<std::uint32_t>
        of_face; ///< faces of the low-poly mesh: the part, no_index for one without a counterpart
    std::vector<std::vector<HighMesh>> high;        ///< per part
    std::vector<std::string> low_alone, high_alone; ///< names without a counterpart, sorted
};

/// High-poly parts belong to the low-poly part with the same key, or with the longest one that their key goes on from after a _, so
/// that high_wheel_bolts belongs to low_wheel. Throws Error{Refusal::unsuitable}, which tells names of both, if nothing matches.
NameMatch match_names(const Mesh& low, const std::string& path, std::vector<HighMesh> high);

} // namespace bake
