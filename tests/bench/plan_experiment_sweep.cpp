// plan_experiment_sweep: the errors of every model in the configurations of plan_experiment_set.h, from whole pictures. The truth
// that scripts/plan_experiment judges `bake plan` by.
//
//   plan_experiment_sweep [--first N] [--count N] [--threads N] [--data FOLDER] [--meshes FOLDER] [--held-out] [--done FILE]
//                         [--show SHEET.png] [--head]
//
// Prints one row of csv per configuration: those that are held out, or else the others. The configurations whose number begins a
// row of the file after --done are left out, so that a run can be continued by appending to it.
#include "bake/base/error.h"
#include "bake/preview/tone.h"
#include "bake/verdict/compare/compared_scene.h"
#include "bake/verdict/compare/picture_errors.h"
#include "plan_experiment_set.h"
#include "plan_experiment_truth.h"
#include <cstdio>
#include <cstring>
#include <ctime>
#include <set>

using namespace bench;

namespace {

/// Samples per pixel: few first, and all of them where four standard errors leave a doubt about a budget.
constexpr int first_spp = 16, truth_spp = 64;
constexpr std::uint32_t truth_seed = 0x7a57e;
constexpr double tolerable_change = 0.003; ///< RMSE; the reference is refined until it changes by less
constexpr double most_triangles = 1.3e6;   ///< of a reference
constexpr int most_levels_of_rungs = 5;    ///< columns of the csv are for up to 2^5 segments per edge

struct Arguments {
    int first = 0, count = 360, threads = 0;
    PlanFolders folders{"../shared/data", "meshes"};
    bool held_out = false, head = false;
    std::string done, sheet;
};

std::vector<std::string> column_names() {
    std::vector<std::string> names = {"plain", "roughness", "bump", "bump+roughness", "normal"};
    for (int levels = 0; levels <= most_levels_of_rungs; ++levels)
        for (const Shade shade : {Shade::displace, Shade::displace_normal}) names.push_back(name({shade, levels}));
    return names;
}

void print_head() {
    std::printf(
        "trial,object,relief,finish,light,elevation_deg,distance,sun_deg,width,height,height_px,slope,exposure,area,"
        "triangles,reference,change,change_error,seconds");
    for (const std::string& column : column_names()) std::printf(",%s,%s error", column.c_str(), column.c_str());
    std::printf("\n");
}

/// Stops at which the picture without relief is well exposed.
float exposure_of(const MethodScene& plain) {
    RenderSettings settings = plain.scene.settings;
    settings.spp = 8, settings.seed = truth_seed;
    return automatic_exposure(render(plain.scene, settings));
}

/// Whether an error may lie between .9 and 1.1 of a budget.
bool is_in_doubt(const TrueError& error) {
    return std::any_of(std::begin(plan_budgets), std::end(plan_budgets), [&](double budget) {
        const double low = 0.9 * budget, high = 1.1 * budget;
        return error.square + 4 * error.error >= low * low && error.square - 4 * error.error <= high * high;
    });
}

class TrialTruth {
public:
    explicit TrialTruth(const PlanTrial& trial) : trial_(trial), scenes_(trial.entries, "") {}

    void print() {
        const std::clock_t start = std::clock();
        exposure_ = exposure_of(scenes_.load({Shade::plain}));
        TrueLadder ladder = true_ladder(scenes_.triangles());
        set_reference(ladder.reference);
        TrueError change = error_of({Shade::displace, ladder.reference.levels - 1});
        while (change.square > tolerable_change * tolerable_change && is_affordable(ladder.reference.levels + 1)) {
            const ShadeMethod coarser = ladder.reference;
            ++ladder.reference.levels;
            set_reference(ladder.reference);
            change = error_of(coarser);
        }
        std::vector<std::pair<std::string, TrueError>> errors;
        for (const ShadeMethod& rung : ladder.rungs) {
            const bool as_plain = rung.shade == Shade::roughness && !has_highlight();
            errors.emplace_back(name(rung), as_plain ? errors.front().second : error_of(rung));
        }
        const double area = errors.front().second.area;
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        print_trial(area, name(ladder.reference));
        std::printf(",%.4g,%.2g,%.2f", change.square, change.error, seconds);
        for (const std::string& column : column_names()) {
            const auto found =
                std::find_if(errors.begin(), errors.end(), [&](const auto& error) { return error.first == column; });
            if (found == errors.end()) std::printf(",,");
            else std::printf(",%.4g,%.2g", found->second.square, found->second.error);
        }
        std::printf("\n");
        std::fflush(stdout);
    }

private:
    bool is_affordable(int levels) const {
        return double(scenes_.triangles()) * std::exp2(2 * levels) <= most_triangles;
    }
    /// What relief does to roughness shows in highlights alone; a mirror has none.
    bool has_highlight() const { return trial_.finish == 1 || trial_.finish == 2; }

    TrueView view(const MethodScene& scene) const {
        return {scene.of_object, scenes_.settings(), exposure_, truth_seed};
    }

