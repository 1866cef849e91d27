#include "camera_options.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "options.h"
#include <sstream>

namespace bake {
SceneCamera parse_camera(const std::string& flag, const std::string& text) {
    if (ending(text) == ".toml") return read_camera(text);
    const auto refuse = [&](const std::string& why) {
        return Error(Refusal::usage,
                     flag + " " + text + ": " + why +
                         "; give a scene file, or such as position=0,1,5:target=0,0,0:fov-deg=40:height=1080");
    };
    Camera camera;
    camera.target = Vec3f(0);
    double height = 1080;
    bool placed = false;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ':');) {
        const std::size_t equals = part.find('=');
        const std::string key = part.substr(0, equals);
        std::vector<double> values;
        std::istringstream numbers(equals == std::string::npos ? "" : part.substr(equals + 1));
        for (std::string number; std::getline(numbers, number, ',');) {
            const auto value = parse_number(number);
            if (!value || std::abs(*value) > 1e15) throw refuse("'" + number + "' is not a number");
            values.push_back(*value);
        }
        const bool point = key == "position" || key == "target";
        if (!point && key != "fov-deg" && key != "height") throw refuse("'" + key + "' is not a key of a camera");
        if (values.size() != (point ? 3 : 1))
            throw refuse(key + (point ? " takes three numbers" : " takes one number"));
        if (key == "position") camera.position = Vec3f(values[0], values[1], values[2]), placed = true;
        if (key == "target") camera.target = Vec3f(values[0], values[1], values[2]);
        if (key == "fov-deg") camera.fov_deg = float(values[0]);
        if (key == "height") height = values[0];
    }
    if (!placed) throw refuse("has no position");
    if (camera.position == camera.target) throw refuse("has its target at its position");
    if (!(camera.fov_deg >= 0.001f && camera.fov_deg <= 179)) throw refuse("fov-deg is 0.001 to 179");
    if (!(height >= 1 && height <= 65536 && height == int(height))) throw refuse("height is 1 to 65536 pixels");
    return {camera_frame(camera), int(height)};
}

} // namespace bake
