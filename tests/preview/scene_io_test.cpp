#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/scene_io.h"
#include "preview/little_scenes.h"
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <unistd.h>

using namespace bake;
using namespace bake::test;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() /
                    ("bake_scene_io_test_" + std::to_string(getpid()) + "_" + std::to_string(std::rand()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(*this / name, std::ios::binary) << text;
        return *this / name;
    }
};

std::string refusal(const std::string& file, Refusal why, const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK_MESSAGE(error.refusal == why, message);
        CHECK_MESSAGE(message.rfind(file, 0) == 0, message);
        CHECK_MESSAGE(message.find("; ") != std::string::npos, message);
        CHECK_MESSAGE(message.find('\n') == std::string::npos, message);
        return message.substr(file.size());
    }
    FAIL("not refused");
    return "";
}

void check_refused_at(int line, const std::string& named, const std::string& text) {
    const Folder folder;
    const std::string file = folder.write("scene.toml", text);
    const std::string message = refusal(file, Refusal::unreadable, [&] { read_scene(file); });
    CHECK_MESSAGE(message.rfind(":" + std::to_string(line) + ": ", 0) == 0, message);
    CHECK_MESSAGE(message.find(named) != std::string::npos, message);
}

Image<float> grey_texels() {
    Image<float> image(2, 2, 3);
    std::fill_n(image.data(), image.size(), 0.5f);
    return image;
}

const char* every_key = R"(
[render]
size = [320, 200]
spp = 9
bounces = 2
diffuse-bounces = 3
shadows = false
sky-light = "off"
terminator = "chiang"
seed = 12
exposure = -1.5
background = [0.1, 0.2, 0.3]

[camera]
position = [1, 2, 3]
target = [0, 1, 0]
up = [0, 0, 1]
fov-deg = 25

[sky]
faces = "sky/%s.png"
scale = 2
yaw-deg = 30
colour-space = "linear"

[[light]]
type = "directional"
from = [0, 3, 4]
colour = [1, 0.5, 0.25]
intensity = 2

[[light]]
type = "point"
position = [5, 6, 7]
falloff = [1, 0.5, 0.25]
ambient = 0.5
diffuse = [1, 0.5, 0]
specular = 2

[[light]]
type = "spot"
position = [1, 2, 3]
direction = [0, -2, 0]
inner-deg = 10
outer-deg = 60

[[light]]
type = "quad"
position = [0, 9, 0]
direction = [0, -1, 0]
size = 2

[[light]]
type = "quad"
position = [0, 9, 0]
edge-u = [1, 0, 0]
edge-v = [0, 0, 3]

[[light]]
type = "ambient"
colour = 0.25

[[material]]
name = "brick"
ambient = 0.1
diffuse = [0.5, 0.4, 0.3]
specular = 0.2
shininess = 50
emission = 0.01
reflect = 0.3
albedo = "brick.png"
albedo-space = "srgb"
bump = "/abs/brick_slopes.exr"
bump-scale = 0.5

[[material]]
name = "mapped"
normal = "../maps/n.png"
encoding = "signed"
directx = true

[[mesh]]
file = "a.obj"
material = "mapped"
translate = [1, 0, 0]
rotate-deg = [0, 90, 0]
scale = 2
flat = true

