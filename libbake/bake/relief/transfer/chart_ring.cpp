#include "bake/relief/transfer/chart_ring.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/relief/map/normal_code.h"
#include <array>
#include <vector>

namespace bake {
namespace {

constexpr float alike = 0.87f; // cosine of 30 degrees
constexpr std::array<std::array<int, 2>, 8> neighbours = {
    {{0, -1}, {-1, 0}, {1, 0}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

class Ring {
public:
    Ring(const Image<float>& map, const Image<unsigned char>& owned) : map_(map), owned_(owned) {}

    /// Zero if no neighbour is owned.
    Vec3f at(int x, int y) const noexcept {
        Vec3f sum(0);
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
            const auto [dx, dy] = neighbours[k];
            if (k == 4 && sum != Vec3f(0)) break; // diagonals only where no side is owned
            if (!owned(x + dx, y + dy)) continue;
            const Vec3f near = normal(x + dx, y + dy);
            const Vec3f far = owned(x + 2 * dx, y + 2 * dy) ? normal(x + 2 * dx, y + 2 * dy) : near;
            sum += glm::dot(near, far) > alike ? 2.0f * near - far : near;
        }
        return unit_or_zero(sum);
    }

private:
    bool owned(int x, int y) const noexcept {
        return x >= 0 && y >= 0 && x < map_.width() && y < map_.height() && owned_.at(x, y);
    }
    Vec3f normal(int x, int y) const noexcept {
        const float* rgb = &map_.at(x, y);
        return decode_normal({rgb[0], rgb[1], rgb[2]}, false);
    }

    const Image<float>& map_;
    const Image<unsigned char>& owned_;
};

struct Filled {
    int x, y;
    Vec3f normal;
};

} // namespace

std::int64_t continue_charts(Image<float>& map, Image<unsigned char>& owned) {
    const Ring ring(map, owned);
    std::vector<std::vector<Filled>> rows(std::size_t(map.height()));
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < map.width(); ++x)
                if (!owned.at(x, y))
                    if (const Vec3f n = ring.at(x, y); n != Vec3f(0)) rows[std::size_t(y)].push_back({x, y, n});
    });
    std::int64_t count = 0;
    for (const std::vector<Filled>& row : rows)
        for (const Filled& texel : row) {
            const Vec3f code = encode_normal(texel.normal, false);
            for (int c = 0; c < 3; ++c) map.at(texel.x, texel.y, c) = code[c];
            owned.at(texel.x, texel.y) = 1, ++count;
        }
    return count;
}

} // namespace bake
