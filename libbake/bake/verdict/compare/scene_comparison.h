// Compares the methods that show a relief, by pictures of one scene.
//
// Every method renders the same camera, lights and samples. The reference is a true displacement, as fine as it must be.
#pragma once
#include "bake/verdict/compare/causes.h"
#include "bake/verdict/compare/compared_scene.h"
#include "bake/verdict/compare/figures.h"
#include "bake/verdict/compare/picture_errors.h"
#include <functional>
#include <optional>

namespace bake {

struct SceneCompareOptions {
    std::vector<ShadeMethod> methods;     ///< empty: default_methods()
    std::optional<ShadeMethod> reference; ///< none: displaced, refined until the next refinement changes little
    int repeats = 1;                      ///< renderings that are timed
    bool causes = true;                   ///< whether the share of the error by cause is computed
    FlipOptions flip;
    std::vector<Limit> limits; ///< over the object's pixels; of every method
    /// Receives a line when a method is rendered.
    std::function<void(const std::string&)> told;
};

/// Of repeated work.
struct Seconds {
    double median = 0, least = 0, most = 0;
};

struct MethodCost {
    Seconds prepare; ///< reads meshes, bakes, tessellates and builds the Bvh; pictures are in memory already
    Seconds render;  ///< after a first rendering of two samples per pixel that is not timed
    std::int64_t triangles = 0, object_bytes = 0, texture_bytes = 0;
    double seconds() const noexcept { return prepare.median + render.median; }
};

struct MethodRow {
    std::string method; ///< name(shade)
    ShadeMethod shade;
    MethodCost cost;
    MethodPicture picture;
    PictureErrors errors;
    std::optional<CauseShares> shares;                  ///< none: not asked for, or interrupted
    bool on_time_front = false, on_bytes_front = false; ///< see pareto_front()
};

struct ReferenceRow {
    std::string method; ///< name(shade)
    ShadeMethod shade;
    MethodCost cost;
    MethodPicture picture;
    int refinements = 0; ///< that were rendered to settle it
    Estimate change;     ///< RMSE over the object's pixels of the last refinement; 0 if the method was given
    double smallest = 0; ///< the smallest RMSE of a method that this was judged by
    std::string why;     ///< why no finer one was tried
};

struct SceneComparison {
    std::string object;
    int width = 0, height = 0, spp = 0;
    float exposure = 0;
    bool automatic_exposure = false;
    ReferenceRow reference;
    std::vector<MethodRow> rows; ///< in the order of the options
    std::vector<std::string> notes, warnings;
    bool over_limit = false, interrupted = false;
};

/// Stopped by Ctrl-C after the reference was rendered, it compares what is there, see accept_interrupt(). Throws the errors
/// of ComparedScene and of load(), and Error{Refusal::usage} for limits of what is not computed.
SceneComparison compare_scene(const SceneEntries& entries, const std::string& object,
                              const SceneCompareOptions& options, Progress* progress = nullptr);

/// Names and values over the object's pixels: rmse, psnr, ssim, flip and hdr-flip with percentiles, angle, outline.
std::vector<Figure> figures(const PictureErrors& errors);
std::string to_text(const SceneComparison& comparison);
/// `scene`: the file; `command`: the command line that compares a method alone, or all of them for an empty name.
std::string to_json(const SceneComparison& comparison, const std::string& scene,
                    const std::function<std::string(const std::string& method)>& command);
std::string to_csv(const SceneComparison& comparison);

} // namespace bake
