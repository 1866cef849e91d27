// bound_hunt_sweep: looks for a scene in which a bound of the plan (error_bound()) is below the measured error.
//
//   bound_hunt_sweep [SCENES] [FIRST_SEED]     default 10000 scenes; exit code 1 if a bound is refuted
//
// Of every tenth scene without a bound the error is measured too, to tell of what share of the scenes within a budget of .01 a
// bound says so.
#include "verdict/plan/bound_hunt.h"
#include <chrono>
#include <cstdio>
#include <cstdlib>

using namespace bake;

namespace {

struct Tally {
    int drawn = 0, bounds = 0, refuted = 0, settled = 0, within = 0, within_measured = 0, flat_within_measured = 0;
    double nearest = 0; ///< largest ratio of the error to the bound
};

void count(std::uint32_t seed, Tally& tally) {
    constexpr double budget = 0.01;
    constexpr int half = 8;
    const auto scene = test::drawn_scene(seed, "displace:8");
    const test::Hunted found = test::hunt(*scene, half);
    ++tally.drawn;
    const bool sampled = seed % 10 == 0;
    if (!found.bound) {
        if (!sampled) return;
        const bool within = test::measured_error(*scene, half).rmse() <= budget;
        tally.within_measured += within, tally.flat_within_measured += within && scene->base == "plane";
        return;
    }
    ++tally.bounds;
    tally.settled += found.bound->rmse <= budget;
    if (sampled && found.bound->rmse <= budget) ++tally.within;
    else if (sampled && found.error.rmse() <= budget)
        ++tally.within_measured, tally.flat_within_measured += scene->base == "plane";
    const double low = std::sqrt(std::fmax(0.0, found.error.square - 4 * found.error.error));
    if (found.bound->rmse > 0) tally.nearest = std::fmax(tally.nearest, low / found.bound->rmse);
    if (!found.refuted()) return;
    ++tally.refuted;
    std::printf("REFUTED seed %u: %s, slope %.3g: bound %.5f (%s), error %.5f +- %.5f\n", unsigned(seed),
                scene->base.c_str(), scene->slope, found.bound->rmse, found.bound->why.c_str(), found.error.rmse(),
                found.error.high() - found.error.rmse());
}

} // namespace

int main(int argc, char** argv) {
    const int scenes = argc > 1 ? std::atoi(argv[1]) : 10000, first = argc > 2 ? std::atoi(argv[2]) : 1;
    const auto start = std::chrono::steady_clock::now();
    Tally tally;
    for (int i = 0; i < scenes; ++i) {
        count(std::uint32_t(first + i), tally);
        if (i % 1000 == 999)
            std::printf("%d scenes, %d bounds, %d refuted\n", i + 1, tally.bounds, tally.refuted), std::fflush(stdout);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("scenes %d, with a bound %d, settled at .01 %d, refuted %d, largest share of a bound %.3f, %.0f s\n",
                tally.drawn, tally.bounds, tally.settled, tally.refuted, tally.nearest, seconds);
    std::printf("of every tenth scene: within .01 %d (flat %d); of these settled by a bound %d\n",
                tally.within + tally.within_measured, tally.within + tally.flat_within_measured, tally.within);
    return tally.refuted > 0;
}
