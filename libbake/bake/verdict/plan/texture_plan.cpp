#include "bake/verdict/plan/texture_plan.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/picture/texture_file.h"
#include "bake/preview/loaded_picture.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

const char* kind_of(TextureUse use) noexcept {
    return use == TextureUse::normal ? "normal" : use == TextureUse::bump ? "bump" : "albedo";
}

/// The file that an entry names for a texture that load() read for it; empty for baked ones.
std::string file_of(const Scene& scene, const SceneEntries& entries, int material, TextureUse use) {
    const Material& own = *scene.materials[material];
    // Material 0 is that of meshes without one.
    for (std::size_t i = 0; i < entries.materials.size() && i + 1 < scene.materials.size(); ++i) {
        const Material& read = *scene.materials[i + 1];
        const MaterialEntry& entry = entries.materials[i];
        if (use == TextureUse::albedo && own.albedo == read.albedo && !entry.albedo.empty()) return entry.albedo;
        if (use == TextureUse::normal && own.normal_map == read.normal_map && !entry.normal_map.empty())
            return entry.normal_map;
        if (use == TextureUse::bump && own.bump_table == read.bump_table && !entry.bump_table.empty())
            return entry.bump_table;
    }
    return {};
}

/// The meshes with a material, as far as the entries tell: each stands for one instance.
std::vector<int> meshes_with(const Scene& scene, const SceneEntries* entries, const Material& material) {
    std::vector<int> meshes;
    if (!entries || scene.instances.size() != entries->meshes.size() + std::size_t(entries->ground.has_value()))
        return meshes;
    for (std::size_t i = 0; i < entries->meshes.size(); ++i)
        if (scene.instances[i].material == &material) meshes.push_back(int(i));
    return meshes;
}

/// The name of a baked map: that of the first mesh with it.
std::string object_of(const SceneEntries* entries, const std::vector<int>& meshes, const Material& material) {
    if (meshes.empty()) return material.name;
    const MeshEntry& mesh = entries->meshes[std::size_t(meshes.front())];
    return !mesh.name.empty() ? mesh.name : !mesh.file.empty() ? mesh.file : mesh.shape;
}

const Texture& texture_of(const Material& material, TextureUse use) noexcept {
    return use == TextureUse::normal ? material.normal_map
           : use == TextureUse::bump ? material.bump_table
                                     : material.albedo;
}

/// The entries of materials that show a texture which load() read for them.
std::vector<int> entries_with(const Scene& scene, const SceneEntries& entries, const SceneTexture& texture) {
    std::vector<int> with;
    for (std::size_t i = 0; i < entries.materials.size() && i + 1 < scene.materials.size(); ++i)
        if (texture_of(*scene.materials[i + 1], texture.use) == texture.picture) with.push_back(int(i));
    return with;
}

/// By the key of its entries, or of those of the meshes that it is baked for.
bool is_in_bc5(const SceneEntries& entries, const SceneTexture& texture) {
    const auto says = [&](int material) { return entries.materials[std::size_t(material)].normal_bc5; };
    return std::any_of(texture.entries.begin(), texture.entries.end(), says) ||
           std::any_of(texture.meshes.begin(), texture.meshes.end(), [&](int mesh) {
               const MeshEntry& entry = entries.meshes[std::size_t(mesh)];
               return entry.high.normal_bc5 || (entry.material >= 0 && says(entry.material));
           });
}

bool share_a_material(const SceneTexture& a, const SceneTexture& b) noexcept {
    return std::find_first_of(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end()) !=
           a.materials.end();
}

/// The error that the picture may have after texture i is decided.
double share_of(double budget, const std::vector<SceneTexture>& textures, std::size_t i) noexcept {
    int before = 0, all = 0;
    for (std::size_t k = 0; k < textures.size(); ++k)
        if (share_a_material(textures[i], textures[k])) ++all, before += k < i;
    return budget * std::sqrt(double(before + 1) / all);
}

/// Forms that a texture may get: a file no larger one than it has.
std::vector<TextureForm> forms_of(const SceneTexture& texture, const TextureForm& source, const PartOptions& options) {
    const Image<float>& image = *texture.picture;
    auto forms =
        texture_forms(texture.use, image.width(), image.height(), texture.use == TextureUse::albedo && is_grey(image));
    if (!texture.baked) std::erase_if(forms, [&](const TextureForm& form) { return form.bytes() >= source.bytes(); });
    std::erase_if(forms, [&](const TextureForm& form) {
        const bool stored_alike =
            form.channels == source.channels && form.bits == source.bits && form.half == source.half;
        return (!options.sizes && form.halvings > 0) || (!options.formats && !stored_alike);
    });
    return forms;
}

