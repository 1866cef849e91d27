// The smallest form of each texture whose picture stays within a budget: baked normal maps and bump tables, and albedos.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/texture_form.h"
#include "bake/verdict/plan/worst_probe.h"

namespace bake {

/// A picture that materials of a scene share.
struct SceneTexture {
    std::string name; ///< its file, or the object whose baked map it is
    TextureUse use = TextureUse::albedo;
    bool baked = false;
    bool bc5 = false; ///< the scene shows it as its blocks
    Texture picture;
    std::vector<int> materials; ///< indices in Scene::materials
    std::vector<int> entries;   ///< of a file: indices in SceneEntries::materials
    std::vector<int> meshes;    ///< of a baked map: indices in SceneEntries::meshes
};

/// Albedos, normal maps and bump tables of the objects in a scene that load() made of `entries`; without entries all count as
/// baked, and have the names of materials. Further maps of glTF materials are not among them.
std::vector<SceneTexture> scene_textures(const Scene& scene, const SceneEntries* entries = nullptr);

/// What a texture is stored in, as far as is known: a file without loss, and normals of a .dds or .ktx2 in BC5 if neither 8 nor
/// 16 bits hold them, or if the scene shows them so; a baked normal map as RGB of 8 bits, a baked bump table
/// in 16 bits.
TextureForm source_form(const SceneTexture& texture);

/// One plan per texture, in the order of scene_textures(). Every form is tried from the smallest on, because errors do not
/// always fall with size, over the objects that show the texture. A material with n textures is judged with the k already
/// decided in place, and may then have the error budget sqrt((k + 1) / n), so that the picture with all of them is within the
/// budget.
/// With options.like_rgb8 a normal map gets the smallest form that errs no more than RGB of 8 bits at full size does, on the
/// same 8192 pixels of its objects, or all.
/// Where no form is within it, a file stays as it is, and a baked map gets the finest form. `scene` is built.
std::vector<TexturePlan> plan_textures(const Scene& scene, const SceneEntries* entries, const PartOptions& options,
                                       Progress* progress = nullptr);

/// The form of a plan.
TextureForm form_of(const TexturePlan& plan) noexcept;

} // namespace bake
