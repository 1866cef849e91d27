#include "batch_task.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/temporary_file.h"
#include "run_command.h"
#include <algorithm>
#include <filesystem>
#include <mutex>
#include <set>

namespace bake {
namespace fs = std::filesystem;

void prepare_folders(const std::vector<BatchTask>& tasks) {
    std::set<fs::path> folders;
    for (const BatchTask& task : tasks)
        for (const std::string& path : task.outputs) folders.insert(fs::path(path).parent_path());
    for (const fs::path& folder : folders) {
        std::error_code failed;
        if (!folder.empty()) fs::create_directories(folder, failed);
        sweep_temporary_files(folder);
    }
}

std::unordered_set<std::string> shared_inputs(const std::vector<BatchTask>& tasks) {
    std::unordered_set<std::string> once, often;
    for (const BatchTask& task : tasks)
        for (const std::string& path : task.inputs)
            if (!once.insert(path).second) often.insert(path);
    return often;
}

std::size_t shared_bytes() {
    constexpr std::uint64_t most = std::uint64_t(1) << 30;
    return std::size_t(std::min(most, memory_limit().bytes / 8));
}

namespace {

/// A line without what print_line() puts before it and behind it.
std::string words_of(std::string line) {
    constexpr std::string_view before = "bake: ";
    if (line.starts_with(before)) line.erase(0, before.size());
    while (!line.empty() && line.back() == '\n') line.pop_back();
    return line;
}

} // namespace

TaskRun run_task(const BatchTask& task, int threads) {
    std::vector<std::string> words = task.words;
    if (std::none_of(words.begin(), words.end(), [](const std::string& word) { return word.starts_with("--threads"); }))
        words.push_back("--threads=" + std::to_string(threads));
    std::optional<SharedLoads::Pause> pause;
    if (task.alone && shared_loads()) pause.emplace(*shared_loads());
    TaskRun done;
    CommandFiles files;
    std::mutex mutex;
    done.code = run_command(words, {.print = [](const std::string&) {},
                                    .tell =
                                        [&](const std::string& line) {
                                            const std::lock_guard lock(mutex);
                                            done.notes.push_back(words_of(line));
                                        },
                                    .sweeps = false,
                                    .begins = {},
                                    .files = &files});
    if (done.code != 0 && !done.notes.empty()) // the last line is the refusal
        done.message = std::move(done.notes.back()), done.notes.pop_back();
    done.read = std::move(files.read), done.written = std::move(files.written);
    if (done.code == 0 && done.written.empty() && !task.outputs.empty())
        done.code = int(Refusal::unwritable),
        done.message = task.outputs[0] + ": was not written; see the options of the bake";
    return done;
}

} // namespace bake
