#include "oracle/surfaces.h"
#include <algorithm>

namespace oracle {

Spread spread(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    Spread s;
    for (const double value : values) s.mean += value, s.rms += value * value;
    s.mean /= double(values.size());
    s.rms = std::sqrt(s.rms / double(values.size()));
    s.p95 = values[std::size_t(0.95 * double(values.size() - 1))];
    s.max = values.back();
    return s;
}

} // namespace oracle
