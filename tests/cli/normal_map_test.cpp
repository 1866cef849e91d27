// bake normal-map from outside: what the map says in the options' conventions, and real heights on a plane and a mesh.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "picture/png_bytes.h"
#include "picture/texels.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> height_of(int width, int height, const auto& value) {
    Image<float> image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = float(value(x, y));
    return image;
}

Image<float> map(const Folder& folder, std::vector<std::string> options, nlohmann::json* said = nullptr) {
    options.insert(options.begin(), {"normal-map", "-o", "n.exr", "--depth", "float", "--json"});
    const Run run = run_bake(folder, options, {.seconds = 60});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    if (said) *said = nlohmann::json::parse(run.out);
    return read_image(folder / "n.exr");
}

/// Every texel a unit normal on the outer side, within what the file's encoding leaves.
void check_unit(const Image<float>& rgb, double tolerance) {
    REQUIRE(rgb.channels() == 3);
    double worst = 0, lowest = 1;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const float* t = rgb.data() + i;
        const double x = 2.0 * t[0] - 1, y = 2.0 * t[1] - 1, z = 2.0 * t[2] - 1;
        worst =
            std::max(worst, std::abs(std::sqrt(x * x + y * y + z * z) - 1)); // a NaN fails, too: max keeps the number
        if (!(std::isfinite(x) && std::isfinite(y) && std::isfinite(z))) worst = 1e9;
        lowest = std::min(lowest, z);
    }
    CHECK(worst <= tolerance);
    CHECK(lowest > -tolerance);
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE(
        "normal-map: a ramp tilts against its rise; green up, --directx down, --invert and amplitude turn it round") {
        const Folder folder;
        // Slope 1/2 along u on a plane 1 wide, -1/4 along v.
        write_image(folder / "h.exr", height_of(32, 32, [](int x, int y) { return (x / 2.0 + y / 4.0) / 32; }),
                    {.depth = Depth::float32});
        const double length = std::sqrt(1 + 0.25 + 1 / 16.0);
        const auto check = [&](const std::vector<std::string>& options, double x, double y) {
            std::vector<std::string> all = options;
            all.insert(all.end(), {"--height", "h.exr", "--wrap", "clamp"});
            const Image<float> rgb = map(folder, all);
            for (const int at : {0, 13, 31}) {
                CHECK(2 * rgb.at(at, 7, 0) - 1 == doctest::Approx(x / length).epsilon(1e-4));
                CHECK(2 * rgb.at(at, 7, 1) - 1 == doctest::Approx(y / length).epsilon(1e-4));
                CHECK(2 * rgb.at(at, 7, 2) - 1 == doctest::Approx(1 / length).epsilon(1e-4));
            }
        };
        check({}, -0.5, 0.25);
        check({"--directx"}, -0.5, -0.25);
        check({"--invert"}, 0.5, -0.25);
        check({"--amplitude", "-1"}, 0.5, -0.25);
        check({"--amplitude", "2", "--extent", "2,2"}, -0.5, 0.25);
        check({"--midlevel", "0.1"}, -0.5, 0.25);
        for (const char* method : {"blinn", "surface-gradient", "exact", "constant-scale", "lecture"})
            check({"--method", method}, -0.5, 0.25);
    }

    TEST_CASE("normal-map: every depth holds the map within its encoding, flat is (0.5, 0.5, 1)") {
        const Folder folder;
        write_image(folder / "h.exr",
                    height_of(32, 32, [](int x, int y) { return 0.01 * std::sin(x * 0.7) * std::cos(y * 0.4); }),
                    {.depth = Depth::float32});
        const Image<float> exact = map(folder, {"--height", "h.exr"});
        struct {
            const char *file, *depth;
            double step;
        } const cases[] = {{"n.png", "8", 0.5 / 255},     {"n.png", "16", 0.5 / 65535},  {"n.tif", "8", 0.5 / 255},
                           {"n.tif", "16", 0.5 / 65535},  {"n.tif", "float", 1e-7},      {"n.exr", "half", 1 / 4096.0},
                           {"n.exr", "auto", 1 / 4096.0}, {"n.png", "auto", 0.5 / 65535}};
        for (const auto& c : cases) {
            CAPTURE(std::string(c.depth));
            REQUIRE(run_bake(folder, {"normal-map", "--height", "h.exr", "-o", c.file, "--depth", c.depth}).code == 0);
            const Image<float> stored = read_image(folder / c.file);
            double worst = 0;
            for (std::size_t i = 0; i < exact.size(); ++i)
                worst = std::max(worst, double(std::abs(stored.data()[i] - exact.data()[i])));
            CHECK(worst <= c.step * 1.001 + 1e-7);
        }
        write_image(folder / "flat.png", height_of(4, 4, [](int, int) { return 0.25; }), {});
        REQUIRE(run_bake(folder, {"normal-map", "--height", "flat.png", "-o", "flat_n.png", "--depth", "8"}).code == 0);
        const Image<float> flat = read_image(folder / "flat_n.png");
        CHECK(flat.at(2, 2, 0) == doctest::Approx(128 / 255.0));
        CHECK(flat.at(2, 2, 1) == doctest::Approx(128 / 255.0));
        CHECK(flat.at(2, 2, 2) == 1);
    }

    TEST_CASE("normal-map: the steepest slopes there are give unit normals, not NaN") {
        const Folder folder;
        write_image(folder / "h.exr", height_of(16, 16, [](int x, int y) { return (x ^ y) & 1 ? 1e12 : -1e12; }),
                    {.depth = Depth::float32});
        check_unit(map(folder, {"--height", "h.exr", "--amplitude", "1e12", "--wrap", "clamp", "--filter", "central",
                                "--extent", "1e6,1e6"}),
                   1e-4);
        write_image(folder / "tiny.exr", height_of(16, 16, [](int x, int) { return x * 1e-40; }),
                    {.depth = Depth::float32});
        check_unit(map(folder, {"--height", "tiny.exr", "--amplitude", "1e-12", "--wrap", "clamp"}), 1e-6);
    }

    TEST_CASE("normal-map: a lone picture is the height of a flat rectangle, as --height is") {
        const Folder folder;
        const std::string dots = (own_meshes() / "dots.png").string();
        REQUIRE(run_bake(folder, {"normal-map", dots, "-o", "alone.png"}).code == 0);
        REQUIRE(run_bake(folder, {"normal-map", "--height", dots, "-o", "named.png"}).code == 0);
        CHECK((texels_of(folder / "alone.png") == texels_of(folder / "named.png")));
        check_refused(folder, {"normal-map", (own_meshes() / "torus.obj").string(), "-o", "a.png"}, 2,
                      "--height: is required");
    }

    TEST_CASE("amplitude: object units, or per cent of the mesh's diagonal or the picture's width, in every verb") {
        const Folder folder;
        const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();
        const auto said = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), {"--json", "--quiet"});
            const Run run = run_bake(folder, arguments);
            REQUIRE_MESSAGE(run.code == 0, run.err);
            return nlohmann::json::parse(run.out);
        };
        const auto amplitude = [&](const std::vector<std::string>& arguments) {
            return said(arguments)["amplitude"].get<double>();
        };
        write_image(folder / "lengths.exr", height_of(8, 8, [](int x, int) { return x % 2 * 0.01; }),
                    {.depth = Depth::float32});
        const nlohmann::json displaced = said({"displace", torus, "--height", dots, "-o", "a.ply"});
        const double diagonal = displaced["diagonal"];
        // Without an amplitude: 1 % of what the relief lies on; bump tables are in the picture's own units.
        CHECK(displaced["amplitude"].get<double>() == doctest::Approx(0.01 * diagonal));
        CHECK(amplitude({"normal-map", torus, "--height", dots, "--size", "16", "-o", "a.png"}) ==
              doctest::Approx(0.01 * diagonal));
        CHECK(amplitude({"normal-map", dots, "-o", "a.png"}) == doctest::Approx(0.01));
        CHECK(amplitude({"normal-map", dots, "--extent", "3,1", "-o", "a.png"}) == doctest::Approx(0.03));
        CHECK(amplitude({"bump-table", dots, "-o", "a.exr"}) == 1);
        // A per cent of the same.
        CHECK(amplitude({"displace", torus, "--height", dots, "--amplitude", "2%", "-o", "a.ply"}) ==
              doctest::Approx(0.02 * diagonal));
        CHECK(amplitude({"normal-map", torus, "--height", dots, "--amplitude", "2%", "--size", "16", "-o", "a.png"}) ==
              doctest::Approx(0.02 * diagonal));
        CHECK(amplitude({"normal-map", dots, "--amplitude", "2%", "--extent", "3,1", "-o", "a.png"}) ==
              doctest::Approx(0.06));
        CHECK(amplitude({"bump-table", dots, "--amplitude", "2%", "--extent", "3,1", "-o", "a.exr"}) ==
              doctest::Approx(0.06));
        CHECK(amplitude({"bump-table", dots, "--amplitude", "-2%", "-o", "a.exr"}) == doctest::Approx(-0.02));
        // Floats are lengths, and zero is no displacement.
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"normal-map", "lengths.exr", "-o", "a.png"},
              {"normal-map", torus, "--height", "lengths.exr", "--size", "16", "-o", "a.png"},
              {"displace", torus, "--height", "lengths.exr", "-o", "a.ply"}}) {
            const nlohmann::json object = said(arguments);
            CHECK(object["amplitude"] == 1);
            CHECK(object["midlevel"] == 0);
        }
        const Run words = run_bake(folder, {"normal-map", dots, "-o", "a.png"});
        CHECK(words.out.find("amplitude 0.01, midlevel 0.5") != std::string::npos);
        CHECK(words.err.find("amplitude 0.01, 1 % of the picture's width; --amplitude sets it") != std::string::npos);
        CHECK(run_bake(folder, {"normal-map", "lengths.exr", "-o", "a.png"}).err.find("taken as lengths") !=
              std::string::npos);
        CHECK(run_bake(folder, {"normal-map", dots, "-o", "a.png", "--amplitude", "1%"}).err.find("amplitude") ==
              std::string::npos);
        // The default tilts the normal by degrees, not beyond seeing: one level of 256.
        CHECK(said({"normal-map", dots, "-o", "a.png"})["step_tilt_deg"].get<double>() < 5);
    }

    TEST_CASE("normal-map: an sRGB tag and a tint of one level change nothing") {
        const Folder folder;
        std::vector<std::string> grey, tinted;
        for (int y = 0; y < 8; ++y) {
            std::string g, t;
            for (int x = 0; x < 8; ++x) {
                const char level = char(100 + (x * x + 3 * y) % 40);
                g += level;
                t += {level, level, char(level + 1)};
            }
            grey.push_back(g), tinted.push_back(t);
        }
        write_file(folder / "plain.png", png_bytes(8, 8, 8, 0, grey));
        write_file(folder / "tagged.png", png_bytes(8, 8, 8, 0, grey, srgb_tag()));
        write_file(folder / "tinted.png", png_bytes(8, 8, 8, 2, tinted));
        const Image<float> plain = map(folder, {"--height", "plain.png"});
        for (const char* file : {"tagged.png", "tinted.png"}) {
            const Image<float> other = map(folder, {"--height", file});
            for (std::size_t i = 0; i < plain.size(); ++i) CHECK(std::abs(other.data()[i] - plain.data()[i]) < 1e-6);
        }
    }

    TEST_CASE("normal-map: --size makes a smaller or larger map, on a plane and on a mesh") {
        const Folder folder;
        const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();
        for (const auto& [size, width, height] :
             {std::tuple("64", 64, 64), {"300x17", 300, 17}, {"1", 1, 1}, {"512x512", 512, 512}}) {
            const Image<float> plane = map(folder, {"--height", dots, "--size", size});
            CHECK(plane.width() == width);
            CHECK(plane.height() == height);
            check_unit(plane, 1e-5);
            const Image<float> mesh = map(folder, {torus, "--height", dots, "--amplitude", "1%", "--size", size});
            CHECK(mesh.width() == width);
            check_unit(mesh, 1e-5);
        }
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("normal-map and bump-table: real heights on a plane and on Spot give unit normals and a budget") {
        const fs::path data = shared_data();
        std::vector<std::string> heights;
        for (const auto& entry : fs::directory_iterator(data / "textures/heights"))
            heights.push_back(entry.path().string());
        for (const auto& entry : fs::recursive_directory_iterator(data / "textures/pairs")) {
            const std::string stem = entry.path().stem().string();
            if (stem.ends_with("_hm") || stem.ends_with("_Displacement") || stem.ends_with("_depth"))
                heights.push_back(entry.path().string());
        }
        std::sort(heights.begin(), heights.end());
        CHECK(heights.size() >= 16);
        const std::string spot = (data / "meshes/spot/spot_quadrangulated.obj").string();
        const Folder folder;
        for (const std::string& height : heights) {
            CAPTURE(height);
            nlohmann::json said;
            check_unit(map(folder, {"--height", height, "--amplitude", "0.02"}, &said), 1e-5);
            const double plane = said["error_budget"]["total_deg"];
            CHECK((plane >= 0 && plane < 90));
            check_unit(map(folder, {spot, "--height", height, "--amplitude", "0.5%", "--size", "512"}, &said), 1e-5);
            const double mesh = said["error_budget"]["total_deg"];
            CHECK((mesh >= 0 && mesh < 90));
            CHECK(said["texels"]["covered"].get<int>() > 512 * 512 / 4);
            CHECK(said["texels"]["degenerate"] == 0);

            const Run table = run_bake(folder, {"bump-table", height, "-o", "t.tif", "--amplitude", "0.02", "--json"});
            REQUIRE(table.code == 0);
            CHECK(nlohmann::json::parse(table.out)["error_budget"]["total_deg"].is_number());
            const Image<float> slopes = read_image(folder / "t.tif");
            bool finite = true;
            for (std::size_t i = 0; i < slopes.size(); ++i) finite = finite && std::isfinite(slopes.data()[i]);
            CHECK(finite);
        }
    }

} // TEST_SUITE
