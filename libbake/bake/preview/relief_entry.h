// A height as a material of a scene states it.
#pragma once
#include "bake/preview/relief_method.h"
#include <optional>
#include <string>

namespace bake {

/// A height and how it is shown; the numbers mean what they mean to `bake displace`.
struct ReliefEntry {
    std::string file;
    std::optional<float> amplitude; ///< object units, or a part of the diagonal; none: the default of the commands
    bool relative = false;          ///< the amplitude is a part of the diagonal of the mesh
    std::optional<float> midlevel;
    Filter filter = Filter::automatic;
    Wrap wrap = Wrap::repeat;
    std::optional<ShadeMethod> shade; ///< none: exact
};

/// What the values of a height mean on a shape of this diagonal: those of the entry, and the defaults of the commands.
ReliefOptions relief_options(const ReliefEntry& entry, const ImageInfo& file, double diagonal);

} // namespace bake
