// A scene file that is planned by hand.
#pragma once
#include "bake/preview/render.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/plan/planned_scene.h"
#include "cli/command.h"
#include "verdict/plan/hand_made_plan.h"
#include <cmath>

namespace bake::test {

/// Writes a scene, plans it by hand, and reads the result.
struct Round {
    explicit Round(std::string scene) : text(std::move(scene)) {
        write_file(folder / "s.toml", text);
        entries = read_scene(folder / "s.toml");
    }
    std::string planned(const std::string& out = "p.toml") {
        const std::string result = planned_scene(text, entries, plan, folder / out);
        write_file(folder / out, result);
        read = read_scene(folder / out);
        return result;
    }
    /// Of each mesh, as the planned scene has it.
    std::vector<std::string> shades() const {
        std::vector<std::string> names;
        for (const MeshEntry& mesh : read.meshes)
            names.push_back(
                name(read.materials[std::size_t(mesh.material)].relief.shade.value_or(ShadeMethod{Shade::exact})));
        return names;
    }

    Folder folder;
    std::string text;
    SceneEntries entries, read;
    ScenePlan plan;
};

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The lines of `after` that `before` does not have, in order.
inline std::string new_lines(const std::string& before, const std::string& after) {
    std::istringstream in(after);
    std::string text;
    for (std::string line; std::getline(in, line);)
        if (!has("\n" + before, "\n" + line + "\n")) text += line + "\n";
    return text;
}

/// Puts a sky beside the scene, "sky_%s.png".
inline void copy_sky(const Round& round) {
    for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
        const std::string name = std::string("sky_") + face + ".png";
        fs::copy_file(own_meshes() / name, round.folder / name);
    }
}

inline Image<float> picture_of(const Scene& scene) { return render(scene, scene.settings); }

inline float largest_difference(const Image<float>& a, const Image<float>& b) {
    REQUIRE(a.size() == b.size());
    float largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.data()[i] - b.data()[i]));
    return largest;
}

/// The planned file shows what the planned entries do.
inline void check_same_picture(const Round& round) {
    const Scene file = load(round.read), entries = load(planned_entries(round.entries, round.plan));
    CHECK(file.lights.size() == entries.lights.size());
    CHECK(largest_difference(picture_of(file), picture_of(entries)) == 0);
}

} // namespace bake::test
