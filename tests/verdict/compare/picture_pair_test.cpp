#include "bake/preview/tone.h"
#include "bake/verdict/compare/picture_pair.h"
#include "verdict/compare/files.h"
#include <cmath>
#include <limits>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {
    TEST_CASE("picture_pair: floats come as they are, 8-bit levels as linear light, grey as three equal channels") {
        const Files files;
        const Image<float> colour = noisy(5, 4, 1);
        const std::string a = files.exr("a.exr", colour),
                          grey = files.png("g.png", picture(5, 4, 1, [](int x, int, int) { return x * 51 / 255.0; }));
        const PicturePair floats = read_picture_pair(a, a);
        CHECK(equal(floats.reference, colour));
        CHECK(equal(floats.test, colour));
        CHECK_FALSE(floats.grey);
        CHECK_FALSE(floats.integers);
        const PicturePair greys = read_picture_pair(grey, grey);
        CHECK(greys.grey);
        CHECK(greys.integers);
        REQUIRE(greys.reference.channels() == 3);
        for (int c = 0; c < 3; ++c)
            CHECK(greys.reference.at(2, 1, c) == doctest::Approx(std::pow((0.4 + 0.055) / 1.055, 2.4)));
    }

    TEST_CASE("picture_pair: alpha and further channels are left out, even with NaN in them") {
        const Files files;
        const Image<float> colour = noisy(5, 4, 1);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const auto with_alpha = picture(5, 4, 4, [&](int x, int y, int c) { return c < 3 ? colour.at(x, y, c) : nan; });
        const PicturePair pair = read_picture_pair(files.exr("a.exr", colour), files.exr("b.exr", with_alpha));
        CHECK(equal(pair.test, colour));
        REQUIRE(pair.notes.size() == 1);
        CHECK(has(pair.notes[0], "b.exr: alpha is not compared"));
    }

    TEST_CASE("picture_pair: a normal map that says what it is gets a note, whatever its format") {
        const Files files;
        const Image<float> colour = noisy(5, 4, 1);
        const std::string plain = files.exr("plain.exr", colour);
        const Facts facts = {{"content", std::string("normal map")}};
        const RunRecord run({"normal-map", {}});
        for (const char* name : {"n.png", "n.exr", "n.tif"}) {
            const PicturePair pair = read_picture_pair(plain, files.write(name, colour, {.facts = facts}));
            REQUIRE_FALSE(pair.notes.empty());
            CHECK(has(pair.notes.back(), std::string(name) + ": its record says that it is a normal map; `normals`"));
        }
        CHECK(read_picture_pair(plain, plain).notes.empty());
    }

    TEST_CASE("picture_pair: sizes, channels and NaN are refused by name") {
        const Files files;
        const std::string a = files.exr("a.exr", noisy(5, 4, 1)), small = files.exr("small.exr", noisy(4, 4, 1));
        const auto said = [&](const std::string& first, const std::string& second) {
            return refusal(Refusal::unsuitable, [&] { read_picture_pair(first, second); });
        };
        CHECK(has(said(a, small), "small.exr: is 4 x 4, where "));
        const auto one = [](int channels) { return picture(5, 4, channels, [](int, int, int) { return 0.5; }); };
        CHECK(has(said(a, files.exr("grey.exr", one(1))), "grey.exr: has one grey channel, where "));
        const std::string two = files.write("two.exr", one(2), {.depth = Depth::float32, .channels = {"b_u", "b_v"}});
        CHECK(has(said(two, two), "two.exr: has two channels, which are no colour"));
        Image<float> bad = noisy(5, 4, 2);
        bad.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
        CHECK(has(said(a, files.exr("bad.exr", bad)), "bad.exr: 1 pixel is NaN or Inf, the first at column 3, row 2"));
    }

    TEST_CASE("picture_pair: what is shown is what render writes") {
        const Image<float> light = picture(8, 1, 3, [](int x, int, int c) { return std::exp2(x - 4) * (c + 1) - 0.1; });
        const Image<float> out = shown(light, 1.5f);
        for (std::size_t i = 0; i < out.size(); ++i)
            CHECK(out.data()[i] == shown_value(light.data()[i], 1.5f, Tone::srgb));
    }
}
