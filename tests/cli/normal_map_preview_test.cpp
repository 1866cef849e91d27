// bake normal-map --preview: a picture of the map beside it.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// A round bump in the middle.
void write_bump(const std::string& file) {
    Image<float> bump(64, 64, 1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            bump.at(x, y) = float(std::exp(-(std::pow(x - 31.5, 2) + std::pow(y - 31.5, 2)) / 150));
    write_image(file, bump, {.depth = Depth::u16});
}

Run preview(const Folder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "normal-map");
    arguments.insert(arguments.end(), {"--preview", "p.png", "--preview-size", "48"});
    const Run run = run_bake(folder, arguments);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run;
}

/// How much brighter the upper left flank of what is in the middle is than the lower right one.
double lit_from_upper_left(const std::string& file) {
    const Image<float> picture = read_image(file);
    REQUIRE(picture.width() == 48);
    double difference = 0;
    for (int k = 3; k < 9; ++k) difference += double(picture.at(24 - k, 24 - k, 1) - picture.at(24 + k, 24 + k, 1)) / 6;
    return difference;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("normal-map --preview: what rises is bright at its upper left, whatever way green points") {
        const Folder folder;
        write_bump(folder / "bump.png");
        for (const std::string engine : {"unreal", "three"})
            for (const bool dent : {false, true}) {
                CAPTURE(engine);
                CAPTURE(dent);
                std::vector<std::string> arguments = {"bump.png", "--for", engine, "-o", "n.png", "--amplitude", "0.1"};
                if (dent) arguments.push_back("--invert");
                const Run run = preview(folder, arguments);
                CHECK(run.out.find("p.png: preview, 48 pixels") != std::string::npos);
                CHECK(lit_from_upper_left(folder / "p.png") * (dent ? -1 : 1) > 0.15);
            }
        preview(folder, {"bump.png", "-o", "n.exr", "--size", "64x16", "--amplitude", "0.1"});
        CHECK(read_image(folder / "p.png").height() == 48); // the rectangle is that of the height
        // The rectangle fills the picture.
        preview(folder, {"bump.png", "-o", "n.exr", "--extent", "2,1", "--amplitude", "0.1"});
        const Image<float> wide = read_image(folder / "p.png");
        CHECK(wide.width() == 48);
        CHECK(wide.height() == 24);
        CHECK(wide.at(0, 0, 1) == doctest::Approx(double(wide.at(47, 23, 1))).epsilon(0.05));
        CHECK(double(wide.at(20, 10, 1) - wide.at(27, 13, 1)) > 0.1);
    }

    TEST_CASE(
        "normal-map --preview: on a mesh, from a height, a high-poly mesh and bevels; the map is the same without") {
        const Folder folder;
        write_bump(folder / "bump.png");
        const std::string torus = (own_meshes() / "torus.obj").string();
        struct Bake {
            std::vector<std::string> arguments;
            const char* out;
        };
        const Bake bakes[] = {{{torus, "--height", "bump.png", "--amplitude", "2%", "--size", "64"}, "n.png"},
                              {{torus, "--height", "bump.png", "--amplitude", "2%", "--size", "64"}, "n.dds"},
                              {{torus, "--height", "bump.png", "--amplitude", "2%", "--size", "64"}, "n.glb"},
                              {{torus, "--high", torus, "--size", "64"}, "n.png"},
                              {{torus, "--bevel", "1%", "--size", "64"}, "n.png"}};
        for (const Bake& bake : bakes) {
            CAPTURE(std::string(bake.out));
            std::vector<std::string> arguments = bake.arguments;
            arguments.insert(arguments.end(), {"-o", bake.out, "--json"});
            const auto json = nlohmann::json::parse(preview(folder, arguments).out);
            CHECK(json["preview"] == "p.png");
            CHECK(json["outputs"].size() == 2);
            const Image<float> picture = read_image(folder / "p.png");
            CHECK(picture.width() == 48);
            CHECK(std::abs(picture.at(24, 24, 1) - picture.at(1, 1, 1)) > 0.05f);
            const std::string with = contents(folder / bake.out);
            arguments.insert(arguments.begin(), "normal-map");
            REQUIRE(run_bake(folder, arguments).code == 0);
            CHECK(contents(folder / bake.out) == with);
        }
    }

    TEST_CASE("normal-map --preview: refusals") {
        const Folder folder;
        write_bump(folder / "bump.png");
        const std::string torus = (own_meshes() / "torus.obj").string();
        const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& named) {
            arguments.insert(arguments.begin(), "normal-map");
            check_refused(folder, arguments, code, named);
        };
        const std::vector<std::string> mesh = {torus, "--height", "bump.png"};
        const auto on_mesh = [&](std::vector<std::string> more) {
            more.insert(more.begin(), mesh.begin(), mesh.end());
            return more;
        };
        refused(on_mesh({"-o", "n.png", "--preview", "p.png", "--space", "object"}), 2,
                "--preview: shows maps in tangent");
        refused(on_mesh({"-o", "n.<UDIM>.png", "--preview", "p.png"}), 2, "--preview: shows one map");
        refused(on_mesh({"-o", "n.png", "--preview", "p.png", "--tile", "1001"}), 2, "--preview: shows one map");
        refused({"bump.png", "-o", "n.png", "--preview", "p.dds"}, 2, "p.dds");
        refused({"bump.png", "-o", "n.png", "--preview", "n.png"}, 2, "n.png");
        refused({"bump.png", "-o", "n.png", "--preview", "bump.png"}, 2, "bump.png");
        refused({"bump.png", "-o", "n.png", "--preview", "missing/p.png"}, 5, "missing");
        refused({"bump.png", "-o", "n.png", "--preview-size", "64"}, 2, "--preview-size");
    }
}
