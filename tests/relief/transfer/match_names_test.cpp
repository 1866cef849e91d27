// Parts of high-poly meshes and parts of a low-poly mesh, by name.
#include "bake/base/error.h"
#include "bake/relief/transfer/match_names.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// One triangle for each name; an empty name: a face without a group.
Mesh triangles_of_groups(const std::vector<std::string>& names) {
    Mesh mesh;
    for (const std::string& name : names) {
        const auto first = std::uint32_t(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)});
        mesh.corner_position.insert(mesh.corner_position.end(), {first, first + 1, first + 2});
        mesh.face_begin.push_back(first + 3);
        mesh.face_group.push_back(name.empty() ? no_index : std::uint32_t(mesh.groups.size()));
        if (!name.empty()) mesh.groups.push_back(name);
    }
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("match_names: the key of a part is its name without low and high") {
        CHECK(part_key("low_wheel") == "wheel");
        CHECK(part_key("Wheel_HIGH") == "wheel");
        CHECK(part_key("wheel.lp") == "wheel");
        CHECK(part_key("hp-wheel") == "wheel");
        CHECK(part_key("wheel") == "wheel");
        CHECK(part_key("lowland") == "lowland"); // a word of its own
        CHECK(part_key("low_") == "low_");
        CHECK(part_key("High") == ""); // low.obj and high.ply
    }

    TEST_CASE("match_names: parts of one name, with what hangs on them, and those that are alone") {
        std::vector<HighMesh> high;
        high.push_back({triangles_of_groups({"high_body", "high_body_bolts", "high_flag"}), "a.ply"});
        high.push_back({triangles_of_groups({"high_wheel", "high_wheel_left"}), "b.ply"});
        const NameMatch match = match_names(
            triangles_of_groups({"low_wheel", "low_body", "low_glass", "low_wheel_left"}), "low.obj", std::move(high));
        REQUIRE(match.names == std::vector<std::string>{"body", "wheel", "wheel_left"});
        CHECK(match.of_face == std::vector<std::uint32_t>{1, 0, no_index, 2});
        CHECK(match.low_alone == std::vector<std::string>{"low_glass"});
        CHECK(match.high_alone == std::vector<std::string>{"high_flag"});
        REQUIRE(match.high[0].size() == 2); // the body and its bolts
        CHECK(match.high[0][0].mesh.faces() == 1);
        CHECK(match.high[1].size() == 1); // the left wheel has a part of its own
        CHECK(match.high[2][0].name == "b.ply");
    }

    TEST_CASE("match_names: without a group the material names a part, without both the file") {
        Mesh low = triangles_of_groups({"", ""});
        low.materials = {"steel"}, low.face_material = {0, no_index};
        std::vector<HighMesh> high;
        high.push_back({triangles_of_groups({"steel_high"}), "x.ply"});
        high.push_back({triangles_of_groups({""}), "folder/crate_high.ply"});
        const NameMatch match = match_names(low, "folder/crate_low.obj", std::move(high));
        CHECK(match.names == std::vector<std::string>{"crate", "steel"});
        CHECK(match.of_face == std::vector<std::uint32_t>{1, 0});
    }
}

TEST_SUITE("stability") {

    TEST_CASE("match_names: names that match nothing are refused, with some of both") {
        std::vector<HighMesh> high;
        high.push_back({triangles_of_groups({"stone"}), "high.ply"});
        try {
            match_names(triangles_of_groups({"low_wheel"}), "low.obj", std::move(high));
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).find("low.obj: no part has the name") == 0);
            CHECK(std::string(error.what()).find("low_wheel against stone") != std::string::npos);
        }
    }
}
