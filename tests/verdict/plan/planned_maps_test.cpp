// Maps of the sizes that a plan chose: the scene file with them, and its picture.
#include "bake/picture/image_io.h"
#include "bake/verdict/plan/plan_parts.h"
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/texture_form.h"
#include "verdict/plan/planned_round.h"
#include "verdict/plan/planned_texture.h"

using namespace bake;
using namespace bake::test;

namespace {

const std::string two_balls = R"([render]
size = [24, 16]
spp = 2
exposure = 0

[[light]]
type = "directional"
from = [-1, 1, 1]

[[material]]
name = "studs"
albedo = "dots_normal.png"
height = {file = "dots.png", amplitude = 0.05} # the relief
shade = "normal"

[[material]]
name = "paint"
albedo = "dots_normal.png" # the same

[[mesh]]
name = "left"
shape = "sphere:R=1"
segments = [12, 6]
material = "studs"
translate = [-1, 0, 0]

[[mesh]]
name = "right"
shape = "torus:R=0.6,r=0.3"
segments = [12, 6]
material = "studs"
translate = [1, 0, 0]

[[mesh]]
shape = "plane"
material = "paint"
translate = [0, -1, 0]
)";

struct Balls : Round {
    explicit Balls(const std::string& file_text = two_balls) : Round(file_text) {
        for (const char* file : {"dots.png", "dots_normal.png"}) fs::copy_file(own_meshes() / file, folder / file);
        const Scene scene = load(entries);
        textures = scene_textures(scene, &entries);
        PartOptions options;
        options.budget = 10; // the smallest form of each
        plan.textures = plan_textures(scene, &entries, options);
    }
    TexturePlan& planned_map(const std::string& file) {
        for (TexturePlan& texture : plan.textures)
            if (texture.file.ends_with(file)) return texture;
        FAIL(file);
        return plan.textures.front();
    }
    void set(const std::string& file, int size) {
        TexturePlan& texture = planned_map(file);
        texture.width = texture.height = size;
        texture.channels = 3, texture.bits = 16, texture.half = false;
    }
    std::vector<SceneTexture> textures;
};

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("planned maps: a texture knows its materials, or the meshes that it is baked for") {
        Balls round;
        REQUIRE(round.plan.textures.size() == 3);
        CHECK(round.planned_map("dots_normal.png").materials == std::vector<int>{0, 1});
        CHECK(round.planned_map("dots_normal.png").meshes.empty());
        CHECK(round.planned_map("left").meshes == std::vector<int>{0});
        CHECK(round.planned_map("right").meshes == std::vector<int>{1});
    }

    TEST_CASE("planned maps: files and baked maps get their sizes, and the picture is the one that was judged") {
        Balls round;
        round.set("dots_normal.png", 32), round.set("left", 64), round.set("right", 16);
        const std::string text = round.planned();
        CHECK(has(text, "albedo = \"dots_normal.png\" # the same\n"));
        CHECK(round.read.materials.size() == 3);
        for (const MaterialEntry& material : round.read.materials) CHECK(material.albedo_size == 32);
        CHECK(round.read.materials[std::size_t(round.read.meshes[0].material)].relief_size == 64);
        CHECK(round.read.materials[std::size_t(round.read.meshes[1].material)].relief_size == 16);
        check_same_picture(round);

        Scene judged = load(round.entries);
        for (std::size_t i = 0; i < round.textures.size(); ++i)
            set_texture(judged, round.textures[i].materials, round.textures[i].use,
                        planned_texture(round.textures[i], round.plan.textures[i]));
        const SceneEntries entries = planned_entries(round.entries, round.plan);
        Scene rounded = load(entries);
        round_textures(entries, round.plan, rounded);
        CHECK(largest_difference(picture_of(judged), picture_of(rounded)) < 1e-5f);
        CHECK(largest_difference(picture_of(judged), picture_of(load(round.read))) < 1e-3f);
        CHECK(largest_difference(picture_of(judged), picture_of(load(round.entries))) > 1e-2f);
    }

    TEST_CASE("planned maps: a map in BC5 is said by the scene, and shown as it was judged") {
        Balls round;
        round.set("dots_normal.png", 128), round.set("left", 256), round.set("right", 64);
        for (const char* ball : {"left", "right"})
            round.planned_map(ball).channels = 2, round.planned_map(ball).bits = bc5_bits;
        const std::string text = round.planned();
        CHECK(has(text, "normal-depth = \"bc5\"\n"));
        CHECK(round.read.materials.size() == 3);
        for (const int mesh : {0, 1})
            CHECK(round.read.materials[std::size_t(round.read.meshes[std::size_t(mesh)].material)].normal_bc5);
        CHECK(!round.read.materials[std::size_t(round.read.meshes[2].material)].normal_bc5);
        CHECK(has(text, "\"studs normal 64 bc5\""));
        check_same_picture(round);
        const auto notes = not_in_scene(round.entries, round.plan);
        REQUIRE(notes.size() == 1); // of the albedo of 16 bits
        CHECK(!has(notes[0], "left"));

        // Planned again, the maps are in BC5 already.
        for (const SceneTexture& texture : scene_textures(load(round.read), &round.read))
            CHECK(source_form(texture).in_bc5() == (texture.use == TextureUse::normal));

        // The judged, the planned and the rounded scene have the same texels: blocks are not encoded twice.
        const SceneEntries entries = planned_entries(round.entries, round.plan);
        Scene rounded = load(entries);
        round_textures(entries, round.plan, rounded);
        const Image<float> judged = planned_texture(round.textures[1], round.plan.textures[1]);
        const auto now = scene_textures(rounded, &entries);
        REQUIRE(now[1].name == round.textures[1].name);
        REQUIRE(now[1].picture->size() == judged.size());
        CHECK(std::equal(judged.data(), judged.data() + judged.size(), now[1].picture->data()));
    }

    TEST_CASE("planned maps: blocks of noise, which change when they are encoded again, are encoded once") {
        Round round("[[light]]\ntype = \"ambient\"\n[[material]]\nname = \"m\"\nnormal = \"n.exr\"\n[[mesh]]\n"
                    "shape = \"plane\"\nmaterial = \"m\"\n");
        Image<float> noise(64, 64, 3);
        for (std::size_t i = 0; i < noise.size(); ++i)
            noise.data()[i] = i % 3 == 2 ? 1 : 0.1f * float(std::sin(double(i * i)));
        write_image(round.folder / "n.exr", noise, {.depth = Depth::float32});
        const SceneTexture source = scene_textures(load(round.entries), &round.entries)[0];
        round.plan.textures = {
            TexturePlan{.file = "n.exr", .kind = "normal", .width = 64, .height = 64, .channels = 2}};
        TexturePlan& map = round.plan.textures[0];
        map.bits = bc5_bits, map.source_width = map.source_height = 64, map.materials = {0};
        const SceneEntries entries = planned_entries(round.entries, round.plan);
        Scene rounded = load(entries);
        round_textures(entries, round.plan, rounded);
        const Image<float> judged = planned_texture(source, map);
        const Texture now = scene_textures(rounded, &entries)[0].picture;
        CHECK(std::equal(judged.data(), judged.data() + judged.size(), now->data()));
    }

    TEST_CASE("planned maps: files of normals in BC5 are said by the scene, unless they have it") {
        Balls round;
        round.plan.textures = {TexturePlan{.file = "n.png", .kind = "normal", .width = 8, .height = 8, .channels = 2}};
        TexturePlan& map = round.plan.textures[0];
        map.bits = bc5_bits, map.source_width = map.source_height = 8, map.materials = {1};
        CHECK(new_lines(round.text, round.planned()) == "normal-depth = \"bc5\"\n");
        CHECK(planned_entries(round.entries, round.plan).materials[1].normal_bc5);
        CHECK(!planned_entries(round.entries, round.plan).materials[0].normal_bc5);
        map.source_bits = bc5_bits;
        CHECK(round.planned() == round.text);
    }

    TEST_CASE("planned maps: what a scene shows in BC5 is shown as floats where another form is chosen") {
        std::string text = two_balls;
        text.insert(text.find("shade = \"normal\""), "normal-depth = \"bc5\"\n");
        Balls round(text);
        round.set("dots_normal.png", 128), round.set("left", 32), round.set("right", 256);
        round.planned_map("right").channels = 2, round.planned_map("right").bits = bc5_bits; // as it is
        REQUIRE(round.planned_map("left").source_bits == bc5_bits);
        CHECK(new_lines(text, round.planned()) ==
              "name = \"studs normal 32 float\"\nrelief-size = 32\nnormal-depth = \"float\"\n"
              "material = \"studs normal 32 float\"\n");
        const auto material = [&](const SceneEntries& entries, std::size_t mesh) {
            return entries.materials[std::size_t(entries.meshes[mesh].material)];
        };
        const SceneEntries entries = planned_entries(round.entries, round.plan);
        for (const SceneEntries* scene : {&std::as_const(round.read), &entries}) {
            CHECK(!material(*scene, 0).normal_bc5);
            CHECK(material(*scene, 0).relief_size == 32);
            CHECK(material(*scene, 1).normal_bc5);
            CHECK(material(*scene, 1).relief_size == 0);
        }
        check_same_picture(round);
    }

    TEST_CASE("planned maps: the key of a file that is no longer in BC5 is cleared, and none is written without one") {
        Round round("[[material]]\nname = \"m\"\nnormal = \"n.png\"\nnormal-depth = \"bc5\" # small\n"
                    "[[material]]\nname = \"k\"\nnormal = \"n.ktx2\"\n[[mesh]]\nshape = \"plane\"\nmaterial = \"m\"\n");
        for (const int material : {0, 1}) {
            TexturePlan& map =
                round.plan.textures.emplace_back(TexturePlan{.kind = "normal", .channels = 2, .bits = 8});
            map.width = map.height = 4, map.source_width = map.source_height = 8;
            map.source_channels = 2, map.source_bits = bc5_bits, map.materials = {material};
        }
        const std::string text = round.planned();
        CHECK(new_lines(round.text, text) == "relief-size = 4\nnormal-depth = \"float\" # small\nrelief-size = 4\n");
        for (const SceneEntries& entries : {planned_entries(round.entries, round.plan), round.read})
            for (const MaterialEntry& material : entries.materials) {
                CHECK(!material.normal_bc5);
                CHECK(material.relief_size == 4);
            }
    }

    TEST_CASE("planned maps: nothing is written of maps that keep their size") {
        Balls round;
        round.set("dots_normal.png", 128), round.set("left", 256), round.set("right", 256);
        CHECK(round.planned() == round.text);
        CHECK(not_in_scene(round.entries, round.plan).size() == 1); // of 16 bits instead of 8
        for (TexturePlan& texture : round.plan.textures) texture.bits = texture.source_bits;
        CHECK(not_in_scene(round.entries, round.plan).empty());
    }

    TEST_CASE("planned maps: with other models, and the same size for all") {
        Balls round;
        round.set("dots_normal.png", 128), round.set("left", 64), round.set("right", 64);
        round.plan.objects = {shown_by("left", "normal", {0}), shown_by("right", "normal", {1})};
        CHECK(new_lines(round.text, round.planned()) == "relief-size = 64\n");
        round.plan.objects = {shown_by("left", "bump", {0}), shown_by("right", "normal", {1})};
        round.planned();
        CHECK(round.shades()[0] == "bump");
        CHECK(round.shades()[1] == "normal");
        check_same_picture(round);
    }

    TEST_CASE("planned maps: a map that is of no mesh of the file keeps its size, with a note") {
        Balls round;
        round.set("dots_normal.png", 128), round.set("left", 64), round.set("right", 256);
        for (TexturePlan& texture : round.plan.textures) texture.bits = texture.source_bits;
        round.planned_map("left").meshes.clear();
        CHECK(round.planned() == round.text);
        const auto notes = not_in_scene(round.entries, round.plan);
        REQUIRE(notes.size() == 1);
        CHECK(notes[0].starts_with("keeps the size of the normal map of left"));
    }
}
