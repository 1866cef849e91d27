// Our normal maps against those that authors made from the same heights. The manifest's figures are of central
// differences, so that filter is compared; sobel, the default for 8 bits, is .0006 and .016 below on two of the six.
#include "bake/relief/map/normal_map.h"
#include "folders.h"
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

using namespace bake;

namespace {

/// -n_x / n_z or -n_y / n_z of an encoded map, under a repeating 5 x 5 box.
std::vector<double> box_slopes(const Image<float>& map, int axis, bool directx) {
    const int width = map.width(), height = map.height();
    const auto slope = [&](int x, int y) {
        x = wrap_index(x, width, Wrap::repeat), y = wrap_index(y, height, Wrap::repeat);
        const Vec3f n = decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, directx);
        return -double(n[axis]) / std::max(0.05, double(n.z));
    };
    std::vector<double> out;
    out.reserve(std::size_t(width) * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) sum += slope(x + i, y + j);
            out.push_back(sum / 25);
        }
    return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) mean_a += a[i] / double(a.size()), mean_b += b[i] / double(b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

} // namespace

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("normal_map: from each real height, at least as close to the author's map as the manifest's figure") {
        const auto pairs = test::shared_data() / "textures/pairs";
        // Those of a stated correlation of .95 or more; least: its digits, less half of the last. scale: slope per unit of
        // height per texel in the author's map.
        const struct {
            const char *height, *normals;
            double least_x, least_y, scale;
            bool inverted;
        } known[] = {
            {"ambientcg_Rock020/Rock020_1K_Displacement.jpg", "ambientcg_Rock020/Rock020_1K_Normal.jpg", .9985, .9985,
             63, false},
            {"ambientcg_Tiles036/Tiles036_1K_Displacement.jpg", "ambientcg_Tiles036/Tiles036_1K_Normal.jpg", .9945,
             .9945, 3.5, false},
            {"cube2_metal_tech_01/metal_tech_01_hm.png", "cube2_metal_tech_01/metal_tech_01_nm.png", .9995, .9995, 68.4,
             false},
            {"cube2_diamond_plate_big_gk/diamond_plate_big_gk_hm.png",
             "cube2_diamond_plate_big_gk/diamond_plate_big_gk_nm.png", .9975, .9975, 47, false},
            {"cube2_wall_plate_12_gk/wall_plate_12_gk_hm.png", "cube2_wall_plate_12_gk/wall_plate_12_gk_nm.png", .965,
             .9955, 7.2, true},
            {"cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_hm.png",
             "cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_nm.png", .965, .945, 33, false},
        };
        for (const auto& k : known) {
            HeightTexture height = read_height((pairs / k.height).string());
            if (k.inverted) invert(height);
            const Image<float> author = read_image((pairs / k.normals).string());
            REQUIRE(author.width() == height.values.width());
            NormalMapOptions options;
            options.directx = true;
            options.height_options.amplitude = k.scale / author.width(); // per unit of u on a picture one unit wide
            const HeightField field(height, options.height_options, Filter::central, author.width(), author.height());
            const Image<float> ours = normal_map(field, {1, double(author.height()) / author.width()}, options);
            const double along_x = correlation(box_slopes(ours, 0, true), box_slopes(author, 0, true));
            const double along_y = correlation(box_slopes(ours, 1, true), box_slopes(author, 1, true));
            MESSAGE(std::string(k.height) << ": " << along_x << ", " << along_y);
            CHECK(along_x >= k.least_x);
            CHECK(along_y >= k.least_y);
        }
    }
}
