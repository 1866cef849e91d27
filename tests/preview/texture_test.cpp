#include "bake/base/error.h"
#include "bake/preview/texture.h"
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <unistd.h>

using namespace bake;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() /
                    ("bake_texture_test_" + std::to_string(getpid()) + "_" + std::to_string(std::rand()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
};

/// One row of texels of the values given.
Image<float> texels(int channels, std::initializer_list<float> values) {
    Image<float> image(int(values.size()) / channels, 1, channels);
    std::copy(values.begin(), values.end(), image.data());
    return image;
}

std::string written(const std::string& file, const Image<float>& image, Depth depth,
                    std::vector<std::string> names = {}) {
    write_image(file, image, {.depth = depth, .channels = std::move(names)});
    return file;
}

void check_unsuitable(const std::string& file, void (*work)(const std::string&)) {
    try {
        work(file);
        FAIL("not refused");
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::unsuitable);
        CHECK(std::string(error.what()).rfind(file, 0) == 0);
    }
}

bool near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-6f) { return glm::length(a - b) <= tolerance; }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("texture: lookup is exact at texel centres, linear between them, v up, repeated") {
        Image<float> image(2, 2, 2); // upper row (0,0) (1,0), lower row (0,2) (1,2)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) {
                image.at(x, y, 0) = float(x);
                image.at(x, y, 1) = float(2 * y);
            }
        const auto check = [&](float u, float v, float first, float second) {
            const Vec2f value = lookup2(image, {u, v});
            CHECK(value.x == doctest::Approx(first));
            CHECK(value.y == doctest::Approx(second));
        };
        check(0.25f, 0.75f, 0, 0); // upper left texel
        check(0.75f, 0.25f, 1, 2); // lower right texel
        check(0.5f, 0.5f, 0.5f, 1);
        check(0.375f, 0.75f, 0.25f, 0);
        check(0, 0.75f, 0.5f, 0); // half way to the texel on the other side
        check(-3.75f, 10.25f, 0, 2);
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const float bad : {nan, std::numeric_limits<float>::infinity()})
            CHECK(std::isfinite(lookup2(image, {bad, 0}).x));
    }

    TEST_CASE("texture: an 8-bit colour is decoded from sRGB, a float one is not, grey becomes three channels") {
        const Folder folder;
        const std::string png = written(folder / "a.png", texels(3, {0.5f, 0, 1}), Depth::u8);
        const float decoded = float(std::pow((128 / 255.0 + 0.055) / 1.055, 2.4));
        CHECK(near(lookup3(*read_albedo(png), {0.5f, 0.5f}), {decoded, 0, 1}, 1e-5f));
        CHECK(near(lookup3(*read_albedo(png, ColourSpace::linear), {0.5f, 0.5f}), {128 / 255.0f, 0, 1}, 1e-5f));
        const std::string exr = written(folder / "a.exr", texels(1, {0.5f}), Depth::float32);
        CHECK(near(lookup3(*read_albedo(exr), {0.5f, 0.5f}), Vec3f(0.5f)));
    }

    TEST_CASE("texture: a normal map is unorm, or signed when that makes its vectors unit, unless told") {
        const Folder folder;
        const std::string unorm =
            written(folder / "unorm.exr", texels(3, {0.5f, 0.75f, 1, 0.25f, 0.5f, 0.9f}), Depth::float32);
        const std::string with_sign =
            written(folder / "signed.exr", texels(3, {0, -0.5f, 1, 0.25f, 0.5f, 0.9f}), Depth::float32);
        const Vec2f first(0.25f, 0.5f);
        CHECK(near(lookup3(*read_normal_map(unorm), first), {0, 0.5f, 1}));
        CHECK(near(lookup3(*read_normal_map(with_sign), first), {0, -0.5f, 1}));
        CHECK(near(lookup3(*read_normal_map(unorm, NormalEncoding::signed_), first), {0.5f, 0.75f, 1}));
        CHECK(near(lookup3(*read_normal_map(with_sign, NormalEncoding::unorm), first), {-1, -2, 1}));
        CHECK(near(lookup3(*read_normal_map(unorm, NormalEncoding::automatic, true), first), {0, -0.5f, 1}));
    }

    TEST_CASE("texture: a normal map of floats keeps its relief where one value is a hair below 0") {
        const Folder folder;
        const std::string file = written(
            folder / "hair.exr", texels(3, {0.5f, 0.75f, 0.93f, 0.25f, -0.0001f, 0.5f, 0.5f, 0.5f, 1}), Depth::float32);
        std::vector<std::string> notes;
        CHECK(near(lookup3(*read_normal_map(file, NormalEncoding::automatic, false, &notes), {1 / 6.0f, 0.5f}),
                   {0, 0.5f, 0.86f}));
        CHECK(notes.empty());
    }

    TEST_CASE("texture: z of a normal map of two channels is rebuilt, and the note says so") {
        const Folder folder;
        const std::string two =
            written(folder / "two.exr", texels(2, {0.5f, 0.8f, 0.5f, 0.2f}), Depth::float32, {"R", "G"});
        const std::string three = written(folder / "three.png", texels(3, {0.5f, 0.8f, 0, 0.5f, 0.2f, 0}), Depth::u16);
        for (const std::string& file : {two, three}) {
            std::vector<std::string> notes;
            CHECK(near(lookup3(*read_normal_map(file, NormalEncoding::automatic, false, &notes), {0.25f, 0.5f}),
                       {0, 0.6f, 0.8f}, 1e-4f));
            REQUIRE(notes.size() == 1);
            CHECK(notes[0].find("z is rebuilt") != std::string::npos);
        }
        const std::string one = written(folder / "one.png", texels(1, {0.5f, 0.8f}), Depth::u8);
        check_unsuitable(one, [](const std::string& file) { read_normal_map(file); });
    }

    TEST_CASE("texture: a bump table's channels go by their names, else by their order, times the scale") {
        const Folder folder;
        const std::string plain = written(folder / "plain.exr", texels(2, {-3, 7}), Depth::float32);
        const std::string named =
            written(folder / "named.exr", texels(3, {-3, 5, 7}), Depth::float32, {"b_u", "other", "b_v"});
        for (const std::string& file : {plain, named}) {
            const Vec2f slopes = lookup2(*read_bump_table(file, 2), {0.5f, 0.5f});
            CHECK(slopes.x == -6);
            CHECK(slopes.y == 14);
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("texture: what cannot be a bump table or a normal map is refused by its name") {
        const Folder folder;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const auto bump = [](const std::string& file) { read_bump_table(file); };
        check_unsuitable(written(folder / "integers.png", texels(3, {0, 0, 0}), Depth::u16), bump);
        check_unsuitable(written(folder / "height.exr", texels(1, {0}), Depth::float32), bump);
        check_unsuitable(written(folder / "bumpslopes.exr", texels(6, {0, 0, 0, 0, 0, 0}), Depth::float32), bump);
        check_unsuitable(written(folder / "nan.exr", texels(2, {nan, 0}), Depth::float32), bump);
        const auto normal = [](const std::string& file) { read_normal_map(file); };
        check_unsuitable(written(folder / "one.exr", texels(1, {0}), Depth::float32), normal);
        check_unsuitable(written(folder / "nan3.exr", texels(3, {0, nan, 0}), Depth::float32), normal);
        check_unsuitable(folder / "nan3.exr", [](const std::string& file) { read_albedo(file); });
        CHECK_THROWS_AS(read_albedo(folder / "missing.png"), Error);
    }

} // TEST_SUITE
