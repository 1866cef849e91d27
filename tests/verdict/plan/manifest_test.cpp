// The list of bakes: what a plan needs, as TOML and back.
#include "bake/base/error.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/texture_form.h"
#include "cli/command.h"
#include "verdict/plan/hand_made_plan.h"

using namespace bake;
using namespace bake::test;

namespace {

/// A torus of the collection and shapes, with one material each.
struct Hall {
    Hall() {
        fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
        fs::copy_file(own_meshes() / "torus.obj", folder / "torus.obj");
        write_file(folder / "s.toml", R"([[material]]
name = "studs"
height = {file = "dots.png", amplitude = 0.125}
[[material]]
name = "rest"
height = {file = "dots.png", amplitude = "2%", midlevel = 0.25, filter = "c2", wrap = "repeat"}
[[mesh]]
name = "ring one"
file = "torus.obj"
material = "studs"
[[mesh]]
name = "ball"
shape = "sphere:R=2"
material = "studs"
[[mesh]]
name = "wheel"
file = "torus.obj"
material = "rest"
)");
        entries = read_scene(folder / "s.toml");
    }
    Manifest manifest(const std::string& ring, const std::string& ball, const std::string& wheel,
                      const std::string& out = "b.toml") {
        ScenePlan plan;
        plan.objects = {shown_by("ring one", ring, {0}), shown_by("ball", ball, {1}), shown_by("wheel", wheel, {2})};
        return plan_manifest(entries, plan, folder / out);
    }
    Folder folder;
    SceneEntries entries;
};

using Words = std::vector<std::string>;

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("manifest: models without files of their own need no bake") {
        CHECK(Hall().manifest("plain", "exact", "roughness").bakes.empty());
    }

    TEST_CASE("manifest: one table serves all objects with its height and amplitude") {
        const Manifest manifest = Hall().manifest("bump", "bump+roughness", "blinn");
        REQUIRE(manifest.bakes.size() == 1);
        const Bake& table = manifest.bakes[0];
        CHECK(command_of(table) == Words{"bump-table", "dots.png", "--amplitude=0.125", "--out=ring_one_bump.exr"});
        CHECK(table.objects == Words{"ring one", "ball"});
        CHECK(table.use == "bump");
        CHECK(table.after.empty());
    }

    TEST_CASE("manifest: a table has the amplitude that a per cent of the mesh is, the other commands the per cent") {
        Hall hall;
        const Manifest table = hall.manifest("plain", "plain", "bump");
        REQUIRE(table.bakes.size() == 1);
        const SceneEntries& entries = hall.entries;
        const Scene scene = load(entries);
        const double size = diagonal(bounds(scene.instances[0].shape->mesh));
        CHECK(std::stod(table.bakes[0].options[0].second) == doctest::Approx(0.02 * size).epsilon(1e-6));
        CHECK(table.bakes[0].options.size() == 2); // and the filter; a table has no midlevel
        const Manifest mesh = hall.manifest("plain", "plain", "displace:4");
        REQUIRE(mesh.bakes.size() == 1);
        CHECK(command_of(mesh.bakes[0]) == Words{"displace", "torus.obj", "--height=dots.png", "--levels=2",
                                                 "--amplitude=2%", "--midlevel=0.25", "--out=wheel_displaced.glb"});
        CHECK(mesh.bakes[0].use == "file");
    }

    TEST_CASE("manifest: a residual map stands behind its mesh, and the map of a shape behind the shape's file") {
        const Manifest manifest = Hall().manifest("displace+normal:8", "normal", "plain");
        REQUIRE(manifest.bakes.size() == 4);
        CHECK(manifest.bakes[0].name == "ring_one_displaced");
        CHECK(manifest.bakes[0].options[1] == std::pair<std::string, std::string>("seam", "average"));
        CHECK(manifest.bakes[1].after == Words{"ring_one_displaced"});
        CHECK(command_of(manifest.bakes[1]) == Words{"normal-map", "torus.obj", "--height=dots.png",
                                                     "--residual-of=ring_one_displaced.glb", "--amplitude=0.125",
                                                     "--out=ring_one_detail.png"});
        CHECK(manifest.bakes[2].verb == "surface");
        CHECK(manifest.bakes[2].use == "");
        CHECK(manifest.bakes[3].files == Words{"ball_surface.glb"});
        CHECK(manifest.bakes[3].after == Words{"ball_surface"});
    }

