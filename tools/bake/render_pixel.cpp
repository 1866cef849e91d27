#include "render_pixel.h"
#include "bake/preview/render.h"
#include "bake/verdict/explain_pixel.h"
#include "inputs/number_option.h"

namespace bake {

int print_pixel(const Scene& scene, const std::pair<int, int>& pixel, const CommonArgs& common) {
    const auto [x, y] = pixel;
    const RenderSettings& settings = scene.settings;
    if (x >= settings.width || y >= settings.height)
        throw Error(Refusal::usage, "--pixel " + std::to_string(x) + "," + std::to_string(y) +
                                        ": is not in the picture of " + std::to_string(settings.width) + " x " +
                                        std::to_string(settings.height) + " pixels; give one of them, from 0,0");
    for (const std::string& line : scene.notes) note(common, line);
    Progress progress(common.quiet || common.json);
    const float exposure =
        settings.exposure ? *settings.exposure : automatic_exposure(render(scene, settings, nullptr, &progress));
    progress.finish();
    const std::vector<RouteStep> route = explain_pixel(scene, x, y, exposure, !settings.exposure);
    if (common.json) common.report->object = nlohmann::ordered_json::parse(to_json(route));
    else print_text(to_text(route));
    return 0;
}

} // namespace bake
