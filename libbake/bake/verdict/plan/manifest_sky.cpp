#include "bake/verdict/plan/manifest_sky.h"
#include "bake/base/error.h"
#include "bake/environment/file/face_files.h"

namespace bake {

const char* sky_obstacle(const SkyEntry& entry, const SkyPlan& sky) {
    if (sky.model == "constant") return "it is one colour; \"sh-bands\" of the scene shows it";
    if (sky.model != "faces") return "they are no faces; \"sh-bands\" of the scene shows them";
    if (entry.reduction.sh_bands > 0) return "they are those of a series that \"sh-bands\" of the scene names";
    std::vector<std::string> files = {entry.image};
    if (entry.image.empty()) files.assign(entry.faces.begin(), entry.faces.end());
    for (const std::string& file : files)
        if (file.find_first_of(reserved_in_paths) != std::string::npos) return reserved_path;
    if (files.size() == 1) return nullptr;
    try {
        if (name_faces(files).files == entry.faces) return nullptr;
    } catch (const Error&) { // as below
    }
    return "its files are named like other faces than they are listed as; rename them";
}

Bake sky_bake(const SkyEntry& entry, const SkyPlan& sky,
              const std::function<std::string(const std::string& file)>& path) {
    Bake bake{.verb = "cubemap", .use = "faces"};
    if (!entry.image.empty()) bake.files = {path(entry.image)};
    else
        for (const std::string& file : entry.faces) bake.files.push_back(path(file));
    bake.options = {{"size", std::to_string(sky.face)}, {"samples", "exact"}};
    if (entry.space != ColourSpace::automatic)
        bake.options.emplace_back(entry.space == ColourSpace::linear ? "linear" : "srgb", "");
    if (entry.bad != BadPolicy::refuse)
        bake.options.emplace_back("bad", entry.bad == BadPolicy::zero ? "zero" : "clamp");
    return bake;
}

} // namespace bake
