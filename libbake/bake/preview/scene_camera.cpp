#include "bake/preview/scene_camera.h"
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_io.h"

namespace bake {

SceneCamera read_camera(const std::string& scene_file) {
    const SceneEntries entries = read_scene(scene_file);
    if (!entries.camera_position || !entries.camera_target)
        return {camera_frame(load(entries).camera), entries.settings.height};
    const Camera camera{*entries.camera_position, *entries.camera_target, entries.camera_up, entries.fov_deg};
    return {camera_frame(camera), entries.settings.height};
}

} // namespace bake
