// What the bakes say of a picture that is hardly a height, and the options by which check --pair reproduces a map.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

using namespace bake;
using namespace bake::test;

namespace {

template <class Value> std::string picture(const std::string& file, int channels, const Value& value) {
    Image<float> image(64, 64, channels);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = float(value(x, y, c));
    write_image(file, image, {.depth = Depth::u16});
    return file;
}

double wave(int x, int y) {
    return 0.5 + 0.3 * std::sin(2 * std::numbers::pi * 3 * x / 64) + 0.15 * std::cos(2 * std::numbers::pi * 2 * y / 64);
}

const char* const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

/// The three bakes of one height.
std::vector<std::vector<std::string>> bakes() {
    return {{"bump-table", "h.png", "-o", "t.exr"},
            {"normal-map", "--height", "h.png", "--amplitude", "0.02", "-o", "n.exr"},
            {"displace", "square.obj", "--height", "h.png", "--amplitude", "0.02", "-o", "d.obj"}};
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE(
        "bakes: one note each for a height that breaks at its border, that is a normal map, or that has one value") {
        const Folder folder;
        write_file(folder / "square.obj", square);
        const auto check_note = [&](const std::string& words, const std::vector<std::string>& more = {}) {
            for (std::vector<std::string> bake : bakes()) {
                CAPTURE(bake[0]);
                bake.insert(bake.end(), more.begin(), more.end());
                const Run run = run_bake(folder, bake);
                CHECK(run.code == 0);
                const std::string mention = words.empty() ? "h.png: " : "h.png: " + words;
                CHECK((run.err.find(mention) != std::string::npos) == !words.empty());
                bake.push_back("--json");
                const auto json = nlohmann::json::parse(run_bake(folder, bake).out);
                CHECK((json["notes"].dump().find(mention) != std::string::npos) == !words.empty());
            }
        };
        picture(folder / "h.png", 1, [](int x, int y, int) { return wave(x, y); });
        check_note("");
        picture(folder / "h.png", 1, [](int x, int, int) { return x / 63.0; });
        check_note("does not tile in x");
        check_note("", {"--wrap-u", "clamp"});
        picture(folder / "h.png", 1, [](int, int, int) { return 1; });
        check_note("every texel has the same value, 1");
        picture(folder / "h.png", 3, [](int x, int y, int c) {
            const double s = std::cos(2 * std::numbers::pi * 3 * x / 64),
                         t = std::sin(2 * std::numbers::pi * 2 * y / 64);
            const double z = 1 / std::sqrt(s * s + t * t + 1);
            return 0.5 + 0.5 * (c == 0 ? s * z : c == 1 ? t * z : z);
        });
        check_note("looks like a normal map");
        check_note("", {"--channel", "r"});
    }

    TEST_CASE("displace: a float map of zeros moves nothing, also inverted, and as vectors") {
        const Folder folder;
        write_file(folder / "square.obj", square);
        Image<float> zeros(8, 8, 3);
        std::fill_n(zeros.data(), zeros.size(), 0.0f);
        write_image(folder / "zeros.exr", zeros, {.depth = Depth::half});
        for (const std::vector<std::string>& more :
             std::vector<std::vector<std::string>>{{}, {"--invert"}, {"--amplitude", "3"}, {"--vector", "tangent"}}) {
            std::vector<std::string> all = {"displace", "square.obj", "--height", "zeros.exr", "-o", "d.obj"};
            all.insert(all.end(), more.begin(), more.end());
            REQUIRE(run_bake(folder, all).code == 0);
            const Run run = run_bake(folder, {"check", "d.obj", "--against", "square.obj", "--json"});
            CHECK(double(nlohmann::json::parse(run.out)["files"][0]["hausdorff"]["upper"]) < 1e-9);
        }
        // The middle of an integer map lies on the surface.
        picture(folder / "h.png", 1, [](int, int, int) { return 0.75; });
        REQUIRE(
            run_bake(folder, {"displace", "square.obj", "--height", "h.png", "--amplitude", "1", "-o", "d.obj"}).code ==
            0);
        const Run run = run_bake(folder, {"check", "d.obj", "--against", "square.obj", "--json"});
        CHECK(double(nlohmann::json::parse(run.out)["files"][0]["hausdorff"]["upper"]) ==
              doctest::Approx(0.25).epsilon(0.01));
    }

    TEST_CASE("check --pair: the options that it prints reproduce the map") {
        const Folder folder;
        picture(folder / "h.png", 1, [](int x, int y, int) { return wave(x, y); });
        const std::vector<std::string> bake = {"normal-map", "--height", "h.png"};
        const auto baked = [&](const std::string& out, const std::string& options) {
            std::vector<std::string> all = bake;
            all.insert(all.end(), {"-o", out});
            std::istringstream words(options);
            for (std::string word; words >> word;) all.push_back(word);
            const Run run = run_bake(folder, all);
            REQUIRE_MESSAGE(run.code == 0, run.err);
            return read_image(folder / out);
        };
        for (const char* options : {"--amplitude 0.05", "--amplitude 0.02 --invert --directx",
                                    "--amplitude 0.1 --directx", "--amplitude 0.05 --extent 1,2 --invert"}) {
            CAPTURE(options);
            const Image<float> author = baked("author.png", options);
            const Run run = run_bake(folder, {"check", "--pair", "h.png", "author.png", "--json"});
            REQUIRE(run.code == 0);
            const auto pair = nlohmann::json::parse(run.out)["files"][0];
            const std::string found = pair["bake_options"];
            CAPTURE(found);
            const Image<float> again = baked("again.png", found);
            double worst = 0;
            for (std::size_t i = 0; i < author.size(); ++i)
                worst = std::max(worst, double(std::abs(author.data()[i] - again.data()[i])));
            CHECK(worst < 0.02);
        }
    }

    TEST_CASE("render: a normal map of two channels is rendered with its z rebuilt, and a note says so") {
        const Folder folder;
        write_file(folder / "square.obj", square);
        const auto store = [](bool blue) {
            return [blue](int x, int y, int c) {
                const double s = 0.5 * std::sin(0.3 * x), t = 0.5 * std::cos(0.2 * y);
                return c == 0   ? 0.5 + 0.5 * s
                       : c == 1 ? 0.5 + 0.5 * t
                       : blue   ? 0.5 + 0.5 * std::sqrt(1 - s * s - t * t)
                                : 0;
            };
        };
        picture(folder / "whole.png", 3, store(true));
        picture(folder / "two.png", 3, store(false));
        const auto shot = [&](const std::string& map, bool noted) {
            write_file(folder / "s.toml",
                       "[render]\nsize = 32\nspp = 1\n[[light]]\ntype = \"directional\"\nfrom = [1, 1, 2]\n"
                       "[[material]]\nname = \"m\"\nnormal = \"" +
                           map + "\"\n[[mesh]]\nfile = \"square.obj\"\nmaterial = \"m\"\n");
            const Run run = run_bake(folder, {"render", "s.toml", "-o", "r.exr", "--depth", "float"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            CHECK((run.err.find("z is rebuilt") != std::string::npos) == noted);
            return read_image(folder / "r.exr");
        };
        const Image<float> whole = shot("whole.png", false), two = shot("two.png", true);
        double worst = 0;
        for (std::size_t i = 0; i < whole.size(); ++i)
            worst = std::max(worst, double(std::abs(whole.data()[i] - two.data()[i])));
        CHECK(worst < 1e-3);
    }
}
