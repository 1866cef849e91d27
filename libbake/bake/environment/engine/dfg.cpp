#include "bake/environment/engine/dfg.h"
#include "bake/base/parallel.h"
#include "bake/light/ggx_albedo.h"
#include <algorithm>

namespace bake {

Image<float> dfg_table(int size) {
    Image<float> table(size, size, 2);
    for_rows(size, 4, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const double r = (y + 0.5) / size, alpha = std::max(double(least_ggx_alpha), r * r);
            for (int x = 0; x < size; ++x) {
                const GgxAlbedo albedo = integrated_ggx_albedo(alpha, (x + 0.5) / size);
                table.at(x, y, 0) = 1 - albedo.loss - albedo.schlick;
                table.at(x, y, 1) = albedo.schlick;
            }
        }
    });
    return table;
}

} // namespace bake