[[mesh]]
file = "b.ply"
scale = [1, 2, 3]
)";

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "scene_io: NaN, infinity and numbers beyond all doubles are refused for every key, with its line and name") {
        const std::string text = every_key;
        int numbers = 0;
        for (std::size_t begin = 0, end = 0, line = 1; begin < text.size(); begin = end + 1, ++line) {
            end = text.find('\n', begin);
            const std::string whole = text.substr(begin, end - begin);
            const std::size_t equals = whole.find(" = ");
            if (equals == std::string::npos || whole.find('"') != std::string::npos) continue;
            for (std::size_t at = equals; (at = whole.find_first_of("-0123456789", at)) != std::string::npos;) {
                const std::size_t stop = std::min(whole.find_first_not_of("-.0123456789", at), whole.size());
                for (const char* bad : {"nan", "inf", "-inf", "+nan", "1e999", "-1e999"}) {
                    CAPTURE(whole);
                    std::string changed = text;
                    changed.replace(begin + at, stop - at, bad);
                    check_refused_at(int(line), bad[1] == '1' || bad[0] == '1' ? "" : whole.substr(0, equals), changed);
                }
                at = stop;
                ++numbers;
            }
        }
        CHECK(numbers == 84);
    }

    TEST_CASE("scene_io: every key is read") {
        const Folder folder;
        const SceneEntries s = read_scene(folder.write("scene.toml", every_key));
        CHECK(s.settings.width == 320);
        CHECK(s.settings.height == 200);
        CHECK(s.settings.spp == 9);
        CHECK(s.settings.bounces == 2);
        CHECK(!s.settings.shadows);
        CHECK(s.settings.diffuse_bounces == 3);
        CHECK(s.settings.sky_light == SkyLighting::off);
        CHECK(s.settings.terminator == Terminator::chiang);
        CHECK(s.settings.seed == 12);
        CHECK(s.settings.exposure == -1.5f);
        CHECK(s.background == Vec3f(0.1f, 0.2f, 0.3f));
        CHECK(s.cameras.at(0).position.value() == Vec3f(1, 2, 3));
        CHECK(s.cameras.at(0).target.value() == Vec3f(0, 1, 0));
        CHECK(s.cameras.at(0).up == Vec3f(0, 0, 1));
        CHECK(s.cameras.at(0).fov_deg == 25);
        CHECK(s.sky.image == folder / "sky/%s.png"); // found when the scene is loaded, by any words for faces
        CHECK(s.sky.scale == 2);
        CHECK(s.sky.space == ColourSpace::linear);
        CHECK(s.sky.yaw_deg == 30);

        REQUIRE(s.lights.size() == 5);
        CHECK(s.lights[0].kind == LightKind::directional);
        CHECK(glm::length(s.lights[0].from - Vec3f(0, 0.6f, 0.8f)) < 1e-6f);
        CHECK(s.lights[0].colour == Vec3f(2, 1, 0.5f));
        CHECK(s.lights[1].kind == LightKind::point);
        CHECK(s.lights[1].position == Vec3f(5, 6, 7));
        CHECK(s.lights[1].falloff.constant == 1);
        CHECK(s.lights[1].falloff.linear == 0.5f);
        CHECK(s.lights[1].falloff.quadratic == 0.25f);
        CHECK(s.lights[1].diffuse == Vec3f(1, 0.5f, 0));
        CHECK(s.lights[1].specular == Vec3f(2));
        CHECK(s.ambient == Vec3f(0.75f)); // of the point light, and of the ambient one
        CHECK(s.lights[2].kind == LightKind::spot);
        CHECK(s.lights[2].from == Vec3f(0, 1, 0));
        CHECK(s.lights[2].cos_inner == doctest::Approx(std::cos(pi / 18)));
        CHECK(s.lights[2].cos_outer == doctest::Approx(0.5));
        for (const int k : {3, 4}) {
            CHECK(s.lights[k].kind == LightKind::quad);
            const Vec3f area = glm::cross(s.lights[k].edge_u, s.lights[k].edge_v);
            CHECK(glm::length(area - Vec3f(0, k == 3 ? -4 : -3, 0)) < 1e-5f);
        }

        REQUIRE(s.materials.size() == 2);
        const MaterialEntry &brick = s.materials[0], &mapped = s.materials[1];
        CHECK(brick.name == "brick");
        CHECK(brick.reflectance.ambient == Vec3f(0.1f));
        CHECK(brick.reflectance.diffuse == Vec3f(0.5f, 0.4f, 0.3f));
        CHECK(brick.reflectance.specular == Vec3f(0.2f));
        CHECK(brick.reflectance.shininess == 50);
        CHECK(brick.reflectance.emission == Vec3f(0.01f));
        CHECK(brick.reflect == Vec3f(0.3f));
        CHECK(brick.albedo == folder / "brick.png");
        CHECK(brick.albedo_space == ColourSpace::srgb);
        CHECK(brick.bump_table == "/abs/brick_slopes.exr");
        CHECK(brick.bump_scale == 0.5f);
        CHECK(mapped.reflectance.ambient == mapped.reflectance.diffuse);
        CHECK(mapped.normal_map == (folder.path.parent_path() / "maps/n.png").string());
        CHECK(mapped.encoding == NormalEncoding::signed_);
        CHECK(mapped.directx);

        REQUIRE(s.meshes.size() == 2);
        CHECK(s.meshes[0].file == folder / "a.obj");
        CHECK(s.meshes[0].material == 1);
        CHECK(s.meshes[0].placement.translate == Vec3f(1, 0, 0));
        CHECK(s.meshes[0].placement.rotate_deg == Vec3f(0, 90, 0));
        CHECK(s.meshes[0].placement.scale == Vec3f(2));
        CHECK(s.meshes[0].flat);
        CHECK(s.meshes[1].material == -1);
        CHECK(s.meshes[1].placement.scale == Vec3f(1, 2, 3));
    }

    TEST_CASE("scene_io: a scene of one line has a camera and a light; a file with several meshes is read once") {
        const Folder folder;
        write_mesh(folder / "ball.obj", sphere_mesh(16, 8));
        const Scene one = load(read_scene(folder.write("one.toml", "mesh = [{file = \"ball.obj\"}]")));
        CHECK(one.lights.size() == 1);
        CHECK(one.settings.width == 512);
        CHECK(seen_at(one, 32, 32) != Vec3f(0));
        const std::string text = "mesh = [{file = \"ball.obj\"}, {file = \"ball.obj\", translate = [3, 0, 0]}]";
        const Scene two = load(read_scene(folder.write("two.toml", text)));
        CHECK(two.shapes.size() == 1);
        CHECK(two.instances.size() == 2);
        CHECK(two.bvh->triangle_count() == 2 * one.bvh->triangle_count());
    }

    TEST_CASE("scene_io: materials with the same file share its texture") {
        const Folder folder;
        write_image(folder / "a.png", grey_texels(), {.depth = Depth::u8});
        write_mesh(folder / "ball.obj", sphere_mesh(8, 4));
        const std::string text = R"(
        mesh = [{file = "ball.obj"}]
        material = [{name = "a", albedo = "a.png"}, {name = "b", albedo = "a.png"},
                    {name = "c", albedo = "a.png", albedo-space = "linear"}])";
        const Scene scene = load(read_scene(folder.write("scene.toml", text)));
        REQUIRE(scene.materials.size() == 4);
        CHECK(scene.materials[1]->albedo == scene.materials[2]->albedo);
        CHECK(scene.materials[1]->albedo != scene.materials[3]->albedo);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("scene_io: an unknown key or table is refused with its name and line") {
        check_refused_at(2, "\"fov\"", "[camera]\nfov = 30\n");
        check_refused_at(4, "\"colour\"", "[[mesh]]\nfile = \"a.obj\"\n\ncolour = 1\n");
        check_refused_at(1, "\"lights\"", "[lights]\n");
        check_refused_at(3, "\"falloff\"",
                         "[[light]]\ntype = \"directional\"\nfalloff = [1, 0, 0]\nfrom = [0, 1, 0]\n");
        check_refused_at(2, "\"Spp\"", "[render]\nSpp = 3\n");
    }

    TEST_CASE("scene_io: a value of the wrong type or out of range is refused with its name and line") {
        check_refused_at(2, "\"spp\"", "[render]\nspp = 2.5\n");
        check_refused_at(2, "\"spp\"", "[render]\nspp = 0\n");
        check_refused_at(2, "\"size\"", "[render]\nsize = [10, 20, 30]\n");
        check_refused_at(2, "\"size\"", "[render]\nsize = [0, 10]\n");
        check_refused_at(2, "\"size\"", "[render]\nsize = 10000000000\n");
        check_refused_at(2, "\"exposure\"", "[render]\nexposure = nan\n");
        check_refused_at(2, "\"background\"", "[render]\nbackground = [0.1, -0.1, 0]\n");
        check_refused_at(2, "\"shadows\"", "[render]\nshadows = 1\n");
        check_refused_at(3, "\"position\"", "[camera]\n\nposition = [0, inf, 0]\n");
        check_refused_at(2, "\"position\"", "[camera]\nposition = [0, \"1\", 0]\n");
        check_refused_at(2, "\"up\"", "[camera]\nup = [0, 0, 0]\n");
        check_refused_at(2, "\"fov-deg\"", "[camera]\nfov-deg = 180\n");
        check_refused_at(1, "\"target\"", "[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]\n");
        check_refused_at(2, "\"type\"", "[[light]]\ntype = \"sun\"\n");
        check_refused_at(1, "\"from\"", "[[light]]\ntype = \"directional\"\n");
        check_refused_at(3, "\"from\"", "[[light]]\ntype = \"directional\"\nfrom = [0, 0, 0]\n");
        check_refused_at(4, "\"falloff\"", "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nfalloff = [0, 0, 0]\n");
        const std::string spot = "[[light]]\ntype = \"spot\"\nposition = [0, 0, 0]\n",
                          quad = "[[light]]\ntype = \"quad\"\n";
        check_refused_at(1, "\"direction\"", spot);
        check_refused_at(5, "\"inner-deg\"", spot + "direction = [0, -1, 0]\ninner-deg = 50\n");
        check_refused_at(1, "\"position\"", quad);
        check_refused_at(1, "\"edge-v\"", quad + "position = [0, 1, 0]\nedge-u = [1, 0, 0]\n");
        check_refused_at(1, "no area", quad + "position = [0, 1, 0]\ndirection = [0, -1, 0]\nsize = 0\n");
        check_refused_at(2, "\"file\"", "[[mesh]]\nfile = 3\n");
        check_refused_at(1, "\"file\"", "[[mesh]]\nflat = true\n");
        check_refused_at(3, "\"scale\"", "[[mesh]]\nfile = \"a.obj\"\nscale = [1, 0, 1]\n");
        check_refused_at(3, "\"material\"", "[[mesh]]\nfile = \"a.obj\"\nmaterial = \"gold\"\n");
        check_refused_at(4, "\"name\"", "[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"\n");
        check_refused_at(4, "\"normal\"", "[[material]]\nname = \"a\"\nbump = \"b.exr\"\nnormal = \"n.png\"\n");
        check_refused_at(1, "\"faces\"", "[sky]\n");
        check_refused_at(2, "%s", "[sky]\nfaces = \"sky.png\"\n");
        check_refused_at(2, "\"faces\"", "[sky]\nfaces = [\"a\", \"b\"]\n");
        check_refused_at(1, "\"mesh\"", "mesh = 3\n");
        check_refused_at(1, "\"camera\"", "camera = [1, 2]\n");
    }

    TEST_CASE("scene_io: a file that is not TOML is refused with the line") {
        check_refused_at(3, "", "[render]\nspp = 3\nsize = = 4\n");
        check_refused_at(2, "", "[render]\n[render]\n");
        check_refused_at(1, "", std::string("\x00\xff\xfe", 3));
        const std::string missing = "/nowhere/scene.toml";
        refusal(missing, Refusal::unreadable, [&] { read_scene(missing); });
        refusal("/tmp", Refusal::unreadable, [] { read_scene("/tmp"); });
    }

    TEST_CASE("scene_io: missing or unsuitable files are refused with the line of the scene") {
        const Folder folder;
        const auto check = [&](const std::string& text, Refusal why, const std::string& after) {
            const std::string file = folder.write("scene.toml", text);
            const std::string message = refusal(file, why, [&] { load(read_scene(file)); });
            CHECK_MESSAGE(message.rfind(after, 0) == 0, message);
        };
        check("", Refusal::unsuitable, ": ");
        check("\n[[mesh]]\nfile = \"gone.obj\"\n", Refusal::unreadable, ":3: " + (folder / "gone.obj"));
        check("[sky]\nfaces = \"gone_%s.png\"\n", Refusal::unreadable, ":2: " + (folder / "gone_px.png"));
        write_mesh(folder / "ball.obj", sphere_mesh(8, 4));
        check("[[mesh]]\nfile = \"ball.obj\"\nmaterial = \"m\"\n[[material]]\nname = \"m\"\nnormal = \"gone.png\"\n",
              Refusal::unreadable, ":4: " + (folder / "gone.png"));
        Mesh bare = sphere_mesh(8, 4);
        bare.uvs.clear();
        bare.corner_uv.clear();
        write_mesh(folder / "bare.obj", bare);
        write_image(folder / "a.png", grey_texels(), {.depth = Depth::u8});
        check("[[mesh]]\nfile = \"bare.obj\"\nmaterial = \"m\"\n[[material]]\nname = \"m\"\nalbedo = \"a.png\"\n",
              Refusal::unsuitable, ":2: " + (folder / "bare.obj"));
    }

} // TEST_SUITE
