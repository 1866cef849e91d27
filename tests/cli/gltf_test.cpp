// glTF from outside: the Khronos validator on what we write, and verbs on what others wrote.
#include "bake/surface/chart/tangent_space.h"
#include "cli/command.h"
#include "cli/gltf_validator.h"
#include "mesh/gltf/gltf_files.h"
#include "picture/texels.h"

namespace {
using namespace bake;
using namespace bake_tests;

/// Ours has bytes that viewers look at: a picture of one pixel.
std::vector<std::uint8_t> one_pixel() {
    return {0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,    0,    13,  'I',  'H',  'D',  'R',  0,
            0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,    0,   0x3a, 0x7e, 0x9b, 0x55, 0,
            0,    0,    10,   'I',  'D',  'A',  'T',  0x78, 0x9c, 0x63, 0x68, 0,   0,    0,    0x82, 0,    0x81,
            0x77, 0xcd, 0x72, 0xb6, 0,    0,    0,    0,    'I',  'E',  'N',  'D', 0xae, 0x42, 0x60, 0x82};
}

const char* const samples[] = {"gltf/NormalTangentTest.glb", "gltf/armor.gltf", "leeperrysmith/LeePerrySmith.glb",
                               "materialx/boombox.glb", "materialx/shaderball.glb"};

void write_both(const TemporaryFolder& folder, const std::string& name, const Gltf& gltf) {
    for (const char* ending : {".glb", ".gltf"}) write_gltf(folder.file(name + ending), gltf);
}
} // namespace

