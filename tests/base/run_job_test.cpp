#include "bake/base/parallel.h"
#include "bake/base/run_job.h"
#include <atomic>
#include <chrono>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("stability") {
    TEST_CASE("run_job: its threads work for it, and for the process when it has ended") {
        std::atomic<int> wrong = 0;
        const auto work_for_a_while = [&](const Job& right) {
            for_rows(200, 1, [&](std::int64_t, std::int64_t) {
                if (&current_job() != &right) ++wrong;
                const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
                while (std::chrono::steady_clock::now() < end) continue;
            });
        };
        for (int round = 0; round < 50; ++round) {
            {
                Job job;
                job.threads = 2;
                run_job(job, [&] { work_for_a_while(job); });
            }
            work_for_a_while(process_job());
        }
        CHECK(wrong.load() == 0);
    }
}
