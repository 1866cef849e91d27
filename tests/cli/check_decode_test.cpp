// bake check --decode from outside: maps of one tile of the uvs, and of all of them.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

using namespace bake;
using namespace bake::test;

namespace {

/// two.obj: a square in tile 1001 and one in 1002 that is twice as wide in space, and n.1001.exr and n.1002.exr, which lean.
struct Tiles : Folder {
    Tiles() {
        write_file(*this / "two.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 3 1 0\n"
                                      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\n"
                                      "f 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n");
        Image<float> map(4, 4, 3);
        const float n[] = {float(0.5 + std::sqrt(0.125)), 0.5f, float(0.5 + std::sqrt(0.125))};

        for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = n[i % 3];
        for (const char* tile : {"1001", "1002"})
            write_image(*this / (std::string("n.") + tile + ".exr"), map, {.depth = Depth::float32});
    }
};

nlohmann::json files(const Folder& folder, const std::string& map, std::vector<std::string> more = {}, int code = 0) {
    std::vector<std::string> all = {"check", "--json", "--decode", map, "two.obj"};
    all.insert(all.end(), more.begin(), more.end());
    const Run run = run_bake(folder, all);
    CAPTURE(run.err);
    CHECK(run.code == code);
    return nlohmann::json::parse(run.out)["files"];
}

/// Degrees by which frames from derivatives differ in the mean.
double by_derivatives(const nlohmann::json& report) { return report["decodings"][2]["mean_deg"]; }

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("check --decode: <UDIM> in the name checks each tile against its own charts") {
        const Tiles folder;
        const nlohmann::json all = files(folder, "n.<UDIM>.exr");
        REQUIRE(all.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(all[i]["file"] == (i == 0 ? "n.1001.exr" : "n.1002.exr"));
            CHECK(all[i]["tile"] == (i == 0 ? 1001 : 1002));
            CHECK(all[i]["texels"] == 16);
        }
        // In the wide square p_u is twice as long as p_v, and slopes along it are halved.
        CHECK(by_derivatives(all[0]) < 1e-3);
        CHECK(by_derivatives(all[1]) == doctest::Approx(45 - std::atan(0.5) * 180 / std::numbers::pi).epsilon(1e-4));
        const nlohmann::json second = files(folder, "n.1002.exr", {"--tile", "1002"});
        REQUIRE(second.size() == 1);
        CHECK(second[0] == all[1]);
        CHECK(run_bake(folder, {"check", "--decode", "n.1002.exr", "two.obj", "--tile", "1002"}).out.find("tile") !=
              std::string::npos);
    }

    TEST_CASE("check --decode: a tile that is missing, that has no charts, or that is not named") {
        const Tiles folder;
        std::filesystem::remove(folder / "n.1001.exr");
        const nlohmann::json one = files(folder, "n.<UDIM>.exr", {}, 3);
        REQUIRE(one.size() == 2);
        CHECK(one[0]["code"] == 3);
        CHECK(one[1]["texels"] == 16); // the others are checked all the same
        CHECK(files(folder, "n.1002.exr", {"--tile", "1003"}, 4)[0]["error"].get<std::string>().find("1003") !=
              std::string::npos);
        CHECK(files(folder, "n.1002.exr", {}, 4)[0]["error"].get<std::string>().find("--tile") != std::string::npos);
        check_refused(folder, {"check", "--decode", "n.<UDIM>.exr", "none.obj"}, 3, "none.obj: no such file");
    }

    TEST_CASE("check --decode: --tile goes with it alone, and not with the names of all tiles") {
        const Tiles folder;
        check_refused(folder, {"check", "two.obj", "--tile", "1001"}, 2, "--tile requires --decode");
        check_refused(folder, {"check", "--decode", "n.<UDIM>.exr", "two.obj", "--tile", "1001"}, 2,
                      "--tile: <UDIM> in the name of the map asks for all tiles");
    }

} // TEST_SUITE