TEST_SUITE("cli") {
    TEST_CASE("gltf: the Khronos validator finds nothing wrong with what we write" *
              doctest::skip(test::no_validator())) {
        const TemporaryFolder folder;
        Gltf rich{rich_triangles(6, 3), {}, {}, {}};
        rich.images = {
            {"height", "image/png", "", one_pixel()}, {"", "", "a b.png", one_pixel()}, {"", "", "gone.png", {}}};
        GltfMaterial brick{.name = "brick"};
        brick.normal = GltfTexture{1, 0, 0.5, {33071, 33648, 9987, 9729}};
        brick.base_color = GltfTexture{0, 1, 1, {}};
        brick.emissive = GltfTexture{2, 0, 1, {}};
        brick.alpha_mode = "MASK", brick.alpha_cutoff = 0.25f, brick.double_sided = true;
        rich.materials = {brick, {.name = "plaster"}};
        rich.nodes = {{"mirror", 0, 8, {-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}},
                      {"shear", 8, 20, {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                      {"", 20, rich.mesh.faces(), {0, 300, 0, 0, -300, 0, 0, 0, 0, 0, 300, 0, 0, 0, 0, 1}}};
        write_both(folder, "rich", rich);

        // What other formats allow: no normals, zero normals, missing uvs, names that are no UTF-8, attributes that clash.
        Gltf poor{read_text("t.obj", "v 0 0 0\nv 3 0 0\nv 1 1 0\nv 0 3 0\nv 5 5 1\nvn 0 0 0\nvt .5 1\nusemtl \xff\nf 1 "
                                     "2/1 3//1 4\nf 2 5 4 3 1\nf 1 1 2\n"),
                  {},
                  {},
                  {}};
        poor.mesh.attributes = {{"a b", 1, std::vector<float>(poor.mesh.corners())},
                                {"A_B", 2, std::vector<float>(2 * poor.mesh.corners())},
                                {"TEXCOORD_7", 2, std::vector<float>(2 * poor.mesh.corners())},
                                {"COLOR_1", 3, std::vector<float>(3 * poor.mesh.corners())},
                                {"", 1, std::vector<float>(poor.mesh.corners())}};
        poor.mesh.tangents.assign(poor.mesh.corners(), Vec4f(0, 0, 0, 0));
        write_both(folder, "poor", poor);
        Gltf bare{poor.mesh, {}, {}, {}};
        bare.mesh.corner_normal.clear(), bare.mesh.corner_uv.clear();
        bare.materials = {brick};
        write_both(folder, "bare", bare);
        write_mesh(folder.file("one.glb"), read_text("t.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"));
        CHECK(test::validator_says(folder.path) == "");
    }

    TEST_CASE("gltf: bake check tells its parts, its missing images and that v runs the wrong way") {
        const test::Folder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        gltf.images = {{"", "", "gone.png", one_pixel()}};
        gltf.materials = {{.name = "brick", .normal = GltfTexture{0, 0, 1, {}}}, {.name = "plaster"}};
        write_gltf(folder / "a.gltf", gltf);
        const auto check = [&](const std::vector<std::string>& options) {
            std::vector<std::string> all = {"check", "a.gltf"};
            all.insert(all.end(), options.begin(), options.end());
            const test::Run run = test::run_bake(folder, all);
            CHECK(run.code == 0);
            return run.out;
        };
        CHECK(check({}).find("1 node, 1 normal texture, 1 image, tangents of its own") != std::string::npos);
        CHECK(check({"--flip-v"}).find("see --flip-v") != std::string::npos);
        CHECK(check({}).find("see --flip-v") == std::string::npos);
        std::filesystem::remove(folder / "gone.png");
        CHECK(check({}).find("1 missing image") != std::string::npos);
        CHECK(check({"--json"}).find("\"missing_images\":1") != std::string::npos);
        std::filesystem::remove(folder / "a.bin");
        const std::string height = (test::own_meshes() / "bricks.png").string();
        test::check_refused(folder, {"normal-map", "a.gltf", "--height", height, "--amplitude", "1", "-o", "n.png"}, 3,
                            "a.bin");
    }

    TEST_CASE("gltf: normal-map, explain and render take a .glb as they take the same mesh as .obj") {
        const test::Folder folder;
        Mesh mesh = read_mesh((test::own_meshes() / "torus.obj").string());
        mesh.attributes.clear();
        write_mesh(folder / "t.glb", mesh);
        mesh = read_mesh(folder / "t.glb"); // triangles, and v as the turn leaves it
        write_mesh(folder / "t.obj", mesh);
        const std::string height = (test::own_meshes() / "bricks.png").string();
        const auto run = [&](std::vector<std::string> arguments) {
            const test::Run done = test::run_bake(folder, arguments, {.seconds = 60});
            CHECK_MESSAGE(done.code == 0, done.err);
            return done.out;
        };
        const auto bake_map = [&](const std::string& name, const std::string& out, std::vector<std::string> more = {}) {
            std::vector<std::string> all = {"normal-map", name,     "--height", height, "--amplitude",
                                            "1%",         "--size", "128",      "-o",   out};
            all.insert(all.end(), more.begin(), more.end());
            run(all);
            return test::texels_of(folder / out);
        };
        CHECK(bake_map("t.glb", "a.png") == bake_map("t.obj", "b.png"));
        CHECK(bake_map("t.glb", "c.png", {"--flip-v"}) != bake_map("t.obj", "b.png"));
        for (Vec2f& uv : mesh.uvs) uv.y = 1 - uv.y;
        write_mesh(folder / "up.glb", mesh);
        CHECK(bake_map("up.glb", "d.png", {"--flip-v"}) == test::texels_of(folder / "a.png"));
        const auto explain = [&](const std::string& name) {
            return run({"explain", name, "--height", height, "--amplitude", "1%", "--uv", "0.25,0.5", "--quiet"});
        };
        std::string told = explain("t.glb"), as_obj = explain("t.obj");
        for (std::size_t at; (at = told.find("t.glb")) != std::string::npos;) told.replace(at, 5, "t.obj");
        CHECK(told == as_obj);
        for (const std::string name : {"t.glb", "t.obj"}) {
            test::write_file(folder / "s.toml", "mesh = [{file = \"" + name + "\"}]\n");
            run({"render", "s.toml", "-o", name + ".png", "--size", "64", "--spp", "1"});
        }
        CHECK(test::texels_of(folder / "t.glb.png") == test::texels_of(folder / "t.obj.png"));
    }
} // cli

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("gltf: the samples come back bit for bit from what we write of them") {
        const std::filesystem::path data = test::shared_data();
        const TemporaryFolder folder;
        for (const char* sample : samples) {
            CAPTURE(sample);
            const Gltf first = read_gltf((data / "meshes" / sample).string());
            const std::string stem = std::filesystem::path(sample).stem().string();
            for (const char* ending : {".glb", ".gltf"}) {
                const GltfWritten done = write_gltf(folder.file(stem + ending), first);
                CHECK(done.dropped_images + done.moved_nodes == 0);
                const Gltf back = read_gltf(folder.file(stem + ending));
                const Mesh& expected = first.mesh;
                if (done.mended_normals + done.mended_tangents > 0)
                    MESSAGE(sample << ": " << done.mended_normals << " normals and " << done.mended_tangents
                                   << " tangents mended");
                else CHECK(same_mesh(back.mesh, expected));
                CHECK(same_corners({.positions = back.mesh.positions,
                                    .face_begin = back.mesh.face_begin,
                                    .corner_position = back.mesh.corner_position},
                                   {.positions = expected.positions,
                                    .face_begin = expected.face_begin,
                                    .corner_position = expected.corner_position}));
                CHECK(back.materials == first.materials);
                CHECK(back.nodes == first.nodes);
                REQUIRE(back.images.size() == first.images.size());
                for (std::size_t i = 0; i < back.images.size(); ++i)
                    CHECK(back.images[i].bytes == first.images[i].bytes);
            }
        }
    }

    TEST_CASE("gltf: the Khronos validator finds nothing wrong with what we write of the samples" *
              doctest::skip(test::no_shared_data() || test::no_validator())) {
        const TemporaryFolder folder;
        for (const char* sample : samples) {
            const std::filesystem::path file = test::shared_data() / "meshes" / sample;
            Gltf gltf = read_gltf(file.string());
            // The format asks for tangents on a mesh with a normal texture.
            if (gltf.materials.size() == 1 && gltf.materials[0].normal) add_tangents(gltf.mesh);
            write_both(folder, file.stem().string(), gltf);
        }
        CHECK(test::validator_says(folder.path) == "");
    }
} // real
