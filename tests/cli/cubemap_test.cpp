#include "bake/environment/file/environment_io.h"
#include "bake/environment/sky/solid_angle.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace bake;
using namespace bake::test;

namespace {

std::vector<std::string> words(const std::string& line) {
    std::vector<std::string> all{"cubemap"};
    std::istringstream in(line);
    for (std::string word; in >> word;) all.push_back(word);
    return all;
}

Run cubemap(const Folder& folder, const std::string& line) { return run_bake(folder, words(line)); }

nlohmann::json cubemap_json(const Folder& folder, const std::string& line) {
    const Run run = cubemap(folder, line + " --json");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.err == "");
    return nlohmann::json::parse(run.out);
}

void refused(const Folder& folder, const std::string& line, int code, const std::string& named) {
    check_refused(folder, words(line), code, named);
}

void write_faces(const Folder& folder, const std::string& pattern, int n, float value = 0.5f,
                 Depth depth = Depth::float32) {
    for (const std::string& file : cube_files(folder / pattern)) {
        Image<float> face(n, n, 1); // grey TIFF needs no OpenImageIO, which takes .2 s to load
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = value + 0.001f * float(i % 7);
        write_image(file, face, {.depth = depth});
    }
}

void write_flat(const std::string& file, int width, int height, float value, int channels = 1) {
    Image<float> image(width, height, channels);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = value;
    write_image(file, image, {.depth = Depth::float32});
}

