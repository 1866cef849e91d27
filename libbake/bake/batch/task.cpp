#include "bake/batch/task.h"
#include "bake/base/error.h"
#include "bake/batch/pattern.h"
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace bake {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw Error(Refusal::unreadable, file + ": " + why);
}

std::string in_marks(const std::string& name) { return "\"" + name + "\""; }

/// Calls change(text) on every text of a bake that can have {stem} in it; `paths`: on its inputs alone.
void for_texts(Bake& bake, bool paths, const std::function<void(std::string&)>& change) {
    for (std::string& path : bake.files) change(path);
    for (auto& [option, path] : bake.inputs) change(path);
    if (paths) return;
    for (auto& [option, value] : bake.options) change(value);
    for (auto& [option, path] : bake.outputs) change(path);
    change(bake.name);
}

std::string replaced(std::string text, const std::string& word, const std::string& by) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
        text.replace(at, word.size(), by);
    return text;
}

std::string plain_path(const std::string& path) { return fs::path(path).lexically_normal().string(); }

/// Bakes without patterns and tiles.
class Expansion {
public:
    explicit Expansion(const std::string& file) : file_(file) {}

    std::vector<Bake> tasks_of(const Bake& bake) {
        expect_plain(bake);
        std::vector<Bake> tasks;
        for (const Bake& one : of_files(bake)) {
            const std::vector<Bake> tiles = of_tiles(one);
            tasks.insert(tasks.end(), tiles.begin(), tiles.end());
        }
        for (const Bake& task : tasks)
            for (const auto& [option, path] : task.outputs) written_.push_back(plain_path(path));
        return tasks;
    }

private:
    std::vector<Bake> of_files(const Bake& bake) const {
        std::string pattern;
        Bake copy = bake;
        for_texts(copy, true, [&](const std::string& path) {
            if (!is_pattern(path)) return;
            if (!pattern.empty() && pattern != path)
                refuse(file_,
                       "bake " + in_marks(bake.name) + " lists files by two patterns; write {stem} in one of them");
            pattern = path;
        });
        if (pattern.empty()) return {bake};
        std::vector<std::string> found = files_of(pattern);
        for (const std::string& path : written_)
            if (matches(pattern, path)) found.push_back(path);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        leave_out_outputs(bake, found);
        if (found.empty())
            refuse(file_,
                   "bake " + in_marks(bake.name) + ": there is no file " + in_marks(pattern) + "; check the name");
        std::vector<Bake> tasks;
        for (const std::string& path : found) {
            Bake task = bake;
            if (task.name.find("{stem}") == std::string::npos) task.name += ":{stem}";
            for_texts(task, true, [&](std::string& text) { text = text == pattern ? path : text; });
            for_texts(task, false, [&](std::string& text) { text = replaced(text, "{stem}", stem_of(path)); });
            tasks.push_back(std::move(task));
        }
        return tasks;
    }

    /// A pattern that also matches what the bake writes would give one more task with every run.
    static void leave_out_outputs(const Bake& bake, std::vector<std::string>& found) {
        std::set<std::string> own;
        for (const std::string& path : found)
            for (const auto& [option, text] : bake.outputs)
                if (const std::string out = plain_path(replaced(text, "{stem}", stem_of(path)));
                    out != plain_path(path))
                    own.insert(out);
        std::erase_if(found, [&](const std::string& path) { return own.contains(plain_path(path)); });
    }

    static std::vector<Bake> of_tiles(const Bake& bake) {
        if (bake.tiles.empty()) return {bake};
        std::vector<Bake> tasks;
        for (const int tile : bake.tiles) {
            Bake task = bake;
            if (task.name.find("{tile}") == std::string::npos) task.name += ":{tile}";
            for_texts(task, false, [&](std::string& text) {
                for (const char* place : {"{tile}", "<UDIM>"}) text = replaced(text, place, std::to_string(tile));
            });
            task.options.emplace_back("tile", std::to_string(tile));
            tasks.push_back(std::move(task));
        }
        return tasks;
    }

