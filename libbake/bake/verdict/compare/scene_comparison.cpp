#include "bake/verdict/compare/scene_comparison.h"
#include "bake/base/error.h"
#include "bake/base/interruption.h"
#include "bake/base/memory.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/preview/passes.h"
#include "bake/verdict/chart/pareto.h"
#include "bake/verdict/compare/cause_judge.h"
#include "bake/verdict/compare/default_methods.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace bake {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int rays_per_pixel_edge = 4;
constexpr int normal_samples = 4;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Seconds seconds_of(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    const std::size_t half = times.size() / 2;
    const double median = times.size() % 2 ? times[half] : 0.5 * (times[half - 1] + times[half]);
    return {median, times.front(), times.back()};
}

/// What is rendered of a method, and what that cost.
struct Rendered {
    MethodCost cost;
    MethodPicture picture;
    std::vector<std::string> notes; ///< of loading
};

/// Mean shading normals.
Image<float> normals_of(const Scene& scene) {
    RenderSettings settings = scene.settings;
    settings.spp = std::min(settings.spp, normal_samples);
    settings.bounces = 0;
    const Image<float> layers = render_layers(scene, settings);
    const std::vector<std::string> names = layer_channels();
    const int first = int(std::find(names.begin(), names.end(), "N.X") - names.begin());
    Image<float> normals(layers.width(), layers.height(), 3);
    for (int y = 0; y < layers.height(); ++y)
        for (int x = 0; x < layers.width(); ++x)
            for (int c = 0; c < 3; ++c) normals.at(x, y, c) = layers.at(x, y, first + c);
    return normals;
}

class Comparison {
public:
    Comparison(const SceneEntries& entries, const std::string& object, const SceneCompareOptions& options,
               Progress* progress)
        : scene_(entries, object), options_(options), progress_(progress) {}

    SceneComparison run();

private:
    Rendered render(const ShadeMethod& method) const;
    void begin(SceneComparison& result);
    void render_methods(SceneComparison& result);
    void refine_reference(SceneComparison& result);
    void judge(SceneComparison& result) const;
    double smallest_error(const SceneComparison& result) const;
    void add_causes(SceneComparison& result) const;
    void compare(SceneComparison& result);
    static void take_reference(SceneComparison& result, Rendered rendered, const ShadeMethod& method);
    void tell(const std::string& line) const {
        if (options_.told) options_.told(line);
    }

    ComparedScene scene_;
    SceneCompareOptions options_;
    Progress* progress_;
    int levels_ = 0; ///< of the reference
};

Rendered Comparison::render(const ShadeMethod& method) const {
    throw_if_interrupted();
    Rendered result;
    std::vector<double> prepare, times;
    std::optional<MethodScene> scene;
    for (int i = 0; i < options_.repeats; ++i) {
        scene.reset();
        return_free_memory();
        const Clock::time_point start = Clock::now();
        scene.emplace(scene_.load(method));
        prepare.push_back(seconds_since(start));
    }
    RenderSettings warm = scene->scene.settings;
    warm.spp = 2;
    render_halves(scene->scene, warm);
    for (int i = 0; i < options_.repeats; ++i) {
        const Clock::time_point start = Clock::now();
        result.picture.halves = render_halves(scene->scene, scene->scene.settings, nullptr, progress_);
        times.push_back(seconds_since(start));
    }
    result.notes = scene->scene.notes;
    result.picture.normals = normals_of(scene->scene);
    result.picture.mask = object_mask(scene->scene, scene->of_object, rays_per_pixel_edge);
    result.cost = {seconds_of(prepare), seconds_of(times), object_triangles(*scene), object_bytes(*scene),
                   texture_bytes(*scene)};
    if (progress_) progress_->finish();
    return result;
}

void Comparison::take_reference(SceneComparison& result, Rendered rendered, const ShadeMethod& method) {
    result.reference.method = name(method);
    result.reference.shade = method;
    result.reference.cost = rendered.cost;
    result.reference.picture = std::move(rendered.picture);
}

