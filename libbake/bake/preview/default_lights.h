// Lights for scenes that have none.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

/// One directional light from the upper left of the scene's camera.
void add_default_light(Scene& scene);
/// Three directional lights placed relative to the scene's camera, as in a portrait, and ambient light: a key light from the
/// upper left, a weaker fill light from the right, and a rim light from behind, which shows the outline.
void add_studio_lights(Scene& scene);

} // namespace bake
