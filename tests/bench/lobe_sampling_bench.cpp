// lobe_sampling_bench [SAMPLES [RUNS]]: the chi-square test of every lobe's sampler, in full: 1e6 samples and 5 runs unless given.
// Prints the smallest p-value of the runs of each, as a table in Markdown, and fails if one is below the level that Sidak's
// correction gives for a significance of 0.01 of the test as a whole. The quick test is tests/light/lobe_sampling_test.
#include "bench.h"
#include "light/chi_square.h"

using namespace bake;
using namespace bake::test;
using namespace bake::test::chi_square;

int main(int argc, char** argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 1'000'000, runs = argc > 2 ? std::atoi(argv[2]) : 5;
    const std::vector<Case> all = cases();
    const double views[] = {10, 50, 80};
    const double level = 1 - std::pow(1 - 0.01, 1.0 / (3.0 * double(runs) * double(all.size())));
    bool failed = false;
    std::printf("| lobe | least p of %d runs, seen from 10° | 50° | 80° | ns per sample |\n|---|---|---|---|---|\n",
                runs);
    for (const Case& c : all) {
        std::printf("| %s |", c.name.c_str());
        double seconds = 0;
        for (const double view : views) {
            const Vec3f v(direction(c.view > 90 ? 180 - view : view, 25));
            const std::vector<double> shares = expected_shares(c.bsdf, v, 6);
            double least = 1;
            for (int run = 0; run < runs; ++run) {
                std::vector<double> counts;
                seconds += bench::seconds([&] { counts = counted(c.bsdf, v, count, std::uint64_t(run) + 1); });
                least = std::min(least, p_value(counts, shares, count));
            }
            failed |= !(least > level);
            std::printf(" %.2g |", least);
        }
        std::printf(" %.0f |\n", 1e9 * seconds / (3.0 * runs * count));
        std::fflush(stdout);
    }
    std::printf("\n%d samples; a run fails below p = %.3g: %s\n", count, level, failed ? "FAILED" : "none does");
    return failed ? 1 : 0;
}
