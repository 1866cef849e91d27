// A second scene of the same objects, in which materials, sky and lights can be changed while the first one is rendered too.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

/// Built, with copies of all but the shapes, which stay those of `scene`: a built scene that must outlive the twin. Material
/// i of the twin is a copy of material i of the scene.
Scene twin_of(const Scene& scene);

/// Gives a scene that was built without a sky a copy of the sky of a built scene, with all that build() makes of a sky: nothing
/// is computed.
void copy_sky(Scene& to, const Scene& from);

/// Copies a cube.
Cube copied(const Cube& cube);

/// Shows another sky, and is lit by it as a scene that is built with it. (The table of the old sky would give the difference of
/// the two less noise, but too few samples to where a small light is blurred: what such samples lack in number they have in
/// size, and the clamp of samples takes it away.)
void set_sky(Scene& twin, Cube cube);

/// Replaces textures of one picture in all materials; the new one has its mips.
enum class TextureUse { albedo, normal, bump };
void set_texture(Scene& twin, std::span<const int> materials, TextureUse use, Image<float>&& picture);

} // namespace bake
