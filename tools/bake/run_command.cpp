#include "run_command.h"
#include "bake/base/input_record.h"
#include "bake/base/memory.h"
#include "bake/base/run_job.h"
#include "bake/base/system_lack.h"
#include "command_line.h"
#include "run_description.h"
#include <algorithm>
#include <exception>
#include <new>

namespace bake {
namespace {

/// Why memory was not granted. The limit is still in force.
int fail_without_memory() try {
    const MemoryLimit memory = memory_limit();
    return fail("out of memory: this takes more than " + memory.described() + "; use smaller inputs or outputs, or " +
                    memory.advice(),
                Refusal::unsuitable);
} catch (const std::bad_alloc&) { // not even for the line
    std::fputs("bake: out of memory; use smaller inputs or outputs\n", stderr);
    return int(Refusal::unsuitable);
}

/// What work() returns, or the exit code of its refusal, which is printed.
int guarded(const std::function<int()>& work) {
    try {
        return work();
    } catch (const Error& error) {
        return fail(error.what(), error.refusal);
    } catch (const std::bad_alloc&) {
        return fail_without_memory();
    } catch (const std::exception& error) {
        if (lacks_threads(error))
            return fail("no thread can be started; use --threads 1, or raise ulimit -u or the limit on memory",
                        Refusal::unsuitable);
        return fail(std::string("stopped by ") + error.what() + "; please report this", Refusal::unsuitable);
    }
}

/// Runs the verb, and prints its object under --json, also that of a refusal.
int run_verb(CommandLine& line, const std::vector<std::string>& words, RunReport& report, CommandFiles* files) {
    OutputSet outputs;
    const InputRecord inputs;
    const RunRecord record(describe_run(*line.app.get_subcommands().front()));
    line.common.outputs = &outputs, line.common.report = &report;
    const int code = guarded(line.chosen);
    if (line.common.json) print_json(whole_report(report, words, outputs.committed(), code), report.indent);
    if (files) *files = {files_read(), outputs.committed()};
    return code;
}

/// The words of a reason as it was printed.
std::string reason_of(const std::string& line) {
    const std::string before = "bake: ";
    return line.substr(before.size(), line.size() - before.size() - 1);
}

} // namespace

int run_command(const std::vector<std::string>& words, const CommandIo& io) {
    Job job;
    job.draws = io.draws, job.sweeps = io.sweeps, job.print = io.print, job.tell = io.tell;
    job.watch = io.watch, job.stops = io.stops;
    RunReport report;
    const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
    if (json) // no note is printed then, but reasons alone
        job.hears = [&](const std::string& line) { report.add_error(reason_of(line)); };
    std::unique_ptr<CommandLine> line;
    std::optional<int> code;
    job.threads = 1;
    run_job(job, [&] {
        const auto read = [&] {
            line = std::make_unique<CommandLine>();
            code = line->take(words);
            return 0;
        };
        if (const int refused = guarded(read); refused != 0) code = refused;
        if (json && code.value_or(0) != 0) print_json(whole_report(report, words, {}, *code));
    });
    if (code) return *code;
    // What begins here belongs to the process, not to the job.
    const auto begin = [&] { return io.begins ? (io.begins(line->common.threads), 0) : 0; };
    if (const int refused = guarded(begin); refused != 0) {
        if (json) print_json(whole_report(report, words, {}, refused));
        return refused;
    }
    job.threads = line->common.threads;
    run_job(job, [&] { code = guarded([&] { return run_verb(*line, words, report, io.files); }); });
    return *code;
}

} // namespace bake
