#include "bake/preview/scene_maps.h"

namespace bake {
namespace {

using Model = Reflectance::Model;

/// Reads the file. Refuses it unless `used`.
bool read_map(const Section& in, const char* key, std::string& file, bool used, const char* needs) {
    if (!read_path(in, key, file)) return false;
    if (!used) refuse(in, *in.table.get(key), in_quotes(key) + " is of materials with " + needs + "; remove it");
    return true;
}

} // namespace

void read_maps(const Section& in, MaterialEntry& m) {
    Reflectance& r = m.reflectance;
    const bool ggx = r.model == Model::ggx, highlight = !ggx && r.model != Model::dielectric;
    const auto lacks = [&](const char* key) { return !in.table.get(key); };
    const char* const other = "another brdf than \"ggx\" and \"dielectric\"";
    if (read_map(in, "specular-map", m.specular_map, highlight, other) && lacks("specular")) r.specular = Vec3f(1);
    read_map(in, "shininess-map", m.shininess_map, highlight, other);
    if (read_map(in, "roughness-map", m.roughness_map, ggx, "brdf = \"ggx\"") && lacks("roughness")) r.roughness = 1;
    if (read_map(in, "metallic-map", m.metallic_map, ggx, "brdf = \"ggx\"") && lacks("metallic")) r.metallic = 1;
    if (read_path(in, "emission-map", m.emission_map) && lacks("emission")) r.emission = Vec3f(1);
    read_path(in, "occlusion-map", m.occlusion_map);
    if (const toml::node* cutoff = in.table.get("alpha-cutoff")) {
        if (m.albedo.empty())
            refuse(in, *cutoff, "\"alpha-cutoff\" needs an \"albedo\" with alpha; add one or remove the key");
        float value = 0;
        read(in, "alpha-cutoff", value, 0, 1);
        m.alpha_cutoff = value;
    }
}

} // namespace bake