constexpr int compared = 8192; ///< pixels on which forms are compared with RGB8

void set_form(TexturePlan& plan, const TextureForm& form) {
    plan.width = form.width, plan.height = form.height, plan.channels = form.channels, plan.bits = form.bits;
    plan.half = form.half;
    plan.bytes = form.bytes();
}

TexturePlan start(const SceneTexture& texture, const TextureForm& source) {
    TexturePlan plan{.file = texture.name, .kind = kind_of(texture.use)};
    set_form(plan, source);
    plan.source_width = source.width, plan.source_height = source.height;
    plan.source_channels = source.channels, plan.source_bits = source.bits;
    plan.source_bytes = source.bytes();
    plan.materials = texture.entries, plan.meshes = texture.meshes;
    return plan;
}

/// The texels of a form as they are read back. `halvings`: of the texture. In the form of a map that the scene shows in
/// BC5 it stays as it is, because the encoder need not find its blocks again.
Image<float> texels_of(const SceneTexture& texture, const std::vector<Image<float>>& halvings,
                       const TextureForm& form) {
    const Image<float>& halving = halvings[std::size_t(form.halvings)];
    return texture.bc5 && form == source_form(texture) ? copied(halving) : stored(halving, texture.use, form);
}

/// The first form that errs no more than RGB of 8 bits at full size does on the same pixels, by the same random numbers. That
/// one is among the forms of a map that has more bits. Leaves the twin with the chosen form.
TexturePlan decide_like_rgb8(const SceneTexture& texture, const PartOptions& options, WorstProbe& probe, Scene& twin) {
    const TextureForm source = source_form(texture);
    TexturePlan plan = start(texture, source);
    const std::vector<Image<float>> halvings = halvings_of(*texture.picture);
    const auto show = [&](const TextureForm& form) {
        set_texture(twin, texture.materials, texture.use, texels_of(texture, halvings, form));
    };
    show({0, texture.picture->width(), texture.picture->height(), 3, 8});
    const SquareEstimate rgb8 = probe.measure(twin, compared).error;
    plan.rgb8_rmse = rgb8.rmse();
    std::string smaller; // the last form that errs more
    for (const TextureForm& form : forms_of(texture, source, options)) {
        show(form);
        // Most forms are far off, and are refused after a few pixels.
        SquareEstimate error = probe.judge(twin, plan.rgb8_rmse).error;
        if (error.low() <= plan.rgb8_rmse) error = probe.measure(twin, compared).error;
        if (error.rmse() <= plan.rgb8_rmse) {
            set_form(plan, form);
            plan.error = error;
            plan.why =
                form.text() + " errs by " + error_text(error) + ", RGB of 8 bits in full size by " + error_text(rgb8);
            if (!smaller.empty()) plan.why += "; " + smaller;
            return plan;
        }
        smaller = form.text() + " errs by " + error_text(error);
    }
    set_texture(twin, texture.materials, texture.use, copied(halvings[0]));
    plan.error.all = true;
    plan.why = "nothing smaller errs as little as RGB of 8 bits in full size, which errs by " + error_text(rgb8) +
               (smaller.empty() ? std::string() : "; " + smaller);
    return plan;
}

