// bake cubemap --for: what engines load.
#include "bake/base/vec.h"
#include "bake/environment/engine/engine_levels.h"
#include "bake/environment/file/environment_io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
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

nlohmann::json json_of(const Folder& folder, const std::string& line) {
    const Run run = run_bake(folder, words(line + " --json"));
    CAPTURE(line);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    return nlohmann::json::parse(run.out);
}

/// A lat-long of a bright upper half, brighter ahead and to the right.
void write_sky(const std::string& path) {
    Image<float> sky(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                const double azimuth = 2 * 3.14159265 * (x + 0.5) / 64, up = std::cos(3.14159265 * (y + 0.5) / 32);
                sky.at(x, y, c) = float((1 + 0.2 * c) * (2 + up - 0.6 * std::cos(azimuth) - 0.3 * std::sin(azimuth)));
            }
    write_image(path, sky, {.depth = Depth::float32});
}

const std::set<std::string> set_of(const std::string& ending, const std::string& dfg) {
    return {"environment" + ending, "skybox" + ending, "irradiance" + ending, "dfg" + dfg, "sh.txt"};
}

std::set<std::string> names_in(const std::string& path) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(path)) names.insert(entry.path().filename().string());
    return names;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("cubemap --for: one run writes the whole set of each engine into a folder") {
        const Folder folder;
        write_sky(folder / "sky.tif");
        struct Expected {
            const char *consumer, *ending, *dfg, *texels;
            int levels;
            double relative;
        };
        for (const Expected& e : {Expected{"three", ".dds", ".dds", "bc6h", 2, 0.02},
                                  {"bevy", ".ktx2", ".ktx2", "rgb9e5", 2, 2e-3},
                                  {"babylon", ".dds", ".dds", "half", 5, 3e-4},
                                  {"filament", ".ktx", ".ktx2", "half", 2, 3e-4}}) {
            CAPTURE(e.consumer);
            const std::string size =
                e.consumer == std::string("bevy") || e.consumer == std::string("filament") ? "32" : "16";
            const auto json = json_of(folder, std::string("sky.tif --for ") + e.consumer + " --size " + size + " -o " +
                                                  e.consumer + "/");
            CHECK(names_in(folder / e.consumer) == set_of(e.ending, e.dfg));
            CHECK(json["for"] == e.consumer);
            CHECK(json["sh"].size() == 9);
            CHECK(json["roughness"].size() == std::size_t(e.levels));
            for (const auto& file : json["files"]) {
                if (!file.contains("relative_rmse")) continue;
                CAPTURE(file.dump());
                CHECK(file["texels"] == e.texels);
                CHECK(file["relative_rmse"].get<double>() < e.relative);
                CHECK(file["relative_rmse"].get<double>() > 0);
                CHECK(file["flux_error"].get<double>() < 2e-3);
                CHECK(file["clamped"] == 0);
                CHECK(file["bytes"] == fs::file_size(folder / file["file"].get<std::string>()));
            }
        }
    }

    TEST_CASE("cubemap --for: every form is read back as the sky that it was made from") {
        const Folder folder;
        write_sky(folder / "sky.tif");
        json_of(folder, "sky.tif --size 32 -o truth.tif");
        const Image<float> truth = read_image(folder / "truth.tif");
        for (const std::string ending : {"dds", "ktx2"})
            for (const std::string texels : {"rgb9e5", "half", "bc6h"}) {
                CAPTURE(ending);
                CAPTURE(texels);
                const std::string file = "env_" + texels + "." + ending;
                json_of(folder, "sky.tif --for three --size 32 --texels " + texels + " -o " + file);
                json_of(folder, file + " -o again.tif");
                const Image<float> again = read_image(folder / "again.tif");
                REQUIRE(again.height() == truth.height());
                double most = 0;
                for (int y = 0; y < truth.height(); ++y)
                    for (int x = 0; x < truth.width(); ++x)
                        for (int c = 0; c < 3; ++c)
                            most = std::max(most, std::abs(double(again.at(x, y, c) / truth.at(x, y, c)) - 1));
                CHECK(most < (texels == "bc6h" ? 0.06 : 5e-3));
            }
    }

    TEST_CASE("cubemap --for: levels as files, and pictures for engines that filter themselves") {
        const Folder folder;
        write_sky(folder / "sky.tif");
        json_of(folder, "sky.tif --for three --size 32 --levels-as-files -o levels/");
        CHECK(names_in(folder / "levels").count("environment_2.dds") == 1);
        CHECK(read_image(folder / "levels/environment_2.dds").width() == 8);
        CHECK(json_of(folder, "sky.tif --for unreal --yaw 180 -o sky.hdr")["yaw_deg"] == 180); // to and back
        json_of(folder, "sky.tif --for godot -o godot/");
        const Image<float> truth = read_image(folder / "sky.tif");
        for (const std::string file : {"sky.hdr", "godot/panorama.exr"}) {
            CAPTURE(file);
            const Image<float> picture = read_image(folder / file);
            REQUIRE(picture.width() == 64);
            for (int x = 0; x < 64; x += 7)
                CHECK(double(picture.at(x, 9, 1)) == doctest::Approx(double(truth.at(x, 9, 1))).epsilon(0.01));
        }
    }

    TEST_CASE("cubemap --for: a lat-long has each direction where the program looks it up") {
        const Folder folder;
        Image<float> sky(64, 32, 3); // in the axes of glTF: radiance 2 + direction
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x) {
                const double azimuth = 2 * pi * ((x + 0.5) / 64 - 0.5), polar = pi * (y + 0.5) / 32;
                sky.at(x, y, 0) = float(2 - std::sin(polar) * std::sin(azimuth));
                sky.at(x, y, 1) = float(2 + std::cos(polar));
                sky.at(x, y, 2) = float(2 + std::sin(polar) * std::cos(azimuth));
            }
        write_image(folder / "sky.tif", sky, {.depth = Depth::float32});
        // u of a direction, by the formula of each program and in its own axes.
        struct Program {
            const char *name, *middle;
            double (*u)(double x, double z); ///< of the axes of a glTF file, as the program imports it
        };
        const Program programs[] = {
            {"three", "+X", [](double x, double z) { return std::atan2(z, x) / (2 * pi) + 0.5; }},
            {"blender", "+X", [](double x, double z) { return 0.5 - std::atan2(-z, x) / (2 * pi); }}, // its y is -z
            {"godot", "+Z", [](double x, double z) { return std::atan2(x, -z) / (2 * pi); }},
            {"unity", "+Z", [](double x, double z) { return 1 - std::atan2(-x, -z) / (2 * pi); }}, // its x is -x
            {"unreal", "-Z", [](double x, double z) { return (1 + std::atan2(x, -z) / pi) / 2; }}, // its y is z
            {"substance", "-X", [](double x, double z) { return std::atan2(-z, -x) / (2 * pi) + 0.5; }},
        };
        for (const Program& program : programs) {
            CAPTURE(std::string(program.name));
            const Run run = run_bake(folder, words(std::string("sky.tif --for ") + program.name + " -o made.hdr"));
            REQUIRE(run.code == 0);
            CHECK(run.out.find(program.name + std::string(" has ") + program.middle) != std::string::npos);
            const Image<float> made = read_image(folder / "made.hdr");
            for (double azimuth = 0.1; azimuth < 2 * pi; azimuth += 0.7) {
                const double x = std::sin(azimuth), z = std::cos(azimuth), u = program.u(x, z);
                const int column = std::min(63, int(64 * (u - std::floor(u))));
                CHECK(std::abs(double(made.at(column, 16, 0)) - 2 - x) < 0.1);
                CHECK(std::abs(double(made.at(column, 16, 2)) - 2 - z) < 0.1);
                CHECK(made.at(column, 4, 1) > 2.8f);
            }
        }
    }

    TEST_CASE("cubemap: spherical harmonics are printed and written") {
        const Folder folder;
        write_sky(folder / "sky.tif");
        const auto json = json_of(folder, "sky.tif --irradiance sh:3 --sh sh.txt -o e.tif");
        REQUIRE(json["sh"].size() == 9);
        std::istringstream text(contents(folder / "sh.txt"));
        for (const auto& coefficient : json["sh"])
            for (const auto& channel : coefficient) {
                double value = 0;
                text >> value;
                CHECK(value == doctest::Approx(channel.get<double>()));
            }
        const Run run = run_bake(folder, words("sky.tif --irradiance sh:3 -o e.tif"));
        CHECK(run.out.find("sh 2  2: ") != std::string::npos);
    }

    TEST_CASE("cubemap --for: refusals") {
        const Folder folder;
        write_sky(folder / "sky.tif");
        const auto refused = [&](const std::string& line, const std::string& named) {
            check_refused(folder, words("sky.tif " + line), 2, named);
        };
        refused("--for three --size 100 -o a.dds", "give a power of two");
        refused("--for three -o a.tif", "write .dds or .ktx2");
        refused("--for godot -o a.dds", "write .hdr or .exr");
        refused("--for bevy -o a.hdr", "is no cube map for bevy");
        refused("--for three --texels half -o a.hdr", "gets a lat-long");
        refused("--for three --sh a.txt -o a.hdr", "gets a lat-long");
        refused("--for three --mips -o a.dds", "leave out --irradiance");
        refused("--for three --to latlong -o a.dds", "leave out --to");
        refused("--for three --levels-as-files -o a.dds", "needs a folder");
        refused("--for godot --texels half -o a.exr", "--texels");
        refused("--texels half -o a.exr", "add an engine");
        refused("--sh a.txt -o a.exr", "--sh: is for");
        refused("--for filament --texels bc6h -o a.ktx", "holds half floats");
    }
}