void Comparison::begin(SceneComparison& result) {
    result.object = scene_.object();
    const RenderSettings& settings = scene_.settings();
    result.width = settings.width, result.height = settings.height;
    result.spp = settings.spp + settings.spp % 2;
    result.notes = scene_.notes();
    if (options_.reference) {
        take_reference(result, render(*options_.reference), *options_.reference);
        result.reference.why = "as asked for";
    } else {
        for (levels_ = first_reference_levels(scene_.triangles(), options_.methods);; --levels_) {
            try {
                const ShadeMethod method{Shade::displace, levels_};
                take_reference(result, render(method), method);
                break;
            } catch (const Error& error) {
                if (levels_ == 0 || error.refusal != Refusal::unsuitable) throw;
                result.reference.why = "a finer one does not fit in memory";
            }
        }
    }
    result.automatic_exposure = !settings.exposure;
    result.exposure =
        settings.exposure ? *settings.exposure : automatic_exposure(mean_picture(result.reference.picture.halves));
    tell(format("reference %s: %.3g M triangles, %.2f s to prepare, %.2f s to render", result.reference.method.c_str(),
                double(result.reference.cost.triangles) * 1e-6, result.reference.cost.prepare.median,
                result.reference.cost.render.median));
}

/// Notes that were not told before.
void add_new(const std::vector<std::string>& notes, std::vector<std::string>& told) {
    for (const std::string& line : notes)
        if (std::find(told.begin(), told.end(), line) == told.end()) told.push_back(line);
}

void Comparison::render_methods(SceneComparison& result) {
    for (const ShadeMethod& method : options_.methods) {
        MethodRow row{.method = name(method), .shade = method, .cost = {}, .picture = {}, .errors = {}, .shares = {}};
        Rendered rendered = render(method);
        row.cost = rendered.cost;
        add_new(rendered.notes, result.notes);
        row.picture = std::move(rendered.picture);
        const auto pixels = pixels_of_either(result.reference.picture.mask, row.picture.mask);
        row.errors.object.square =
            square_error(result.reference.picture.halves, row.picture.halves, result.exposure, pixels);
        const Estimate rmse = root(row.errors.object.square);
        tell(format("%s: %.2f s to prepare, %.2f s to render, rmse %.4g +- %.1g", row.method.c_str(),
                    row.cost.prepare.median, row.cost.render.median, rmse.value, rmse.error));
        result.rows.push_back(std::move(row));
    }
}

/// Of methods whose error is above its noise; infinite if there is none.
double Comparison::smallest_error(const SceneComparison& result) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const MethodRow& row : result.rows) {
        const auto pixels = pixels_of_either(result.reference.picture.mask, row.picture.mask);
        const Estimate square =
            square_error(result.reference.picture.halves, row.picture.halves, result.exposure, pixels);
        if (square.value > 2 * square.error) smallest = std::min(smallest, std::sqrt(square.value));
    }
    return smallest;
}

/// Halves the edges until that changes less than a tenth of the smallest error, or less than the noise.
void Comparison::refine_reference(SceneComparison& result) {
    ReferenceRow& reference = result.reference;
    if (options_.reference || !reference.why.empty()) return;
    while (levels_ < most_displacement_levels) {
        Rendered finer;
        try {
            finer = render({Shade::displace, levels_ + 1});
        } catch (const Error& error) {
            if (error.refusal != Refusal::unsuitable) throw;
            reference.why = "a finer one does not fit in memory";
            return;
        }
        const auto pixels = pixels_of_either(reference.picture.mask, finer.picture.mask);
        const Estimate change = square_error(reference.picture.halves, finer.picture.halves, result.exposure, pixels);
        ++levels_, ++reference.refinements;
        take_reference(result, std::move(finer), {Shade::displace, levels_});
        reference.change = root(change);
        reference.smallest = smallest_error(result);
        tell(format("reference %s: changes the one before by rmse %.4g +- %.1g", reference.method.c_str(),
                    reference.change.value, reference.change.error));
        if (change.value <= 2 * change.error) {
            reference.why = "the last refinement changed it by less than the noise";
            return;
        }
        if (reference.change.value <= 0.1 * reference.smallest) {
            reference.why = "the last refinement changed it by less than a tenth of the smallest error of a method";
            return;
        }
    }
    reference.why = "no finer displacement exists";
}

