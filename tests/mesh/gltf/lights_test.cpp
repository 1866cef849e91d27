#include "bake/base/error.h"
#include "bake/mesh/gltf/lights.h"
#include "cli/command.h"
#include <doctest/doctest.h>

using namespace bake;
using bake::test::Folder;

namespace {

struct Read {
    std::vector<GltfLight> lights;
    std::vector<std::string> notes;
};

Read read(const std::string& lights, const std::string& nodes, const std::string& more = "") {
    const Folder folder;
    test::write_file(folder / "a.gltf",
                     R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[)" + lights +
                         R"(]}},"nodes":[)" + nodes + "]" + more + "}");
    Read out;
    out.lights = read_gltf_lights(folder / "a.gltf", out.notes);
    return out;
}

std::string node(int light, const std::string& more = "") {
    return R"({"extensions":{"KHR_lights_punctual":{"light":)" + std::to_string(light) + "}}" + more + "}";
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("read_gltf_lights: kind, colour, range and cones, with the format's defaults") {
        const Read all = read(R"({"type":"point","name":"p","color":[0.5,1,0],"intensity":7,"range":3},)"
                              R"({"type":"spot","spot":{"innerConeAngle":0.1}},{"type":"directional"})",
                              node(0) + "," + node(1) + "," + node(2));
        REQUIRE(all.lights.size() == 3);
        CHECK(all.notes.empty());
        CHECK(all.lights[0].type == GltfLight::Type::point);
        CHECK(all.lights[0].name == "p");
        CHECK(all.lights[0].colour == Vec3f(0.5f, 1, 0));
        CHECK(all.lights[0].intensity == 7);
        CHECK(all.lights[0].range == 3);
        CHECK(all.lights[1].inner == 0.1);
        CHECK(all.lights[1].outer == doctest::Approx(pi / 4));
        CHECK(std::isinf(all.lights[1].range));
        CHECK(all.lights[2].intensity == 1);
        CHECK(all.lights[2].direction == Vec3d(0, 0, -1));
    }

    TEST_CASE("read_gltf_lights: placed by the nodes of the scene that is shown, unless hidden") {
        const std::string turned =
            R"(,"rotation":[-0.70710678118654752,0,0,0.70710678118654752],"translation":[1,2,3])";
        const Read all =
            read(R"({"type":"spot"})",
                 R"({"children":[1],"translation":[0,10,0]},)" + node(0, turned) + "," + node(0) + "," +
                     R"({"extensions":{"KHR_lights_punctual":{"light":0},"KHR_node_visibility":{"visible":false}}})",
                 R"(,"scene":0,"scenes":[{"nodes":[0,3]}])");
        REQUIRE(all.lights.size() == 1);
        CHECK(all.lights[0].position == Vec3d(1, 12, 3));
        CHECK(glm::length(all.lights[0].direction - Vec3d(0, -1, 0)) < 1e-12);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("read_gltf_lights: lights that are not valid are left out, with a note") {
        for (const std::string light : {R"({})", R"({"type":"area"})", R"({"type":"point","intensity":-1})",
                                        R"({"type":"point","intensity":"high"})",
                                        R"({"type":"point","intensity":1e300})", R"({"type":"point","color":[1,2]})",
                                        R"({"type":"point","color":[1,-1,0]})", R"({"type":"point","range":0})", R"(7)",
                                        R"({"type":"spot","spot":{"innerConeAngle":0.8,"outerConeAngle":0.5}})",
                                        R"({"type":"spot","spot":{"outerConeAngle":9}})"}) {
            CAPTURE(light);
            const Read one = read(light, node(0));
            CHECK(one.lights.empty());
            REQUIRE(one.notes.size() == 1);
            CHECK(one.notes[0].find("light 0 is not as KHR_lights_punctual asks") == 0);
        }
        CHECK(read(R"({"type":"point"})", node(3)).notes.size() == 1);
        CHECK(read(R"({"type":"spot"})", node(0, R"(,"scale":[0,0,0])")).notes.size() == 1);
        CHECK(read(R"({"type":"point"})", node(0, R"(,"translation":[1e20,0,0])")).lights.empty());
    }

    TEST_CASE("read_gltf_lights: nodes that are no nodes are refused") {
        const std::vector<std::string> faults = {R"({"children":["a"]})", R"({"children":[7]})",
                                                 R"({"translation":["a",0,0]})",
                                                 node(0, R"(,"translation":[1e300,0,0])")};
        for (const std::string& nodes : faults) {
            CAPTURE(nodes);
            bool refused = false;
            try {
                read(R"({"type":"point"})", nodes);
            } catch (const Error& error) {
                refused = true;
                CHECK(error.refusal == Refusal::unreadable);
            }
            CHECK(refused);
        }
    }

} // TEST_SUITE
