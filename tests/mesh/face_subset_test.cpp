#include "bake/mesh/face_subset.h"
#include "mesh/gltf/gltf_files.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("face_subset: corners have the values that they had, and nothing is kept that no corner has") {
        const Mesh mesh = bake_tests::rich_triangles(4, 2);
        const std::vector<std::vector<std::uint32_t>> faces = faces_by_material(mesh);
        REQUIRE(faces.size() == 3);
        CHECK(faces[2].empty());
        std::size_t total = 0;
        for (const std::size_t material : {0, 1}) {
            const Mesh part = face_subset(mesh, faces[material]);
            total += part.faces();
            REQUIRE(part.faces() == faces[material].size());
            CHECK(part.positions.size() < mesh.positions.size());
            for (std::size_t f = 0; f < part.faces(); ++f)
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = part.face_begin[f] + k, b = mesh.face_begin[faces[material][f]] + k;
                    CHECK(part.positions[part.corner_position[a]] == mesh.positions[mesh.corner_position[b]]);
                    CHECK(part.normals[part.corner_normal[a]] == mesh.normals[mesh.corner_normal[b]]);
                    CHECK(part.uvs[part.corner_uv[a]] == mesh.uvs[mesh.corner_uv[b]]);
                    CHECK(part.tangents[a] == mesh.tangents[b]);
                    CHECK(part.attributes[1].values[2 * a + 1] == mesh.attributes[1].values[2 * b + 1]);
                    CHECK(part.face_material[f] == material);
                }
        }
        CHECK(total == mesh.faces());
    }

    TEST_CASE("face_subset: all faces, none, and a mesh without materials") {
        Mesh mesh = bake_tests::rich_triangles(2, 1);
        CHECK(face_subset(mesh, {}).faces() == 0);
        CHECK(face_subset(mesh, {}).positions.empty());
        mesh.face_material.clear();
        const auto faces = faces_by_material(mesh);
        CHECK(faces.back().size() == mesh.faces());
        CHECK(face_subset(mesh, faces.back()).positions.size() == mesh.positions.size());
    }

} // TEST_SUITE
