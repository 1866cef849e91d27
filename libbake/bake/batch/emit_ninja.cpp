// The tasks as a build.ninja.
#include "bake/base/content_hash.h"
#include "bake/base/error.h"
#include "bake/base/printable.h"
#include "bake/batch/emit.h"
#include "bake/batch/levels.h"
#include "bake/batch/pattern.h"
#include "bake/environment/file/face_files.h"
#include <algorithm>
#include <filesystem>

namespace bake {
namespace {

constexpr std::string_view tile_place = "<UDIM>";

/// As a path or a value of build.ninja has it.
std::string escaped(const std::string& text, bool path) {
    std::string out;
    for (const char c : text) {
        // Ninja knows no way to write these.
        if (static_cast<unsigned char>(c) < ' ' || (path && c == '|'))
            throw Error(Refusal::unsuitable, printable(text) + ": has a character that Ninja cannot read in names; "
                                                               "rename the file, or run it by bake batch");
        if (c == '$' || (path && (c == ' ' || c == ':'))) out += '$';
        out += c;
    }
    return out;
}

std::string escaped(const std::vector<std::string>& paths) {
    std::string out;
    for (const std::string& path : paths) out += " " + escaped(path, true);
    return out;
}

/// Outputs whose names hold a place for a number are not known before: a file of its own tells that the task was done.
bool has_place(const std::string& path) {
    return path.find('%') != std::string::npos || path.find('<') != std::string::npos;
}

std::string stamp_of(const BatchTask& task) { return ".bake-done/" + content_hash(task.name.data(), task.name.size()); }

std::vector<std::string> outputs_of(const BatchTask& task) {
    std::vector<std::string> outputs = task.outputs;
    if (std::erase_if(outputs, has_place) > 0) outputs.push_back(stamp_of(task));
    return outputs;
}

/// The six files of a sky. If they are not complete, the names that are written for the pattern, so that Ninja tells which
/// one is missing.
std::vector<std::string> faces_of(const std::string& pattern) {
    std::array<std::string, 6> files;
    try {
        files = find_faces(pattern).files;
    } catch (const Error& error) {
        if (error.refusal == Refusal::usage) return {pattern}; // two places, which the command refuses
        files = cube_files(pattern);
    }
    return {files.begin(), files.end()};
}

/// The files of all tiles that are there; the name itself if there are none.
std::vector<std::string> tiles_of(std::string path) {
    const std::string name = path;
    for (auto at = path.find(tile_place); at != std::string::npos; at = path.find(tile_place))
        path.replace(at, tile_place.size(), "????");
    const std::vector<std::string> files = files_of(path);
    return files.empty() ? std::vector{name} : files;
}

/// The files that an input of a task stands for. None for one that a task before writes under the same name, or beside its
/// outputs, as the pictures of an asset: it is known by the needs of the task.
std::vector<std::string> files_of_input(const std::string& path, const BatchTask& task,
                                        const std::vector<BatchTask>& tasks) {
    std::error_code absent;
    if (std::filesystem::exists(path, absent)) return {path};
    if (!has_place(path)) {
        const auto writes_it = [&](const BatchTask& other) {
            return std::find(other.outputs.begin(), other.outputs.end(), path) != other.outputs.end();
        };
        const bool known = task.needs.empty() || std::any_of(tasks.begin(), tasks.end(), writes_it);
        return known ? std::vector{path} : std::vector<std::string>();
    }
    const auto is_this = [plain = std::filesystem::path(path).lexically_normal()](const std::string& output) {
        return std::filesystem::path(output).lexically_normal() == plain;
    };
    for (const std::uint32_t need : task.needs)
        if (std::any_of(tasks[need].outputs.begin(), tasks[need].outputs.end(), is_this)) return {};
    if (is_face_pattern(path)) return faces_of(path);
    return path.find(tile_place) != std::string::npos ? tiles_of(path) : std::vector{path};
}

/// The command of a task. Ninja makes the folders of outputs, but of those that it knows alone.
std::string line_of(const BatchTask& task, const std::vector<std::string>& outputs) {
    if (outputs == task.outputs) return command_line_of(task);
    std::string folders = folder_line_of({task});
    if (!folders.empty()) folders.replace(folders.size() - 1, 1, " && ");
    return folders + command_line_of(task) + " && touch " + stamp_of(task);
}

} // namespace

std::string emitted_ninja(const std::vector<BatchTask>& tasks) {
    std::string text = "# Made by bake batch for Ninja. Run ninja in the folder of the manifest.\n"
                       "rule bake\n  command = $line\n  description = $name\n";
    for (const BatchTask& task : tasks) {
        const std::vector<std::string> outputs = outputs_of(task);
        text += "\nbuild" + escaped(outputs) + ": bake";
        for (const std::string& path : task.inputs) text += escaped(files_of_input(path, task, tasks));
        if (!task.needs.empty()) text += " |";
        for (const std::uint32_t need : task.needs) text += escaped(outputs_of(tasks[need]));
        text +=
            "\n  line = " + escaped(line_of(task, outputs), false) + "\n  name = " + escaped(task.name, false) + "\n";
    }
    return text;
}

} // namespace bake