    TEST_CASE("manifest: baked maps have the bits that were decided for them") {
        Hall hall;
        ScenePlan plan;
        plan.objects = {shown_by("ring one", "normal", {0}), shown_by("ball", "bump", {1}),
                        shown_by("wheel", "normal", {2})};
        const auto decide = [&](const std::string& kind, int bits, bool half) {
            TexturePlan& texture = plan.textures.emplace_back(TexturePlan{.kind = kind, .bits = bits, .half = half});
            texture.meshes = {int(plan.textures.size()) - 1};
        };
        decide("normal", 8, false), decide("bump", 16, false), decide("normal", 16, false);
        const auto bakes = [&] { return plan_manifest(hall.entries, plan, hall.folder / "b.toml").bakes; };
        REQUIRE(bakes().size() == 3);
        CHECK(command_of(bakes()[0]) == Words{"normal-map", "torus.obj", "--height=dots.png", "--amplitude=0.125",
                                              "--depth=8", "--out=ring_one_normal.png"});
        CHECK(command_of(bakes()[1]) ==
              Words{"bump-table", "dots.png", "--amplitude=0.125", "--depth=16", "--out=ball_bump.png"});
        CHECK(bakes()[2].outputs[0].second == "wheel_normal.png");
        CHECK(bakes()[2].options.back().first != "depth");
        plan.textures[1].half = true;
        CHECK(command_of(bakes()[1]) == Words{"bump-table", "dots.png", "--amplitude=0.125", "--out=ball_bump.exr"});
    }

    TEST_CASE("manifest: maps in BC5 are textures, and a file of normals cannot be made one") {
        Hall hall;
        ScenePlan plan;
        plan.objects = {shown_by("ring one", "normal", {0}), shown_by("wheel", "displace+normal:8", {2})};
        for (const int mesh : {0, 2})
            plan.textures.push_back(
                {.kind = "normal", .width = 256, .height = 256, .channels = 2, .bits = bc5_bits, .meshes = {mesh}});
        plan.textures.push_back({.file = hall.folder / "n.png", .kind = "normal", .bits = bc5_bits, .materials = {0}});
        const Manifest manifest = plan_manifest(hall.entries, plan, hall.folder / "b.toml");
        REQUIRE(manifest.bakes.size() == 3);
        CHECK(command_of(manifest.bakes[0]) == Words{"normal-map", "torus.obj", "--height=dots.png",
                                                     "--amplitude=0.125", "--depth=bc5", "--out=ring_one_normal.ktx2"});
        CHECK(manifest.bakes[2].outputs[0].second == "wheel_detail.ktx2");
        plan.textures[0].width = plan.textures[0].height = 64;
        const auto skipped = [&] {
            const auto option = plan_manifest(hall.entries, plan, hall.folder / "b.toml").bakes[0].options.back();
            CHECK(option.first == "skip-mips");
            return option.second;
        };
        for (const int source : {256, 128, 64}) { // of the height, or of what "relief-size" leaves of it
            plan.textures[0].source_width = plan.textures[0].source_height = source;
            CHECK(skipped() == "2");
        }
        REQUIRE(manifest.notes.size() == 1);
        CHECK(manifest.notes[0].starts_with("n.png: no command stores a file of normals in BC5"));
    }

    TEST_CASE("manifest: maps of models that the scene has are baked if they were decided") {
        Hall hall;
        hall.entries.materials[0].relief.shade = ShadeMethod{Shade::normal};
        ScenePlan plan;
        plan.textures.push_back({.file = "ring one", .kind = "normal", .channels = 3, .bits = 8, .meshes = {0, 1}});
        const Manifest manifest = plan_manifest(hall.entries, plan, hall.folder / "b.toml");
        REQUIRE(manifest.bakes.size() == 3); // the ball's surface is one of them
        CHECK(manifest.bakes[0].name == "ring_one_normal");
        CHECK(manifest.bakes[0].options.back() == std::pair<std::string, std::string>("depth", "8"));
        plan.textures[0].meshes = {2}; // whose material has no model
        CHECK(plan_manifest(hall.entries, plan, hall.folder / "b.toml").bakes.empty());
    }

    TEST_CASE("manifest: paths are seen from its own folder") {
        Hall hall;
        fs::create_directory(hall.folder / "out");
        const Manifest manifest = hall.manifest("normal", "plain", "plain", "out/b.toml");
        REQUIRE(manifest.bakes.size() == 1);
        CHECK(manifest.bakes[0].files == Words{"../torus.obj"});
        CHECK(manifest.bakes[0].inputs[0].second == "../dots.png");
        CHECK(manifest.bakes[0].outputs[0].second == "ring_one_normal.png");
    }

    TEST_CASE("manifest: what no command bakes is told") {
        Hall hall;
        hall.entries.meshes[0].repeat = Vec2f(2);
        const Manifest manifest = hall.manifest("displace:4", "plain", "plain");
        CHECK(manifest.bakes.empty());
        REQUIRE(manifest.notes.size() == 1);
        CHECK(manifest.notes[0].starts_with("ring one: no command bakes its displace:4: its uvs repeat"));
        CHECK(hall.manifest("bump", "plain", "plain").bakes.size() == 1);
    }

