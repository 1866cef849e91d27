#include "bake/environment/sky/cross.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A face turned by quarter turns, counter-clockwise: written once more, so that nothing leans on libbake's.
Image<float> quarter_turns(const Image<float>& face, int turns) {
    const int n = face.width();
    Image<float> out(n, n, 1);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            int from_x = x, from_y = y;
            for (int k = 0; k < turns; ++k) {
                const int old = from_x;
                from_x = n - 1 - from_y;
                from_y = old;
            }
            out.at(x, y) = face.at(from_x, from_y);
        }
    return out;
}

/// Steps between neighbouring filled cells are no larger than steps inside, for a smooth sky and a net of the cube.
bool is_net(const Image<float>& picture, int n) {
    const auto step = [&](int x0, int y0, int x1, int y1) { return std::abs(picture.at(x0, y0) - picture.at(x1, y1)); };
    const auto filled = [&](int x, int y) { return picture.at(x, y) != 0; };
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            if (x + 1 < picture.width() && filled(x, y) && filled(x + 1, y) && step(x, y, x + 1, y) > 1.2f / float(n))
                return false;
            if (y + 1 < picture.height() && filled(x, y) && filled(x, y + 1) && step(x, y, x, y + 1) > 1.2f / float(n))
                return false;
        }
    return true;
}

float smooth(const Vec3d& d, int) { return float(2 + 0.3 * d.x - 0.25 * d.y + 0.2 * d.z + 0.1 * d.x * d.y); }

/// Every cross of a shape that is a net of the smooth sky, found by trying the turns of the face that is aside.
Image<float> cross_of(const Cube& sky, CubeLayout layout, const CrossShape& shape) {
    const bool wide = layout == CubeLayout::hcross;
    const int n = sky.size();
    for (int turns = 0; turns < 4; ++turns) {
        Image<float> picture(wide ? 4 * n : 3 * n, wide ? 3 * n : 4 * n, 1);
        std::fill_n(picture.data(), picture.size(), 0.0f);
        const auto put = [&](CubeFace face, int turned_by, int column, int row) {
            const Image<float> cell = quarter_turns(sky[face], turned_by);
            for (int y = 0; y < n; ++y) std::copy_n(cell.row(y), n, &picture.at(column * n, row * n + y));
        };
        using enum CubeFace;
        const CubeFace across[4] = {pz, px, nz, nx}, down[4] = {pz, ny, nz, py};
        for (int k = 0; k < 4; ++k) {
            const int at = (shape.first + k) % 4;
            if (wide) put(across[k], 0, at, 1);
            else put(down[k], k == 2 ? 2 : 0, 1, at);
        }
        if (wide) put(py, 0, shape.first, 0), put(ny, turns, shape.second, 2);
        else put(nx, 0, 0, shape.first), put(px, turns, 2, shape.second);
        if (is_net(picture, n)) return picture;
    }
    return {};
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("cross: every net of four in a line with one face at each side is found and folded") {
        const Cube sky = test::sky_of(16, 1, smooth);
        for (const CubeLayout layout : {CubeLayout::hcross, CubeLayout::vcross})
            for (int first = 0; first < 4; ++first)
                for (int second = 0; second < 4; ++second) {
                    CAPTURE(first);
                    CAPTURE(second);
                    const Image<float> picture = cross_of(sky, layout, {first, second});
                    REQUIRE(!picture.empty());
                    const CrossShape shape = find_cross(picture, layout);
                    CHECK(shape.first == first);
                    CHECK(shape.second == second);
                    CHECK(test::same_bytes(cut_cross(picture, layout, shape, "cross.png"), sky));
                }
    }

    TEST_CASE(
        "cross: a face of one colour in the usual place, or a filled background, is no reason to look elsewhere") {
        const Cube sky = test::sky_of(16, 1, smooth);
        Image<float> black_floor = cross_of(sky, CubeLayout::hcross, {1, 1});
        for (int y = 32; y < 48; ++y)
            for (int x = 16; x < 32; ++x) black_floor.at(x, y) = 0;
        CHECK(find_cross(black_floor, CubeLayout::hcross) == CrossShape{});
        Image<float> labels = cross_of(sky, CubeLayout::hcross, {1, 1});
        for (const int column : {0, 2, 3})
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) labels.at(column * 16 + x, y) = float((x + y) % 5);
        CHECK(find_cross(labels, CubeLayout::hcross) == CrossShape{});
    }

    TEST_CASE("cross: noise of compression in empty cells does not count") {
        const Cube sky = test::sky_of(32, 1, smooth);
        Image<float> picture = cross_of(sky, CubeLayout::hcross, {0, 0});
        for (std::size_t i = 0; i < picture.size(); ++i)
            if (picture.data()[i] == 0) picture.data()[i] = 0.005f * float(i * 2654435761u % 3);
        CHECK(find_cross(picture, CubeLayout::hcross) == CrossShape{0, 0});
    }

} // TEST_SUITE
