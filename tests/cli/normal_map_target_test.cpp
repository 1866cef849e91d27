// bake normal-map for a program that loads it (--for), like a map by another program (--like), and repeated (--repeat).
#include "bake/base/provenance.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

using Json = nlohmann::json;

/// Waves that fit `times` times along u and v.
void write_waves(const std::string& file, int width, int height, int times = 1) {
    Image<float> waves(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            waves.at(x, y) = float(0.5 + 0.2 * std::sin(2 * M_PI * times * (x + 0.5) / width) +
                                   0.2 * std::cos(2 * M_PI * times * (y + 0.5) / height));
    write_image(file, waves, {.depth = Depth::u16});
}

double largest_difference(const std::string& a, const std::string& b) {
    const Image<float> one = read_image(a), other = read_image(b);
    if (one.size() != other.size()) return 1;
    double most = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        most = std::max(most, double(std::abs(one.data()[i] - other.data()[i])));
    return most;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("--for: sets green, depth and, in a folder, the name, as each program expects them") {
        const Folder folder;
        write_waves(folder / "brick.png", 32, 32);
        const struct {
            const char *name, *file;
            bool down;
            int bits;
        } engines[] = {{"unreal", "T_brick_N.png", true, 8},    {"unity", "brick_Normal.png", false, 8},
                       {"godot", "brick_normal.png", false, 8}, {"blender", "brick_normal.png", false, 16},
                       {"three", "brick_normal.png", false, 8}, {"substance", "brick_normal.png", true, 16}};
        for (const auto& e : engines) {
            CAPTURE(e.name);
            const std::string out = std::string(e.name) + "/";
            const Run run =
                run_bake(folder, {"normal-map", "brick.png", "--for", e.name, "-o", out, "--amplitude", "0.05"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            CHECK(run.err.empty());
            const ImageInfo info = read_image_info(folder / (out + e.file));
            CHECK(info.bits == e.bits);
            CHECK(record_word(info.record, "green") == (e.down ? "down" : "up"));
            REQUIRE(run_bake(folder, {"normal-map", "brick.png", "-o", "plain.png", "--amplitude", "0.05", "--depth",
                                      std::to_string(e.bits)})
                        .code == 0);
            CHECK((largest_difference(folder / (out + e.file), folder / "plain.png") > 0.01) == e.down);
        }
    }

    TEST_CASE("--for: a size that the program changes is told, contradictions and folders without it are refused") {
        const Folder folder;
        write_waves(folder / "brick.png", 24, 32);
        const auto err = [&](const std::string& engine) {
            const Run run = run_bake(folder, {"normal-map", "brick.png", "--for", engine, "-o", "n.png"});
            REQUIRE(run.code == 0);
            return run.err;
        };
        CHECK(err("unreal").find("24 x 32: Unreal makes no mips") != std::string::npos);
        CHECK(err("three").find("24 x 32") == std::string::npos);
        check_refused(folder, {"normal-map", "brick.png", "--for", "unity", "--directx", "-o", "n.png"}, 2,
                      "--directx, --for unity");
        check_refused(folder, {"normal-map", "brick.png", "-o", "maps/"}, 2, "is a folder");
        check_refused(folder, {"normal-map", "brick.png", "--for", "quake", "-o", "n.png"}, 2, "quake");
        check_refused(folder, {"normal-map", "missing.png", "--for", "unity", "-o", "gone/"}, 3, "missing.png");
        CHECK(!fs::exists(folder.path / "gone"));
    }

    TEST_CASE("--like: takes strength, green and inversion of a map by another program") {
        const Folder folder;
        write_waves(folder / "h.png", 64, 64);
        const std::vector<std::vector<std::string>> authors = {
            {"--amplitude", "0.07"}, {"--amplitude", "0.02", "--directx"}, {"--amplitude", "0.04", "--invert"}};
        for (const std::vector<std::string>& options : authors) {
            std::vector<std::string> words = {"normal-map", "h.png", "-o", "author.png"};
            words.insert(words.end(), options.begin(), options.end());
            REQUIRE(run_bake(folder, words).code == 0);
            const Run run = run_bake(folder, {"normal-map", "h.png", "--like", "author.png", "-o", "ours.png"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            CHECK(largest_difference(folder / "author.png", folder / "ours.png") < 2e-3);
        }
        write_image(folder / "other.png", Image<float>(64, 64, 3), {.depth = Depth::u8});
        check_refused(folder, {"normal-map", "h.png", "--like", "other.png", "-o", "n.png"}, 4, "other.png");
        check_refused(folder, {"normal-map", "h.png", "--like", "author.png", "--amplitude", "1", "-o", "n.png"}, 2,
                      "--like");
    }

    TEST_CASE("--like: with --repeat each copy is as steep as the author's map") {
        const Folder folder;
        write_waves(folder / "h.png", 64, 64);
        write_file(folder / "q.obj",
                   "v 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
        REQUIRE(run_bake(folder, {"normal-map", "h.png", "--amplitude", "0.07", "-o", "author.png"}).code == 0);
        const Image<float> author = read_image(folder / "author.png");
        for (const bool on_mesh : {true, false}) {
            std::vector<std::string> words = {"normal-map", "--height", "h.png", "--like", "author.png",
                                              "--repeat",   "3,2",      "-o",    "n.png",  "--size",
                                              "192x128",    "--filter", "sobel"};
            if (on_mesh) words.insert(words.begin() + 1, "q.obj");
            else words.insert(words.end(), {"--extent", "6,4"});
            const Run run = run_bake(folder, words);
            REQUIRE_MESSAGE(run.code == 0, run.err);
            const Image<float> map = read_image(folder / "n.png");
            double most = 0;
            for (int y = 0; y < 128; ++y)
                for (int x = 0; x < 192; ++x)
                    for (int c = 0; c < 3; ++c)
                        most = std::max(most, double(std::abs(map.at(x, y, c) - author.at(x % 64, y % 64, c))));
            CHECK(most < 0.02);
        }
    }

    TEST_CASE("--repeat: a mesh with the height N times is that with a height of N times as many waves") {
        const Folder folder;
        write_waves(folder / "once.png", 32, 32);
        write_waves(folder / "often.png", 96, 64, 1);
        Image<float> often(96, 64, 1);
        const Image<float> once = read_image(folder / "once.png");
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) often.at(x, y) = once.at(x % 32, y % 32);
        write_image(folder / "often.png", often, {.depth = Depth::u16});
        write_file(folder / "q.obj",
                   "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
        const auto map = [&](const std::string& height, const std::string& out, const std::vector<std::string>& more) {
            std::vector<std::string> words = {"normal-map", "q.obj",  "--height", height,     "-o",
                                              out,          "--size", "96x64",    "--filter", "c2"};
            words.insert(words.end(), more.begin(), more.end());
            const Run run = run_bake(folder, words);
            REQUIRE_MESSAGE(run.code == 0, run.err);
        };
        map("once.png", "a.png", {"--repeat", "3,2"});
        map("often.png", "b.png", {});
        CHECK(largest_difference(folder / "a.png", folder / "b.png") == 0);
        const auto displaced = [&](const std::string& height, const std::string& out,
                                   const std::vector<std::string>& more) {
            std::vector<std::string> words = {"displace", "q.obj", "--height", height, "-o", out, "--levels", "4"};
            words.insert(words.end(), more.begin(), more.end());
            REQUIRE(run_bake(folder, words).code == 0);
            const std::string text = contents(folder / out);
            return text.substr(text.find('\n')); // behind the record
        };
        CHECK(displaced("once.png", "a.obj", {"--repeat", "3,2"}) == displaced("often.png", "b.obj", {}));
        check_refused(
            folder, {"normal-map", "q.obj", "--height", "once.png", "--repeat", "2", "--wrap", "clamp", "-o", "n.png"},
            2, "--repeat");
        for (const char* wrong : {"0", "1.5", "2,", "2,3,4", "x"})
            check_refused(folder, {"normal-map", "q.obj", "--height", "once.png", "--repeat", wrong, "-o", "n.png"}, 2,
                          "--repeat");
    }
}
