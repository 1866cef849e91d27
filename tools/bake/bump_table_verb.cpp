#include "bump_table_output.h"
#include "inputs/file_kind.h"

namespace bake {
namespace {

/// Of the slopes: a loss that is told.
constexpr double least_loss = 0.1;

/// Notes what the table gets wrong beyond what shows: levels that are too few, if the amplitude is given, and slopes that the
/// filter loses.
void note_errors(const BumpTableArgs& args, const BumpTableReport& report, const CommonArgs& common) {
    if (args.height.amplitude && report.budget.quantisation_deg > smallest_seen_deg)
        note(common,
             format("%s: its levels tilt the normal by %.2g deg (rms): they are too few for this amplitude; give "
                    "16 bits, or --dequantise a smooth height",
                    args.height.path.c_str(), report.budget.quantisation_deg));
    if (report.loss < least_loss || report.budget.filter_deg < smallest_seen_deg || report.budget.lossy) return;
    const std::string filter(name(report.table.filter()));
    note(common, format("%s: the filter %s loses %.0f %% of the slopes at its frequencies; ", args.height.path.c_str(),
                        filter.c_str(), 100 * report.loss) +
                     (report.advice ? "--filter " + std::string(name(report.advice->filter)) + " keeps them"
                                    : "a picture of more texels or bits keeps them"));
}

/// Resolves the options that depend on others, and refuses what a table cannot be. Returns the depth of the file.
Depth resolve(BumpTableArgs& args) {
    const Depth depth = resolve_depth(args.out, args.depth);
    const bool bumpslopes = args.layout == TableLayout::bumpslopes;
    const Vec2d extent = args.extent.value_or(Vec2d(0));
    args.options.amplitude = args.height.amplitude.value_or(Length{}).in_units(args.extent ? extent.x : 1);
    args.options.extent_u = extent.x, args.options.extent_v = extent.y;
    if (args.extent) check_steepness(args.height, args.options.amplitude, std::min(extent.x, extent.y));
    args.options.units = args.units.value_or(bumpslopes ? SlopeUnits::texel : SlopeUnits::uv);
    args.options.filter = args.height.filter;
    args.options.wrap_u = args.height.wrap_u(), args.options.wrap_v = args.height.wrap_v();
    if (depth == Depth::u8)
        throw Error(Refusal::usage, args.out + ": 8 bits are too few for slopes; use --depth 16, half or float");
    if (depth == Depth::u16 && bumpslopes)
        throw Error(Refusal::usage,
                    args.out + ": bumpslopes are signed; write .exr or .tif with --depth half or float");
    if (args.no_mips && !bumpslopes)
        throw Error(Refusal::usage, "--no-mips: a table of slopes has none; it is for --layout bumpslopes");
    expect_picture(args.height.path);
    return depth;
}

int run(BumpTableArgs& args, const CommonArgs& common) {
    const Depth depth = resolve(args);
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
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
    report.loss = slope_loss(height, table.filter(), args.options.wrap_u, args.options.wrap_v);
    watch.lap("budget");
    report.extent = resolve_extent(args.options.extent_u, args.options.extent_v, table.width(), table.height());
    report.tilt_deg = step_tilt_deg(height.step, args.options.amplitude, report.extent.x, table.width());
    print_result(common, to_text(args, report), to_json(args, report), watch);
    // Of a table that is there: Ctrl-C until now leaves none.
    note_errors(args, report, common);
    if (report.advice) note(common, to_text(*report.advice));
    return 0;
}

} // namespace

std::function<int()> bump_table_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<BumpTableArgs>();
    add_height_path(sub, "grey", args->height)->required();
    add_output_option(sub, args->out,
                      "Table to write (.exr, .tif, .png): channels b_u, b_v, v up, positive where the height rises");
    add_height_options(sub, args->height);
    add_choice<std::optional<SlopeUnits>>(sub, "--units", args->units,
                                          {{"difference", SlopeUnits::difference},
                                           {"texel", SlopeUnits::texel},
                                           {"uv", SlopeUnits::uv},
                                           {"world", SlopeUnits::world},
                                           {"lecture", SlopeUnits::difference}},
                                          "Slopes: difference h[+1] - h[-1]; texel; uv per unit of u and v (default "
                                          "for slopes); world per object unit (needs --extent to differ from 1 wide)",
                                          1);
    add_length_option(sub, "--amplitude", args->height.amplitude,
                      "Height of white above black: object units, or a per cent of the picture's width [1]", false);
    add_extent_option(sub, args->extent, "Object units the picture is wide and high [1,H/W]");
    add_choice<TableLayout>(sub, "--layout", args->layout,
                            {{"slopes", TableLayout::slopes}, {"bumpslopes", TableLayout::bumpslopes}},
                            "slopes: (b_u, b_v); bumpslopes: OpenImageIO's h, s, t, s2, t2, st with mips, t down, per "
                            "texel unless --units");
    sub.add_flag("--no-mips", args->no_mips, "Of bumpslopes: the finest level alone, in scanlines");
    add_depth_option(sub, args->depth,
                     "auto: half for .exr, float for .tif, 16 for .png; 16 is biased and says by how much", false);
    add_choice<Compression>(sub, "--compression", args->compression,
                            {{"auto", Compression::automatic}, {"none", Compression::none}, {"zip", Compression::zip}},
                            "Lossless; auto: zip for .exr, none for .tif");
    add_examples(sub, "  bake bump-table meshes/bricks.png -o bricks.exr\n"
                      "  bake bump-table meshes/bricks.png -o bricks.tif --units world --extent 2,2 --amplitude 3%\n"
                      "  bake bump-table meshes/bricks.png -o bumpslopes.exr --layout bumpslopes\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
