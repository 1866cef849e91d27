#include "bake/relief/map/stored_error.h"
#include "bake/base/parallel.h"
#include "bake/relief/map/error_budget.h"
#include "bake/relief/map/normal_code.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {

StoredError stored_error(const Image<float>& stored, const Image<float>& normals) {
    const std::size_t width = std::size_t(normals.width()), count = width * std::size_t(normals.height());
    std::vector<float> angles(count);
    for_rows(normals.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::size_t i = std::size_t(begin) * width; i < std::size_t(end) * width; ++i) {
            const float* rgb = stored.data() + i * std::size_t(stored.channels());
            const float* n = normals.data() + 3 * i;
            const Vec3d read(decode_normal({rgb[0], rgb[1], rgb[2]}, false));
            angles[i] = float(180 / pi * angle_between(read, {n[0], n[1], n[2]}));
        }
    });
    StoredError error;
    double sum = 0, squares = 0;
    for (const float angle : angles) sum += double(angle), squares += double(angle) * double(angle);
    error.mean_deg = sum / double(count), error.rms_deg = std::sqrt(squares / double(count));
    const auto p95 = angles.begin() + std::ptrdiff_t(count * 95 / 100);
    std::nth_element(angles.begin(), p95, angles.end());
    error.p95_deg = double(*p95), error.max_deg = double(*std::max_element(p95, angles.end()));
    return error;
}

} // namespace bake
