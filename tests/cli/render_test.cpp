#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

using namespace bake;
namespace fs = std::filesystem;

namespace {

const std::string dots =
    std::string(std::getenv("BAKE_SOURCE") ? std::getenv("BAKE_SOURCE") : ".") + "/meshes/dots.png";

struct Folder {
    fs::path path = fs::temp_directory_path() /
                    ("bake_render_test_" + std::to_string(getpid()) + "_" + std::to_string(std::rand()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
};

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Run {
    int code;
    std::string out, err;
};

Run run_bake(const Folder& folder, const std::string& arguments) {
    const char* bake = std::getenv("BAKE");
    REQUIRE_MESSAGE(bake, "BAKE names the command to test");
    const std::string out = folder / "stdout", err = folder / "stderr";
    const std::string command =
        "cd '" + folder.path.string() + "' && '" + bake + "' " + arguments + " >'" + out + "' 2>'" + err + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(out), contents(err)};
}

Run bake_render(const Folder& folder, const std::string& arguments) { return run_bake(folder, "render " + arguments); }

/// A ball above a floor under two lights, with a mirror's share.
void write_scene(const Folder& folder) {
    write_mesh(folder / "ball.obj", test::sphere_mesh(32, 16));
    write_mesh(folder / "floor.ply", test::plane_mesh());
    test::write_file(folder / "scene.toml", R"(
[render]
size = [48, 32]
spp = 3
exposure = 1

[[light]]
type = "directional"
from = [1, 2, 3]

[[light]]
type = "ambient"
intensity = 0.2

[[material]]
name = "gloss"
specular = 0.5
reflect = 0.2

[[mesh]]
file = "ball.obj"
material = "gloss"

[[mesh]]
file = "floor.ply"
translate = [0, -1, 0]
rotate-deg = [-90, 0, 0]
scale = 3
)");
}

void check_refused(const Folder& folder, const std::string& arguments, int code, const std::string& named) {
    const Run run = bake_render(folder, arguments);
    CHECK_MESSAGE(run.code == code, arguments << ": " << run.err);
    CHECK(run.out.empty());
    CHECK_MESSAGE(std::count(run.err.begin(), run.err.end(), '\n') == 1, run.err);
    CHECK_MESSAGE(run.err.find(named) != std::string::npos, run.err);
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("render: a PNG of the scene's size, the same bytes for any number of threads") {
        const Folder folder;
        write_scene(folder);
        std::string first;
        for (const char* threads : {"1", "2", "7"}) {
            const Run run = bake_render(folder, std::string("scene.toml -o a.png --threads ") + threads);
            REQUIRE_MESSAGE(run.code == 0, run.err);
            CHECK(run.err.empty());
            CHECK(run.out.find("a.png: 48 x 32, 3 spp, ") == 0);
            CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 1);
            if (first.empty()) first = contents(folder / "a.png");
            CHECK(contents(folder / "a.png") == first);
        }
        const ImageInfo info = read_image_info(folder / "a.png");
        CHECK(info.width == 48);
        CHECK(info.height == 32);
        CHECK(info.type == SampleType::u8);
        CHECK(info.channels.size() == 3);
    }

    TEST_CASE("render: EXR holds the radiance, PNG the same exposed and sRGB-encoded") {
        const Folder folder;
        write_scene(folder);
        REQUIRE(bake_render(folder, "scene.toml -o a.exr --depth float").code == 0);
        REQUIRE(bake_render(folder, "scene.toml -o a.png").code == 0);
        REQUIRE(bake_render(folder, "scene.toml -o half.exr").code == 0);
        CHECK(read_image_info(folder / "half.exr").type == SampleType::half);
        const Image<float> linear = read_image(folder / "a.exr"), shown = read_image(folder / "a.png");
        REQUIRE(linear.size() == shown.size());
        float brightest = 0;
        for (std::size_t i = 0; i < linear.size(); ++i) {
            const float exposed = std::min(1.0f, 2 * linear.data()[i]); // exposure 1: twice
            CHECK(std::abs(linear_to_srgb(exposed) - shown.data()[i]) <= 0.51f / 255);
            brightest = std::max(brightest, linear.data()[i]);
        }
        CHECK(brightest > 0.3f);
    }

    TEST_CASE("render: size and samples from the command line win, and --json says what was done") {
        const Folder folder;
        write_scene(folder);
        const Run run = bake_render(folder, "scene.toml -o a.exr --size 20x10 --spp 2 --json");
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const nlohmann::json result = nlohmann::json::parse(run.out);
        CHECK(result["width"] == 20);
        CHECK(result["height"] == 10);
        CHECK(result["spp"] == 2);
        CHECK(result["triangles"] == 32 * 16 * 2 + 2);
        CHECK(result["rays"] > 20 * 10 * 2);
        CHECK(result["bad_samples"] == 0);
        CHECK(read_image_info(folder / "a.exr").width == 20);
        REQUIRE(bake_render(folder, "scene.toml -o a.png --size 16").code == 0);
        CHECK(read_image_info(folder / "a.png").height == 16);
    }

