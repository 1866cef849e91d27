#include "bake/batch/emit.h"
#include "bake/batch/levels.h"
#include <algorithm>
#include <filesystem>
#include <set>

namespace bake {
namespace {

std::string commands(const std::vector<BatchTask>& tasks) {
    std::string text =
        "# Made by bake batch as commands. Run the lines in the folder of the manifest.\n" + folder_line_of(tasks);
    const auto levels = levels_of(tasks);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (level > 0) text += "# These need the lines before.\n";
        for (const std::size_t task : levels[level]) text += command_line_of(tasks[task]) + "\n";
    }
    return text;
}

} // namespace

std::string command_line_of(const BatchTask& task) {
    std::string line = "bake";
    for (const std::string& word : task.words) line += " " + shell_word(word);
    return line;
}

std::string folder_line_of(const std::vector<BatchTask>& tasks) {
    std::set<std::string> folders;
    for (const BatchTask& task : tasks)
        for (const std::string& path : task.outputs)
            if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
                folders.insert(folder.string());
    std::string line;
    for (const std::string& folder : folders) line += " " + shell_word(folder);
    return line.empty() ? "" : "mkdir -p --" + line + "\n";
}

std::vector<std::vector<std::size_t>> levels_of(const std::vector<BatchTask>& tasks) {
    std::vector<std::size_t> level(tasks.size());
    std::vector<std::vector<std::size_t>> out;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        for (const std::uint32_t need : tasks[i].needs) level[i] = std::max(level[i], level[need] + 1);
        out.resize(std::max(out.size(), level[i] + 1));
        out[level[i]].push_back(i);
    }
    return out;
}

std::string emitted(const std::vector<BatchTask>& tasks, EmitFormat format, const EmitOptions& options) {
    switch (format) {
    case EmitFormat::ninja: return emitted_ninja(tasks);
    case EmitFormat::slurm: return emitted_slurm(tasks, options);
    case EmitFormat::commands: return commands(tasks);
    case EmitFormat::openjd: return emitted_openjd(tasks, options);
    }
    return {};
}

} // namespace bake
