// bake batch: the bakes of a manifest, those alone that would change something.
#include "bake/base/block_writer.h"
#include "bake/base/file_bytes.h"
#include "bake/base/interruption.h"
#include "bake/base/run_job.h"
#include "bake/base/version.h"
#include "bake/batch/emit.h"
#include "bake/batch/schedule.h"
#include "batch_report.h"
#include "batch_task.h"
#include "inputs/choice.h"
#include "inputs/number_option.h"
#include "render_progress.h"
#include "ticker.h"
#include "version_text.h"
#include <filesystem>
#include <mutex>

namespace bake {
namespace {
namespace fs = std::filesystem;

struct BatchArgs {
    std::string manifest, state, filter, out;
    BatchOptions options;
    bool dry_run = false, stop = false;
    EmitOptions emit;
    std::optional<EmitFormat> format;
};

std::string program() { return std::string(version()) + " " + source_commit; }

/// While it lives, the working directory of the process is another one.
struct WorkingFolder {
    const fs::path before = fs::current_path();
    explicit WorkingFolder(const fs::path& folder) {
        if (!folder.empty()) fs::current_path(folder);
    }
    ~WorkingFolder() {
        std::error_code failed;
        fs::current_path(before, failed);
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
};

/// The tasks of the manifest. In the working directory, as the paths in it are relative to its folder.
std::vector<BatchTask> tasks_of(const BatchArgs& args, const FileBytes& bytes) {
    const Manifest manifest = parse_manifest(std::string(bytes.begin(), bytes.end()), args.manifest);
    std::vector<BatchTask> tasks = batch_tasks(manifest, args.manifest);
    for (const BatchTask& task : tasks)
        if (task.words[0] == "batch")
            throw Error(Refusal::unreadable, args.manifest + ": bake \"" + task.name +
                                                 "\" runs bake batch; run its manifest by a command of its own");
    return args.filter.empty() ? tasks : with_needs(tasks, args.filter, args.manifest);
}

/// Works on the ledger: it is no input of this command, appears at once, and is written after Ctrl-C too.
void apart(const std::function<void()>& work) {
    Job job;
    job.threads = 1, job.stop_accepted = true;
    run_job(job, work);
}

int emit(const BatchArgs& args, std::vector<BatchTask> tasks, const CommonArgs& common) {
    // Programs that print a line for each task themselves want none of ours.
    if (*args.format == EmitFormat::ninja || *args.format == EmitFormat::slurm)
        for (BatchTask& task : tasks) task.words.push_back("--quiet");
    const std::string text = emitted(tasks, *args.format, args.emit);
    if (!args.out.empty()) {
        BlockWriter file(args.out);
        file.write(text);
        file.commit();
    } else if (!common.json) {
        print_text(text);
    }
    common.outputs->commit();
    if (common.json) common.report->object = emitted_object(args.manifest, tasks, args.out.empty() ? text : "");
    return 0;
}

int run(const BatchArgs& given, const CommonArgs& common) {
    BatchArgs args = given;
    if (!args.state.empty()) args.state = fs::absolute(args.state) / fs::path(args.manifest).filename();
    else args.state = fs::absolute(args.manifest);
    if (!args.out.empty()) args.out = fs::absolute(args.out);
    Stopwatch watch;
    const FileBytes bytes = read_file(args.manifest);
    const WorkingFolder there(fs::path(args.manifest).parent_path());
    const std::vector<BatchTask> tasks = tasks_of(args, bytes);
    args.emit.folder = fs::current_path().string();
    args.emit.name = fs::path(args.manifest).filename().string();
    if (args.format) return emit(args, tasks, common);
    args.state += ".ledger";
    std::optional<Ledger> ledger;
    apart([&] { ledger.emplace(args.state, program()); });
    args.options.threads = thread_count();
    args.options.keep_going = !args.stop;
    watch.lap("plan");
    if (args.dry_run) {
        print_plan(common, args.manifest, tasks, plan_batch(tasks, *ledger, args.options), watch);
        return 0;
    }
    apart([&] { OutputFile(args.state); }); // a folder that cannot be written to is refused before the work
    BatchProgress progress;
    std::vector<TaskReport> reports;
    std::once_flag prepared;
    const SharedLoads loads(shared_inputs(tasks), shared_bytes());
    const auto run_one = [&](const BatchTask& task, int threads) {
        std::call_once(prepared, [&] { prepare_folders(tasks); });
        return run_task(task, threads);
    };
    const auto write = [&] { apart([&] { ledger->write(); }); };
    {
        const Ticker ticker(is_visible(common), [&] { return progress_line(progress, watch.elapsed()); });
        reports = run_batch(tasks, *ledger, args.options, run_one, progress, write);
    }
    watch.lap("run");
    write();
    accept_interrupt();
    print_reports(common, args.manifest, tasks, reports, watch);
    return code_of(reports);
}

} // namespace

std::function<int()> batch_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<BatchArgs>();
    add_examples(sub, "  bake batch meshes/bakes.toml --dry-run\n"
                      "  bake batch meshes/bakes.toml --emit ninja -o build.ninja\n");
    sub.add_option("manifest", args->manifest, "List of bakes, TOML (docs/manifest.md)")->required();
    sub.add_flag("--dry-run", args->dry_run, "Print what would run and why, and run nothing");
    sub.add_flag("--force", args->options.force, "Run all tasks, changed or not");
    sub.add_flag("--stop", args->stop, "Start no task after one failed [all that do not need it are run]");
    sub.add_option("--filter", args->filter,
                   "Run the tasks whose names match this pattern with * and ?, and what they need");
    sub.add_option("--state", args->state, "Folder for the ledger of what was read and written [that of the manifest]");
    add_choice(sub, "--emit", args->format,
               {{"ninja", std::optional(EmitFormat::ninja)},
                {"slurm", EmitFormat::slurm},
                {"commands", EmitFormat::commands},
                {"openjd", EmitFormat::openjd}},
               "Run nothing; write the tasks for Ninja, for Slurm, as lines of a shell, or as an OpenJD template");
    add_integer_option(sub, "--chunk", args->emit.chunk, 1, 100000,
                       "Tasks that a farm runs one after another in one job")
        ->default_str(std::to_string(args->emit.chunk));
    sub.add_option("-o,--out", args->out, "File that --emit writes [stdout]");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
