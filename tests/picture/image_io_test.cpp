#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "picture/png_bytes.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

using namespace bake;
using namespace bake::test;

namespace {

/// Values in [0, 1] without a pattern, the ends among them.
Image<float> noise(int width, int height, int channels) {
    Image<float> image(width, height, channels);
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < image.size(); ++i) {
        state = state * 1664525 + 1013904223;
        image.data()[i] = i % 97 == 0 ? 0.0f : i % 89 == 0 ? 1.0f : float(state >> 8) / float(1 << 24);
    }
    return image;
}

float largest_difference(const Image<float>& a, const Image<float>& b) {
    REQUIRE(a.width() == b.width());
    REQUIRE(a.height() == b.height());
    REQUIRE(a.channels() == b.channels());
    float most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a.data()[i] - b.data()[i]));
    return most;
}

/// The refusal that reading brings, and its message.
std::pair<int, std::string> refusal(const std::string& file, const ReadLimits& limits = {}) {
    try {
        read_image(file, nullptr, limits);
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        CHECK(std::string(error.what()).starts_with(file + ": "));
        return {int(error.refusal), error.what()};
    }
    return {0, ""};
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("image_io: every ending, depth and channel count comes back as written") {
        const Folder folder;
        struct Kind {
            const char* ending;
            Depth depth;
            SampleType type;
            double tolerance; // integers: half a level; half: 11 bits; float: none
        };
        const Kind kinds[] = {{".png", Depth::u8, SampleType::u8, 0.5 / 255},
                              {".png", Depth::u16, SampleType::u16, 0.5 / 65535},
                              {".tif", Depth::u8, SampleType::u8, 0.5 / 255},
                              {".tif", Depth::u16, SampleType::u16, 0.5 / 65535},
                              {".tif", Depth::float32, SampleType::float32, 0},
                              {".tiff", Depth::automatic, SampleType::float32, 0},
                              {".exr", Depth::half, SampleType::half, std::exp2(-12)},
                              {".exr", Depth::float32, SampleType::float32, 0},
                              {".png", Depth::automatic, SampleType::u16, 0.5 / 65535},
                              {".EXR", Depth::automatic, SampleType::half, std::exp2(-12)}};
        for (const Kind& kind : kinds)
            for (const int channels : {1, 2, 3, 4}) {
                CAPTURE(std::string(kind.ending));
                CAPTURE(std::string(name(kind.type)));
                CAPTURE(channels);
                const std::string file = folder / (std::string("a") + kind.ending);
                const Image<float> image = noise(37, 301, channels); // more than one band of rows
                write_image(file, image, {.depth = kind.depth});
                ImageInfo info;
                const Image<float> back = read_image(file, &info);
                CHECK(largest_difference(back, image) <= kind.tolerance * 1.0001);
                CHECK(info.type == kind.type);
                CHECK(int(info.channels.size()) == channels);
                CHECK(info.alpha_channel == (channels == 2 ? 1 : channels == 4 ? 3 : -1));
                CHECK_FALSE(info.srgb_tagged);
                CHECK(read_image_info(file).height == 301);
            }
        CHECK(folder.names().size() == 5); // no temporary is left
    }

    TEST_CASE("image_io: float files keep negative, tiny and huge values to the last bit; integers clamp") {
        const Folder folder;
        Image<float> image(3, 2, 1);
        const float values[] = {-1.5f, 1e-42f, 3e38f, -0.0f, 1e30f, 0.1f};
        std::copy_n(values, 6, image.data());
        for (const char* file : {"a.exr", "a.tif"}) {
            write_image(folder / file, image, {.depth = Depth::float32});
            CHECK(std::memcmp(read_image(folder / file).data(), values, sizeof values) == 0);
        }
        write_image(folder / "a.png", image, {.depth = Depth::u8});
        const Image<float> clamped = read_image(folder / "a.png");
        CHECK(clamped.at(0, 0) == 0);
        CHECK(clamped.at(2, 0) == 1);
        image.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
        write_image(folder / "a.png", image, {.depth = Depth::u16});
        CHECK(read_image(folder / "a.png").at(0, 0) == 0);
    }

    TEST_CASE("image_io: one texel, one row and one column") {
        const Folder folder;
        for (const auto& [width, height] : {std::pair(1, 1), {1, 300}, {300, 1}, {70000, 1}, {1, 70000}})
            for (const char* file : {"a.png", "a.exr", "a.tif"}) {
                CAPTURE(std::string(file));
                const Image<float> image = noise(width, height, 1);
                write_image(folder / file, image, {});
                CHECK(largest_difference(read_image(folder / file), image) < 5e-4);
            }
    }

    TEST_CASE("image_io: alpha is neither multiplied into colours nor divided out of them") {
        const Folder folder;
        Image<float> image(2, 2, 4);
        const float rgba[] = {1, 0.6f, 0.2f, 0, 0.2f, 0.4f, 0.8f, 0.2f, 0, 1, 0, 1, 0.4f, 0.4f, 0.4f, 0.6f};
        std::copy_n(rgba, 16, image.data());
        for (const char* file : {"a.png", "a.tif", "a.exr"}) {
            CAPTURE(std::string(file));
            write_image(folder / file, image, {});
            CHECK(largest_difference(read_image(folder / file), image) < 3e-4);
        }
        // A foreign PNG of one transparent texel.
        write_file(folder / "b.png", png_bytes(1, 1, 8, 6, {std::string("\x33\x66\xcc\x00", 4)}));
        const Image<float> back = read_image(folder / "b.png");
        CHECK(back.at(0, 0, 0) == doctest::Approx(0x33 / 255.0));
        CHECK(back.at(0, 0, 2) == doctest::Approx(0xcc / 255.0));
        CHECK(back.at(0, 0, 3) == 0);
    }

    TEST_CASE("image_io: an sRGB tag is told, and changes no value") {
        const Folder folder;
        write_file(folder / "tagged.png", png_bytes(2, 1, 8, 0, {"\x40\xc0"}, srgb_tag()));
        ImageInfo info;
        const Image<float> image = read_image(folder / "tagged.png", &info);
        CHECK(info.srgb_tagged);
        CHECK(image.at(0, 0) == doctest::Approx(64 / 255.0));
        CHECK(image.at(1, 0) == doctest::Approx(192 / 255.0));
    }

    TEST_CASE("image_io: PNG of 1, 2 and 4 bits: levels divided by the largest, the bits told") {
        const Folder folder;
        struct {
            int bits;
            std::string row;
            float second;
        } const cases[] = {{1, std::string("\x40", 1), 1.0f},
                           {2, std::string("\x20", 1), 2 / 3.0f},
                           {4, std::string("\x07", 1), 7 / 15.0f}};
        for (const auto& c : cases) {
            CAPTURE(c.bits);
            write_file(folder / "a.png", png_bytes(2, 1, c.bits, 0, {c.row}));
            ImageInfo info;
            const Image<float> image = read_image(folder / "a.png", &info);
            CHECK(info.bits == c.bits);
            CHECK(image.at(0, 0) == 0);
            CHECK(image.at(1, 0) == doctest::Approx(c.second).epsilon(2e-3)); // 8 bits hold two thirds of 255 exactly
        }
    }

    TEST_CASE("image_io: sRGB colours decode by IEC 61966-2-1 and encode back") {
        Image<float> image(3, 1, 4);
        const float values[] = {0.02f, 0.5f, 1, 0.5f, 0, 0.04045f, 0.7353569f, 0.25f, 0.1f, 0.2f, 0.3f, 1};
        std::copy_n(values, 12, image.data());
        srgb_to_linear(image, 3);
        CHECK(image.at(0, 0, 0) == doctest::Approx(0.02 / 12.92));
        CHECK(image.at(0, 0, 1) == doctest::Approx(0.2140411).epsilon(1e-5));
        CHECK(image.at(0, 0, 3) == 0.5f); // alpha
        CHECK(image.at(1, 0, 2) == doctest::Approx(0.5).epsilon(1e-5));
        for (int i = 0; i < 12; ++i)
            if (i % 4 != 3) CHECK(linear_to_srgb(image.data()[i]) == doctest::Approx(values[i]).epsilon(1e-4));
        CHECK(linear_to_srgb(-1) == 0);
        CHECK(linear_to_srgb(std::numeric_limits<float>::quiet_NaN()) == 0);
    }

    TEST_CASE("image_io: the same bytes for 1, 2 and 7 threads and from run to run") {
        const Folder folder;
        const Image<float> image = noise(500, 700, 3);
        for (const char* file : {"a.png", "a.exr", "a.tif"}) {
            std::string first;
            for (const int threads : {1, 2, 7, 1}) {
                // No file keeps the time it was written at.
                if (threads == 7) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
                const ThreadLimit limit(threads);
                write_image(folder / file, image, {.compression = Compression::zip});
                if (first.empty()) first = contents(folder / file);
                CHECK_MESSAGE((contents(folder / file) == first), std::string(file) << " by " << threads);
            }
        }
    }

    TEST_CASE("image_io: depths and endings that do not go together are usage errors") {
        CHECK(resolve_depth("a.png", Depth::automatic) == Depth::u16);
        CHECK(resolve_depth("a.exr", Depth::automatic) == Depth::half);
        CHECK(resolve_depth("a.tif", Depth::automatic) == Depth::float32);
        CHECK(resolve_depth("A.PNG", Depth::u8) == Depth::u8);
        const std::pair<const char*, Depth> wrong[] = {
            {"a.png", Depth::half},  {"a.png", Depth::float32}, {"a.exr", Depth::u8},
            {"a.exr", Depth::u16},   {"a.tif", Depth::half},    {"a.jpg", Depth::automatic},
            {"a", Depth::automatic}, {"", Depth::automatic},    {"png", Depth::automatic}};
        for (const auto& [file, depth] : wrong) {
            try {
                resolve_depth(file, depth);
                FAIL_CHECK(file << " was accepted");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::usage);
            }
        }
    }

    TEST_CASE("image_io: an unfinished writer leaves the old file and nothing else") {
        const Folder folder;
        for (const char* file : {"a.png", "a.exr", "a.tif"}) {
            write_file(folder / file, "old");
            {
                ImageWriter writer(folder / file, 64, 64, 1, {});
                writer.write(noise(64, 32, 1).data(), 32);
            }
            CHECK(contents(folder / file) == "old");
        }
        CHECK(folder.names() == std::set<std::string>{"a.png", "a.exr", "a.tif"});
    }

    TEST_CASE("image_io: what is not a picture is unreadable, what is too large for the limit unsuitable") {
        const Folder folder;
        write_file(folder / "empty.png", "");
        write_file(folder / "text.exr", "not a picture\n");
        write_file(folder / "half.png", std::string("\x89PNG\r\n\x1a\n", 8));
        fs::create_directory(folder / "folder.png");
        for (const char* file : {"empty.png", "text.exr", "half.png", "folder.png", "absent.png"})
            CHECK(refusal(folder / file).first == 3);
        CHECK(refusal("/dev/null").first == 3);
        write_image(folder / "a.exr", noise(64, 64, 1), {});
        CHECK(refusal(folder / "a.exr", {.max_bytes = 64 * 64 * 4}).first == 0);
        CHECK(refusal(folder / "a.exr", {.max_bytes = 64 * 64 * 4 - 1}).first == 4);
    }

    TEST_CASE("image_io: headers that claim more than a small file can hold are refused before anything is allocated") {
        const Folder folder;
        for (const std::uint32_t side : {100000u, 0x7fffffffu, 0xffffffffu}) {
            write_file(folder / "huge.png", png_bytes(side, side, 16, 6, {std::string(8, 'x')}));
            CHECK(refusal(folder / "huge.png").first == 3);
        }
        // A real EXR with its windows widened: dataWindow's and displayWindow's far corner are the last 8 of 16 bytes.
        write_image(folder / "small.exr", noise(8, 8, 1), {});
        const std::string small = contents(folder / "small.exr");
        const auto widened = [&](const std::string& name, std::uint32_t far) {
            std::string bytes = small;
            const std::size_t at = bytes.find(name + '\0' + "box2i") + name.size() + 1 + 6 + 4 + 8;
            for (int i = 0; i < 8; ++i) bytes[at + i] = char(far >> 8 * (i % 4));
            return bytes;
        };
        for (const char* window : {"dataWindow", "displayWindow"})
            for (const std::uint32_t far : {99999u, 40000u, 0x7ffffffeu}) {
                CAPTURE(std::string(window));
                CAPTURE(far);
                write_file(folder / "huge.exr", widened(window, far));
                const int code = refusal(folder / "huge.exr").first;
                CHECK((code == 3 || code == 4));
            }
    }

    TEST_CASE("image_guard: EXR headers that the library lets pass are refused") {
        const Folder folder;
        write_image(folder / "a.exr", noise(8, 8, 1), {});
        const std::string whole = contents(folder / "a.exr");
        CHECK(refusal(folder / "a.exr").first == 0);
        for (const std::string name : {"dataWindow", "displayWindow", "compression", "channels"}) {
            std::string bytes = whole;
            const std::size_t at = bytes.find(name + '\0');
            REQUIRE(at != std::string::npos);
            bytes[at + name.size() - 1] = '_';
            write_file(folder / "b.exr", bytes);
            const auto [code, message] = refusal(folder / "b.exr");
            CHECK(code == 3);
            CHECK(message.find(name) != std::string::npos);
        }
        std::string bytes = whole;
        bytes[bytes.find(std::string("chlist") + '\0') + 7 + 4] = '\x02'; // the first letter of a channel's name
        write_file(folder / "b.exr", bytes);
        CHECK(refusal(folder / "b.exr").first == 3);
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("image_io: real files cut short are unreadable wherever pixels are missing") {
        const fs::path data = shared_data();
        const Folder folder;
        std::vector<std::string> files = {
            (data / "textures/heights/plain_heightmap.png").string(),
            (data / "textures/heights/terrain3d_mountain1.exr").string(),
            (data / "textures/heights/terrain3d_terrain1.exr").string(),
            (data / "environments/openexr/PeriodicPattern.exr").string(),
            (data / "textures/pairs/cube2_castell_wall_gk_v01/castell_wall_gk_v01_hm.jpg").string(),
            (data / "environments/latlong/lebombo_1k.hdr").string()};
        const Image<float> height = read_image(files[0]);
        for (const Compression compression : {Compression::none, Compression::zip}) {
            files.push_back(folder / (compression == Compression::none ? "plain.tif" : "zip.tif"));
            write_image(files.back(), height, {.depth = Depth::u16, .compression = compression});
        }
        for (const std::string& file : files) {
            CAPTURE(std::string(file));
            const std::string whole = contents(file), cut = folder / ("cut" + fs::path(file).extension().string());
            const Image<float> image = read_image(file);
            for (const double share : {0.1, 0.5, 0.9, 0.99}) {
                write_file(cut, whole.substr(0, std::size_t(double(whole.size()) * share)));
                Image<float> back;
                try {
                    back = read_image(cut);
                } catch (const Error& error) {
                    CHECK(error.refusal == Refusal::unreadable);
                    continue;
                }
                // Only what comes after the pixels may be missing: smaller mips, the end mark.
                CHECK_MESSAGE(share > 0.5, "read from " << share << " of the file");
                CHECK(largest_difference(back, image) == 0);
            }
        }
    }

    TEST_CASE("image_io: data windows are placed in their display window, cube strips are read whole") {
        const fs::path folder = shared_data() / "environments/openexr";
        const Image<float> cube = read_image(folder / "OrientationCube.exr");
        CHECK(cube.width() == 512);
        CHECK(cube.height() == 6 * 512);
        ImageInfo info;
        const Image<float> latlong = read_image(folder / "OrientationLatLong.exr", &info);
        CHECK(latlong.width() == info.width);
        CHECK(info.format == "openexr");

        // The same picture with its data window moved right by 8 and down by 8: what falls outside is cut off, what is
        // uncovered is 0.
        const Folder own;
        Image<float> image(32, 16, 1);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float(i + 1);
        write_image(own / "a.exr", image, {.depth = Depth::float32});
        std::string bytes = contents(own / "a.exr");
        const std::size_t at = bytes.find(std::string("displayWindow") + '\0') + 14 + 6 + 4;
        const std::int32_t window[] = {-8, -4, 19, 15};
        std::memcpy(bytes.data() + at, window, sizeof window);
        write_file(own / "b.exr", bytes);
        const Image<float> placed = read_image(own / "b.exr", &info);
        REQUIRE(placed.width() == 28);
        REQUIRE(placed.height() == 20);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 28; ++x) CHECK(placed.at(x, y) == (x >= 8 && y >= 4 ? image.at(x - 8, y - 4) : 0));
    }

} // TEST_SUITE
