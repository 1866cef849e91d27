// The tasks for farms: levels of jobs, each with a chunk of tasks.
#include "bake/base/error.h"
#include "bake/base/printable.h"
#include "bake/batch/emit.h"
#include "bake/batch/levels.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

/// Branches of a case: "0) run 5 bake ...; run 6 bake ...;;" for each chunk of a level. Sets `jobs` to their number.
std::string branches(const std::vector<BatchTask>& tasks, const std::vector<std::size_t>& level, std::size_t chunk,
                     std::size_t& jobs) {
    std::string text;
    for (jobs = 0; jobs * chunk < level.size(); ++jobs) {
        text += std::to_string(jobs) + ")\n";
        const std::size_t end = std::min(level.size(), (jobs + 1) * chunk);
        for (std::size_t i = jobs * chunk; i < end; ++i)
            text += "    run " + std::to_string(level[i]) + " " + command_line_of(tasks[level[i]]) + "\n";
        text += "    ;;\n";
    }
    return text;
}

constexpr const char* slurm_head = R"sh(#!/bin/bash
# Made by bake batch for Slurm. Run it on a machine that submits to Slurm, with options of sbatch behind it if you like:
#   bash THIS_FILE --partition=night
# It submits one array of jobs for each level of the tasks; a level starts when all jobs of the one before succeeded.
)sh";

// Level and folder are arguments of the script: a value of --export ends at a comma, and `--export=NONE` is an option that
// sites ask for.
constexpr const char* slurm_submit = R"sh(
if [ "${1:-}" != run-level ]; then
    script=$(realpath "$0") && cd "$folder" || exit
    done_tasks=$(mktemp -d "$folder/.bake-slurm-XXXXXX") || exit
    after=()
    for level in "${!jobs[@]}"; do
        id=$(sbatch --parsable --requeue --array="0-$((jobs[level] - 1))" --job-name="bake-$level" --chdir="$folder" \
            "${after[@]}" "$@" "$script" run-level "$level" "$done_tasks") || exit
        echo "$id"
        after=(--dependency="afterok:${id%%;*}" --kill-on-invalid-dep=yes)
    done
    exit
fi
level=$2
done_tasks=$3

# A job that is run again, as its machine failed, leaves out the tasks that were done.
code=0
run() {
    local task=$1
    shift
    [ -e "$done_tasks/$task" ] && return
    if "$@"; then : >"$done_tasks/$task"; else code=$?; fi
}

)sh";

} // namespace

std::string emitted_slurm(const std::vector<BatchTask>& tasks, const EmitOptions& options) {
    constexpr std::size_t most_jobs = 1000; // of an array, where Slurm's MaxArraySize is as it comes
    std::string counts, cases = "case $level in\n";
    const auto levels = levels_of(tasks);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const std::size_t chunk =
            std::max(std::size_t(options.chunk), (levels[level].size() + most_jobs - 1) / most_jobs);
        std::size_t jobs = 0;
        cases += std::to_string(level) + ") case $SLURM_ARRAY_TASK_ID in\n" +
                 branches(tasks, levels[level], chunk, jobs) + "    esac ;;\n";
        counts += (counts.empty() ? "" : " ") + std::to_string(jobs);
    }
    return slurm_head + ("folder=" + shell_word(options.folder)) + "\njobs=(" + counts + ")\n" + slurm_submit +
           folder_line_of(tasks) + cases + "esac\nexit $code\n";
}

/// A name for a job: of 1 to 128 bytes of whole characters, without control characters and what would be a format string.
std::string job_name(const std::string& file) {
    constexpr std::size_t most = 128;
    std::string name = printable(file);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '{' || c == '}'; }, '_');
    std::size_t end = std::min(name.size(), most);
    while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
    return name.substr(0, end);
}

namespace {

/// A template is UTF-8, and programs that run it replace what stands in double braces.
void refuse_unwritable(const std::vector<BatchTask>& tasks) {
    for (const BatchTask& task : tasks)
        for (const std::string& word : task.words)
            if (printable(word) != word || word.find("{{") != std::string::npos || word.find("}}") != std::string::npos)
                throw Error(Refusal::unsuitable, printable(word) +
                                                     ": has double braces, or characters that are no text, "
                                                     "which an OpenJD template cannot have; rename it");
}

} // namespace

std::string emitted_openjd(const std::vector<BatchTask>& tasks, const EmitOptions& options) {
    refuse_unwritable(tasks);
    Json steps = Json::array();
    const auto levels = levels_of(tasks);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        std::size_t jobs = 0;
        const std::string cases = branches(tasks, levels[level], std::size_t(options.chunk), jobs);
        // Folder and number of the job are arguments: what replaces {{Param.Folder}} in a script is not quoted for a shell.
        const std::string script = "#!/bin/bash\ncd -- \"$1\" || exit\n" + folder_line_of(tasks) +
                                   "code=0\n"
                                   "run() {\n    shift\n    \"$@\" || code=$?\n}\n"
                                   "case $2 in\n" +
                                   cases + "esac\nexit $code\n";
        Json step = {
            {"name", "Level" + std::to_string(level)},
            {"parameterSpace",
             {{"taskParameterDefinitions",
               {{{"name", "Job"}, {"type", "INT"}, {"range", "0-" + std::to_string(jobs - 1)}}}}}},
            {"script",
             {{"actions",
               {{"onRun",
                 {{"command", "{{Task.File.Run}}"},
                  {"args", Json::array({"{{Param.Folder}}", "{{Task.Param.Job}}"})}}}}},
              {"embeddedFiles", {{{"name", "Run"}, {"type", "TEXT"}, {"runnable", true}, {"data", script}}}}}}};
        if (level > 0) step["dependencies"] = {{{"dependsOn", "Level" + std::to_string(level - 1)}}};
        steps.push_back(std::move(step));
    }
    const Json folder = {{"name", "Folder"},          {"type", "PATH"},
                         {"objectType", "DIRECTORY"}, {"dataFlow", "INOUT"},
                         {"default", options.folder}, {"description", "Folder of the manifest"}};
    const Json job = {{"specificationVersion", "jobtemplate-2023-09"},
                      {"name", job_name(options.name)},
                      {"description", "Made by bake batch"},
                      {"parameterDefinitions", Json::array({folder})},
                      {"steps", steps}};
    return job.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace bake
