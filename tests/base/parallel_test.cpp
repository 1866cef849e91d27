#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "cli/command.h"
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("for_rows: each row is worked on once, in chunks that do not depend on the threads") {
        for (const int threads : {1, 2, 7})
            for (const std::int64_t rows : {0, 1, 63, 64, 65, 1000})
                for (const std::int64_t grain : {-1, 0, 1, 7, 64, 5000}) {
                    const ThreadLimit limit(threads);
                    auto times = std::vector<std::atomic<int>>(std::size_t(rows));
                    std::atomic<bool> sound = true;
                    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
                        const std::int64_t most = std::max<std::int64_t>(1, grain);
                        if (begin % most != 0 || end > rows || end - begin > most || begin >= end) sound = false;
                        for (std::int64_t y = begin; y < end; ++y) ++times[std::size_t(y)];
                    });
                    CHECK(sound);
                    int wrong = 0;
                    for (const auto& count : times) wrong += count != 1;
                    CHECK(wrong == 0);
                }
    }

    TEST_CASE("for_rows: an exception of a chunk comes out as it was") {
        for (const int threads : {1, 4}) {
            const ThreadLimit limit(threads);
            try {
                for_rows(100, 1, [](std::int64_t begin, std::int64_t) {
                    if (begin == 57) throw Error(Refusal::unsuitable, "row 57");
                });
                FAIL_CHECK("nothing was thrown");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unsuitable);
                CHECK(std::string(error.what()) == "row 57");
            }
        }
    }

    TEST_CASE("for_rows: inside for_rows neither deadlocks nor skips") {
        const ThreadLimit limit(3);
        std::atomic<int> count = 0;
        for_rows(20, 1, [&](std::int64_t, std::int64_t) {
            for_rows(30, 4, [&](std::int64_t begin, std::int64_t end) { count += int(end - begin); });
        });
        CHECK(count == 600);
    }

    TEST_CASE("ThreadLimit: as many threads as it says while it lives") {
        {
            const ThreadLimit limit(1);
            CHECK(thread_count() == 1);
            CHECK(slot_count() >= 1);
        }
        const ThreadLimit none(0);
        CHECK(thread_count() >= 1);
    }

    TEST_CASE(
        "in_order: bands are consumed in order, each with the slot it was computed in, and slots are not shared") {
        for (const int threads : {1, 2, 7})
            for (const std::int64_t bands : {0, 1, 2, 100}) {
                const ThreadLimit limit(threads);
                auto held = std::vector<std::atomic<std::int64_t>>(std::size_t(slot_count()));
                for (auto& slot : held) slot = -1;
                std::atomic<bool> sound = true;
                std::int64_t next = 0;
                in_order(
                    bands,
                    [&](std::int64_t band, int slot) {
                        if (slot < 0 || slot >= int(held.size())) sound = false;
                        else if (held[std::size_t(slot)].exchange(band) != -1) sound = false;
                        for (volatile int spin = 0; spin < int(band * 7919 % 5000);) spin = spin + 1;
                    },
                    [&](std::int64_t band, int slot) {
                        if (band != next++ || held[std::size_t(slot)].exchange(-1) != band) sound = false;
                    });
                CHECK(sound);
                CHECK(next == bands);
            }
    }

    TEST_CASE("in_order: exceptions of either side come out, and nothing is consumed after one") {
        for (const bool in_compute : {true, false}) {
            std::int64_t consumed = 0;
            try {
                in_order(
                    50,
                    [&](std::int64_t band, int) {
                        if (in_compute && band == 20) throw Error(Refusal::unwritable, "compute");
                    },
                    [&](std::int64_t band, int) {
                        if (!in_compute && band == 20) throw Error(Refusal::unwritable, "consume");
                        ++consumed;
                    });
                FAIL_CHECK("nothing was thrown");
            } catch (const Error& error) {
                CHECK(std::string(error.what()) == (in_compute ? "compute" : "consume"));
            }
            CHECK(consumed <= 20);
        }
    }

    TEST_CASE("progress: silent where stderr is no terminal, and Ctrl-C stops long work with Refusal::interrupted") {
        // In a process of its own, for the flag stays up.
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        const pid_t child = fork();
        if (child == 0) {
            dup2(ends[1], 2);
            close(ends[0]);
            catch_interrupts();
            Progress progress(false);
            progress.start("bake", 10);
            for (int i = 0; i < 10; ++i) progress.add(1);
            progress.finish();
            const ThreadLimit limit(1);
            try {
                for_rows(
                    10, 1,
                    [](std::int64_t begin, std::int64_t) {
                        if (begin == 3) raise(SIGINT);
                    },
                    &progress);
            } catch (const Error& error) {
                _exit(int(error.refusal));
            }
            _exit(0);
        }
        close(ends[1]);
        char drawn[64];
        CHECK(read(ends[0], drawn, sizeof drawn) == 0);
        close(ends[0]);
        int status = 0;
        waitpid(child, &status, 0);
        CHECK(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 130);
        CHECK_FALSE(interrupted());
    }

} // TEST_SUITE
