#include "plan_options.h"
#include "bake/verdict/report/page_tables.h"
#include "inputs/file_kind.h"
#include <sstream>

namespace bake {
namespace {

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    std::istringstream in(list);
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    return words;
}

CostWeights parse_cost(const std::string& list) {
    CostWeights weights;
    if (!list.empty()) weights = {.triangle = 0, .byte = 0, .ms = 0}; // what is not named costs nothing
    for (const std::string& word : words_of(list)) {
        const std::size_t equals = word.find('=');
        const std::string key = word.substr(0, equals);
        double* const weight = key == "triangles" ? &weights.triangle
                               : key == "bytes"   ? &weights.byte
                               : key == "ms"      ? &weights.ms
                                                  : nullptr;
        if (!weight || equals == std::string::npos)
            throw Error(Refusal::usage, "--cost " + list + ": has " + word +
                                            ", which is no weight; write such as triangles=1,bytes=0.01,ms=1000");
        *weight = number_of("--cost " + key, word.substr(equals + 1), 0, 1e12);
    }
    if (weights.triangle + weights.byte + weights.ms <= 0)
        throw Error(Refusal::usage, "--cost " + list + ": nothing costs anything; give one weight above 0");
    return weights;
}

void parse_decisions(const std::string& list, PlanOptions& options) {
    options.decide_objects = false;
    for (const std::string& word : words_of(list)) {
        bool* const decision = word == "object"    ? &options.decide_objects
                               : word == "texture" ? &options.decide_textures
                               : word == "format"  ? &options.decide_formats
                               : word == "sky"     ? &options.decide_sky
                               : word == "lights"  ? &options.decide_lights
                                                   : nullptr;
        if (!decision)
            throw Error(Refusal::usage, "--decide " + list + ": has " + word +
                                            ", which is not decided; these are object, texture, format, sky, lights");
        *decision = true;
    }
}

void expect_toml(const char* flag, const std::string& file) {
    if (!file.empty() && file != null_device && ending(file) != ".toml")
        throw Error(Refusal::usage, std::string(flag) + " " + file + ": is written as TOML; end its name with .toml");
}

void expect_new(const char* flag, const std::string& file, const char* other_flag, const std::string& other) {
    if (!file.empty() && file == other && file != null_device)
        throw Error(Refusal::usage, std::string(flag) + " " + file + ": is " + other_flag + " too; give two names");
}

} // namespace

void add_plan_options(CLI::App& sub, PlanArgs& args) {
    sub.add_option("scene", args.scene, "Scene (.toml) whose objects have heights or high-poly meshes")->required();
    sub.add_option("--budget", args.budget,
                   "Largest error of an object: strict (rmse=0.005), normal (rmse=0.01), loose (rmse=0.02), or a "
                   "number. rmse: of exposed linear light, each sample clamped to [0, 1] before samples are averaged, "
                   "over the area that the object covers in the picture, of the worst camera, against true "
                   "displacement or the high-poly mesh. flip: mean FLIP over the same. deg: mean angle between the "
                   "shading normals")
        ->type_name("strict|normal|loose|rmse=E|flip=E|deg=E")
        ->capture_default_str();
    sub.add_option("--camera", args.cameras, "Names of the scene's cameras with commas between them; all: each of them")
        ->type_name("NAME,...|all")
        ->capture_default_str();
    add_size_option(sub, args.size, "Pixels, instead of the scene's own", 8192);
    sub.add_option("--cost", args.cost,
                   "Weights of what a model costs, with commas between them; what is left out costs nothing "
                   "[triangles=1,bytes=0.01]")
        ->type_name("triangles=W|bytes=W|ms=W,...");
    sub.add_option("--decide", args.decide,
                   "What is decided, with commas between them: object (the model of each relief), texture (sizes of "
                   "maps), format (their bits, or BC5), sky (its faces), lights (which of them no camera can tell)")
        ->type_name("object|texture|format|sky|lights,...")
        ->capture_default_str();
    add_choice<MapBudget>(sub, "--map-budget", args.map_budget,
                          {{"share", MapBudget::share}, {"rgb8", MapBudget::rgb8}},
                          "What a normal map may err: its share of the budget, or as much as it does at full size in "
                          "RGB of 8 bits");
    sub.add_option("-o,--out", args.out, "Scene to write: the same with what was chosen")->type_name("PLANNED.toml");
    sub.add_option("--manifest", args.manifest, "List of the bakes that the models need")->type_name("BAKES.toml");
    sub.add_option("--report", args.report,
                   "HTML file to write, which opens without a network: the pictures of the planned scene, of full "
                   "displacement and of everything bumped for flipping, and all decisions")
        ->type_name("OUT.html");
    sub.add_flag("--verify", args.verify,
                 "Render whole pictures of the planned scene and of the reference too; exit with 1 over the budget");
    sub.add_flag("--measure", args.measure,
                 "Time the milliseconds instead of taking them from the cost model; the plan may differ from run to "
                 "run");
    add_integer_option(sub, "--seed", args.seed, 0, 1000000000, "Of the pixels that are probed")->capture_default_str();
}

PlanOptions plan_options(const PlanArgs& args) {
    PlanOptions options;
    options.budget = parse_budget(args.budget);
    if (args.cameras != "all") options.cameras = words_of(args.cameras);
    options.weights = parse_cost(args.cost);
    parse_decisions(args.decide, options);
    options.maps_like_rgb8 = args.map_budget == MapBudget::rgb8;
    if (options.maps_like_rgb8 && !options.decide_textures && !options.decide_formats)
        throw Error(Refusal::usage, "--map-budget rgb8: no map is decided; add texture,format to --decide");
    options.verify = args.verify, options.measure = args.measure, options.pictures = !args.report.empty();
    options.seed = std::uint32_t(args.seed);
    expect_toml("--out", args.out);
    expect_toml("--manifest", args.manifest);
    expect_new("--manifest", args.manifest, "--out", args.out);
    expect_new("--report", args.report, "--out", args.out);
    expect_new("--report", args.report, "--manifest", args.manifest);
    return options;
}

std::string command_of(const PlanArgs& args) {
    const PlanArgs usual;
    std::string text = "bake plan " + shell_word(args.scene);
    const auto add = [&](const char* flag, const std::string& value, const std::string& otherwise) {
        if (value != otherwise) text += std::string(" ") + flag + " " + shell_word(value);
    };
    add("--budget", args.budget, usual.budget), add("--camera", args.cameras, usual.cameras);
    if (args.size) text += format(" --size %dx%d", args.size->first, args.size->second);
    add("--cost", args.cost, usual.cost), add("--decide", args.decide, usual.decide);
    if (args.map_budget == MapBudget::rgb8) text += " --map-budget rgb8";
    if (args.seed != usual.seed) text += format(" --seed %d", args.seed);
    if (args.verify) text += " --verify";
    if (args.measure) text += " --measure";
    add("-o", args.out, ""), add("--manifest", args.manifest, ""), add("--report", args.report, "");
    return text;
}

} // namespace bake
