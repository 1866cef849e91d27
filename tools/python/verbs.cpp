// The verbs of the command, and their options for signatures and stubs.
#include "command_line.h"
#include "module.h"
#include "pages/option_view.h"
#include "run_command.h"
#include "wait.h"
#include <mutex>
#include <pybind11/stl.h>

namespace bake::python {
namespace {

/// (exit code, what it printed, the reasons it gave)
py::tuple run(const std::vector<std::string>& words, const py::object& progress) {
    std::mutex mutex; // several threads of a command may print
    std::string out, err;
    int code = 0;
    const auto into = [&](std::string& text) {
        return [&](const std::string& more) {
            const std::lock_guard lock(mutex);
            text += more;
        };
    };
    wait_for(progress, [&](Watch& watch) {
        CommandIo io{.print = into(out), .tell = into(err)};
        io.watch = [&](const std::string& step, std::int64_t done, std::int64_t total) {
            watch.report(step, done, total);
        };
        io.stops = [&] { return watch.stop.load(); };
        code = run_command(words, io);
    });
    // Names of files are bytes, and need not be UTF-8.
    const auto text = [](const std::string& bytes) {
        return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(bytes.data(), py::ssize_t(bytes.size()), "replace"));
    };
    return py::make_tuple(code, text(out), text(err));
}

py::dict described(const OptionView& option) {
    py::dict d;
    d["name"] = option.names.back();
    d["positional"] = option.positional;
    d["value"] = option.value;
    d["choices"] = option.choices;
    d["required"] = option.required;
    d["many"] = option.many;
    d["description"] = option.description;
    d["default"] = option.default_value;
    return d;
}

/// Per verb (name, job, examples, options).
py::list verbs() {
    const CommandLine line;
    py::list out;
    for (const CLI::App* verb : verbs_of(line.app)) {
        py::list options;
        for (const OptionView& option : options_of(*verb)) options.append(described(option));
        out.append(py::make_tuple(verb->get_name(), verb->get_description(), verb->get_footer(), options));
    }
    return out;
}

} // namespace

void add_verbs(py::module_& m) {
    m.def("run", &run, py::arg("words"), py::arg("progress") = py::none());
    m.def("verbs", &verbs);
}

} // namespace bake::python
