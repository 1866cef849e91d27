#include "bake/preview/texture_size.h"
#include "bake/picture/bc5.h"
#include "bake/relief/map/bump_table.h"

namespace bake {
namespace {

bool is_larger(const Image<float>& image, int most) noexcept { return std::max(image.width(), image.height()) > most; }

Image<float> smaller(const Image<float>& image, int most) {
    Image<float> half = halve(image);
    while (is_larger(half, most)) half = halve(half);
    return half;
}

} // namespace

Texture halved_to(const Texture& texture, int most) {
    if (!texture || most <= 0 || !is_larger(*texture, most)) return texture;
    return std::make_shared<const Image<float>>(smaller(*texture, most));
}

Texture normals_halved_to(const Texture& texture, int most) {
    if (!texture || most <= 0 || !is_larger(*texture, most)) return texture;
    Image<float> image = smaller(*texture, most);
    for (std::size_t i = 0; i < image.size(); i += 3) {
        float* t = image.data() + i;
        const Vec3f unit = unit_or_zero(Vec3f(t[0], t[1], t[2]));
        for (int c = 0; c < 3; ++c) t[c] = unit[c];
    }
    return std::make_shared<const Image<float>>(std::move(image));
}

Texture normals_in_bc5(const Texture& texture) {
    if (!texture) return texture;
    Image<float> image = copied(*texture);
    bc5_round(image);
    return std::make_shared<const Image<float>>(std::move(image));
}

} // namespace bake
