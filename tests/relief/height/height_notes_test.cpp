#include "bake/relief/height/height_notes.h"
#include <cmath>
#include <doctest/doctest.h>
#include <filesystem>
#include <numbers>
#include <unistd.h>

using namespace bake;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("bake_height_notes_" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

double wave(int x, int y) {
    return 0.5 + 0.3 * std::sin(2 * std::numbers::pi * 3 * x / 64) * std::sin(2 * std::numbers::pi * 3 * y / 64);
}

/// The notes on a picture of 64 x 64 texels, written as a PNG of 8 bits.
template <class Value>
std::vector<std::string> notes(int channels, const Value& value, Grey grey = Grey::mean, Wrap wrap = Wrap::repeat) {
    const Folder folder;
    Image<float> image(64, 64, channels);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = float(value(x, y, c));
    const std::string file = (folder.path / "a.png").string();
    write_image(file, image, {.depth = Depth::u8});
    return height_notes(read_height(file, grey), wrap, wrap);
}

double normal_map(int x, int y, int c) {
    const double s = std::cos(0.3 * x), t = std::sin(0.3 * y), z = 1 / std::sqrt(s * s + t * t + 1);
    return 0.5 + 0.5 * (c == 0 ? s * z : c == 1 ? t * z : z);
}

bool one(const std::vector<std::string>& notes, const std::string& words) {
    return notes.size() == 1 && notes[0].find(words) != std::string::npos;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("height_notes: a height that tiles has none, whatever its channels are") {
        CHECK(notes(1, [](int x, int y, int) { return wave(x, y); }).empty());
        CHECK(notes(3, [](int x, int y, int) { return wave(x, y); }).empty());
    }

    TEST_CASE("height_notes: a normal map and a colour picture have one each, unless the channel was chosen") {
        CHECK(one(notes(3, normal_map, Grey::mean, Wrap::mirror), "looks like a normal map"));
        CHECK(one(notes(3, normal_map, Grey::luma, Wrap::mirror), "looks like a normal map"));
        const auto colour = [](int x, int y, int c) {
            return c == 1 ? 1 - wave(x, y) : wave(x, y) * (c == 0 ? 1 : 0.5);
        };
        CHECK(one(notes(3, colour), "looks like a colour picture"));
        CHECK(notes(3, colour, Grey::r).empty());
    }

    TEST_CASE("height_notes: one value everywhere") {
        CHECK(one(notes(1, [](int, int, int) { return 1; }), "every texel has the same value, 1"));
        CHECK(one(notes(3, [](int, int, int) { return 0.2; }), "every texel has the same value"));
    }

    TEST_CASE("height_notes: a ramp that is repeated breaks at its border, one that is clamped does not") {
        const auto ramp = [](int x, int, int) { return x / 63.0; };
        CHECK(one(notes(1, ramp), "does not tile in x: the step across its border is 63 times"));
        CHECK(one(notes(1, ramp), "`wrap_u`"));
        CHECK(one(notes(1, [](int x, int y, int) { return (x + y) / 126.0; }), "does not tile in x and y"));
        for (const Wrap wrap : {Wrap::clamp, Wrap::mirror}) CHECK(notes(1, ramp, Grey::mean, wrap).empty());
    }
}