template <class Cost> void mark_front(std::vector<MethodRow>& rows, bool MethodRow::*front, const Cost& cost) {
    std::vector<CostError> points;
    for (const MethodRow& row : rows) points.push_back({cost(row), row.errors.object.rmse.value});
    const std::vector<bool> marks = pareto_front(points);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*front = marks[i];
}

void Comparison::judge(SceneComparison& result) const {
    const MethodRow* plain = nullptr;
    for (MethodRow& row : result.rows) {
        row.errors =
            picture_errors(result.reference.picture, row.picture, {.exposure = result.exposure, .flip = options_.flip});
        for (const std::string& line : over_limits(figures(row.errors), options_.limits))
            result.warnings.push_back(row.method + ": " + line), result.over_limit = true;
        if (row.method == "plain") plain = &row;
    }
    mark_front(result.rows, &MethodRow::on_time_front, [](const MethodRow& row) { return row.cost.seconds(); });
    mark_front(result.rows, &MethodRow::on_bytes_front,
               [](const MethodRow& row) { return double(row.cost.object_bytes); });
    if (!plain) return;
    const AreaErrors& none = plain->errors.object;
    for (const MethodRow& row : result.rows) {
        const AreaErrors& own = row.errors.object;
        if (&row == plain || own.square.value - none.square.value <= 2 * (own.square.error + none.square.error))
            continue;
        result.notes.push_back(format("%s is worse than no relief here: rmse %.3g against %.3g", row.method.c_str(),
                                      own.rmse.value, none.rmse.value));
    }
}

void Comparison::add_causes(SceneComparison& result) const {
    std::int64_t pixels = 0;
    for (const MethodRow& row : result.rows) pixels = std::max(pixels, row.errors.object.pixels);
    const CauseJudge judge(scene_, result.reference.shade, result.exposure, pixels);
    for (MethodRow& row : result.rows) {
        row.shares = judge.shares(row.shade, progress_);
        if (progress_) progress_->finish();
    }
}

/// What Ctrl-C ends; what is there by then is kept.
void Comparison::compare(SceneComparison& result) {
    try {
        render_methods(result);
        refine_reference(result);
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted || result.rows.empty() || !accept_interrupt()) throw;
        result.interrupted = true;
        if (result.reference.why.empty()) result.reference.why = "interrupted";
    }
    if (progress_) progress_->start("compare", 0);
    judge(result);
    if (progress_) progress_->finish();
    if (!options_.causes || result.interrupted) return;
    try {
        add_causes(result);
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted || !accept_interrupt()) throw;
        result.interrupted = true;
    }
}

SceneComparison Comparison::run() {
    if (options_.methods.empty()) options_.methods = default_methods(scene_.triangles());
    over_limits(figures(PictureErrors{}), options_.limits); // names, before the long work
    SceneComparison result;
    begin(result);
    compare(result);
    return result;
}

} // namespace

std::vector<Figure> figures(const PictureErrors& errors) {
    std::vector<Figure> all = {{"rmse", errors.object.rmse.value},
                               {"psnr", errors.object.psnr.value, true},
                               {"ssim", errors.object.ssim.value, true}};
    add_figures(all, "flip", errors.object.flip_of_pixels);
    add_figures(all, "hdr-flip", errors.object.hdr_flip_of_pixels);
    add_figures(all, "angle", errors.angles);
    all.push_back({"outline", errors.outline.mean});
    all.push_back({"outline-max", errors.outline.max});
    return all;
}

SceneComparison compare_scene(const SceneEntries& entries, const std::string& object,
                              const SceneCompareOptions& options, Progress* progress) {
    return Comparison(entries, object, options, progress).run();
}

} // namespace bake