bool same_picture(const std::string& a, const std::string& b) {
    const Image<float> x = read_image(a), y = read_image(b);
    if (x.width() != y.width() || x.height() != y.height() || x.channels() != y.channels()) return false;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x.data()[i] != y.data()[i]) return false;
    return true;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("cubemap: the labelled sky goes through every layout of faces and comes back texel by texel") {
        const Folder folder;
        REQUIRE(cubemap(folder, "labels --size 64 -o first_%s.png").code == 0);
        const std::pair<const char*, const char*> steps[] = {
            {"hcross", "a.png"}, {"vcross", "b.exr"}, {"strip", "c.tif"}, {"hcross", "d.tif"}};
        std::string last = "first_%s.png";
        for (const auto& [layout, file] : steps) {
            const nlohmann::json result = cubemap_json(folder, last + " --to " + layout + " -o " + file + " --depth " +
                                                                   (file[0] == 'a' ? "16" : "float"));
            CHECK(result["to"] == layout);
            last = file;
        }
        REQUIRE(cubemap(folder, "d.tif -o last_%s.png").code == 0);
        for (int k = 0; k < 6; ++k)
            CHECK(same_picture(cube_files(folder / "first_%s.png")[k], cube_files(folder / "last_%s.png")[k]));
        // Six files in any order, by their names.
        REQUIRE(cubemap(folder, "first_nz.png first_px.png first_py.png first_pz.png first_nx.png first_ny.png --to "
                                "hcross -o e.png --depth 16")
                    .code == 0);
        CHECK(same_picture(folder / "a.png", folder / "e.png"));
    }

    TEST_CASE("cubemap: 8-bit pictures come through unchanged, sRGB or not") {
        const Folder folder;
        REQUIRE(cubemap(folder, "labels --size 32 --to hcross -o a.png --depth 8").code == 0);
        REQUIRE(cubemap(folder, "a.png --to strip -o b.png").code == 0);
        REQUIRE(cubemap(folder, "b.png --to hcross -o c.png").code == 0);
        CHECK(read_image_info(folder / "c.png").bits == 8);
        CHECK(same_picture(folder / "a.png", folder / "c.png"));
        REQUIRE(cubemap(folder, "b.png --to hcross -o d.png --linear").code == 0);
        CHECK(same_picture(folder / "a.png", folder / "d.png"));
        // Linear light: half the level is a fifth of the light.
        REQUIRE(cubemap(folder, "a.png --to hcross -o light.tif").code == 0);
        REQUIRE(cubemap(folder, "a.png --to hcross -o level.tif --linear").code == 0);
        CHECK(read_image(folder / "light.tif").at(40, 40) < read_image(folder / "level.tif").at(40, 40));
    }

    TEST_CASE("cubemap: an EXR is a cube to other readers, tagged, with samples on the edges, in OpenEXR's order") {
        const Folder folder;
        const nlohmann::json result = cubemap_json(folder, "labels --size 32 -o sky.exr");
        CHECK(result["to"] == "openexr-cube");
        const ImageInfo info = read_image_info(folder / "sky.exr");
        CHECK(info.environment == EnvironmentTag::cube);
        CHECK(info.width == 32);
        CHECK(info.height == 192);
        CHECK(cubemap_json(folder, "sky.exr -o again_%s.exr")["from"] == "openexr-cube");
        REQUIRE(cubemap(folder, "labels --size 64 --to openexr-latlong -o wide.exr").code == 0);
        CHECK(read_image_info(folder / "wide.exr").environment == EnvironmentTag::latlong);
        CHECK(cubemap_json(folder, "wide.exr -o w_%s.exr")["from"] == "openexr-latlong");
    }

    TEST_CASE("cubemap: lat-longs and octahedral maps and back keep the sky's light") {
        const Folder folder;
        REQUIRE(cubemap(folder, "labels --size 64 -o a_%s.tif").code == 0);
        REQUIRE(cubemap(folder, "a_%s.tif --to latlong -o wide.tif --samples exact").code == 0);
        REQUIRE(cubemap(folder, "wide.tif --to octahedral --size 160 -o oct.tif --samples exact").code == 0);
        REQUIRE(cubemap(folder, "oct.tif --from octahedral --size 64 -o b_%s.tif --samples exact").code == 0);
        CHECK(read_image_info(folder / "wide.tif").width == 256);
        CHECK(read_image_info(folder / "wide.tif").height == 128);
        for (int k = 0; k < 6; ++k) {
            // Each face's middle keeps its colour: upright and in its place.
            const Image<float> a = read_image(cube_files(folder / "a_%s.tif")[k]),
                               b = read_image(cube_files(folder / "b_%s.tif")[k]);
            double difference = 0, size = 0;
            for (std::size_t i = 0; i < a.size(); ++i)
                difference += std::abs(a.data()[i] - b.data()[i]), size += a.data()[i];
            CHECK(difference / size < 0.25);
        }
    }

    TEST_CASE("cubemap: turned faces are found and mended on demand only") {
        const Folder folder;
        const Environment sky = [] {
            Environment made;
            made.cube = make_cube(16, 3);
            for (const CubeFace face : all_cube_faces)
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 16; ++x) {
                        const Vec3d d =
                            glm::normalize(cube_direction(CubePoint<double>{face, (x + 0.5) / 16, (y + 0.5) / 16}));
                        for (int c = 0; c < 3; ++c)
                            made.cube[face].at(x, y, c) =
                                float(1 + 0.4 * std::sin(3 * d.x + c) + 0.3 * d.y * d.z + 0.2 * d.z);
                    }
            return made;
        }();
        const auto files = cube_files(folder / "s_%s.tif");
        for (int k = 0; k < 6; ++k)
            write_image(files[k], turned(sky.cube.faces[k], k == 2 ? 1 : 0), {.depth = Depth::float32});
        const Run told = cubemap(folder, "s_%s.tif -o a_%s.tif --depth float");
        CHECK(told.code == 0);
        CHECK(told.err.find("s_py.tif turned 270 deg; --fix-orientation does so") != std::string::npos);
        CHECK(same_picture(folder / "s_py.tif", folder / "a_py.tif"));
        const nlohmann::json fixed = cubemap_json(folder, "s_%s.tif --fix-orientation -o b_%s.tif --depth float");
        CHECK(fixed["orientation"]["fixed"] == true);
        CHECK(fixed["orientation"]["closes_with"]["py"]["turned_deg"] == 270);
        const Image<float> mended = read_image(folder / "b_py.tif");
        for (std::size_t i = 0; i < mended.size(); ++i) CHECK(mended.data()[i] == sky.cube.faces[2].data()[i]);
    }

    TEST_CASE("cubemap: filters write their levels") {
        const Folder folder;
        write_faces(folder, "sky_%s.tif", 32);
        CHECK(cubemap_json(folder, "sky_%s.tif --mips -o mips_%s.tif")["levels"] == 6);
        CHECK(cubemap_json(folder, "sky_%s.tif --mips --to openexr-cube -o cube.exr")["levels"].get<int>() >= 6);
        CHECK(read_image_info(folder / "cube.exr").environment == EnvironmentTag::cube);
        const nlohmann::json irradiance = cubemap_json(folder, "sky_%s.tif --irradiance sh:3 --size 8 -o sh_%s.tif");
        CHECK(irradiance["width"] == 8);
        CHECK(cubemap_json(folder, "sky_%s.tif --irradiance direct --size 16 --to latlong -o direct.tif")["width"] ==
              16);
        CHECK(cubemap_json(folder, "sky_%s.tif --specular ggx --roughness 0,0.3,1 --size 16 -o ggx_%s.exr")["levels"]
                  .get<int>() >= 3);
        CHECK(cubemap_json(folder, "sky_%s.tif --specular phong --roughness 50 --size 16 -o phong_%s.tif")["levels"] ==
              1);
    }

    TEST_CASE("cubemap: levels beyond the roughnesses are the mean over the solid angle, at any size") {
        // A bright lower right corner of every face: a mean that loses the last row and column would be far too dark.
        const Folder folder;
        for (const int n : {192, 64}) {
            for (const std::string& file : cube_files(folder / "s_%s.tif")) {
                Image<float> face(n, n, 1);
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x) face.at(x, y) = x > n / 2 && y > n / 2 ? 5.0f : 1.0f;
                write_image(file, face, {.depth = Depth::float32});
            }
            const int levels = int(std::log2(n)) + 1;
            const nlohmann::json result =
                cubemap_json(folder, "s_%s.tif --specular ggx --roughness 0,0.1 -o ggx_%s.tif --depth float");
            CHECK(result["levels"] == levels);
            double finest = 0, coarsest = 0;
            const std::vector<double> omega = texel_solid_angles(n / 2);
            for (const std::string& file : cube_files(folder / "ggx_%s.tif")) {
                const Image<float> blurred = read_level(file, 1), last = read_level(file, levels - 1);
                REQUIRE(blurred.width() == n / 2);
                REQUIRE(last.width() == 1);
                CHECK(read_level(file, levels).empty());
                for (std::size_t i = 0; i < omega.size(); ++i) finest += omega[i] * blurred.data()[i] / (4 * pi);
                coarsest += last.at(0, 0) / 6;
            }
            CHECK(coarsest == doctest::Approx(finest).epsilon(1e-5)); // floats
        }
    }

    TEST_CASE("cubemap: in every format with levels, those below one texel per face keep the sky's mean") {
        const Folder folder;
        for (int k = 0; k < 6; ++k) {
            Image<float> face(8, 8, 1);
            for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = float(k + 1);
            write_image(cube_files(folder / "s_%s.tif")[k], face, {.depth = Depth::float32});
        }
        for (const SkyFormatEntry& format : sky_formats) {
            if (!format.mips || format.format == SkyFormat::faces) continue;
            CAPTURE(std::string(format.name));
            const int levels =
                cubemap_json(folder, std::string("s_%s.tif --mips -o m.tif --to ") + format.name)["levels"];
            const Image<float> last = read_level(folder / "m.tif", levels - 1);
            REQUIRE(last.size() == 1);
            CHECK(last.at(0, 0) == doctest::Approx(3.5).epsilon(0.01));
        }
        // A strip of three texels has two faces in each.
        REQUIRE(cubemap(folder, "s_%s.tif --mips -o m.tif --to strip").code == 0);
        const Image<float> pairs = read_level(folder / "m.tif", 4);
        REQUIRE(pairs.height() == 3);
        for (int y = 0; y < 3; ++y) CHECK(pairs.at(0, y) == doctest::Approx(1.5 + 2 * y).epsilon(0.01));
    }

    TEST_CASE("cubemap: an ending in capitals is the same ending") {
        const Folder folder;
        CHECK(cubemap_json(folder, "labels --size 32 -o L.EXR")["to"] == "openexr-cube");
        CHECK(read_image_info(folder / "L.EXR").environment == EnvironmentTag::cube);
    }

    TEST_CASE("cubemap: the help and the documentation name every format") {
        const Folder folder;
        const std::string help = cubemap(folder, "--help").out;
        const std::string page = contents((own_meshes().parent_path() / "docs/cubemap.md").string());
        for (const SkyFormatEntry& format : sky_formats) {
            CAPTURE(std::string(format.name));
            CHECK(help.find(format.name) != std::string::npos);
            CHECK(page.find(format.name) != std::string::npos);
        }
    }

    TEST_CASE("cubemap: a scene is captured from a point, and what is captured is what is seen") {
        const Folder folder;
        REQUIRE(cubemap(folder, "labels --size 64 -o sky_%s.exr").code == 0);
        write_file(folder / "scene.toml", "[render]\nspp = 1\n[sky]\nfaces = \"sky_%s.exr\"\n");
        REQUIRE(cubemap(folder, "--capture scene.toml --at 0,1,0 --size 64 -o seen_%s.exr").code == 0);
        for (int k = 0; k < 6; ++k) {
            const Image<float> a = read_image(cube_files(folder / "sky_%s.exr")[k]),
                               b = read_image(cube_files(folder / "seen_%s.exr")[k]);
            double worst = 0;
            for (std::size_t i = 0; i < a.size(); ++i)
                worst = std::max(worst, double(std::abs(a.data()[i] - b.data()[i])));
            CHECK(worst < 2e-3); // floats of the ray's direction, and half floats of the files
        }
    }

    TEST_CASE("cubemap: usage is refused in one line, and nothing is left behind") {
        const Folder folder;
        write_faces(folder, "s_%s.tif", 4);
        write_flat(folder / "wide.tif", 8, 4, 1);
        refused(folder, "-o a.tif", 2, "no input");
        refused(folder, "wide.tif", 2, "--out");
        refused(folder, "wide.tif -o a.jpg", 2, "a.jpg");
        refused(folder, "wide.tif --to faces -o a.tif", 2, "%s");
        refused(folder, "wide.tif --to latlong -o a_%s.tif", 2, "%s");
        refused(folder, "wide.tif --to hcross --order openexr -o a.tif", 2, "--order");
        refused(folder, "s_%s.tif --from latlong -o a.tif", 2, "--from");
        refused(folder, "wide.tif --from faces -o a.tif", 2, "wide.tif");
        refused(folder, "wide.tif -o wide.tif", 2, "wide.tif");
        refused(folder, "wide.tif --irradiance sh:0 -o a_%s.tif", 2, "--irradiance");
        refused(folder, "wide.tif --irradiance cosine -o a_%s.tif", 2, "--irradiance");
        refused(folder, "wide.tif --specular ggx -o a_%s.tif", 2, "--roughness");
        refused(folder, "wide.tif --roughness 1 -o a_%s.tif", 2, "--specular");
        refused(folder, "wide.tif --specular ggx --roughness 0.1,x -o a_%s.tif", 2, "--roughness");
        refused(folder, "wide.tif --specular ggx --roughness 2 -o a_%s.tif", 2, "roughness");
        refused(folder, "wide.tif --specular ggx --roughness 0,0.1,0.2 --size 2 -o a_%s.tif", 2,
                "3 levels are more than the 2");
        refused(folder, "wide.tif --specular ggx --roughness 0,0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1 -o a_%s.tif", 2,
                "12 levels are more than");
        refused(folder, "wide.tif --mips --to hcross -o a.tif", 2, "a.tif");
        refused(folder, "wide.tif --size 5 --to latlong -o a.tif", 2, "--size");
        refused(folder, "--capture scene.toml -o a.tif", 2, "--at");
        refused(folder, "wide.tif --at 0,0,0 -o a.tif", 2, "--at");
        refused(folder, "wide.tif --samples 9 -o a.tif", 2, "--samples");
        refused(folder, "s_px.tif s_nx.tif s_py.tif s_ny.tif s_pz.tif -o a.tif", 2, "nz");
        refused(folder, "wide.tif -o nowhere/a.tif", 5, "nowhere/a.tif");
    }

    TEST_CASE("cubemap: help has examples") {
        const Folder folder;
        const Run run = cubemap(folder, "--help");
        CHECK(run.code == 0);
        CHECK(run.out.find("Examples:\n  bake cubemap ") != std::string::npos);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("cubemap: every bad input is refused by its name, and six files appear together or not at all") {
        const Folder folder;
        write_faces(folder, "s_%s.tif", 4);
        write_flat(folder / "one.tif", 1, 1, 1);
        write_flat(folder / "square.tif", 8, 8, 1);
        write_flat(folder / "odd.tif", 9, 4, 1);
        write_flat(folder / "row.tif", 2, 1, 1);
        write_file(folder / "empty.tif", "");
        fs::create_directory(folder.path / "folder.tif");
        refused(folder, "one.tif -o a_%s.tif", 4, "one.tif");
        refused(folder, "one.tif --from latlong -o a_%s.tif", 4, "one.tif");
        refused(folder, "square.tif -o a_%s.tif", 4, "square.tif");
        refused(folder, "odd.tif -o a_%s.tif", 4, "odd.tif");
        refused(folder, "square.tif --from latlong -o a_%s.tif", 4, "square.tif");
        refused(folder, "square.tif --from probe -o a_%s.tif", 4, "outside the disc");
        refused(folder, "odd.tif --from ball -o a_%s.tif", 4, "odd.tif");
        refused(folder, "square.tif --from ball --samples exact -o a_%s.tif", 2, "--samples");
        refused(folder, "odd.tif --from hcross -o a_%s.tif", 4, "odd.tif");
        refused(folder, "row.tif --from openexr-latlong -o a_%s.tif", 4, "row.tif");
        refused(folder, "row.tif --from latlong --to openexr-latlong --size 2 -o a.exr", 2, "--size 2");
        refused(folder, "empty.tif -o a_%s.tif", 3, "empty.tif");
        refused(folder, "folder.tif -o a_%s.tif", 3, "folder.tif");
        refused(folder, "gone.tif -o a_%s.tif", 3, "gone.tif");
        refused(folder, "gone_%s.tif -o a_%s.tif", 3, "gone_px.tif");
        write_flat(folder / "s_ny.tif", 8, 8, 1);
        refused(folder, "s_%s.tif -o a_%s.tif", 4, "s_ny.tif");
        write_flat(folder / "s_ny.tif", 4, 5, 1);
        refused(folder, "s_%s.tif -o a_%s.tif", 4, "s_ny.tif");
        write_flat(folder / "s_ny.tif", 4, 4, 1, 3);
        refused(folder, "s_%s.tif -o a_%s.tif", 4, "s_ny.tif");
        fs::remove(folder.path / "s_ny.tif");
        refused(folder, "s_%s.tif -o a_%s.tif", 3, "s_ny.tif");
    }

    TEST_CASE("cubemap: NaN, Inf, negative and too bright texels are counted, placed, and mended on demand") {
        const Folder folder;
        Image<float> sky(16, 8, 1);
        for (std::size_t i = 0; i < sky.size(); ++i) sky.data()[i] = 0.5f;
        sky.at(3, 2) = std::numeric_limits<float>::quiet_NaN();
        sky.at(4, 5) = -1;
        sky.at(9, 6) = std::numeric_limits<float>::infinity();
        write_image(folder / "bad.tif", sky, {.depth = Depth::float32});
        refused(folder, "bad.tif -o a_%s.tif", 4, "1 NaN, 1 infinite, 1 negative; first at column 3, row 2");
        const nlohmann::json zeroed = cubemap_json(folder, "bad.tif --bad zero -o a_%s.tif");
        CHECK(zeroed["mended"]["texels"] == 3);
        CHECK(zeroed["mended"]["first"] == nlohmann::json({3, 2}));
        for (const std::string& file : cube_files(folder / "a_%s.tif")) {
            const Image<float> face = read_image(file);
            for (std::size_t i = 0; i < face.size(); ++i) CHECK((face.data()[i] >= 0 && face.data()[i] <= 0.51f));
        }
        Image<float> bright(16, 8, 1);
        for (std::size_t i = 0; i < bright.size(); ++i) bright.data()[i] = 1e6f;
        write_image(folder / "bright.tif", bright, {.depth = Depth::float32});
        refused(folder, "bright.tif -o b_%s.exr --depth half", 4, "65504");
        CHECK(cubemap_json(folder, "bright.tif -o b_%s.tif")["over_half"]["texels"] == 0);
        CHECK(cubemap_json(folder, "bright.tif -o c_%s.exr --depth half --bad clamp")["over_half"]["over"] == 6 * 16);
        CHECK(read_image(folder / "c_px.exr").at(1, 1) == 65504);
    }

    TEST_CASE(
        "cubemap: radiance that half floats cannot hold is written as float, with a note, in every kind of file") {
        const Folder folder;
        Image<float> bright(32, 16, 1);
        for (std::size_t i = 0; i < bright.size(); ++i) bright.data()[i] = i < 32 ? 1e6f : 1;
        write_image(folder / "bright.tif", bright, {.depth = Depth::float32});
        for (const char* how : {"-o b_%s.exr", "--to latlong -o b.exr", "-o b.exr", "--mips -o m_%s.exr",
                                "--irradiance direct --size 4 -o i_%s.exr"}) {
            const Run run = cubemap(folder, std::string("bright.tif ") + how);
            CAPTURE(how);
            CHECK(run.code == 0);
            CHECK(run.err.find("written as float") != std::string::npos);
        }
        CHECK(read_image_info(folder / "b_py.exr").type == SampleType::float32);
        CHECK(read_image(folder / "b_py.exr").at(4, 4) > 65504);
        // The largest half itself, and what resampling adds to it by rounding, fits.
        for (std::size_t i = 0; i < bright.size(); ++i) bright.data()[i] = i < 64 ? 65504 : 1;
        write_image(folder / "fits.tif", bright, {.depth = Depth::float32});
        CHECK(cubemap(folder, "fits.tif --yaw 7 --size 24 -o f_%s.exr").err == "");
        CHECK(read_image_info(folder / "f_py.exr").type == SampleType::half);
        CHECK(read_image(folder / "f_py.exr").at(12, 12) == 65504);
    }

    TEST_CASE("cubemap: tiny negative values become 0 with a note, larger ones are refused, and render does the same") {
        const Folder folder;
        Image<float> sky(64, 32, 3);
        for (std::size_t i = 0; i < sky.size(); ++i) sky.data()[i] = 0.5f;
        sky.at(30, 10, 2) = -0.1f;
        write_image(folder / "ringing.tif", sky, {.depth = Depth::float32});
        const Run run = cubemap(folder, "ringing.tif --to latlong -o a.tif");
        CHECK(run.code == 0);
        CHECK(run.err.find("1 texels with negative values") != std::string::npos);
        CHECK(read_image(folder / "a.tif").at(30, 10, 2) == 0);
        CHECK(read_image(folder / "a.tif").at(30, 10, 1) == 0.5f);
        CHECK(cubemap(folder, "ringing.tif --to latlong -o a.tif --quiet").err == "");
        for (int x = 0; x < 64; ++x) sky.at(x, 10, 2) = -0.1f;
        write_image(folder / "negative.tif", sky, {.depth = Depth::float32});
        refused(folder, "negative.tif -o a_%s.tif", 4, "64 negative");
        const auto render = [&](const std::string& keys) {
            write_file(folder / "s.toml", "[render]\nsize = 4\nspp = 1\n[sky]\n" + keys);
            return run_bake(folder, {"render", "s.toml", "-o", "s.png"});
        };
        const Run told = render("image = \"ringing.tif\"\n");
        CHECK(told.code == 0);
        CHECK(told.err.find("1 texels with negative values") != std::string::npos);
        CHECK(render("image = \"negative.tif\"\n").code == 4);
        CHECK(render("image = \"negative.tif\"\nbad = \"clamp\"\n").code == 0);
    }

    TEST_CASE("cubemap: messages are plain words") {
        const Folder folder;
        write_faces(folder, "s_%s.tif", 4);
        const std::string mips = cubemap(folder, "s_%s.tif --mips --to hcross -o a.tif").err;
        CHECK(mips.find("give one of these formats in --to: faces, latlong, strip") != std::string::npos);
        const std::string missing = cubemap(folder, "s_px.tif s_nx.tif s_py.tif s_ny.tif s_pz.tif -o a.tif").err;
        CHECK(missing.find("the face nz is missing") != std::string::npos);
        write_flat(folder / "bad.tif", 8, 4, -1);
        const std::string bad = cubemap(folder, "bad.tif -o a_%s.tif").err;
        CHECK(bad.find("set --bad to zero or clamp") != std::string::npos);
    }

    TEST_CASE("cubemap: an interrupted or failing run leaves the old files as they were") {
        const Folder folder;
        write_flat(folder / "wide.tif", 256, 128, 1);
        REQUIRE(cubemap(folder, "wide.tif --size 16 -o a_%s.tif").code == 0);
        const std::string before = contents(folder / "a_py.tif");
        const auto names = folder.names();
        RunLimits small;
        small.file_bytes = 20000; // the disk is full
        CHECK(run_bake(folder, words("wide.tif --size 256 -o a_%s.tif"), small).code != 0);
        CHECK(folder.names() == names);
        RunLimits interrupted;
        interrupted.interrupt_after = 0.05;
        run_bake(folder, words("wide.tif --size 2048 --samples 4x4 -o a_%s.tif"), interrupted);
        CHECK(folder.names() == names);
        CHECK(contents(folder / "a_py.tif") == before);
    }

    TEST_CASE("cubemap: the same bytes for 1, 2 and 7 threads") {
        const Folder folder;
        Image<float> wide(128, 64, 1);
        for (std::size_t i = 0; i < wide.size(); ++i) wide.data()[i] = float(i * 2654435761u % 1000) / 100;
        write_image(folder / "wide.tif", wide, {.depth = Depth::float32});
        // More texels than one band and one tile hold.
        for (const std::string samples : {"1", "exact"}) {
            for (const std::string threads : {"1", "2", "7"})
                REQUIRE(cubemap(folder, "wide.tif --size 260 --yaw 33 --pitch 10 --samples " + samples + " -o t" +
                                            threads + ".tif --threads " + threads)
                            .code == 0);
            CHECK(contents(folder / "t1.tif") == contents(folder / "t2.tif"));
            CHECK(contents(folder / "t1.tif") == contents(folder / "t7.tif"));
        }
    }

} // TEST_SUITE
TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE(
        "cubemap: OpenEXR's two pictures of one scene show the same from inside, and their text is not mirrored") {
        const auto data = shared_data();
        const Folder folder;
        const std::string cube = (data / "environments/openexr/OrientationCube.exr").string(),
                          wide = (data / "environments/openexr/OrientationLatLong.exr").string();
        REQUIRE(cubemap(folder, cube + " --size 256 -o a_%s.exr --bad clamp").code == 0);
        REQUIRE(cubemap(folder, wide + " --size 256 -o b_%s.exr --bad clamp").code == 0);
        for (const char* name : {"a", "b"}) {
            write_file(folder / (std::string(name) + ".toml"),
                       "[render]\nsize = 128\n[camera]\nposition = [0, 0, 0]\ntarget = [0.4, 0.2, 1]\nfov-deg = "
                       "75\n[sky]\nfaces = \"" +
                           std::string(name) + "_%s.exr\"\n");
            REQUIRE(run_bake(folder, {"render", std::string(name) + ".toml", "-o", std::string(name) + ".exr"}).code ==
                    0);
        }
        const Image<float> a = read_image(folder / "a.exr"), b = read_image(folder / "b.exr");
        double same = 0, mirrored = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                for (int c = 0; c < 3; ++c) {
                    same += std::abs(std::min(a.at(x, y, c), 2.0f) - std::min(b.at(x, y, c), 2.0f)) / (3 * 128 * 128);
                    mirrored +=
                        std::abs(std::min(a.at(x, y, c), 2.0f) - std::min(b.at(127 - x, y, c), 2.0f)) / (3 * 128 * 128);
                }
        MESSAGE("mean difference " << same << ", mirrored " << mirrored);
        CHECK(same < 0.03);
        CHECK(same < 0.25 * mirrored);
    }

} // TEST_SUITE
