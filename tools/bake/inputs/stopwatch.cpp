#include "inputs/stopwatch.h"
#include "bake/base/text.h"
#include <chrono>

namespace bake {
namespace {
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
} // namespace

Stopwatch::Stopwatch() : last_(now()) {}

void Stopwatch::lap(const std::string& step) {
    const double time = now(), seconds = time - last_;
    last_ = time;
    for (auto& [name, sum] : laps_)
        if (name == step) {
            sum += seconds;
            return;
        }
    laps_.emplace_back(step, seconds);
}

double Stopwatch::seconds(const std::string& step) const {
    for (const auto& [name, seconds] : laps_)
        if (name == step) return seconds;
    return 0;
}

double Stopwatch::total() const {
    double sum = 0;
    for (const auto& [step, seconds] : laps_) sum += seconds;
    return sum;
}

double Stopwatch::elapsed() const { return now() - last_; }

std::string Stopwatch::to_text() const {
    std::string line;
    for (const auto& [step, seconds] : laps_)
        line += (line.empty() ? "" : ", ") + format("%s %.3f s", step.c_str(), seconds);
    return line;
}

nlohmann::json Stopwatch::to_json() const {
    nlohmann::json object;
    for (const auto& [step, seconds] : laps_) object[step] = seconds;
    return object;
}

} // namespace bake
