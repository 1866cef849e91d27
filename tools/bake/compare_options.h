// Options of bake compare, and the kinds of comparison that it has.
#pragma once
#include "bake/verdict/compare/normals_report.h"
#include "bake/verdict/compare/picture_report.h"
#include "bake/verdict/compare/scene_comparison.h"
#include "options.h"

namespace bake {

/// The methods that show a relief, by pictures of one scene.
struct MethodCompareArgs {
    std::string object, camera, methods, reference = "auto", report;
    std::optional<std::pair<int, int>> size; ///< none: the scene's
    int spp = 16, repeats = 1;
    bool csv = false, no_causes = false;
};

struct CompareArgs {
    std::string file, other, out; ///< other: empty for a scene
    bool normals = false;
    PictureCompareOptions pictures;
    NormalSpace space = NormalSpace::tangent;
    std::vector<std::string> limit_texts;
    std::vector<Limit> limits; ///< the same, by check_compare_usage()
    MeshDistanceOptions distance;
    MethodCompareArgs methods;
};

enum class Comparing { pictures, normals, meshes, methods };

void add_compare_options(CLI::App& sub, CompareArgs& args);
/// Parses the limits. Throws Error{Refusal::usage} for options that the kind of comparison does not have, and the errors of
/// expect_picture() and expect_mesh().
Comparing check_compare_usage(CompareArgs& args, const CLI::App& sub);

/// Each does the comparison and returns the exit code.
int compare_files(const CompareArgs& args, Comparing what, const CommonArgs& common);
int compare_methods(const CompareArgs& args, const CommonArgs& common);

} // namespace bake
