#include "bake/verdict/metric/error_summary.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bake {
namespace {

/// Percentiles by nearest rank. Reorders the errors.
template <class T> void rank(std::vector<T>& errors, ErrorSummary& summary) {
    const auto at = [&](int percent) {
        const std::size_t index = (errors.size() * std::size_t(percent) + 99) / 100 - 1;
        const auto place = errors.begin() + std::ptrdiff_t(index);
        std::nth_element(errors.begin(), place, errors.end());
        return double(*place);
    };
    summary.p95 = at(95);
    summary.p99 = at(99);
    summary.max = double(*std::max_element(errors.begin(), errors.end()));
}

} // namespace

ErrorSummary summarise(const Image<float>& errors) {
    ErrorSummary summary;
    if (errors.size() == 0) return summary;
    const std::size_t row = std::size_t(errors.width()) * std::size_t(errors.channels());
    double sum = 0;
    for (int y = 0; y < errors.height(); ++y) {
        double of_row = 0;
        for (std::size_t i = 0; i < row; ++i) of_row += double(errors.row(y)[i]);
        sum += of_row;
    }
    summary.mean = sum / double(errors.size());
    std::vector<float> values(errors.data(), errors.data() + errors.size());
    rank(values, summary);
    return summary;
}

ErrorSummary summarise(std::vector<double> errors) {
    ErrorSummary summary;
    if (errors.empty()) return summary;
    for (const double error : errors) summary.mean += error;
    summary.mean /= double(errors.size());
    rank(errors, summary);
    return summary;
}

} // namespace bake