    TEST_CASE("render: what is too bright for half floats is their largest number, not infinite") {
        const Folder folder;
        write_mesh(folder / "floor.ply", test::plane_mesh());
        test::write_file(folder / "bright.toml", R"(mesh = [{file = "floor.ply"}]
                                          light = [{type = "ambient", intensity = 1e9}])");
        REQUIRE(bake_render(folder, "bright.toml -o a.exr --size 8").code == 0);
        const Image<float> image = read_image(folder / "a.exr");
        CHECK(image.at(4, 4) == 65504.0f);
    }

    TEST_CASE("render: refusals have their code, one line, and leave the old picture as it was") {
        const Folder folder;
        write_scene(folder);
        test::write_file(folder / "a.png", "old");
        test::write_file(folder / "bad_key.toml", "[render]\nsize = 8\nsamples = 3\n");
        test::write_file(folder / "no_mesh.toml", "[[mesh]]\nfile = \"gone.obj\"\n");
        test::write_file(folder / "empty.toml", "");
        check_refused(folder, "gone.toml -o a.png", 3, "gone.toml");
        check_refused(folder, "bad_key.toml -o a.png", 3, "bad_key.toml:3: ");
        check_refused(folder, "no_mesh.toml -o a.png", 3, "gone.obj");
        check_refused(folder, "empty.toml -o a.png", 4, "empty.toml");
        check_refused(folder, "scene.toml", 2, "--out");
        check_refused(folder, "scene.toml -o a.jpg", 2, "a.jpg");
        check_refused(folder, "scene.toml -o a.png --depth half", 2, "a.png");
        for (const char* size : {"0", "10x", "x10", "10x10x10", "-4", "8x0", "99999", "eight", "8x99999"})
            check_refused(folder, std::string("scene.toml -o a.png --size ") + size, 2, "--size");
        check_refused(folder, "scene.toml -o a.png --spp 0", 2, "--spp");
        check_refused(folder, "scene.toml -o nowhere/a.png", 5, "nowhere/a.png");
        CHECK(contents(folder / "a.png") == "old");
        int files = 0;
        for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path)) ++files;
        CHECK(files == 9); // scene, ball, floor, three bad scenes, a.png, stdout, stderr
    }

    TEST_CASE("render: a bump table in PNG or TIFF of 16 bits gives the picture of the EXR table within its steps") {
        const Folder folder;
        write_mesh(folder / "floor.ply", test::plane_mesh());
        const auto picture = [&](const std::string& table) {
            test::write_file(folder / (table + ".toml"), R"(light = [{type = "directional", from = [1, 2, 3]}]
                material = [{name = "relief", diffuse = 1, bump = ")" +
                                                             table +
                                                             R"("}]
                mesh = [{file = "floor.ply", material = "relief"}]
                camera = {position = [0, 0, 3], target = [0, 0, 0]}
                render = {size = 64, spp = 1})");
            const Run run = bake_render(folder, table + ".toml -o " + table + "_picture.exr --depth float");
            REQUIRE_MESSAGE(run.code == 0, run.err);
            return read_image(folder / (table + "_picture.exr"));
        };
        const std::string bake_table = "bump-table '" + dots + "' --json --amplitude ";
        REQUIRE(run_bake(folder, bake_table + "0.03 -o t.exr --depth float").code == 0);
        const Image<float> expected = picture("t.exr");
        REQUIRE(run_bake(folder, bake_table + "0 -o flat.exr --depth float").code == 0);
        const Image<float> flat = picture("flat.exr");
        for (const std::string name : {"t.png", "t.tif"}) {
            const Run table = run_bake(folder, bake_table + "0.03 -o " + name + " --depth 16");
            REQUIRE_MESSAGE(table.code == 0, table.err);
            const double step = nlohmann::json::parse(table.out)["bias"]["range"].get<double>() / 32767;
            const Image<float> got = picture(name);
            double largest = 0, relief = 0;
            for (std::size_t i = 0; i < got.size(); ++i) {
                largest = std::max(largest, std::abs(double(got.data()[i]) - expected.data()[i]));
                relief = std::max(relief, std::abs(double(flat.data()[i]) - expected.data()[i]));
            }
            CHECK(relief > 0.1);
            // A slope is off by at most half a step on each axis; the radiance of a light of 1 changes no faster than the
            // normal. The floor's p_u and p_v are its edges, 2 long.
            CHECK(largest <= std::sqrt(0.5) * step / 2 + 1e-6);
            CHECK(largest > 0);
        }
        // Integer samples that state no range are refused.
        fs::copy_file(dots, folder / "dots.png");
        test::write_file(folder / "bad.toml", R"(material = [{name = "relief", bump = "dots.png"}]
            mesh = [{file = "floor.ply", material = "relief"}])");
        check_refused(folder, "bad.toml -o a.png", 4, "dots.png");
    }

    TEST_CASE("render: --help has examples") {
        const Folder folder;
        const Run run = bake_render(folder, "--help");
        CHECK(run.code == 0);
        CHECK(run.out.find("Examples:\n  bake render ") != std::string::npos);
    }

} // TEST_SUITE
