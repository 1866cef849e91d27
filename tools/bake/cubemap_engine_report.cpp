#include "bake/base/text.h"
#include "cubemap_engine.h"

namespace bake {

nlohmann::json file_json(const EngineFile& file) {
    nlohmann::json json = {{"file", file.path}, {"what", file.what}};
    if (file.bytes > 0) json["bytes"] = file.bytes; // not known of an .exr before it appears
    if (file.levels == 0) return json;
    json["size"] = file.edge, json["levels"] = file.levels;
    if (file.what == "panorama") return json;
    json["texels"] = file.what == "dfg" ? "half" : name(file.texels);
    if (file.what == "dfg") return json;
    json["rmse"] = file.error.rmse, json["relative_rmse"] = file.error.relative;
    json["flux_error"] = file.error.flux, json["clamped"] = file.error.over;
    return json;
}

std::string file_line(const EngineFile& file) {
    std::string line = printable(file.path) + ": " + file.what;
    if (file.what == "panorama") return line + format(", %d x %d", file.edge, file.edge / 2);
    if (file.levels == 0) return line;
    line += format(", %d x %d", file.edge, file.edge);
    if (file.levels > 1) line += format(", %d levels", file.levels);
    line += format(", %s, %.2f MB", file.what == "dfg" ? "half" : name(file.texels), double(file.bytes) / 1e6);
    if (file.what == "dfg") return line;
    line += format(", read back: error %.2g of the values, %.2g of the mean, flux %.1g", file.error.relative,
                   file.error.rmse, file.error.flux);
    if (file.error.over > 0)
        line +=
            format("; %lld values above the format's largest were clamped", static_cast<long long>(file.error.over));
    return line;
}

std::string latlong_text(const ConsumerEntry& consumer) {
    const LatlongRule& rule = *consumer.latlong;
    return format(", turned by %d degrees: %s has %s of the world in the middle", 90 * rule.quarter_turns,
                  consumer.name, middle_axis(rule));
}

nlohmann::json sh_json(const ShCoefficients& series) {
    nlohmann::json json = nlohmann::json::array();
    for (std::size_t i = 0; i < series.values.size(); i += std::size_t(series.channels))
        json.push_back(std::vector<double>(series.values.begin() + std::ptrdiff_t(i),
                                           series.values.begin() + std::ptrdiff_t(i) + series.channels));
    return json;
}

std::string sh_lines(const ShCoefficients& series) {
    std::string lines;
    for (int l = 0; l < series.bands; ++l)
        for (int m = -l; m <= l; ++m) {
            if (!lines.empty()) lines += '\n';
            lines += format("sh %d %2d:", l, m);
            for (int c = 0; c < series.channels; ++c)
                lines += format(" %.6g", series.values[std::size_t((l * l + l + m) * series.channels + c)]);
        }
    return lines;
}

} // namespace bake