    TEST_CASE("manifest: smaller faces of a sky are a bake, and what no command makes of it is told") {
        Hall hall;
        hall.entries.sky.image = hall.folder / "forest_%s.png";
        const auto manifest = [&](const std::string& model, int face) {
            ScenePlan plan;
            plan.sky = SkyPlan{.model = model, .face = face, .source_face = 64};
            return plan_manifest(hall.entries, plan, hall.folder / "b.toml");
        };
        const Manifest smaller = manifest("faces", 16);
        REQUIRE(smaller.bakes.size() == 1);
        CHECK(command_of(smaller.bakes[0]) ==
              Words{"cubemap", "forest_%s.png", "--size=16", "--samples=exact", "--out=sky_16_%s.exr"});
        CHECK(smaller.bakes[0].use == "faces");
        CHECK(manifest("faces", 64).bakes.empty());
        CHECK(manifest("faces", 64).notes.empty());
        const auto told = [&](const Manifest& none, const std::string& why) {
            CHECK(none.bakes.empty());
            REQUIRE(none.notes.size() == 1);
            CHECK(none.notes[0].starts_with(why));
        };
        told(manifest("sh:3", 32), "sky: no command bakes its harmonics: ");
        told(manifest("constant", 1), "sky: no command bakes its mean: ");
        hall.entries.sky.image = hall.folder / "{a}.exr";
        told(manifest("faces", 16), "sky: no command bakes its smaller faces: the characters *?{}");
        hall.entries.sky.image = "";
        // The words say other faces than the places in the list.
        hall.entries.sky.faces = {"nx.png", "px.png", "py.png", "ny.png", "pz.png", "nz.png"};
        told(manifest("faces", 16), "sky: no command bakes its smaller faces: its files are named like other faces");
    }

    TEST_CASE("manifest: TOML and back is the same") {
        Manifest manifest = Hall().manifest("displace+normal:8", "normal", "bump");
        manifest.bakes[0].options.emplace_back("flip-v", "");
        manifest.bakes[0].options.emplace_back("alpha", "-1 \"x\"\\");
        manifest.bakes[0].tiles = {1001, 1012};
        const std::string text = to_toml(manifest);
        CHECK(text.find("tiles = [1001, 1012]") != std::string::npos);
        CHECK(to_toml(parse_manifest(text, "b.toml")) == text);
    }

    TEST_CASE("manifest: numbers are values too") {
        const Manifest manifest =
            parse_manifest("manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"displace\"\n"
                           "options = {levels = 4, amplitude = 0.1, audit = true}\noutputs = {out = \"a.ply\"}\n",
                           "b.toml");
        CHECK(command_of(manifest.bakes[0]) ==
              Words{"displace", "--levels=4", "--amplitude=0.10000000000000001", "--audit", "--out=a.ply"});
    }

    TEST_CASE("manifest: what is no manifest is refused with its line") {
        const std::string good =
            "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"render\"\noutputs = {out = \"a.png\"}\n";
        CHECK_NOTHROW(parse_manifest(good, "b.toml"));
        const auto refused = [](const std::string& text, const std::string& named) {
            CHECK_THROWS_WITH_AS(parse_manifest(text, "b.toml"), doctest::Contains(("b.toml:" + named).c_str()), Error);
        };
        refused("", "1: is no manifest");
        refused("manifest = 2\n", "1: \"manifest\" is not 1");
        refused("manifest = \"1\"\n", "1: \"manifest\" is not 1");
        refused("manifest = [\n", "1: ");
        refused(good + "file = \"x\"\n", "6: \"file\" is not a key");
        refused(good + "tiles = [1000]\n", "6: \"tiles\" are UDIM numbers");
        refused(good + "tiles = []\n", "6: \"tiles\" is no list");
        refused(good + "afer = []\n", "6: \"afer\" is not a key of a manifest; did you mean \"after\"?");
        refused(good + "options = {\"--levels\" = \"1\"}\n", "6: \"--levels\" is not the name of an option");
        refused(good + "options = {audit = false}\n", "6: \"audit\" is not a string");
        refused(good + "after = [\"b\"]\n", "6: \"after\" names \"b\"");
        refused(good + "[[bake]]\nname = \"a\"\nverb = \"x\"\noutputs = {out = \"b\"}\n", "7: \"name\" \"a\" is used");
        refused("manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"x\"\n", "2: [[bake]] has no \"outputs\"");
        refused("manifest = 1\n[bake]\nname = \"a\"\n", "2: \"bake\" is a list of tables");
    }
}
