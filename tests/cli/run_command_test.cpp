// Commands that run in one process, several at a time.
#include "bake/base/job.h"
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include "bake/base/run_job.h"
#include "cli/command.h"
#include "command_line.h"
#include "run_command.h"
#include "run_report.h"
#include <nlohmann/json.hpp>
#include <thread>

using namespace bake::test;

namespace {

const std::string bricks = (own_meshes() / "bricks.png").string(), torus = (own_meshes() / "torus.obj").string();

struct Said {
    int code = -1;
    std::string out, err;
};

Said run(const std::vector<std::string>& words) {
    Said said;
    said.code = bake::run_command(words, {.print = [&](const std::string& text) { said.out += text; },
                                          .tell = [&](const std::string& text) { said.err += text; }});
    return said;
}

/// Commands that read pictures and meshes, write one or two files, trace rays, print and refuse; `name` begins the names of
/// their outputs.
std::vector<std::vector<std::string>> commands(const std::string& name) {
    return {{"normal-map", bricks, "-o", name + "flat.png", "--json"},
            {"bump-table", bricks, "-o", name + "bump.exr", "--json", "--threads", "1"},
            {"displace", torus, "--height", bricks, "--levels", "1", "--max-memory", "2G", "-o", name + "torus.ply"},
            {"cubemap", "labels", "--size", "8", "-o", name + "sky_%s.png"},
            {"normal-map", torus, "--height", bricks, "--size", "32", "-o", bricks},
            {"normal-map", torus, "--height", "none.png", "-o", name + "none.png"},
            {"render", torus, "--size", "16", "--spp", "1", "-o", name + "torus.png", "--quiet"},
            {"check", torus, "--json"}};
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("RunReport: takes notes and reasons from all threads at once") {
        bake::RunReport report;
        std::vector<std::thread> threads;
        for (int thread = 0; thread < 4; ++thread)
            threads.emplace_back([&, thread] {
                for (int i = 0; i < 500; ++i) {
                    report.add_error("a reason that needs memory of its own, " + std::to_string(thread));
                    report.add_note("note " + std::to_string(i));
                    report.add_note("note " + std::to_string(i) + " of " + std::to_string(thread));
                }
            });
        for (std::thread& thread : threads) thread.join();
        CHECK(report.notes().size() == 5 * 500);
        CHECK(report.error().starts_with("a reason that needs memory of its own, "));
    }

    TEST_CASE("run_command: commands that run at the same time do as they do one after another") {
        const Folder folder;
        const std::size_t count = commands("").size();
        std::vector<Said> alone, together(2 * count);
        for (const auto& words : commands(folder / "a_")) alone.push_back(run(words));
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < 2 * count; ++i)
            threads.emplace_back(
                [&, i] { together[i] = run(commands(folder / (i < count ? "b_" : "c_"))[i % count]); });
        for (std::thread& thread : threads) thread.join();
        for (std::size_t i = 0; i < 2 * count; ++i) {
            CAPTURE(i);
            CHECK(together[i].code == alone[i % count].code);
            CHECK(lines(together[i].out) == lines(alone[i % count].out));
            CHECK(lines(together[i].err) == lines(alone[i % count].err));
        }
        const std::set<std::string> names = folder.names();
        CHECK(names.size() == 3 * 10);
        for (const std::string& name : names)
            if (name.starts_with("a_"))
                for (const char* other : {"b_", "c_"})
                    CHECK(contents(folder / name) == contents(folder / (other + name.substr(2))));
        CHECK(alone[4].code == int(bake::Refusal::usage)); // its input as its output
        CHECK(alone[4].err.find("would replace a file that the output is made from") != std::string::npos);
        CHECK(alone[5].code == int(bake::Refusal::unreadable));
        CHECK(nlohmann::json::parse(together[0].out).is_object());
    }

    TEST_CASE("run_command: help and words that are refused go where the caller wants them") {
        CHECK(run({"help", "bump-table"}).out.find("--channel") != std::string::npos);
        const Said refused = run({"bump-tabel"});
        CHECK(refused.code == int(bake::Refusal::usage));
        CHECK(refused.err.find("did you mean bump-table?") != std::string::npos);
        CHECK(run({""}).code == int(bake::Refusal::usage));
        int threads = -1;
        bake::run_command({"check", torus, "--threads", "3"},
                          {.print = [](const std::string&) {}, .begins = [&](int wanted) { threads = wanted; }});
        CHECK(threads == 3);
    }

    TEST_CASE("run_command: progress is told, and a job that is to stop ends alone, without files") {
        const Folder folder;
        std::atomic<std::int64_t> told = 0, most = 0;
        const auto watch = [&](const std::string& step, std::int64_t done, std::int64_t total) {
            ++told;
            CHECK(!step.empty());
            if (total > 0 && done > most) most = done;
        };
        const std::vector<std::string> words = {"normal-map", bricks, "--quiet", "-o"};
        const auto to = [&](const char* name) {
            std::vector<std::string> all = words;
            all.push_back(folder / name);
            return all;
        };
        CHECK(bake::run_command(to("whole.png"), {.watch = watch}) == 0);
        CHECK(told > 1);
        CHECK(most > 0);
        std::string reason;
        bake::CommandIo io{.tell = [&](const std::string& text) { reason += text; }, .watch = watch};
        io.stops = [] { return true; };
        CHECK(bake::run_command(to("never.png"), io) == int(bake::Refusal::interrupted));
        CHECK(reason == "bake: interrupted; nothing was written\n");
        CHECK(bake::run_command(to("after.png"), {}) == 0); // it was that job alone
        CHECK(folder.names() == std::set<std::string>{"after.png", "whole.png"});
    }

    TEST_CASE("CommandLine: all options can be looked at without running anything") {
        const bake::CommandLine line;
        CHECK(line.app.get_subcommand("normal-map")->get_option("--amplitude") != nullptr);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("run_job: all threads that help work for the job, and for as many as it has") {
        bake::Job job;
        job.threads = 2;
        std::atomic<int> others = 0;
        bake::run_job(job, [&] {
            CHECK(bake::thread_count() == 2);
            bake::for_rows(1000, 1, [&](std::int64_t, std::int64_t) { others += &bake::current_job() != &job; });
        });
        CHECK(others == 0);
        CHECK(&bake::current_job() == &bake::process_job());
    }

    TEST_CASE("MemoryCap: caps of two jobs end in any order, and leave the limit as it was" *
              doctest::skip(sizeof(void*) < 8)) {
        const auto before = bake::started_process_limit();
        const bake::MemoryLimit limit = bake::memory_limit();
        bake::Job one, two;
        std::optional<bake::MemoryCap> first, second;
        const std::uint64_t more = bake::process_memory().resident + (std::uint64_t(1) << 30);
        bake::run_job(one, [&] { first.emplace(bake::MemoryLimit{more, "`one`"}, 0); });
        bake::run_job(two, [&] {
            second.emplace(bake::MemoryLimit{more / 2, "`two`"}, 0);
            CHECK(bake::memory_limit().reason == "`two`");
        });
        bake::run_job(one, [&] {
            CHECK(bake::memory_limit().reason == "`one`");
            first.reset();
        });
        bake::run_job(two, [&] { second.reset(); });
        CHECK(bake::memory_limit().reason == limit.reason);
        CHECK(bake::started_process_limit().has_value() == before.has_value());
    }
}
