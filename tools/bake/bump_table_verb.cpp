#include "bake/relief/map/bake_budget.h"
#include "options.h"
#include "verb.h"
#include <cmath>
#include <cstdio>
#include <limits>

namespace bake {
namespace {

struct BumpTableArgs {
    HeightArgs height;
    std::string out, amplitude = "1", extent;
    BumpTableOptions options;
    std::optional<SlopeUnits> units;
    TableLayout layout = TableLayout::slopes;
    Depth depth = Depth::automatic;
    Compression compression = Compression::automatic;
};

constexpr const char* bumpslopes_channels[] = {"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};

using Code = std::optional<SlopeCode>; ///< of 16-bit files

WriteOptions write_options(const BumpTableArgs& args, Depth depth, bool png, const Code& code = {}) {
    WriteOptions options{
        .depth = depth, .compression = args.compression, .mips = args.layout == TableLayout::bumpslopes};
    if (args.layout == TableLayout::bumpslopes)
        options.channels.assign(std::begin(bumpslopes_channels), std::end(bumpslopes_channels));
    else options.channels = {"b_u", "b_v"};
    if (png) options.channels = {"R", "G", "B"};
    if (code) options.description = to_text(*code);
    return options;
}

/// Rows of pairs as the file has them: biased, and with a third, zero channel in PNG, where two would mean alpha.
class TableSink {
public:
    TableSink(ImageWriter& writer, int width, const Code& code, bool third, float limit, const std::string& path)
        : writer_(writer), width_(width), code_(code), third_(third), limit_(limit), path_(path) {}

    void operator()(const float* pairs, int rows) {
        const std::size_t count = 2 * std::size_t(rows) * width_;
        if (limit_ > 0)
            for (std::size_t i = 0; i < count; ++i)
                if (!(std::abs(pairs[i]) <= limit_))
                    throw Error(Refusal::unsuitable,
                                path_ +
                                    format(": a slope of %g does not fit half floats; use --depth float", pairs[i]));
        if (!code_) return writer_.write(pairs, rows);
        const int channels = third_ ? 3 : 2;
        room_.resize(count / 2 * channels);
        for (std::size_t i = 0; i < count / 2; ++i) {
            room_[i * channels] = code_->encode(pairs[2 * i]);
            room_[i * channels + 1] = code_->encode(pairs[2 * i + 1]);
            if (third_) room_[i * channels + 2] = 0;
        }
        writer_.write(room_.data(), rows);
    }

private:
    ImageWriter& writer_;
    int width_;
    Code code_;
    bool third_;
    float limit_;
    std::string path_;
    std::vector<float> room_;
};

constexpr float largest_half = 65504;

void write_slopes(const BumpTableArgs& args, const BumpTable& table, Depth depth, const Code& code,
                  Progress& progress) {
    const bool png = code && picture_format(args.out) == PictureFormat::png;
    ImageWriter writer(args.out, table.width(), table.height(), png ? 3 : 2, write_options(args, depth, png, code));
    TableSink sink(writer, table.width(), code, png, depth == Depth::half ? largest_half : 0, args.out);
    for_bands(table, std::ref(sink), &progress);
    writer.finish();
}

void write_moments(const BumpTableArgs& args, const BumpTable& table, Depth depth, Progress& progress) {
    ImageWriter writer(args.out, table.width(), table.height(), table.channels(), write_options(args, depth, false));
    const auto write = [&](const float* values, int rows, int width) {
        const std::size_t count = std::size_t(6) * rows * width;
        const float most = depth == Depth::half ? largest_half : std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < count; ++i)
            if (!(std::abs(values[i]) <= most))
                throw Error(Refusal::unsuitable,
                            args.out + format(": a moment of %g does not fit its file; use --depth float, --units "
                                              "texel or a smaller --amplitude",
                                              values[i]));
        writer.write(values, rows);
    };
    for_bands(
        table, [&](const float* values, int rows) { write(values, rows, table.width()); }, &progress);
    if (table.width() > 1 || table.height() > 1) {
        Image<float> level = halve(table);
        for (;;) {
            writer.next_level();
            write(level.data(), level.height(), level.width());
            if (level.width() == 1 && level.height() == 1) break;
            level = halve(level);
        }
    }
    writer.finish();
}

std::string_view name(SlopeUnits units) {
    switch (units) {
    case SlopeUnits::difference: return "difference h[+1] - h[-1]";
    case SlopeUnits::texel: return "per texel";
    case SlopeUnits::uv: return "per unit of u and v";
    case SlopeUnits::world: return "per object unit";
    }
    return "";
}

int run(BumpTableArgs& args, const CommonArgs& common) {
    const Depth depth = resolve_depth(args.out, args.depth);
    const Amplitude amplitude = parse_amplitude(args.amplitude);
    if (amplitude.percent)
        throw Error(Refusal::usage,
                    "--amplitude " + args.amplitude + ": a table has no bounding box; give object units");
    args.options.amplitude = amplitude.value;
    if (!args.extent.empty()) {
        const Vec2d extent = parse_pair("--extent", args.extent);
        args.options.extent_u = extent.x, args.options.extent_v = extent.y;
        check_steepness(args.amplitude, amplitude.value, std::min(extent.x, extent.y));
    }
    args.options.units =
        args.units.value_or(args.layout == TableLayout::bumpslopes ? SlopeUnits::texel : SlopeUnits::uv);
    args.options.filter = args.height.filter;
    args.options.wrap_u = args.height.wrap_u(), args.options.wrap_v = args.height.wrap_v();

    if (depth == Depth::u8)
        throw Error(Refusal::usage, args.out + ": 8 bits are too few for slopes; use --depth 16, half or float");
    if (depth == Depth::u16 && args.layout == TableLayout::bumpslopes)
        throw Error(Refusal::usage,
                    args.out + ": bumpslopes are signed; write .exr or .tif with --depth half or float");
    check_not_input(args.out, args.height.path);
    Stopwatch watch;
    Progress progress(common.quiet);
    const HeightTexture height = load_height(args.height);
    watch.lap("read");
    const int width = height.values.width(), rows = height.values.height();
    const BumpTable table(height, args.options, args.layout);
    Code code;
    if (depth == Depth::u16) code = code_for(table);
    progress.start("bake", rows);
    if (args.layout == TableLayout::slopes) write_slopes(args, table, depth, code, progress);
    else write_moments(args, table, depth, progress);
    progress.finish();
    watch.lap("bake and write");

    const Vec2d extent = resolve_extent(args.options.extent_u, args.options.extent_v, width, rows);
    const BudgetInput input = table_budget(height, args.options, depth, code);
    const ErrorBudget budget = error_budget(input);
    const std::optional<FilterAdvice> advice = better_filter(input, budget);
    if (advice) note(common, to_text(*advice));
    watch.lap("budget");
    const double tilt = step_tilt_deg(height.step, args.options.amplitude, extent.x, width);
    if (common.json) {
        nlohmann::json result = {{"out", args.out},
                                 {"width", width},
                                 {"height", rows},
                                 {"channels", table.channels()},
                                 {"filter", name(table.filter())},
                                 {"units", name(args.options.units)},
                                 {"levels", height.levels},
                                 {"step", height.step},
                                 {"step_tilt_deg", tilt},
                                 {"error_budget", to_json(budget)},
                                 {"seconds", watch.to_json()}};
        if (advice) result["better_filter"] = to_json(*advice);
        if (code) result["bias"] = {{"range", code->range}, {"zero_level", 32768}, {"levels_per_range", 32767}};
        std::printf("%s\n", result.dump(2).c_str());
        return 0;
    }
    std::printf("%s: %d x %d, slopes %s, filter %s (%s)\n", args.out.c_str(), width, rows,
                std::string(name(args.options.units)).c_str(), std::string(name(table.filter())).c_str(),
                describe_levels(height).c_str());
    if (code) std::printf("stored biased: %s\n", to_text(*code).c_str());
    if (height.step > 0)
        std::printf("one level of the height tilts the normal by %.3f deg at extent %g x %g\n", tilt, extent.x,
                    extent.y);
    std::printf("%s\n%s\n", to_text(budget).c_str(), watch.to_text().c_str());
    return 0;
}

} // namespace

std::function<int()> bump_table_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<BumpTableArgs>();
    sub.add_option("grey", args->height.path, "Height picture; values are taken as they are stored, never sRGB-decoded")
        ->required()
        ->check(not_empty());
    sub.add_option("-o,--out", args->out,
                   "Table to write (.exr, .tif, .png): channels b_u, b_v, v up, positive where the height rises")
        ->required()
        ->check(not_empty());
    add_height_options(sub, args->height);
    sub.add_option_function<std::string>(
           "--units",
           [args](const std::string& given) {
               args->units = given == "difference" || given == "lecture" ? SlopeUnits::difference
                             : given == "texel"                          ? SlopeUnits::texel
                             : given == "uv"                             ? SlopeUnits::uv
                                                                         : SlopeUnits::world;
           },
           "Slopes: difference h[+1] - h[-1]; texel; uv per unit of u and v (default for slopes); world per object "
           "unit "
           "(needs --extent to differ from 1 wide)")
        ->check(one_of({"difference", "texel", "uv", "world", "lecture"}))
        ->type_name("difference|texel|uv|world");
    sub.add_option("--amplitude", args->amplitude, "Height of white above black, object units")
        ->check(not_empty())
        ->capture_default_str();
    sub.add_option("--extent", args->extent, "Object units the picture is wide and high [1,H/W]")
        ->check(not_empty())
        ->type_name("W,H");
    add_choice<TableLayout>(sub, "--layout", args->layout,
                            {{"slopes", TableLayout::slopes}, {"bumpslopes", TableLayout::bumpslopes}},
                            "slopes: (b_u, b_v); bumpslopes: OpenImageIO's h, s, t, s2, t2, st with mips, t down, per "
                            "texel unless --units");
    add_choice<Depth>(
        sub, "--depth", args->depth,
        {{"auto", Depth::automatic}, {"half", Depth::half}, {"float", Depth::float32}, {"16", Depth::u16}},
        "auto: half for .exr, float for .tif, 16 for .png; 16 is biased and says by how much");
    add_choice<Compression>(sub, "--compression", args->compression,
                            {{"auto", Compression::automatic}, {"none", Compression::none}, {"zip", Compression::zip}},
                            "Lossless; auto: zip for .exr, none for .tif");
    add_examples(sub, "  bake bump-table meshes/bricks.png -o bricks.exr\n"
                      "  bake bump-table meshes/bricks.png -o bricks.tif --units world --extent 2,2 --amplitude 0.03\n"
                      "  bake bump-table meshes/bricks.png -o bumpslopes.exr --layout bumpslopes\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
