#include "bump_table_output.h"

namespace bake {
namespace {

/// Resolves the options that depend on others, and refuses what a table cannot be. Returns the depth of the file.
Depth resolve(BumpTableArgs& args) {
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
    return depth;
}

int run(BumpTableArgs& args, const CommonArgs& common) {
    const Depth depth = resolve(args);
    Stopwatch watch;
    Progress progress(common.quiet);
    const HeightTexture height = load_height(args.height, common);
    watch.lap("read");
    const BumpTable table(height, args.options, args.layout);
    BumpTableReport report{.height = height, .table = table};
    report.notes = note_doubts(common, args.height, height);
    if (depth == Depth::u16) report.code = code_for(table);
    progress.start("bake", table.height());
    write_table(args, table, depth, report.code, progress);
    progress.finish();
    watch.lap("bake and write");

    const BudgetInput input = table_budget(height, args.options, depth, report.code);
    report.budget = error_budget(input);
    report.advice = better_filter(input, report.budget);
    if (report.advice) note(common, to_text(*report.advice));
    watch.lap("budget");
    report.extent = resolve_extent(args.options.extent_u, args.options.extent_v, table.width(), table.height());
    report.tilt_deg = step_tilt_deg(height.step, args.options.amplitude, report.extent.x, table.width());
    print(args, report, watch, common.json);
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
