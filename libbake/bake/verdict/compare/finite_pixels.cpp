#include "bake/verdict/compare/finite_pixels.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/verdict/finding_text.h"
#include <algorithm>
#include <cmath>

namespace bake {

void require_finite_pixels(const Image<float>& image, int channels, const std::string& file) {
    std::size_t count = 0;
    int first_x = 0, first_y = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const float* pixel = &image.at(x, y);
            if (std::all_of(pixel, pixel + channels, [](float v) { return std::isfinite(v); })) continue;
            if (count++ == 0) first_x = x, first_y = y;
        }
    if (count > 0)
        throw Error(Refusal::unsuitable,
                    file + ": " + counted(count, count == 1 ? "pixel|is" : "pixel|are") +
                        format(" NaN or Inf, the first at column %d, row %d; give ", first_x, first_y) +
                        (count == 1 ? "it a finite value" : "them finite values"));
}

void require_one_size(const Image<float>& image, const std::string& file, const Image<float>& other,
                      const std::string& other_file) {
    if (image.width() == other.width() && image.height() == other.height()) return;
    throw Error(Refusal::unsuitable, other_file + format(": is %d x %d, where ", other.width(), other.height()) + file +
                                         format(" is %d x %d; bring both to one size", image.width(), image.height()));
}

} // namespace bake
