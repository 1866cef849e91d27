// Damaged files through the verbs that bake; check has its own test of them.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace {

const std::string dots = (own_meshes() / "dots.png").string();

/// Answered at once and in little memory: done, or refused in one line that names the file and leaves nothing behind.
/// Returns the exit code.
int answered(const Folder& folder, std::vector<std::string> arguments, const fs::path& input, const std::string& out) {
    CAPTURE(input.string());
    arguments.insert(arguments.end(), {"-o", out});
    const auto before = folder.names();
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    CHECK(run.seconds < 10);
    CHECK(run.peak_mib < 2048);
    if (run.code == 0) {
        CHECK(fs::remove(folder / out));
    } else {
        CHECK((run.code == 3 || run.code == 4));
        CHECK(run.out == "");
        CHECK(lines(run.err) == 1);
        CHECK(run.err.starts_with("bake: " + input.string()));
    }
    CHECK(folder.names() == before);
    return run.code;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("bad input: heights that hold NaN or Inf, vast values, or no such channel are unsuitable") {
        const Folder folder;
        Image<float> image(4, 4, 1);
        for (const float bad :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f}) {
            std::fill_n(image.data(), 16, 0.5f);
            image.at(2, 1) = bad;
            write_image(folder / "h.exr", image, {.depth = Depth::float32});
            check_refused(folder, {"normal-map", "--height", "h.exr", "-o", "a.png"}, 4, "h.exr: 1 values");
            check_refused(folder, {"bump-table", "h.exr", "-o", "a.exr"}, 4, "(2, 1)");
        }
        check_refused(folder, {"bump-table", dots, "-o", "a.exr", "--channel", "a"}, 4, "alpha");
        check_refused(folder, {"bump-table", dots, "-o", "a.exr", "--channel", "luma"}, 4, "luma");
        check_refused(folder, {"normal-map", "--height", "absent.png", "-o", "a.png"}, 3, "absent.png: ");
        check_refused(folder, {"normal-map", "--height", ".", "-o", "a.png"}, 3, "folder");
        check_refused(folder, {"normal-map", "absent.obj", "--height", dots, "--amplitude", "1", "-o", "a.png"}, 3,
                      "absent.obj");
        check_refused(folder, {"normal-map", dots, "--height", dots, "--amplitude", "1", "-o", "a.png"}, 3, "dots.png");
    }

    TEST_CASE("bad input: the least pictures there are can be baked") {
        const Folder folder;
        for (const auto& [width, height] : {std::pair(1, 1), {1, 5}, {5, 1}, {2, 2}})
            for (const char* wrap : {"repeat", "clamp", "mirror"}) {
                Image<float> image(width, height, 1);
                for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float(i) / 8;
                write_image(folder / "h.png", image, {});
                for (const char* filter : {"central", "c2"}) {
                    CAPTURE(width);
                    CAPTURE(height);
                    CAPTURE(std::string(wrap));
                    REQUIRE(run_bake(folder, {"normal-map", "--height", "h.png", "-o", "n.exr", "--depth", "float",
                                              "--wrap", wrap, "--filter", filter})
                                .code == 0);
                    const Image<float> map = read_image(folder / "n.exr");
                    CHECK(map.width() == width);
                    for (std::size_t i = 0; i < map.size(); ++i) CHECK(std::isfinite(map.data()[i]));
                }
            }
        // One texel, and one row along v, are flat, whatever lies beyond.
        Image<float> image(1, 1, 1);
        image.at(0, 0) = 0.7f;
        write_image(folder / "h.png", image, {});
        REQUIRE(run_bake(folder, {"bump-table", "h.png", "-o", "b.exr", "--layout", "bumpslopes", "--depth", "float"})
                    .code == 0);
        const Image<float> moments = read_image(folder / "b.exr");
        CHECK(moments.at(0, 0, 0) == doctest::Approx(0.7).epsilon(1e-4));
        for (int c = 1; c < 6; ++c) CHECK(moments.at(0, 0, c) == 0);
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("bad input: every damaged image is refused by normal-map and bump-table") {
        const fs::path bad = shared_data() / "bad";
        const Folder folder;
        for (const char* kind : {"png", "exr", "other_images"})
            for (const auto& entry : fs::directory_iterator(bad / kind)) {
                if (entry.path().extension() == ".LICENSE") continue;
                const std::string file = entry.path().string();
                CHECK(answered(folder, {"normal-map", "--height", file}, file, "a.png") == 3);
                CHECK(answered(folder, {"bump-table", file}, file, "a.exr") == 3);
            }
    }

    TEST_CASE("bad input: every mesh in trouble is baked whole or refused") {
        const fs::path bad = shared_data() / "bad/meshes";
        const Folder folder;
        for (const auto& entry : fs::directory_iterator(bad))
            answered(folder,
                     {"normal-map", entry.path().string(), "--height", dots, "--amplitude", "1%", "--size", "128"},
                     entry.path(), "a.png");
    }

} // TEST_SUITE
