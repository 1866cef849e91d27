#include "bake/relief/height/repeat.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include <algorithm>

namespace bake {
namespace {

constexpr std::int64_t longest_side = 65536;

void refuse_too_large(std::int64_t width, std::int64_t height, const std::string& path) {
    const MemoryLimit memory = memory_limit();
    const double bytes = 4.0 * double(width) * double(height);
    if (width <= longest_side && height <= longest_side && bytes < double(memory.bytes)) return;
    throw Error(Refusal::unsuitable, path + ": repeated it would have " + std::to_string(width) + " x " +
                                         std::to_string(height) +
                                         " texels, which is too large; set `repeat` lower, or take a smaller picture");
}

} // namespace

void repeat(HeightTexture& height, int along_u, int along_v, Wrap wrap_u, Wrap wrap_v, const std::string& path) {
    if (along_u == 1 && along_v == 1) return;
    const Image<float>& from = height.values;
    const std::int64_t width = std::int64_t(from.width()) * along_u, rows = std::int64_t(from.height()) * along_v;
    refuse_too_large(width, rows, path);
    Image<float> out(int(width), int(rows), 1);
    for_rows(rows, 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            // Copies are counted from the lower left, where u and v are 0; row 0 is the top.
            const int copy = along_v - 1 - y / from.height(), inside = y % from.height();
            const bool turned = wrap_v == Wrap::mirror && copy % 2 == 1;
            const float* const row = from.row(turned ? from.height() - 1 - inside : inside);
            float* to = out.row(y);
            for (int i = 0; i < along_u; ++i, to += from.width())
                if (wrap_u == Wrap::mirror && i % 2 == 1) std::reverse_copy(row, row + from.width(), to);
                else std::copy_n(row, from.width(), to);
        }
    });
    height.values = std::move(out);
    height.info.width = int(width), height.info.height = int(rows);
}

} // namespace bake
