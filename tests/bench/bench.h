// What the benches share: works timed in turn, errors summed up, and the one row they all print.
//
//   bench,case,size,threads,ns_per_item,error_mean_deg,error_p95_deg,error_max_deg,ratio,against,note
//
// ratio is the time over that of `against`, a physical limit or a peer measured in turn in the same run.
#pragma once
#include "bake/base/parallel.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace bench {

template <class Work> double seconds(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median_of(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// Seconds of one work, round by round.
struct Times {
    std::vector<double> seconds;
    double median() const { return median_of(seconds); }
    /// The median of the rounds' own ratios: a neighbour that slows a round slows both.
    double ratio_to(const Times& other) const {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < seconds.size(); ++i) ratios.push_back(seconds[i] / other.seconds[i]);
        return median_of(ratios);
    }
};

/// Times of each work: A B C, A B C, ..., after one round that is not counted, so that noise of the machine falls on
/// all of them alike.
inline std::vector<Times> in_turn(int rounds, const std::vector<std::function<void()>>& works) {
    std::vector<Times> times(works.size());
    for (int round = -1; round < rounds; ++round)
        for (std::size_t i = 0; i < works.size(); ++i) {
            const double time = seconds(works[i]);
            if (round >= 0) times[i].seconds.push_back(time);
        }
    return times;
}

/// printf into a string.
template <class... Values> std::string text(const char* format, Values... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

/// Mean, 95th percentile and largest of a list, degrees. Takes the list: percentiles reorder it.
struct Errors {
    double mean = 0, p95 = 0, max = 0;
};

inline Errors errors_of(std::vector<float> values) {
    if (values.empty()) return {};
    double sum = 0;
    for (const float value : values) sum += double(value);
    const auto p95 = values.begin() + std::ptrdiff_t(values.size() * 95 / 100);
    std::nth_element(values.begin(), p95, values.end());
    return {sum / double(values.size()), double(*p95), double(*std::max_element(p95, values.end()))};
}

inline void print_row(const std::string& name, const std::string& what, std::int64_t size, double ns_per_item,
                      const Errors& errors, double ratio, const std::string& against, const std::string& note) {
    std::printf("%s,%s,%lld,%d,%.4g,%.4g,%.4g,%.4g,%.3g,%s,%s\n", name.c_str(), what.c_str(),
                static_cast<long long>(size), bake::thread_count(), ns_per_item, errors.mean, errors.p95, errors.max,
                ratio, against.c_str(), note.c_str());
    std::fflush(stdout);
}

} // namespace bench
