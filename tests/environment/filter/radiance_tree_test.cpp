#include "bake/environment/filter/radiance_tree.h"
#include "bake/environment/sky/test_sky.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE("radiance_tree: first moments are those about the rounded centre that a node stores") {
        // Rounding moves a centre by up to 3e-8, which a first moment about the exact centre would be off by.
        const Cube sky = label_sky(16);
        const RadianceTree tree(sky);
        for (int level = 1; level <= tree.last_level(); ++level)
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < tree.size(level); ++y)
                    for (int x = 0; x < tree.size(level); ++x) {
                        const SkyNode node = tree.node(level, face, x, y);
                        for (int c = 0; c < 3; ++c) {
                            Vec3d D(0);
                            double flux = 0;
                            for (int k = 0; k < 4; ++k) {
                                const SkyNode part = tree.node(level - 1, face, 2 * x + k % 2, 2 * y + k / 2);
                                D += Vec3d(part.D[c]) + double(part.F[c]) * (Vec3d(part.d) - Vec3d(node.d));
                                flux += double(part.F[c]);
                            }
                            // Half a float's step of D, whose size is at most that of the flux times the radius.
                            CHECK(glm::length(D - Vec3d(node.D[c])) <= 1e-7 * flux * double(node.rho));
                        }
                    }
    }
}
