// A part of the tasks.
#include "bake/base/error.h"
#include "bake/batch/pattern.h"
#include "bake/batch/task.h"

namespace bake {

std::vector<BatchTask> with_needs(std::vector<BatchTask> tasks, const std::string& pattern, const std::string& file) {
    std::vector<bool> wanted(tasks.size());
    bool found = false;
    for (std::size_t i = tasks.size(); i-- > 0;) { // needs stand before those that need them
        wanted[i] = wanted[i] || matches(pattern, tasks[i].name);
        found |= wanted[i];
        if (wanted[i])
            for (const std::uint32_t need : tasks[i].needs) wanted[need] = true;
    }
    if (!found) throw Error(Refusal::usage, file + ": no task has a name like \"" + pattern + "\"; check the pattern");
    std::vector<BatchTask> out;
    std::vector<std::uint32_t> place(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (!wanted[i]) continue;
        place[i] = std::uint32_t(out.size());
        out.push_back(std::move(tasks[i]));
        for (std::uint32_t& need : out.back().needs) need = place[need];
    }
    return out;
}

} // namespace bake
