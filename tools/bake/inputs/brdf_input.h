// A reflection model as text: "phong:n=20,specular=.5", and sums such as "lambert:albedo=.5+blinn:n=32,specular=.3".
#pragma once
#include "bake/light/lobe.h"
#include <string>

namespace bake {

/// Models with their keys, ranges and defaults, one per line.
std::string brdf_models();

/// Throws Error{Refusal::usage} that starts with the flag and names the model or key that was probably meant.
Bsdf parse_brdf(const std::string& flag, const std::string& text);

} // namespace bake
