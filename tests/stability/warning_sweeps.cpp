// What the commands predict of an error, beside the error as measured.
#include "bake/relief/map/bake_budget.h"
#include "bake/relief/map/method_error.h"
#include "relief/map/torus_relief.h"
#include "stability/themes.h"

using namespace bake;

namespace stability {
namespace {

/// The largest error of a whole map of a relief on a torus against the closed form of the displaced torus, and the largest
/// error that the command predicts.
std::vector<Row> method_rows(int steps) {
    constexpr int size = 128;
    const Mesh mesh = oracle::torus_mesh(128, 64);
    const BakeTarget target = make_bake_target(mesh, "torus", size, size);
    std::vector<Row> rows;
    for (const NormalMethod method :
         {NormalMethod::blinn, NormalMethod::surface_gradient, NormalMethod::constant_scale})
        for (const double part : geometric_steps(1e-3, 0.9, steps)) { // of the tube's radius
            const oracle::TorusRelief r{part * 0.4, 5, 3};
            const HeightTexture height = oracle::relief_texture(r, size);
            const NormalMapOptions options = oracle::relief_options(r, size, Filter::c2, method);
            const HeightField field(height, options.height_options, options.filter, size, size);
            NormalMapReport report;
            const Image<float> map = normal_map(field, target, options, report);
            const auto errors =
                oracle::map_errors(map, target, 0, [&](double u, double v) { return oracle::relief_normal(r, u, v); });
            const MethodError predicted = method_error(mesh_budget(height, field, options, target, Depth::float32));
            rows.push_back({std::string(name(method)), part, oracle::spread(errors).max, predicted.largest_deg,
                            describe(predicted, method).empty()
                                ? "no note"
                                : "note: the method is off by up to N deg here; use --method exact"});
        }
    return rows;
}

} // namespace

std::vector<Sweep> warning_sweeps() {
    return {
        {.name = "method_warning",
         .construction =
             "normal-map of waves on a torus of tube radius r by the methods other than exact; x = height over r",
         .x_label = "height over the tube's radius",
         .y_label = "largest error, deg",
         .log_x = true,
         .log_y = true,
         .limit = smallest_seen_deg,
         .closed_form = "the angle between (s; -1) and (D s; -1), largest over the map, as the note tells it",
         .test = "stability/warning_test; relief/map/method_error_test",
         .rows = method_rows},
    };
}

} // namespace stability
