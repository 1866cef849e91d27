// How the time of some work grows with its size.
#pragma once
#include <algorithm>
#include <ctime>

namespace bake::test {

/// Least processor time of three runs of work(size), in seconds: what else the machine does counts little.
template <class Work> double least_seconds(const Work& work, int size) {
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
        const std::clock_t begin = std::clock();
        work(size);
        least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

/// Time for four times the size over the time for the size: 4 if the time is linear, 16 if it is quadratic. Times below
/// a millisecond count as one.
template <class Work> double growth(const Work& work, int size) {
    const double time = std::max(1e-3, least_seconds(work, size));
    return least_seconds(work, 4 * size) / time;
}

/// Between linear and quadratic, with room for what else the machine does.
inline constexpr double most_growth = 9;

} // namespace bake::test
