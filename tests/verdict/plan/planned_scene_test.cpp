// A scene file with the models of a plan: what changes, and what stays.
#include "bake/base/error.h"
#include "verdict/plan/planned_round.h"

using namespace bake;
using namespace bake::test;

namespace {

/// Three meshes and an instance with one material, and the ground with it too.
const std::string shared = R"(# A hall.
[[material]] # of all
  name = "studs" # é
  height = {file = "dots.png", amplitude = 0.1} # the relief
  diffuse = 0.5

[[mesh]]
name = "ring"
shape = "torus"
material = "studs" # here

[[mesh]]
name = "ball"
shape = "sphere"
material = 'studs'

[[mesh]]
name = "post"
shape = "cylinder"
material = "studs"

[[instance]] # another ring
mesh = "ring"
)";

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("planned_scene: a plan without decisions leaves every byte") {
        Round round(shared);
        CHECK(round.planned() == shared);
    }

    TEST_CASE("planned_scene: one model for all is one line more, behind the height and indented like it") {
        Round round(shared);
        round.plan.objects = {shown_by("all", "bump", {0, 1, 2, 3})};
        CHECK(new_lines(shared, round.planned()) == "  shade = \"bump\"\n");
        CHECK(round.shades() == std::vector<std::string>{"bump", "bump", "bump", "bump"});
    }

    TEST_CASE("planned_scene: an older model is replaced where it stands, and its comment stays") {
        Round round("[[material]]\nname = \"studs\"\nshade = 'plain' # as it was\nheight = \"dots.png\"\n"
                    "[[mesh]]\nshape = \"torus\"\nmaterial = \"studs\"\n");
        round.plan.objects = {shown_by("torus", "displace+normal:8", {0})};
        CHECK(has(round.planned(), "shade = \"displace+normal:8\" # as it was\nheight"));
        CHECK(round.shades() == std::vector<std::string>{"displace+normal:8"});
    }

    TEST_CASE("planned_scene: meshes with different models get copies of their material, and instances too") {
        Round round(shared);
        round.plan.objects = {shown_by("ring", "bump", {0}), shown_by("ball", "normal", {1}),
                              shown_by("post", "bump", {2}), shown_by("again", "plain", {3})};
        const std::string text = round.planned();
        CHECK(round.shades() == std::vector<std::string>{"bump", "normal", "bump", "plain"});
        const SceneEntries made = planned_entries(round.entries, round.plan);
        for (std::size_t i = 0; i < made.meshes.size(); ++i)
            CHECK(name(*made.materials[std::size_t(made.meshes[i].material)].relief.shade) == round.shades()[i]);
        CHECK(round.read.materials.size() == 3);
        for (const char* line :
             {"name = \"studs\" # é", "name = \"studs normal\" # é", "material = \"studs normal\"\n",
              "material = \"studs\" # here", "mesh = \"ring\"\nmaterial = \"studs plain\"\n", "[[material]] # of all"})
            CHECK_MESSAGE(has(text, line), line);
        for (const MaterialEntry& material : round.read.materials) {
            CHECK(material.relief.file == round.folder / "dots.png");
            CHECK(material.relief.amplitude == 0.1f);
            CHECK(material.reflectance.diffuse == Vec3f(0.5f));
        }
    }

    TEST_CASE("planned_scene: what is not decided keeps its material, and so does the ground") {
        Round round(shared + "[ground]\nmaterial = \"studs\"\n");
        round.plan.objects = {shown_by("ring", "bump", {0, 3})};
        round.planned();
        CHECK(round.shades() == std::vector<std::string>{"bump", "exact", "exact", "bump"});
        CHECK(round.read.materials[std::size_t(round.read.ground->material)].name == "studs");
        CHECK_FALSE(round.read.materials[std::size_t(round.read.ground->material)].relief.shade);
    }

    TEST_CASE("planned_scene: the ground alone, or one undecided mesh, keeps the material as the file has it") {
        Round ground(shared + "[ground]\nmaterial = \"studs\"\n");
        ground.plan.objects = {shown_by("all", "bump", {0, 1, 2, 3})};
        ground.planned();
        CHECK(ground.shades() == std::vector<std::string>{"bump", "bump", "bump", "bump"});
        CHECK_FALSE(ground.read.materials[std::size_t(ground.read.ground->material)].relief.shade);
        Round mesh(shared);
        mesh.plan.objects = {shown_by("ring", "bump", {0, 3}), shown_by("ball", "bump", {1})};
        mesh.planned();
        CHECK(mesh.read.materials[std::size_t(mesh.read.meshes[2].material)].name == "studs");
        CHECK_FALSE(mesh.read.materials[0].relief.shade);
    }

    TEST_CASE("planned_scene: nothing chosen is the reference") {
        Round round(shared);
        round.plan.objects = {shown_by("ring", "bump", {0})};
        round.plan.objects[0].chosen = -1;
        round.planned();
        CHECK(round.shades()[0] == "displace:64");
    }

    TEST_CASE("planned_scene: tables within braces, keys with dots, tables of their own and lines of both kinds") {
        Round braces("material = [{name = \"a\", height = \"dots.png\"}, {name = \"b\"}]\n"
                     "mesh = [{shape = \"torus\", material = \"a\"}, {shape = \"sphere\", material = \"a\"}]\n");
        braces.plan.objects = {shown_by("torus", "bump", {0}), shown_by("sphere", "blinn", {1})};
        braces.planned();
        CHECK(braces.shades() == std::vector<std::string>{"bump", "blinn"});
        CHECK(braces.read.materials.size() == 3);

        Round dots("[[material]]\r\nname = \"a\"\r\nheight.file = \"dots.png\"\r\nheight.amplitude = 2\r\n"
                   "[[mesh]]\r\nshape = \"torus\"\r\nmaterial = \"a\"\r\n"
                   "[[mesh]]\r\nshape = \"sphere\"\r\nmaterial = \"a\"");
        dots.plan.objects = {shown_by("torus", "bump", {0}), shown_by("sphere", "blinn", {1})};
        CHECK_FALSE(has(dots.planned().substr(1), "e\n"));
        CHECK(dots.shades() == std::vector<std::string>{"bump", "blinn"});
        CHECK(dots.read.materials[1].relief.amplitude == 2.0f);

        Round table("[[material]]\nname = \"a\"\n[material.height]\nfile = \"dots.png\"\n\n"
                    "[[mesh]]\nshape = \"torus\"\nmaterial = \"a\"\n[[mesh]]\nshape = \"sphere\"\nmaterial = \"a\"\n");
        table.plan.objects = {shown_by("torus", "bump", {0}), shown_by("sphere", "blinn", {1})};
        table.planned();
        CHECK(table.shades() == std::vector<std::string>{"bump", "blinn"});
        CHECK(table.read.materials[1].relief.file == table.folder / "dots.png");
    }

    TEST_CASE("planned_scene: a material whose keys stand apart cannot be copied, and the line is named") {
        Round round("[[material]]\nname = \"a\"\n[ground]\nsize = 1\n[material.height]\nfile = \"dots.png\"\n"
                    "[[mesh]]\nshape = \"torus\"\nmaterial = \"a\"\n[[mesh]]\nshape = \"sphere\"\nmaterial = \"a\"\n");
        round.plan.objects = {shown_by("all", "bump", {0, 1})};
        CHECK_NOTHROW(round.planned());
        round.plan.objects = {shown_by("torus", "bump", {0}), shown_by("sphere", "blinn", {1})};
        CHECK_THROWS_WITH_AS(round.planned(), doctest::Contains("s.toml:1: the keys of this material stand apart"),
                             Error);
    }

    TEST_CASE("planned_scene: in another folder, relative paths name the same files, and absolute ones stay") {
        Round round("[sky]\nfaces = \"../sky_%s.png\"\n"
                    "[[material]]\nname = \"a\"\nalbedo = \"maps/c.png\"\nheight = {file = \"dots.png\"}\n"
                    "[[material]]\nname = \"b\"\nheight = \"/far/dots.png\"\n"
                    "[[mesh]]\nfile = \"m.obj\"\nmaterial = \"a\"\n[[mesh]]\nshape = \"torus:R=2\"\n");
        fs::create_directories(round.folder / "out/deep");
        round.planned("out/deep/p.toml");
        CHECK(round.read.sky.image == round.entries.sky.image);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(round.read.materials[i].albedo == round.entries.materials[i].albedo);
            CHECK(round.read.materials[i].relief.file == round.entries.materials[i].relief.file);
            CHECK(round.read.meshes[i].file == round.entries.meshes[i].file);
            CHECK(round.read.meshes[i].shape == round.entries.meshes[i].shape);
        }
        CHECK(has(contents(round.folder / "out/deep/p.toml"), "albedo = \"../../maps/c.png\""));
        CHECK(has(contents(round.folder / "out/deep/p.toml"), "height = \"/far/dots.png\""));
    }
}
