// Lights and shadows that a plan leaves out: the scene file without them, and its picture.
#include "bake/base/error.h"
#include "verdict/plan/planned_round.h"
#include <cmath>

using namespace bake;
using namespace bake::test;

namespace {

const std::string three_lights = R"(# A ball.
[render]
size = [24, 16]
spp = 2
exposure = 0

[sky]
faces = "sky_%s.png"

[[light]] # a fill
type = "ambient"
colour = 0.1

# The sun.
[[light]]
type = "directional" # far
from = [-1, 1, 1]

[[light]] # behind
type = "point"
position = [0, 0, -9]
ambient = 0.25
intensity = 2

[[light]]
type = "quad"
position = [0, 9, 0]
direction = [0, 1, 0]

[[mesh]]
shape = "sphere:R=1"
segments = [12, 6]
)";

std::vector<LightPlan> lights(const std::vector<bool>& keep, bool shadows) {
    std::vector<LightPlan> plans;
    for (std::size_t i = 0; i < keep.size(); ++i)
        plans.push_back({.light = int(i), .keep = keep[i], .shadows = shadows});
    return plans;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("planned lights: one that is left out goes with its keys, and all else stays") {
        Round round(three_lights);
        copy_sky(round);
        round.plan.lights = lights({false, true, false}, true);
        std::string expected = three_lights;
        for (const std::string part : {"[[light]]\ntype = \"directional\" # far\nfrom = [-1, 1, 1]\n",
                                       "[[light]]\ntype = \"quad\"\nposition = [0, 9, 0]\ndirection = [0, 1, 0]\n\n"}) {
            REQUIRE(has(expected, part));
            expected.erase(expected.find(part), part.size());
        }
        CHECK(round.planned() == expected);
        CHECK(not_in_scene(round.entries, round.plan).empty());
        check_same_picture(round);
    }

    TEST_CASE("planned lights: the ambient part of one that is left out stays") {
        Round round(three_lights);
        copy_sky(round);
        round.plan.lights = lights({true, false, true}, true);
        CHECK(has(round.planned(),
                  "[[light]]\ntype = \"ambient\"\ncolour = [0.5, 0.5, 0.5]\n\n[[light]]\ntype = \"quad\""));
        CHECK(round.read.ambient == round.entries.ambient);
        CHECK(round.read.lights.size() == 2);
        check_same_picture(round);
    }

    TEST_CASE("planned lights: none, and no shadows") {
        Round round(three_lights);
        copy_sky(round);
        round.plan.lights = lights({false, false, false}, false);
        CHECK(has(round.planned(), "[render]\nshadows = false\nsize"));
        CHECK(round.read.lights.empty());
        CHECK_FALSE(round.read.settings.shadows);
        check_same_picture(round);
    }

    TEST_CASE("planned lights: shadows are switched off in each way to write a table") {
        const std::string rest = "[[light]]\ntype = \"directional\"\nfrom = [0, 1, 0]\n[[mesh]]\nshape = \"sphere\"\n";
        const auto planned = [&](const std::string& render) {
            Round round(render + rest);
            round.plan.lights = lights({true}, false);
            const std::string text = round.planned();
            CHECK_FALSE(round.read.settings.shadows);
            CHECK(round.read.lights.size() == 1);
            return text;
        };
        CHECK(planned("") == rest + "\n[render]\nshadows = false\n");
        CHECK(planned("[render] # fast\n") == "[render] # fast\nshadows = false\n" + rest);
        CHECK(planned("[render]\r\nspp = 2\r\n") == "[render]\r\nshadows = false\r\nspp = 2\r\n" + rest);
        CHECK(planned("[render]\nshadows = true # soft\n") == "[render]\nshadows = false # soft\n" + rest);
        CHECK(planned("render = {spp = 2}\n") == "render = {spp = 2, shadows = false}\n" + rest);
        CHECK(planned("render = {}\n") == "render = {shadows = false}\n" + rest);
        CHECK(planned("render.spp = 2\n") == "render.spp = 2\nrender.shadows = false\n" + rest);
        CHECK(planned("[render]\nshadows = false\n") == "[render]\nshadows = false\n" + rest);
    }

    TEST_CASE("planned lights: in a list within brackets, and several in a row") {
        const std::string a = "{type = \"directional\", from = [0, 1, 0]}",
                          b = "{type = \"directional\", from = [1, 0, 0]}";
        const std::string mesh = "mesh = [{shape = \"sphere\"}]\n";
        const auto planned = [&](const std::string& list, const std::vector<bool>& keep) {
            Round round("light = [" + list + "]\n" + mesh);
            round.plan.lights = lights(keep, true);
            const std::string text = round.planned();
            CHECK(round.read.lights.size() == std::size_t(std::count(keep.begin(), keep.end(), true)));
            return text;
        };
        CHECK(planned(a + ", " + b, {false, true}) == "light = [ " + b + "]\n" + mesh);
        CHECK(planned(a + ", # one\n" + b + " # two\n", {true, false}) ==
              "light = [" + a + ", # one\n # two\n]\n" + mesh);
        CHECK(planned(a + ", " + b, {false, false}) == "light = [ ]\n" + mesh);
        // Comments before the comma stay, the comma does not.
        CHECK(planned(a + " # one,\n # more\n , " + b, {false, true}) ==
              "light = [ # one,\n # more\n  " + b + "]\n" + mesh);

        const std::string light = "[[light]]\ntype = \"directional\"\nfrom = [0, 1, 0]\n\n";
        Round round("[ground]\n\n" + light + light + light + "[[mesh]]\nshape = \"sphere\"");
        round.plan.lights = lights({false, false, true}, true);
        CHECK(round.planned() == "[ground]\n\n" + light + "[[mesh]]\nshape = \"sphere\"");
    }

    TEST_CASE("planned lights: a file that has other lights by now is refused") {
        Round round(three_lights);
        round.plan.lights = lights({false, true, true}, true);
        round.text += "[[light]]\ntype = \"directional\"\nfrom = [0, 1, 0]\n";
        CHECK_THROWS_WITH_AS(round.planned(), doctest::Contains("changed while it was planned"), Error);
    }

    TEST_CASE("planned lights: those of a glTF file stay, with a note") {
        Round round("[[mesh]]\nshape = \"sphere\"\n");
        round.plan.lights = lights({false}, true);
        CHECK(round.planned() == round.text);
        const std::vector<std::string> notes = not_in_scene(round.entries, round.plan);
        REQUIRE(notes.size() == 1);
        CHECK(notes[0] == "keeps light 1, which is of a glTF file");
    }
}
