#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/sky_format.h"
#include "bake/environment/sky/test_sky.h"
#include <cstring>
#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace bake;

namespace {

constexpr int size = 32;
const ResampleOptions one{Samples::one};

/// A format of the sky table that can be written, with one of the orders that its faces can have.
struct Way {
    SkyFormatEntry format;
    FaceOrder order = FaceOrder::gl;

    /// Whether the faces are sampled at the centres of their texels, so that their values come back to the bit.
    bool keeps_texels() const { return format.is_cube() && !format.is_openexr(); }
    std::string name() const { return format.name + std::string(order == FaceOrder::gl ? "" : " in OpenEXR's order"); }
};

std::vector<Way> all_ways() {
    std::vector<Way> ways;
    for (const SkyFormatEntry& format : sky_formats) {
        if (format.width_per_edge < 1) continue;
        ways.push_back({format});
        if (format.layout == CubeLayout::strip) ways.push_back({format, FaceOrder::openexr});
    }
    return ways;
}

Environment of_cube(Cube cube, bool edges = false) {
    Environment sky;
    sky.cube = std::move(cube);
    sky.edge_samples = edges;
    return sky;
}

/// The sky in this format, read back from its picture.
Environment through(const Way& way, const Environment& sky) {
    const SkyFormatEntry& format = way.format;
    if (format.projection) {
        Environment made;
        made.projection = *format.projection;
        const int width = 4 * size;
        made.picture = to_picture(sky, made.projection, width, width * format.rows / format.columns, one);
        return made;
    }
    const FaceGrid grid{format.is_openexr() ? 2 * size : size, format.is_openexr()};
    Cube faces = to_cube(sky, grid, one);
    if (format.layout)
        faces = cut_faces(paste_faces(faces, *format.layout, way.order), *format.layout, way.order, "sky");
    return of_cube(std::move(faces), format.is_openexr());
}

double difference(const Image<float>& a, const Image<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a.data()[i] - b.data()[i]);
    return sum / double(a.size());
}

Image<float> mirrored(const Image<float>& face) {
    Image<float> result(face.width(), face.height(), face.channels());
    for (int y = 0; y < face.height(); ++y)
        for (int x = 0; x < face.width(); ++x)
            std::copy_n(&face.at(face.width() - 1 - x, y), face.channels(), &result.at(x, y));
    return result;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("round trip: the labelled sky through every pair of layouts comes back upright, texel by texel where "
              "faces stay faces") {
        const Environment labels = of_cube(label_sky(size));
        const std::vector<Way> ways = all_ways();
        REQUIRE(ways.size() >= 10);
        for (const Way& first : ways) {
            const Environment between = through(first, labels);
            for (const Way& second : ways) {
                CAPTURE(first.name());
                CAPTURE(second.name());
                const Cube back = to_cube(through(second, between), {size, false}, one);
                for (const CubeFace face : all_cube_faces) {
                    CAPTURE(cube_face_names[int(face)]);
                    const Image<float>&was = labels.cube[face], &is = back[face];
                    if (first.keeps_texels() && second.keeps_texels()) {
                        CHECK(std::memcmp(was.data(), is.data(), was.size() * sizeof(float)) == 0);
                        continue;
                    }
                    // Blurred by pictures of other texels, but nearer to itself than to any turn, mirror image or other face.
                    const double same = difference(was, is);
                    for (int turns = 0; turns < 4; ++turns) {
                        if (turns) CHECK(same < 0.8 * difference(turned(was, turns), is));
                        CHECK(same < 0.8 * difference(mirrored(turned(was, turns)), is));
                    }
                    for (const CubeFace other : all_cube_faces)
                        if (other != face) CHECK(same < 0.8 * difference(labels.cube[other], is));
                }
            }
        }
    }

} // TEST_SUITE
