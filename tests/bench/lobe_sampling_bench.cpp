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
    constexpr double views[] = {10, 50, 80};
    const double level = 1 - std::pow(1 - 0.01, 1.0 / (3.0 * double(runs) * double(all.size())));
    std::vector<double> least(3 * all.size(), 1.0);
    for_rows(std::int64_t(least.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i) {
            const Case& c = all[i / 3];
            const double view = views[i % 3];
            const Vec3f v(direction(c.view > 90 ? 180 - view : view, 25));
            const std::vector<double> shares = expected_shares(c.bsdf, v, 6);
            for (int run = 0; run < runs; ++run)
                least[i] = std::min(least[i],
                                    p_value(counted(c.bsdf, v, count, std::uint64_t(run) + 1), shares, double(count)));
        }
    });
    std::printf("| lobe | least p of %d runs, seen from 10° | 50° | 80° |\n|---|---|---|---|\n", runs);
    for (std::size_t i = 0; i < all.size(); ++i)
        std::printf("| %s | %.2g | %.2g | %.2g |\n", all[i].name.c_str(), least[3 * i], least[3 * i + 1],
                    least[3 * i + 2]);
    const bool failed = std::any_of(least.begin(), least.end(), [&](double p) { return !(p > level); });
    std::printf("\n%d samples; a run fails below p = %.3g: %s\n", count, level, failed ? "FAILED" : "none does");
    return failed ? 1 : 0;
}
