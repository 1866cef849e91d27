#include "bake/preview/scene_io.h"
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/environment/file/cube_levels.h"
#include "bake/environment/file/face_files.h"
#include "bake/preview/scene_lights.h"
#include "bake/preview/scene_maps.h"
#include "bake/preview/scene_objects.h"
#include "bake/preview/scene_relief.h"
#include "bake/preview/scene_section.h"
#include <algorithm>
#include <filesystem>

namespace bake {
namespace {

void read_render(const Section& in, SceneEntries& scene) {
    allow_only(in, {"size", "spp", "bounces", "diffuse-bounces", "shadows", "sky-light", "terminator", "texture-filter",
                    "seed", "exposure", "tone", "background"});
    RenderSettings& s = scene.settings;
    if (const toml::node* size = in.table.get("size")) {
        if (size->is_number()) {
            s.width = s.height = checked_integer(in, *size, "size", 1, 32768);
        } else {
            const toml::array& list = checked_array(in, *size, "size", 2, "whole numbers");
            s.width = checked_integer(in, *list.get(0), "size", 1, 32768);
            s.height = checked_integer(in, *list.get(1), "size", 1, 32768);
        }
    }
    read(in, "spp", s.spp, 1, 65536);
    read(in, "bounces", s.bounces, 0, 16);
    read(in, "diffuse-bounces", s.diffuse_bounces, 0, 16);
    read(in, "shadows", s.shadows);
    read_choice<SkyLighting>(
        in, "sky-light", s.sky_light,
        {{"off", SkyLighting::off}, {"sampled", SkyLighting::sampled}, {"irradiance", SkyLighting::irradiance}});
    read_choice<Terminator>(in, "terminator", s.terminator,
                            {{"off", Terminator::off},
                             {"flip", Terminator::flip},
                             {"rotate", Terminator::rotate},
                             {"estevez", Terminator::estevez},
                             {"chiang", Terminator::chiang}});
    read_choice<TextureFilter>(
        in, "texture-filter", s.filter,
        {{"off", TextureFilter::off}, {"mips", TextureFilter::mips}, {"moments", TextureFilter::moments}});
    int seed = 0;
    read(in, "seed", seed, 0, 1'000'000'000);
    s.seed = std::uint32_t(seed);
    if (float exposure = 0; in.table.get("exposure")) read(in, "exposure", exposure, -64, 64), s.exposure = exposure;
    read_choice<Tone>(in, "tone", s.tone, {{"srgb", Tone::srgb}, {"aces", Tone::aces}});
    read_colour(in, "background", scene.background);
}

/// Files of `bake cubemap --irradiance` and `--specular ggx`.
void read_sky_levels(const Section& in, SkyEntry& sky) {
    read_path(in, "irradiance", sky.irradiance);
    const bool specular = read_path(in, "specular", sky.specular);
    const toml::node *pattern = in.table.get("specular"), *alphas = in.table.get("specular-roughness");
    if (specular && !is_face_pattern(sky.specular) && !names_cube_levels(sky.specular))
        refuse(in, *pattern,
               "\"specular\" has no %s, which stands for the face; give such as \"ggx_%s.exr\", or a .dds or .ktx2");
    if (specular && !alphas)
        refuse(in, *pattern, "\"specular-roughness\" is missing; give the list of alphas with which the file was made");
    if (!alphas) return;
    if (!specular) refuse(in, *alphas, "\"specular-roughness\" is of \"specular\", which is missing; give its file");
    const toml::array* list = alphas->as_array();
    double before = -1;
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        const auto alpha = list->get(i)->value<double>();
        if (!alpha || !(*alpha > before && *alpha >= 0 && *alpha <= 1)) list = nullptr;
        else sky.alphas.push_back(float(before = *alpha));
    }
    if (!list || list->empty())
        refuse(in, *alphas,
               "\"specular-roughness\" is no list of rising numbers from 0 to 1; give such as [0, 0.1, 1]");
}

void read_sky(const Section& in, SceneEntries& scene) {
    allow_only(in, {"faces", "image", "scale", "yaw-deg", "colour-space", "bad", "irradiance", "specular",
                    "specular-roughness", "face-size", "sh-bands"});
    scene.sky.line = line_of(in.table);
    const toml::node *faces = in.table.get("faces"), *image = in.table.get("image");
    if (!faces && !image)
        refuse(in, in.table,
               "\"faces\" is missing; give \"name_%s.png\" or a list of six files, or \"image\", a lat-long, cross or "
               "strip");
    if (faces && image) refuse(in, *image, "\"image\" and \"faces\" are two skies; give one of them");
    scene.sky.line = line_of(faces ? *faces : *image);
    if (image) {
        read_path(in, "image", scene.sky.image);
    } else if (faces->is_string()) {
        read_path(in, "faces", scene.sky.image);
        try {
            cube_files(scene.sky.image); // refuses what is no pattern
        } catch (const Error& error) {
            refuse(in.file, scene.sky.line, error.what());
        }
    } else {
        const toml::array& list = checked_array(in, *faces, "faces", 6, "files (px, nx, py, ny, pz, nz)");
        for (int i = 0; i < 6; ++i) {
            const auto* name = list.get(i)->as_string();
            if (!name || name->get().empty())
                refuse(in, *list.get(i), "\"faces\" has an entry that is not a file name; give six names in quotes");
            scene.sky.faces[i] = beside(in.file, name->get());
        }
    }
    read(in, "scale", scene.sky.scale, 0);
    read(in, "yaw-deg", scene.sky.yaw_deg, -360, 360);
    read_colour_space(in, "colour-space", scene.sky.space);
    read(in, "face-size", scene.sky.reduction.face_size, 1, 32768);
    read(in, "sh-bands", scene.sky.reduction.sh_bands, 1, 32);
    read_sky_levels(in, scene.sky);
    read_choice<BadPolicy>(in, "bad", scene.sky.bad,
                           {{"refuse", BadPolicy::refuse}, {"zero", BadPolicy::zero}, {"clamp", BadPolicy::clamp}});
}

} // namespace

void read_material(const Section& in, SceneEntries& scene) {
    allow_only(in, {"name",         "brdf",          "ambient",      "diffuse",      "specular",      "shininess",
                    "metallic",     "roughness",     "ior",          "emission",     "reflect",       "albedo",
                    "albedo-space", "bump",          "bump-scale",   "normal",       "encoding",      "directx",
                    "height",       "shade",         "repeat",       "specular-map", "shininess-map", "roughness-map",
                    "metallic-map", "occlusion-map", "emission-map", "alpha-cutoff", "subsurface",    "translucency",
                    "albedo-size",  "relief-size",   "normal-depth"});
    MaterialEntry m;
    m.line = line_of(in.table);
    if (!read(in, "name", m.name)) refuse(in, in.table, "\"name\" is missing; give a name that meshes can refer to");
    for (const MaterialEntry& other : scene.materials)
        if (other.name == m.name)
            refuse(in, *in.table.get("name"), "\"name\" " + in_quotes(m.name) + " is used already; choose another");
    read_colour(in, "diffuse", m.reflectance.diffuse);
    m.reflectance.ambient = m.reflectance.diffuse;
    read_colour(in, "ambient", m.reflectance.ambient);
    read_colour(in, "specular", m.reflectance.specular);
    read_colour(in, "emission", m.reflectance.emission);
    read_colour(in, "reflect", m.reflect);
    read(in, "shininess", m.reflectance.shininess, 0);
    using Model = Reflectance::Model;
    read_choice<Model>(in, "brdf", m.reflectance.model,
                       {{"blinn", Model::blinn},
                        {"phong", Model::phong},
                        {"normalised-blinn", Model::normalised_blinn},
                        {"normalised-phong", Model::normalised_phong},
                        {"ggx", Model::ggx},
                        {"dielectric", Model::dielectric}});
    if (m.reflectance.model == Model::dielectric && !in.table.get("ambient")) m.reflectance.ambient = Vec3f(0);
    read(in, "metallic", m.reflectance.metallic, 0, 1);
    read(in, "roughness", m.reflectance.roughness, 0, 1);
    read(in, "ior", m.reflectance.ior, 1, 10);
    read_triple(in, "subsurface", m.reflectance.subsurface, 0);
    read(in, "translucency", m.reflectance.translucency, 0, 1);
    if (const toml::node* share = in.table.get("translucency"); share && !in.table.get("subsurface"))
        refuse(in, *share, "\"translucency\" has no \"subsurface\"; give the mean free path of the light in the body");
    read_path(in, "albedo", m.albedo);
    read_colour_space(in, "albedo-space", m.albedo_space);
    read(in, "albedo-size", m.albedo_size, 1, 32768);
    read(in, "relief-size", m.relief_size, 1, 32768);
    read_maps(in, m);
    read_path(in, "bump", m.bump_table);
    read(in, "bump-scale", m.bump_scale);
    if (read_path(in, "normal", m.normal_map) && !m.bump_table.empty())
        refuse(in, *in.table.get("normal"), "\"bump\" and \"normal\" both change the normal; keep one of them");
    using enum NormalEncoding;
    read_choice<NormalEncoding>(in, "encoding", m.encoding,
                                {{"auto", automatic}, {"unorm", unorm}, {"signed", signed_}});
    read(in, "directx", m.directx);
    read_choice<bool>(in, "normal-depth", m.normal_bc5, {{"float", false}, {"bc5", true}});
    read_relief(in, m.relief);
    if (!m.relief.file.empty() && !(m.bump_table.empty() && m.normal_map.empty()))
        refuse(in, *in.table.get("height"), "\"height\" changes the normal, as \"bump\" and \"normal\" do; keep one");
    read_repeat(in, m.repeat);
    scene.materials.push_back(std::move(m));
}

namespace {

void read_mesh_entry(const Section& in, SceneEntries& scene) {
    allow_only(in,
               {"file", "shape", "segments", "name", "material", "translate", "rotate-deg", "scale", "flat", "flip-v",
                "uv-set", "subdivide", "repeat", "lights", "high", "shade", "normal-size", "normal-depth"});
    MeshEntry m;
    read_mesh_source(in, m);
    read_mesh_name(in, scene, m);
    read_material_name(in, scene, m.material);
    m.own_materials = m.material < 0;
    read(in, "lights", m.lights);
    read_placement(in, m.placement);
    read_repeat(in, m.repeat);
    read(in, "flat", m.flat);
    read(in, "flip-v", m.flip_v);
    read(in, "uv-set", m.uv_set, 0, 99);
    read_high(in, scene, m);
    scene.meshes.push_back(std::move(m));
}

using ReadSection = void (*)(const Section&, SceneEntries&);

void read_one(const toml::table& root, std::string_view key, ReadSection work, SceneEntries& scene) {
    const toml::node* node = root.get(key);
    if (!node) return;
    const std::string name = "[" + std::string(key) + "]";
    if (!node->is_table()) refuse(scene.file, line_of(*node), in_quotes(key) + " is not a table; write it as " + name);
    work({*node->as_table(), name, scene.file}, scene);
}

void read_each(const toml::table& root, std::string_view key, ReadSection work, SceneEntries& scene) {
    const toml::node* node = root.get(key);
    if (!node) return;
    const std::string name = "[[" + std::string(key) + "]]";
    const toml::array* list = node->as_array();
    if (!list) refuse(scene.file, line_of(*node), in_quotes(key) + " is a list of tables; write it as " + name);
    for (const toml::node& one : *list) {
        if (!one.is_table()) refuse(scene.file, line_of(one), in_quotes(key) + " is not a table; write it as " + name);
        work({*one.as_table(), name, scene.file}, scene);
    }
}

std::string read_text(const std::string& path) {
    constexpr std::uintmax_t larger_than_any = 16 << 20;
    std::error_code absent;
    if (const std::uintmax_t size = std::filesystem::file_size(path, absent); !absent && size > larger_than_any)
        throw Error(Refusal::unreadable, path + ": is larger than 16 MiB; give a scene file");
    const FileBytes file = read_file(path);
    return std::string(file.data.get(), file.size);
}

} // namespace

SceneEntries read_scene(const std::string& path) {
    toml::table root;
    try {
        root = toml::parse(read_text(path), path);
    } catch (const toml::parse_error& error) {
        std::string why(error.description());
        std::replace_if(
            why.begin(), why.end(), [](unsigned char c) { return c < 32; }, ' ');
        refuse(path, int(error.source().begin.line), why + "; correct this line");
    }
    SceneEntries scene;
    scene.file = path;
    allow_only({root, "the scene", scene.file},
               {"render", "camera", "sky", "light", "material", "mesh", "instance", "ground"});
    read_one(root, "render", read_render, scene);
    read_cameras(root, scene);
    read_one(root, "sky", read_sky, scene);
    read_each(root, "light", read_light, scene);
    read_each(root, "material", read_material, scene); // before meshes, which refer to materials
    read_each(root, "mesh", read_mesh_entry, scene);
    read_each(root, "instance", read_instance, scene);
    read_one(root, "ground", read_ground, scene);
    return scene;
}

} // namespace bake
