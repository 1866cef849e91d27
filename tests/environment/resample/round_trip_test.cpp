#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/layout.h"
#include "bake/environment/sky/test_sky.h"
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;

namespace {

constexpr int size = 32;
const ResampleOptions one{Samples::one};

/// A way to lay the sky out, there and back to an environment.
struct Way {
    const char* name;
    bool texels; ///< texel-centred faces, whose texels come back to the bit
    Environment (*through)(const Environment& sky);
};

Environment of_cube(Cube cube, bool edges = false) {
    Environment sky;
    sky.cube = std::move(cube);
    sky.edge_samples = edges;
    return sky;
}

template <CubeLayout layout, FaceOrder order> Environment pasted(const Environment& sky) {
    return of_cube(cut_faces(paste_faces(to_cube(sky, {size, false}, one), layout, order), layout, order, "sky"));
}

template <Projection projection> Environment picture(const Environment& sky) {
    Environment made;
    made.projection = projection;
    const int width = 4 * size;
    made.picture = to_picture(sky, projection, width, projection == Projection::octahedral ? width : width / 2, one);
    return made;
}

Environment edge_sampled(const Environment& sky) {
    const FaceGrid grid{2 * size, true};
    return of_cube(cut_faces(paste_faces(to_cube(sky, grid, one), CubeLayout::strip, FaceOrder::openexr),
                             CubeLayout::strip, FaceOrder::openexr, "sky"),
                   true);
}

const Way ways[] = {{"faces", true,
                     [](const Environment& sky) {
                         return of_cube(to_cube(sky, {size, false}, one));
                     }},
                    {"hcross", true, pasted<CubeLayout::hcross, FaceOrder::gl>},
                    {"vcross", true, pasted<CubeLayout::vcross, FaceOrder::gl>},
                    {"strip", true, pasted<CubeLayout::strip, FaceOrder::gl>},
                    {"strip in OpenEXR's order", true, pasted<CubeLayout::strip, FaceOrder::openexr>},
                    {"latlong", false, picture<Projection::latlong>},
                    {"octahedral", false, picture<Projection::octahedral>},
                    {"openexr-cube", false, edge_sampled},
                    {"openexr-latlong", false, picture<Projection::latlong_edges>}};

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
        for (const Way& first : ways) {
            const Environment between = first.through(labels);
            for (const Way& second : ways) {
                CAPTURE(first.name);
                CAPTURE(second.name);
                const Cube back = to_cube(second.through(between), {size, false}, one);
                for (const CubeFace face : all_cube_faces) {
                    CAPTURE(cube_face_names[int(face)]);
                    const Image<float>&was = labels.cube[face], &is = back[face];
                    if (first.texels && second.texels) {
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
