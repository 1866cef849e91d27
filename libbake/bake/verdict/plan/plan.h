// The cheapest model of each part of a scene whose picture stays within a budget, found by probes of the picture.
#pragma once
#include "bake/preview/render.h"
#include "bake/preview/scene_entries.h"
#include "bake/verdict/plan/budget.h"
#include "bake/verdict/plan/error_tally.h"
#include "bake/verdict/plan/relief_facts.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bake {

class Progress;

/// Weights of what a model costs. Milliseconds come from a model of the time (plan_cost.h) unless `measure` is set.
struct CostWeights {
    double triangle = 1, byte = 0.01, ms = 0;
};

struct PlanOptions {
    Budget budget;
    std::vector<std::string> cameras; ///< names; empty: all of the scene
    CostWeights weights;
    bool decide_objects = true, decide_textures = false, decide_formats = false, decide_sky = false,
         decide_lights = false;
    bool maps_like_rgb8 = false; ///< see PartOptions::like_rgb8
    bool verify = false;
    bool pictures = false; ///< of each camera, see ScenePlan::pictures
    bool neighbours =
        true;             ///< FLIP of the chosen rung and of the next cheaper one, and the error of the next dearer one
    bool measure = false; ///< milliseconds are timed, and the plan may differ from run to run
    std::uint32_t seed = 0;
    std::function<void(const std::string&)> told; ///< a line for each decision
};

struct RungCost {
    std::int64_t triangles = 0, object_bytes = 0, texture_bytes = 0;
    double ms = 0;
    double total(const CostWeights& weights) const noexcept {
        return weights.triangle * double(triangles) + weights.byte * double(texture_bytes) + weights.ms * ms;
    }
};

/// How the error of a rung became known.
enum class Known { bound, probe, not_settled, not_tried, skipped };

struct Rung {
    ShadeMethod method;
    RungCost cost;
    Known known = Known::not_tried;
    SquareEstimate error; ///< of the worst camera; of a probe
    double bound = 0;     ///< upper bound of the RMSE; of a bound
    std::string camera;   ///< the worst one
    double flip = -1;     ///< mean FLIP; negative: not computed
    std::string note;     ///< why it was skipped, or what a bound says
};

struct ObjectPlan {
    std::string object;
    std::string material;    ///< name in the scene file; empty: none
    std::string high;        ///< file of the high-poly mesh; empty: the object has a height
    std::vector<int> meshes; ///< indices in SceneEntries::meshes
    std::vector<Rung> rungs; ///< cheapest first
    int chosen = -1;         ///< index in rungs; -1: nothing is cheap enough, the reference is taken
    ShadeMethod reference;
    RungCost reference_cost;
    double reference_error = 0;     ///< RMSE of the reference against a finer one, estimated
    std::vector<ReliefFacts> facts; ///< one per camera
    double budget = 0;              ///< RMSE that the object may have, after the frame's budget was shared out
    std::string why;                ///< a sentence
    /// Of a normal map as large as the height, in RGB8 with smaller levels; 0: not known.
    std::int64_t rgb8_bytes = 0;
};

struct TexturePlan {
    std::string file;                                  ///< or the object whose baked map it is
    std::string kind;                                  ///< "normal", "bump", "albedo"
    int width = 0, height = 0, channels = 0, bits = 0; ///< chosen; bc5_bits: BC5, see texture_form.h
    bool half = false;                                 ///< chosen: half floats, not integers of 16 bits
    int source_width = 0, source_height = 0, source_channels = 0, source_bits = 0;
    std::int64_t bytes = 0, source_bytes = 0; ///< with smaller levels
    SquareEstimate error;
    std::string why;
    std::vector<int> materials; ///< of a file: those of SceneEntries::materials that name it
    std::vector<int> meshes;    ///< of a baked map: those of SceneEntries::meshes that show it
    /// Of a normal map that was judged by it: what full-size RGB of 8 bits errs by on the same pixels. Negative: not judged so.
    double rgb8_rmse = -1;
};

struct SkyPlan {
    std::string model; ///< "constant", "sh:3", "faces"
    int face = 0, levels = 0, source_face = 0;
    std::int64_t bytes = 0, source_bytes = 0;
    SquareEstimate error;
    std::string why;
};

struct LightPlan {
    int light = 0; ///< index in Scene::lights
    bool keep = true, shadows = true;
    SquareEstimate error; ///< without it, or without its shadows
    std::string why;
};

/// Whole pictures of the planned scene and of the reference.
struct Verification {
    std::string camera, object; ///< object empty: the whole picture
    SquareEstimate predicted, measured;
    double flip = 0;
    bool within = false;
};

/// A camera's picture of the scene, in linear light.
struct PlanPicture {
    enum class Shows { reference, planned, bumped };
    std::size_t camera = 0; ///< in ScenePlan::cameras
    Shows shows = Shows::reference;
    Halves halves; ///< with the same random numbers in all
};

struct ScenePlan {
    Budget budget;
    CostWeights weights;
    std::vector<std::string> cameras;
    std::vector<ObjectPlan> objects;
    std::vector<TexturePlan> textures;
    std::optional<SkyPlan> sky;
    std::vector<LightPlan> lights;
    std::vector<Verification> verified;
    /// Of each camera: with every object displaced in full, as planned, and with a bump table on every object, if all
    /// objects can have one. If no object is decided: as the scene is, and as planned.
    std::vector<PlanPicture> pictures;
    std::vector<std::string> notes;
    float exposure = 0;
    double seconds = 0;
    bool interrupted = false, over_budget = false;
};

/// Models without displacement, then displaced grids with and without a residual map, cheapest first by the weights: of an
/// object of this many triangles. The reference is at least 4 times finer per edge than the finest of them.
std::vector<ShadeMethod> plan_rungs(std::int64_t triangles);
/// Of an object with a high-poly mesh: without its detail, with a normal map of it, and that mesh, which is the reference too.
std::vector<ShadeMethod> plan_high_rungs();

/// Stopped by Ctrl-C it returns the decisions made. Throws the errors of load(), and Error{Refusal::usage} for a camera that is
/// not in the scene.
ScenePlan plan_scene(const SceneEntries& entries, const PlanOptions& options, Progress* progress = nullptr);

/// The entries as planned: each object with its method, maps and sky as small as chosen, without the lights and shadows that are left
/// out. What not_in_scene() (planned_scene.h) lists is not among them.
SceneEntries planned_entries(const SceneEntries& entries, const ScenePlan& plan);

std::string to_text(const ScenePlan& plan);
std::string to_json(const ScenePlan& plan, const std::string& scene);

} // namespace bake
