// What bake check has found so far, and the code with which it ends.
#pragma once
#include "bake/base/memory.h"
#include "bake/verdict/decode_check.h"
#include "options.h"
#include <new>

namespace bake {

// Files are independent: a bad one is reported, and the others are still inspected.
struct CheckResults {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    int code = 0;         ///< of the first bad file
    bool wrong = false;   ///< some file has a warning
    bool over = false;    ///< some distance is over --limit, or some green is not that of --expect
    bool printed = false; ///< a report has been printed as text
};

inline bool over_limit(const DistanceReport& report) { return report.over_limit(); }
inline bool over_limit(const PairReport& report) { return report.unexpected(); }
template <class Report> bool over_limit(const Report&) { return false; }

/// Adds a file that is refused, and prints why.
inline void add_refusal(CheckResults& results, const std::string& file, const std::string& message, Refusal why) {
    const int code = fail(message, why);
    if (results.code == 0) results.code = code;
    results.files.push_back({{"file", file}, {"error", with_flags(message)}, {"code", code}});
}

/// Runs work() on a file; false if the file is refused.
template <class Work> bool is_accepted(CheckResults& results, const std::string& file, const Work& work) {
    try {
        work();
        return true;
    } catch (const Error& error) {
        if (error.refusal == Refusal::interrupted) throw;
        add_refusal(results, file, error.what(), error.refusal);
    } catch (const std::bad_alloc&) {
        const MemoryLimit memory = memory_limit();
        add_refusal(results, file,
                    file + ": takes more memory than " + memory.described() + "; give a smaller one, or " +
                        memory.advice(),
                    Refusal::unsuitable);
    }
    return false;
}

/// Adds the report of inspect(), and prints it; false if the file is refused.
template <class Inspect>
bool add_result(CheckResults& results, const std::string& file, const CommonArgs& common, const Inspect& inspect) {
    return is_accepted(results, file, [&] {
        Progress progress(common.quiet);
        progress.start("check " + printable(file), 0);
        auto report = inspect();
        progress.finish();
        for (auto* lines : {&report.findings.warnings, &report.findings.notes})
            for (std::string& line : *lines) line = with_flags(line);
        results.wrong = results.wrong || !report.findings.warnings.empty();
        results.over = results.over || over_limit(report);
        if (common.json) {
            nlohmann::ordered_json object = nlohmann::ordered_json::parse(to_json(report));
            if (auto found = object.find("bake_options"); found != object.end())
                *found = with_flags(found->get<std::string>());
            results.files.push_back(std::move(object));
        } else {
            print_text((results.printed ? "\n" : "") + with_flags(to_text(report)));
            results.printed = true;
        }
    });
}

} // namespace bake
