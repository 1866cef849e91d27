// What the methods will do wrong with a height on a mesh, predicted before anything is baked.
#pragma once
#include "bake/relief/map/method_error.h"
#include "bake/verdict/inspect.h"

namespace bake {

/// A share of the surface is a share of its area. Angles are between normals.
struct ReliefCheck {
    double diagonal = 0;                  ///< of the mesh
    double least = 0, most = 0, mean = 0; ///< of the height b over the surface, object units
    MethodError constant_scale, blinn;    ///< of NormalMethod
    double fold_margin = 1;               ///< smallest 1 + b a_i; where it is 0 or less, exact turns inside out
    Vec2d fold_uv{0};                     ///< where
    double folded = 0;                    ///< share of the surface with 1 + b a_i <= 0
    double focal = 0;                     ///< |b| at which the place of fold_margin folds; 0: at none
    Filter filter = Filter::central;      ///< with `automatic` resolved
    std::optional<ErrorBudget> budget;    ///< of a normal map; none: the charts do not fit into one tile
    std::optional<FilterAdvice> better_filter;
    double ridge_u_deg = 0, ridge_v_deg = 0; ///< tilt, rms along the border, by a step across a border that repeats
    std::vector<std::string> doubts;         ///< further height_notes()
};

/// The surface is sampled at ReliefPoints. The border counts where a chart covers it.
ReliefCheck check_relief(const Mesh& mesh, const HeightTexture& height, Filter filter, const HeightOptions& options);

struct ReliefReport {
    std::string file, height_file;
    HeightOptions options;
    ReliefCheck check;
    Findings findings;
};

/// Throws Error{Refusal::unsuitable} for a mesh without uvs.
ReliefReport inspect_relief(const std::string& path, const Mesh& mesh, const std::string& height_path,
                            const HeightTexture& height, Filter filter, const HeightOptions& options);

/// Nothing is found of errors that do not show.
Findings judge(const ReliefReport& report);
std::string to_text(const ReliefReport& report);
std::string to_json(const ReliefReport& report);

} // namespace bake
