// A second scene of the same objects, in which materials, sky and lights can be changed while the first one is rendered too.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

/// Built, with copies of all but the shapes, which stay those of `scene`: a built scene that must outlive the twin. Material
/// i of the twin is a copy of material i of the scene.
Scene twin_of(const Scene& scene);

/// Copies a cube.
Cube copied(const Cube& cube);

/// Shows another sky. Directions are still drawn from the table of the old one, so that both scenes take the same samples and
/// their difference has less noise. Together with the directions that are drawn for surfaces that table reaches every
/// direction.
void set_sky(Scene& twin, Cube cube);

/// Replaces textures of one picture in all materials; the new one has its mips.
enum class TextureUse { albedo, normal, bump };
void set_texture(Scene& twin, std::span<const int> materials, TextureUse use, Image<float>&& picture);

} // namespace bake
