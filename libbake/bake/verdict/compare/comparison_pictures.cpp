#include "bake/verdict/compare/comparison_pictures.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/contact_sheet.h"
#include "bake/verdict/chart/scatter.h"
#include "bake/verdict/compare/picture_pair.h"
#include "bake/verdict/metric/false_colour.h"
#include <algorithm>

namespace bake {
namespace {

std::string file_name(std::string method) {
    std::replace_if(
        method.begin(), method.end(), [](char c) { return c == ':' || c == '+'; }, '_');
    return method;
}

Image<float> shown_picture(const MethodPicture& picture, float exposure) {
    return shown(mean_picture(picture.halves), exposure);
}

/// False colours of values that grow from 0 at the left to 1 at the right.
Image<float> colour_scale(int width, int height) {
    Image<float> values(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) values.at(x, y) = (float(x) + 0.5f) / float(width);
    return false_colour(values);
}

template <class Cost>
std::string chart(const SceneComparison& comparison, const std::string& title, const std::string& axis,
                  const Cost& cost) {
    ScatterChart chart{.title = title, .x_label = axis, .y_label = "RMSE over the object's pixels", .dots = {}};
    chart.note = "Bars: one standard error, of the samples.";
    for (const MethodRow& row : comparison.rows) {
        const Estimate& rmse = row.errors.object.rmse;
        chart.dots.push_back(
            {row.method, cost(row), rmse.value, std::max(0.0, rmse.value - rmse.error), rmse.value + rmse.error});
    }
    return scatter_svg(chart);
}

} // namespace

std::vector<NamedPicture> method_pictures(const SceneComparison& comparison) {
    std::vector<NamedPicture> pictures;
    pictures.push_back({"reference.png", shown_picture(comparison.reference.picture, comparison.exposure)});
    for (const MethodRow& row : comparison.rows) {
        pictures.push_back({file_name(row.method) + ".png", shown_picture(row.picture, comparison.exposure)});
        pictures.push_back({file_name(row.method) + "_error.png", false_colour(row.errors.flip)});
    }
    return pictures;
}

Image<float> comparison_sheet(const SceneComparison& comparison) {
    const MethodCost& cost = comparison.reference.cost;
    std::vector<SheetTile> tiles;
    tiles.push_back({{"reference: " + comparison.reference.method,
                      format("%.2f s, %.3g M triangles", cost.seconds(), double(cost.triangles) * 1e-6)},
                     shown_picture(comparison.reference.picture, comparison.exposure)});
    tiles.push_back({{"FLIP error of a pixel", "left 0, right 1"}, colour_scale(comparison.width, comparison.height)});
    for (const MethodRow& row : comparison.rows) {
        const std::string outline =
            row.errors.outline.known ? format("outline %.2f px", row.errors.outline.mean) : std::string();
        tiles.push_back(
            {{row.method, format("%.2f s, %.3g MB", row.cost.seconds(), double(row.cost.object_bytes) * 1e-6)},
             shown_picture(row.picture, comparison.exposure)});
        tiles.push_back({{format("FLIP %.3f, RMSE %.4f", row.errors.object.flip.value, row.errors.object.rmse.value),
                          format("normal %.1f deg", row.errors.angles.mean), outline},
                         false_colour(row.errors.flip)});
    }
    return contact_sheet(tiles, {.columns = 4, .title = comparison.object + ": the methods against true displacement"});
}

std::string time_chart(const SceneComparison& comparison) {
    return chart(comparison, comparison.object + ": error and time", "seconds to prepare and render",
                 [](const MethodRow& row) { return row.cost.seconds(); });
}

std::string bytes_chart(const SceneComparison& comparison) {
    return chart(comparison, comparison.object + ": error and memory", "bytes of the object",
                 [](const MethodRow& row) { return double(row.cost.object_bytes); });
}

} // namespace bake
