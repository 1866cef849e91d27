// What the benches share: works timed in turn, their errors, and the one row they all print.
//
//   bench,case,size,threads,ns_per_item,error_mean_deg,error_p95_deg,error_max_deg,ratio,against,note
//
// ratio is the time over that of `against`, a physical limit or a peer measured in turn in the same run. A row is printed from
// a Measured alone, and only in_turn() makes one: from a Work, which gives its result and knows how wrong a result is. The errors
// are therefore those of the last result that was timed.
#pragma once
#include "bake/base/parallel.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
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

/// printf into a string.
template <class... Values> std::string text(const char* format, Values... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

/// Mean, 95th percentile and largest of `count` values, degrees unless the note of the row says otherwise.
struct Errors {
    double mean = 0, p95 = 0, max = 0;
    std::size_t count = 0; ///< 0: nothing was looked at, and no row can be printed
};

/// Takes the list: percentiles reorder it.
inline Errors errors_of(std::vector<float> values) {
    if (values.empty()) return {};
    double sum = 0;
    for (const float value : values) sum += double(value);
    const auto p95 = values.begin() + std::ptrdiff_t(values.size() * 95 / 100);
    std::nth_element(values.begin(), p95, values.end());
    return {sum / double(values.size()), double(*p95), double(*std::max_element(p95, values.end())), values.size()};
}

/// What is timed, and how wrong its result is: run() gives the result, or a reference to where it leaves it, and
/// errors(result) the errors of that one.
class Work {
public:
    template <class Run, class ErrorsOf>
    requires(!std::is_void_v<std::invoke_result_t<Run&>> &&
             std::is_same_v<
                 Errors, std::invoke_result_t<ErrorsOf&, const std::remove_reference_t<std::invoke_result_t<Run&>>&>>)
        Work(Run work, ErrorsOf errors_of_result) {
        using Result = std::invoke_result_t<Run&>;
        if constexpr (std::is_reference_v<Result>) {
            const auto kept = std::make_shared<std::remove_reference_t<Result>*>(nullptr);
            forget = [kept] { *kept = nullptr; };
            this->run = [kept, work]() mutable { *kept = &work(); };
            this->errors = [kept, errors_of_result]() mutable { return errors_of_result(**kept); };
        } else {
            const auto kept = std::make_shared<std::optional<Result>>();
            forget = [kept] { kept->reset(); };
            this->run = [kept, work]() mutable { kept->emplace(work()); };
            this->errors = [kept, errors_of_result]() mutable { return errors_of_result(**kept); };
        }
    }

private:
    std::function<void()> forget, run;
    std::function<Errors()> errors;
    friend struct Turns;
};

/// Times of a work and the errors of the last result that was timed.
class Measured {
public:
    const Times& times() const { return times_; }
    const Errors& errors() const { return errors_; }
    double median() const { return times_.median(); }
    double ratio_to(const Times& other) const { return times_.ratio_to(other); }
    double ratio_to(const Measured& other) const { return times_.ratio_to(other.times_); }

private:
    Measured(Times times, Errors errors) : times_(std::move(times)), errors_(errors) {}
    Times times_;
    Errors errors_;
    friend struct Turns;
};

struct Turns {
    std::vector<Times> limits;
    std::vector<Measured> works;

    /// Limits and works, A B C, A B C, ..., after `warm_up` rounds that are not counted, so that noise of the machine falls on
    /// all of them alike.
    static Turns of(int rounds, int warm_up, const std::vector<std::function<void()>>& limits,
                    std::vector<Work> works) {
        Turns turns;
        turns.limits.resize(limits.size());
        std::vector<Times> times(works.size());
        for (int round = -warm_up; round < rounds; ++round) {
            const auto count = [&](Times& of, double time) {
                if (round >= 0) of.seconds.push_back(time);
            };
            for (std::size_t i = 0; i < limits.size(); ++i) count(turns.limits[i], bench::seconds(limits[i]));
            for (std::size_t i = 0; i < works.size(); ++i) {
                works[i].forget();
                count(times[i], bench::seconds(works[i].run));
            }
        }
        for (std::size_t i = 0; i < works.size(); ++i) {
            turns.works.push_back(Measured(std::move(times[i]), works[i].errors()));
            works[i].forget();
        }
        return turns;
    }
};

/// After one round that is not counted.
inline Turns in_turn(int rounds, const std::vector<std::function<void()>>& limits, std::vector<Work> works) {
    return Turns::of(rounds, 1, limits, std::move(works));
}
/// One run without another before it: for what takes long.
inline Measured once(Work work) { return Turns::of(1, 0, {}, {std::move(work)}).works[0]; }

/// What a row says besides times and errors.
struct Row {
    std::string bench, what;
    std::int64_t size = 0;
    double items = 1; ///< that the time is divided by
    double ratio = 0;
    std::string against, note;
};

/// The row as text, without a newline. A comma in a name or a note becomes a semicolon.
inline std::string row_text(const Row& row, double seconds, const Errors& errors, const std::string& note) {
    const auto field = [](std::string words) {
        std::replace(words.begin(), words.end(), ',', ';');
        return words;
    };
    return field(row.bench) + "," + field(row.what) +
           text(",%lld,%d,%.4g,%.4g,%.4g,%.4g,%.3g,", static_cast<long long>(row.size), bake::thread_count(),
                1e9 * seconds / row.items, errors.mean, errors.p95, errors.max, row.ratio) +
           field(row.against) + "," + field(note);
}

/// Ends the program where no value was looked at, or where an error is not finite.
inline void print_row(const Measured& measured, const Row& row) {
    const Errors& e = measured.errors();
    if (e.count == 0 || !std::isfinite(e.mean + e.p95 + e.max)) {
        std::fprintf(stderr, "%s %s: no error, or one that is not finite\n", row.bench.c_str(), row.what.c_str());
        std::exit(1);
    }
    std::string note = row.note;
    if (e.max == 0) note += (note.empty() ? "" : "; ") + text("exact: 0 in %zu values", e.count);
    std::printf("%s\n", row_text(row, measured.median(), e, note).c_str());
    std::fflush(stdout);
}

/// For what has no result that could be wrong, such as bare traversal: the columns are 0, and the note says why.
inline void print_row_without_error(const Times& times, const Row& row, const std::string& reason) {
    std::printf(
        "%s\n",
        row_text(row, times.median(), {}, "no error: " + reason + (row.note.empty() ? "" : "; ") + row.note).c_str());
    std::fflush(stdout);
}

} // namespace bench