/// Leaves the twin with the chosen form.
TexturePlan decide(const SceneTexture& texture, const PartOptions& options, WorstProbe& probe, Scene& twin,
                   double budget) {
    const TextureForm source = source_form(texture);
    TexturePlan plan = start(texture, source);
    const std::vector<TextureForm> forms = forms_of(texture, source, options);
    if (!probe.in_view()) {
        if (!forms.empty()) set_form(plan, forms.front());
        plan.why = "no camera sees it";
        return plan;
    }
    if (options.like_rgb8 && texture.use == TextureUse::normal) return decide_like_rgb8(texture, options, probe, twin);
    const std::vector<Image<float>> halvings = halvings_of(*texture.picture);
    std::string smaller; // the last form that was not enough
    for (const TextureForm& form : forms) {
        set_texture(twin, texture.materials, texture.use, texels_of(texture, halvings, form));
        const WorstProbe::Result result = probe.judge(twin, budget);
        if (result.within || (texture.baked && form == forms.back())) {
            set_form(plan, form);
            plan.error = result.error;
            plan.why = result.within ? form.text() + " errs by " + error_text(result.error) + format(" of %.2g", budget)
                                     : "no form is within " + format("%.2g", budget) +
                                           "; this is the finest, and errs by " + error_text(result.error);
            if (!result.settled) plan.why += ", not settled";
            if (!smaller.empty()) plan.why += "; " + smaller;
            return plan;
        }
        smaller = form.text() + " errs by " + error_text(result.error);
    }
    set_texture(twin, texture.materials, texture.use, copied(halvings[0]));
    plan.error.all = true;
    plan.why = "the file stays as it is" + (smaller.empty() ? std::string() : "; " + smaller);
    return plan;
}

} // namespace

std::vector<SceneTexture> scene_textures(const Scene& scene, const SceneEntries* entries) {
    std::vector<SceneTexture> textures;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = *scene.materials[i];
        const bool used = std::any_of(scene.instances.begin(), scene.instances.end(),
                                      [&](const Instance& instance) { return instance.material == &material; });
        if (!used) continue;
        for (const TextureUse use : {TextureUse::normal, TextureUse::bump, TextureUse::albedo}) {
            const Texture& picture = texture_of(material, use);
            if (!picture) continue;
            const auto known = std::find_if(textures.begin(), textures.end(), [&](const SceneTexture& t) {
                return t.use == use && t.picture == picture;
            });
            if (known != textures.end()) {
                known->materials.push_back(int(i));
                continue;
            }
            SceneTexture texture{.use = use, .picture = picture, .materials = {int(i)}};
            if (entries) texture.name = file_of(scene, *entries, int(i), use);
            texture.baked = texture.name.empty();
            if (texture.baked) {
                texture.meshes = meshes_with(scene, entries, material);
                texture.name = object_of(entries, texture.meshes, material);
            } else {
                texture.entries = entries_with(scene, *entries, texture);
            }
            texture.bc5 = entries && use == TextureUse::normal && is_in_bc5(*entries, texture);
            textures.push_back(std::move(texture));
        }
    }
    return textures;
}

TextureForm source_form(const SceneTexture& texture) {
    const Image<float>& image = *texture.picture;
    const TextureForm blocks{0, image.width(), image.height(), 2, bc5_bits};
    if (texture.bc5) return blocks;
    if (!texture.baked) {
        const bool container = texture_container(texture.name).has_value();
        const TextureForm form = lossless_form(image, texture.use, container);
        // The blocks of a texture file need not be what the encoder finds again.
        const bool unknown = form.bits == 32 && texture.use == TextureUse::normal && container;
        return unknown ? blocks : form;
    }
    if (texture.use == TextureUse::normal) return {0, image.width(), image.height(), 3, 8, false};
    if (texture.use == TextureUse::bump) return {0, image.width(), image.height(), 2, 16, false};
    return lossless_form(image, texture.use);
}

std::vector<TexturePlan> plan_textures(const Scene& scene, const SceneEntries* entries, const PartOptions& options,
                                       Progress* progress) {
    const std::vector<SceneTexture> textures = scene_textures(scene, entries);
    std::vector<TexturePlan> plans;
    if (textures.empty()) return plans;
    if (progress) progress->start("textures", std::int64_t(textures.size()));
    Scene twin = twin_of(scene);
    for (std::size_t i = 0; i < textures.size(); ++i) {
        std::vector<const Material*> materials;
        for (const int m : textures[i].materials) materials.push_back(scene.materials[m].get());
        WorstProbe probe(scene, {objects_with(scene, materials)}, options);
        plans.push_back(decide(textures[i], options, probe, twin, share_of(options.budget, textures, i)));
        if (progress) progress->add(1);
    }
    return plans;
}

TextureForm form_of(const TexturePlan& plan) noexcept {
    TextureForm form{0, plan.width, plan.height, plan.channels, plan.bits, plan.half};
    for (int w = plan.source_width, h = plan.source_height; w > plan.width || h > plan.height; ++form.halvings)
        w = std::max(1, w / 2), h = std::max(1, h / 2);
    return form;
}

} // namespace bake
