#include "bake/environment/file/seams.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("seams: twelve, each of two faces that touch, each face in four") {
        int count[6] = {};
        for (const Seam& seam : seams()) {
            CHECK(seam.a.face < seam.b.face);
            CHECK(seam.a.face / 2 != seam.b.face / 2);
            ++count[seam.a.face];
            ++count[seam.b.face];
        }
        for (const int faces : count) CHECK(faces == 4);
    }

    TEST_CASE("seams: the sides of a smooth sky match at each seam, whatever its roughness elsewhere") {
        // Noise on one face only: a mean over the sky would hide what happens between the others.
        Cube sky = test::sky_of(32, 3, test::smooth_radiance);
        for (std::size_t i = 0; i < sky.faces[0].size(); ++i)
            sky.faces[0].data()[i] += 0.5f * float(i * 2654435761u % 100) / 100;
        const SideSteps sides = compare_sides(sky);
        CHECK(!sides.unknown);
        const auto side = [](FaceSide at) { return 4 * at.face + at.side; };
        for (const Seam& seam : seams()) {
            CHECK(sides.ratio[0][side(seam.a)][side(seam.b)] < (seam.a.face == 0 ? 2.5f : 1.3f));
            if (seam.a.face == 0) continue;
            // Any other side of the second face does not fit, nor the same one read backwards.
            CHECK(sides.ratio[0][side(seam.a)][side({seam.b.face, (seam.b.side + 2) % 4})] > 2.5f);
        }
    }

    TEST_CASE("seams: faces of one value or of fewer than eight texels tell nothing") {
        CHECK(compare_sides(test::even_sky(8, 3, 1)).unknown);
        CHECK(compare_sides(test::sky_of(7, 3, test::smooth_radiance)).unknown);
    }

} // TEST_SUITE
