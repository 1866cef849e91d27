#include "bake/preview/scene_camera.h"
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_io.h"

namespace bake {

SceneCamera read_camera(const std::string& scene_file) {
    const SceneEntries entries = read_scene(scene_file);
    const CameraEntry& entry = chosen_camera(entries);
    if (!entry.position || !entry.target || (entry.orthographic && !entry.height))
        return {camera_frame(load(entries).camera), entries.settings.height};
    const float aspect = float(entries.settings.width) / float(entries.settings.height);
    return {camera_frame(place_camera(entry, {}, aspect)), entries.settings.height};
}

} // namespace bake
