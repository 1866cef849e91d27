#include "bake/mesh/gltf/material.h"
#include "mesh/gltf/gltf_files.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("glTF materials: the extensions that are read survive writing, and are named as used") {
        const bake_tests::TemporaryFolder folder;
        Gltf gltf;
        gltf.mesh = bake_tests::rich_triangles(2, 2);
        gltf.materials = {{.name = "brick"}, {.name = "plaster"}};
        gltf.materials[0].emissive_factor = Vec3f(1, 0.5f, 0), gltf.materials[0].emissive_strength = 6.5f;
        gltf.materials[1].unlit = true;
        gltf.nodes = {{.name = "n", .first_face = 0, .end_face = gltf.mesh.faces()}};
        write_gltf(folder.file("a.gltf"), gltf);
        CHECK(read_gltf(folder.file("a.gltf")).materials == gltf.materials);
        const std::string text = bake_tests::bytes_of(folder.file("a.gltf"));
        const std::string used = text.substr(text.find("extensionsUsed"), 120);
        CHECK(used.find("KHR_materials_emissive_strength") != std::string::npos);
        CHECK(used.find("KHR_materials_unlit") != std::string::npos);
    }

    TEST_CASE("glTF materials: one of which only the name is known is written as diffuse, not as the format's metal") {
        const bake_tests::TemporaryFolder folder;
        Gltf gltf;
        gltf.mesh = bake_tests::rich_triangles(2, 2);
        REQUIRE(!gltf.mesh.materials.empty());
        write_gltf(folder.file("a.gltf"), gltf);
        const std::vector<GltfMaterial> back = read_gltf(folder.file("a.gltf")).materials;
        CHECK(back.size() == gltf.mesh.materials.size());
        for (const GltfMaterial& material : back) CHECK(material.metallic == 0);
    }

    TEST_CASE("has_gltf_materials: by the list alone") {
        const bake_tests::TemporaryFolder folder;
        const auto has = [&](const std::string& members) {
            return has_gltf_materials(folder.write("a.gltf", R"({"asset":{"version":"2.0"})" + members + "}"));
        };
        CHECK(!has(""));
        CHECK(!has(R"(,"materials":[])"));
        CHECK(!has(R"(,"nodes":[{"name":"\"materials\""}])"));
        CHECK(has(R"(,"materials":[{}])"));
    }

} // TEST_SUITE