    /// Names of files that a pattern finds may have {} in them, texts of the manifest no other than these.
    void expect_plain(const Bake& bake) const {
        Bake copy = bake;
        bool listed = false;
        for_texts(copy, true, [&](const std::string& path) { listed |= is_pattern(path); });
        for_texts(copy, false, [&](std::string& text) {
            if (listed) text = replaced(text, "{stem}", "");
            if (!bake.tiles.empty()) text = replaced(text, "{tile}", "");
            const std::size_t open = text.find_first_of("{}");
            if (open == std::string::npos) return;
            refuse(file_, "bake " + in_marks(bake.name) + ": " + in_marks(text.substr(open)) +
                              " has no meaning here; {stem} needs an input with * or ?, and {tile} a list of tiles");
        });
    }

    const std::string& file_;
    std::vector<std::string> written_; ///< by the bakes before
};

BatchTask task_of(const Bake& bake) {
    BatchTask task{.name = bake.name, .words = command_of(bake), .inputs = bake.files, .outputs = {}, .needs = {}};
    for (const auto& [option, path] : bake.inputs) task.inputs.push_back(path);
    for (const auto& [option, path] : bake.outputs) task.outputs.push_back(path);
    for (const auto& [option, value] : bake.options) task.alone |= option == "max-memory";
    return task;
}

/// The tasks in an order in which each stands behind those that it needs; of several that could be next, the first.
std::vector<BatchTask> ordered(std::vector<BatchTask> tasks, const std::string& file) {
    std::vector<std::vector<std::uint32_t>> users(tasks.size());
    std::vector<std::size_t> open(tasks.size());
    std::set<std::uint32_t> ready;
    for (std::uint32_t i = 0; i < tasks.size(); ++i) {
        open[i] = tasks[i].needs.size();
        if (open[i] == 0) ready.insert(i);
        for (const std::uint32_t need : tasks[i].needs) users[need].push_back(i);
    }
    std::vector<BatchTask> out;
    std::vector<std::uint32_t> place(tasks.size());
    while (!ready.empty()) {
        const std::uint32_t i = *ready.begin();
        ready.erase(ready.begin());
        place[i] = std::uint32_t(out.size());
        for (const std::uint32_t user : users[i])
            if (--open[user] == 0) ready.insert(user);
        for (std::uint32_t& need : tasks[i].needs) need = place[need];
        std::sort(tasks[i].needs.begin(), tasks[i].needs.end());
        out.push_back(std::move(tasks[i]));
    }
    if (out.size() == tasks.size()) return out;
    std::string names;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (open[i] > 0 && names.size() < 200) names += (names.empty() ? "" : ", ") + in_marks(tasks[i].name);
    refuse(file, "each of " + names + " needs another one of them; change an input or an output");
}

} // namespace

std::vector<BatchTask> batch_tasks(const Manifest& manifest, const std::string& file) {
    Expansion expansion(file);
    std::vector<BatchTask> tasks;
    std::unordered_map<std::string, std::uint32_t> writer, named;
    std::unordered_map<std::string, std::pair<std::uint32_t, std::uint32_t>> of_bake; // first task and the end
    std::vector<const Bake*> origin;
    for (const Bake& bake : manifest.bakes) {
        const auto first = std::uint32_t(tasks.size());
        for (const Bake& one : expansion.tasks_of(bake)) {
            const auto i = std::uint32_t(tasks.size());
            tasks.push_back(task_of(one));
            origin.push_back(&bake);
            if (!named.emplace(one.name, i).second)
                refuse(file, "two tasks have the name " + in_marks(one.name) + "; choose another for one");
            for (const std::string& path : tasks.back().outputs)
                if (const auto [known, fresh] = writer.emplace(plain_path(path), i); !fresh)
                    refuse(file, in_marks(path) + " is an output of " + in_marks(tasks[known->second].name) +
                                     " and of " + in_marks(one.name) + "; choose another name for one");
        }
        of_bake[bake.name] = {first, std::uint32_t(tasks.size())};
    }
    for (std::uint32_t i = 0; i < tasks.size(); ++i) {
        std::set<std::uint32_t> needs;
        for (const std::string& path : tasks[i].inputs)
            if (const auto found = writer.find(plain_path(path)); found != writer.end()) needs.insert(found->second);
        for (const std::string& name : origin[i]->after)
            for (auto [task, end] = of_bake.at(name); task < end; ++task) needs.insert(task);
        tasks[i].needs.assign(needs.begin(), needs.end());
    }
    return ordered(std::move(tasks), file);
}

} // namespace bake
