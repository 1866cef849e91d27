// The sky that a plan chose: the scene file with it, and its picture.
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/sky_plan.h"
#include "verdict/plan/planned_round.h"

using namespace bake;
using namespace bake::test;

namespace {

const std::string under_sky = R"([render]
size = [24, 16]
spp = 2
exposure = 0

[sky] # clouds
faces = "sky_%s.png"
yaw-deg = 20

[[material]]
name = "steel"
reflect = 0.5

[[mesh]]
shape = "sphere:R=1"
segments = [12, 6]
material = "steel"
)";

SkyPlan planned(const std::string& model, int face) { return {.model = model, .face = face, .source_face = 192}; }

/// The lines that the plan adds. The picture of the file is that of the scene with the sky that the plan judged.
std::string added(const std::string& text, const SkyPlan& sky) {
    Round round(text);
    copy_sky(round);
    round.plan.sky = sky;
    const std::string with = round.planned();
    check_same_picture(round);
    Scene judged = load(round.entries);
    set_sky(judged, reduced(copied(judged.sky.cube), reduction_of(sky)));
    CHECK(largest_difference(picture_of(judged), picture_of(load(round.read))) < 1e-6f);
    return new_lines(text, with);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("planned sky: smaller faces, a series and a constant") {
        CHECK(added(under_sky, planned("faces", 16)) == "face-size = 16\n");
        CHECK(added(under_sky, planned("sh:3", 32)) == "sh-bands = 3\n");
        CHECK(added(under_sky, planned("constant", 1)) == "sh-bands = 1\n");
        CHECK(added(under_sky, planned("faces", 192)) == "");
    }

    TEST_CASE("planned sky: light from filtered levels is that of the planned sky") {
        std::string text = under_sky;
        text.insert(text.find("spp"), "sky-light = \"irradiance\"\n");
        text.insert(text.find("yaw-deg"), "face-size = 32\n"); // smaller levels to filter
        CHECK(added(text, planned("faces", 16)) == "face-size = 16\n");
    }

    TEST_CASE("planned sky: an older size is replaced, and faces stay fine enough for a series") {
        std::string text = under_sky;
        text.insert(text.find("yaw-deg"), "face-size = 24 # as it was\n");
        Round round(text);
        copy_sky(round);
        round.plan.sky = planned("faces", 8);
        CHECK(has(round.planned(), "face-size = 8 # as it was\n"));
        check_same_picture(round);
        round.plan.sky = planned("sh:3", 32);
        CHECK(has(round.planned(), "[sky] # clouds\nsh-bands = 3\n"));
        CHECK(round.read.sky.reduction.face_size == 32);
        check_same_picture(round);
    }
}
