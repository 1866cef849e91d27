// The nine coefficients of spherical harmonics that stand for an environment's diffuse light, as engines take them.
#pragma once
#include "bake/environment/filter/spherical_harmonics.h"
#include "bake/picture/consumer.h"

namespace bake {

/// The coefficients of `bands` bands of a sky, in the world, whose x is the negative of cube space's: right-handed, what is
/// ahead in the picture at +z, up at +y. Basis and order as in spherical_harmonics.h. Throws Error{Refusal::usage} for
/// filament with another number of bands than 3.
ShCoefficients engine_sh(const Cube& sky, int bands, ShForm form);

/// One line of text per coefficient in the order of the list, the channels with blanks between them.
std::string to_text(const ShCoefficients& series);
/// The same as a file. Throws as OutputFile.
void write_sh_text(const std::string& path, const ShCoefficients& series);

} // namespace bake
