// bake plan: the cheapest model of each object whose picture stays within a budget.
#include "bake/base/block_writer.h"
#include "bake/base/file_bytes.h"
#include "bake/base/interruption.h"
#include "bake/base/job.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/plan_page.h"
#include "bake/verdict/plan/planned_scene.h"
#include "bake/verdict/report_text.h"
#include "inputs/file_kind.h"
#include "plan_options.h"
#include "render_progress.h"
#include <filesystem>

namespace bake {
namespace {

void write_text(const std::string& path, const std::string& text) {
    BlockWriter out(path);
    out.write(text);
    out.commit();
}

SceneEntries read_entries(const PlanArgs& args, const PlanOptions& options) {
    expect_scene(args.scene);
    SceneEntries entries = read_scene(args.scene);
    if (args.size) std::tie(entries.settings.width, entries.settings.height) = *args.size;
    for (const std::string& camera : options.cameras) find_camera(entries.cameras, camera, args.scene);
    return entries;
}

void write_page(const PlanArgs& args, const ScenePlan& plan, Manifest manifest, const std::string& folder) {
    PageParts page = plan_page(plan, {args.scene, command_of(args), std::move(manifest), folder});
    for (PageSection& section : page.sections) section.html = with_flags(section.html);
    write_text(args.report, page_of(page));
}

/// What the user wants, and the files to write it to.
void write_outputs(const PlanArgs& args, const SceneEntries& entries, const std::string& text, ScenePlan& plan) {
    if (!args.out.empty()) {
        write_text(args.out, planned_scene(text, entries, plan, args.out));
        for (const std::string& line : not_in_scene(entries, plan)) plan.notes.push_back(args.out + ": " + line);
    }
    const std::string& list = args.manifest.empty() ? args.report : args.manifest;
    if (list.empty()) return;
    Manifest manifest = plan_manifest(entries, plan, list);
    plan.notes.insert(plan.notes.end(), manifest.notes.begin(), manifest.notes.end());
    if (!args.manifest.empty()) write_text(args.manifest, to_toml(manifest));
    const std::string folder = std::filesystem::path(list).parent_path().string();
    if (!args.report.empty()) write_page(args, plan, std::move(manifest), folder.empty() ? "." : folder);
}

std::string written(const PlanArgs& args) {
    std::string text;
    if (!args.out.empty()) text += row("planned", printable(args.out));
    if (!args.manifest.empty()) text += row("manifest", printable(args.manifest));
    if (!args.report.empty()) text += row("report", printable(args.report));
    return text;
}

nlohmann::json json_of(const PlanArgs& args, const ScenePlan& plan) {
    nlohmann::json json = nlohmann::json::parse(with_flags(to_json(plan, args.scene)));
    if (!args.out.empty()) json["planned"] = args.out;
    if (!args.manifest.empty()) json["manifest"] = args.manifest;
    if (!args.report.empty()) json["report"] = args.report;
    return json;
}

int run(const PlanArgs& args, const CommonArgs& common) {
    PlanOptions options = plan_options(args);
    if (!args.report.empty()) require_report_page();
    Stopwatch watch;
    const SceneEntries entries = read_entries(args, options);
    const FileBytes file = read_file(args.scene);
    // Files that cannot be written are refused before the work.
    for (const std::string* path : {&args.out, &args.manifest, &args.report})
        if (!path->empty()) OutputFile reserved(*path);
    if (is_visible(common) && draws_on_terminal()) options.told = [&](const std::string& line) { note(common, line); };
    Progress progress(common.quiet);
    ScenePlan plan = plan_scene(entries, options, &progress);
    if (plan.interrupted && interrupted()) accept_interrupt();
    progress.finish();
    watch.lap("plan");
    write_outputs(args, entries, std::string(file.begin(), file.end()), plan);
    print_result(common, with_flags(to_text(plan)) + written(args), json_of(args, plan), watch);
    if (plan.interrupted)
        return fail(args.scene + ": interrupted; printed are the decisions that were made", Refusal::interrupted);
    return plan.over_budget ? int(Refusal::over_limit) : 0;
}

} // namespace

std::function<int()> plan_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<PlanArgs>();
    add_plan_options(sub, *args);
    add_examples(
        sub,
        "  bake plan meshes/studs.toml --size 64\n"
        "  bake plan meshes/studs.toml --size 64 --budget rmse=0.017 --cost triangles=1 -o planned.toml --manifest "
        "bakes.toml\n"
        "  bake plan meshes/studs.toml --size 64 --budget rmse=0.05 --cost bytes=1 --json\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