    void set_reference(const ShadeMethod& method) {
        reference_scene_ = scenes_.load(method);
        reference_ = {};
        add_samples_to(reference_, reference_scene_.scene, view(reference_scene_), first_spp);
        first_reference_ = reference_;
    }

    TrueError error_of(const ShadeMethod& method) {
        const MethodScene scene = scenes_.load(method);
        TruePicture picture;
        add_samples_to(picture, scene.scene, view(scene), first_spp);
        const TrueError first = true_error(first_reference_, picture);
        if (!is_in_doubt(first)) return first;
        add_samples_to(picture, scene.scene, view(scene), truth_spp);
        if (reference_.spp < truth_spp)
            add_samples_to(reference_, reference_scene_.scene, view(reference_scene_), truth_spp);
        return true_error(reference_, picture);
    }

    void print_trial(double area, const std::string& reference) const {
        const RenderSettings& settings = scenes_.settings();
        std::printf("%d,%s,%s,%s,%s,%.1f,%.2f,%.1f,%d,%d,%.3g,%.3g,%g,%.0f,%lld,%s", trial_.number,
                    plan_objects[trial_.object].name, plan_reliefs[trial_.relief].name, plan_finishes[trial_.finish],
                    plan_lights[trial_.light], trial_.elevation_deg, trial_.distance,
                    trial_.light == 2 ? 90 : trial_.sun_deg, settings.width, settings.height, trial_.height_px,
                    trial_.slope, double(exposure_), area, static_cast<long long>(scenes_.triangles()),
                    reference.c_str());
    }

    const PlanTrial& trial_;
    ComparedScene scenes_;
    MethodScene reference_scene_;
    TruePicture first_reference_, reference_; ///< of few samples, and of all
    float exposure_ = 0;
};

/// Pictures of configurations, ten in a row, each without relief and as the reference.
void show(const PlanSet& set, const Arguments& arguments) {
    constexpr int tile = 112, columns = 10;
    const int rows = (arguments.count + columns - 1) / columns;
    Image<float> sheet(columns * tile, 2 * rows * tile, 3);
    std::fill_n(sheet.data(), sheet.size(), 0.f);
    for (int i = 0; i < arguments.count; ++i) {
        const PlanTrial trial = set.trial(arguments.first + i);
        const ComparedScene scenes(trial.entries, "");
        const float exposure = exposure_of(scenes.load({Shade::plain}));
        const ShadeMethod methods[] = {{Shade::plain}, true_ladder(scenes.triangles()).reference};
        for (int method = 0; method < 2; ++method) {
            RenderSettings settings = scenes.settings();
            settings.spp = 16;
            const Image<float> picture = render(scenes.load(methods[method]).scene, settings);
            for (int y = 0; y < std::min(tile, picture.height()); ++y)
                for (int x = 0; x < 3 * std::min(tile, picture.width()); ++x)
                    sheet.row((2 * (i / columns) + method) * tile + y)[3 * (i % columns) * tile + x] =
                        shown_value(picture.row(y)[x], exposure, Tone::srgb);
        }
    }
    write_image(arguments.sheet, sheet, {.depth = Depth::u8});
}

Arguments read_arguments(int argc, char** argv) {
    Arguments a;
    for (int i = 1; i < argc; ++i) {
        const auto is = [&](const char* word) { return std::strcmp(argv[i], word) == 0; };
        if (is("--held-out")) a.held_out = true;
        else if (is("--head")) a.head = true;
        else if (i + 1 == argc) throw Error(Refusal::usage, std::string(argv[i]) + ": is not known, or has no value");
        else if (is("--first")) a.first = std::stoi(argv[++i]);
        else if (is("--count")) a.count = std::stoi(argv[++i]);
        else if (is("--threads")) a.threads = std::stoi(argv[++i]);
        else if (is("--data")) a.folders.data = argv[++i];
        else if (is("--meshes")) a.folders.meshes = argv[++i];
        else if (is("--done")) a.done = argv[++i];
        else if (is("--show")) a.sheet = argv[++i];
        else throw Error(Refusal::usage, std::string(argv[i]) + ": is not known");
    }
    return a;
}

} // namespace

int main(int argc, char** argv) try {
    const Arguments arguments = read_arguments(argc, argv);
    const ThreadLimit limit(arguments.threads);
    const PlanSet set(arguments.folders);
    if (!arguments.sheet.empty()) return show(set, arguments), 0;
    if (arguments.head) print_head();
    const std::set<int> done = arguments.done.empty() ? std::set<int>{} : numbers_in(arguments.done);
    for (int number = arguments.first; number < arguments.first + arguments.count; ++number) {
        const PlanTrial trial = set.trial(number);
        if (trial.held_out != arguments.held_out || done.contains(number)) continue;
        TrialTruth(trial).print();
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "plan_experiment_sweep: %s\n", error.what());
    return 2;
}
