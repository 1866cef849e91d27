// The error of a changed scene over the frame and over the pixels of each material's objects, from every camera: the largest
// counts.
#pragma once
#include "bake/verdict/plan/pixel_probe.h"
#include <memory>
#include <string>

namespace bake {

/// How parts of a scene are looked at: textures, sky and lights.
struct PartOptions {
    struct View {
        std::string name;
        Camera camera;
    };
    std::vector<View> views; ///< empty: the scene's own camera
    float exposure = 0;      ///< stops
    double budget = 0.01;    ///< RMSE, see budget.h
    std::uint32_t seed = 0;
    int half = 16; ///< see ProbeOptions
    StoppingRule rule;
    bool sizes = true, formats = true; ///< of textures: what may change; formats are channels and bits
    /// Normal maps may err as much as they do at full size in RGB of 8 bits, whatever `budget` is.
    bool like_rgb8 = false;
};

/// The options' views, or the scene's camera.
std::vector<PartOptions::View> views_of(const Scene& scene, const PartOptions& options);

/// The instances of an object, a flag for each of the scene. Empty: the whole frame.
using ObjectMask = std::vector<std::uint8_t>;
/// Instances with any of these materials.
ObjectMask objects_with(const Scene& scene, std::span<const Material* const> materials);
/// The whole frame, and the objects of each material. Beyond `most` materials, all objects together stand for the rest.
std::vector<ObjectMask> frame_and_materials(const Scene& scene, int most = 16);

class WorstProbe {
public:
    /// `reference` is built and must outlive the object.
    WorstProbe(const Scene& reference, std::vector<ObjectMask> objects, const PartOptions& options);

    struct Result {
        SquareEstimate error; ///< the worst that was measured: of one object, from one camera
        std::string camera;   ///< its name
        bool within = false;  ///< everywhere, though not everywhere `settled`
        bool settled = true;
    };
    /// Stops at the first object that is over the budget. Objects that no camera sees do not count.
    Result judge(const Scene& candidate, double budget);
    /// The worst error whatever it is, from at least `pixels` object pixels each.
    Result measure(const Scene& candidate, int pixels = 2048);
    bool in_view() const noexcept { return !probes_.empty(); }

private:
    struct Part {
        const ObjectMask* object;
        std::string camera;
        ReferenceProbe probe;
    };
    StoppingRule rule_;
    std::vector<std::unique_ptr<ObjectMask>> objects_;
    std::vector<std::unique_ptr<Part>> probes_;
};

/// ".0042 (.0035 to .0049)", for sentences.
std::string error_text(const SquareEstimate& error);

} // namespace bake
