// Forms of textures: sizes, bytes, and the error of reading back what was stored.
#include "bake/picture/bc5.h"
#include "bake/verdict/plan/texture_form.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Unit vectors within 60 degrees of the z axis.
Image<float> random_normals(int width, int height) {
    std::mt19937 random(3);
    const auto next = [&] { return float(random()) / 4294967296.0f; };
    Image<float> image(width, height, 3);
    for (std::size_t i = 0; i < image.size(); i += 3) {
        const float z = 0.5f + 0.5f * next(), east = 2 * pi_f * next(), ring = std::sqrt(1 - z * z);
        image.data()[i] = ring * std::cos(east), image.data()[i + 1] = ring * std::sin(east), image.data()[i + 2] = z;
    }
    return image;
}

double largest_angle(const Image<float>& a, const Image<float>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); i += 3)
        largest = std::max(largest, angle_deg(*reinterpret_cast<const Vec3f*>(a.data() + i),
                                              *reinterpret_cast<const Vec3f*>(b.data() + i)));
    return largest;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("texture forms: bytes are those of all levels, in ascending order") {
        CHECK(TextureForm{0, 1, 1, 3, 8}.bytes() == 3);
        CHECK(TextureForm{0, 256, 256, 3, 8}.bytes() == std::int64_t(4 * 4 * 4 * 4 * 4 * 4 * 4 * 4 * 4) - 1);
        CHECK(TextureForm{0, 4, 1, 2, 16}.bytes() == 4 * (4 + 2 + 1));
        // Blocks of 16 bytes: 2 x 2, and one for each of the three levels 4 x 2, 2 x 1 and 1 x 1.
        CHECK(TextureForm{0, 8, 5, 2, bc5_bits}.bytes() == 16 * (4 + 3));
        // A third of RGB of 8 bits, but for the two levels that are smaller than a block.
        CHECK(3 * (TextureForm{0, 256, 256, 2, bc5_bits}.bytes() - 32) == TextureForm{0, 256, 256, 3, 8}.bytes() - 15);
        for (const TextureUse use : {TextureUse::normal, TextureUse::bump, TextureUse::albedo}) {
            const auto forms = texture_forms(use, 600, 100);
            CHECK(forms.front().width * forms.front().height == 1);
            CHECK(forms.back().width == 600);
            for (std::size_t i = 1; i < forms.size(); ++i) {
                CHECK(forms[i - 1].bytes() <= forms[i].bytes());
                CHECK(!(forms[i - 1] == forms[i]));
            }
        }
    }

    TEST_CASE("texture forms: stored normals are within the bound of their depth, and z is rebuilt") {
        const Image<float> source = random_normals(37, 23);
        const auto error = [&](int channels, int bits) {
            return largest_angle(stored(source, TextureUse::normal, {0, 37, 23, channels, bits}), source);
        };
        // ORACLES: asin(sqrt 3 / (2^bits - 1)); without z the error of x and y grows by 1 / z = 2 at 60 degrees.
        CHECK(error(3, 8) <= 0.389);
        CHECK(error(3, 8) > 0.1);
        CHECK(error(2, 8) <= 2 * 0.389);
        CHECK(error(3, 16) <= 1.6e-3);
        CHECK(error(2, 16) <= 2 * 1.6e-3);
    }

    TEST_CASE("texture forms: normals in BC5 are the texels of their blocks, of unit vectors") {
        const auto halvings = halvings_of(random_normals(16, 12));
        Image<float> unit = stored(halvings[1], TextureUse::normal, {1, 8, 6, 3, 32, true}), decoded(8, 6, 3);
        bc5_decode(bc5_encode(unit).data(), decoded);
        const TextureForm bc5{1, 8, 6, 2, bc5_bits};
        const Image<float> read = stored(halvings[1], TextureUse::normal, bc5);
        CHECK(std::equal(read.data(), read.data() + read.size(), decoded.data()));
        CHECK(bc5.text() == "8 x 6, BC5");
        const auto forms = texture_forms(TextureUse::normal, 8, 6);
        CHECK(std::count_if(forms.begin(), forms.end(), [](const TextureForm& form) { return form.in_bc5(); }) == 4);
        CHECK(lossless_form(read, TextureUse::normal).bits > 0);
        for (const TextureUse use : {TextureUse::bump, TextureUse::albedo})
            for (const TextureForm& form : texture_forms(use, 8, 6)) CHECK(!form.in_bc5());
    }

    TEST_CASE("texture forms: halved normals are unit vectors") {
        const auto halvings = halvings_of(random_normals(16, 16));
        REQUIRE(halvings.size() == 5);
        const Image<float> small = stored(halvings[2], TextureUse::normal, {2, 4, 4, 3, 16});
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                CHECK(glm::length(*reinterpret_cast<const Vec3f*>(&small.at(x, y))) ==
                      doctest::Approx(1).epsilon(1e-4));
        const Vec3f before = *reinterpret_cast<const Vec3f*>(&halvings[2].at(1, 1));
        CHECK(glm::length(before) < 0.98f);
        CHECK(angle_deg(before, *reinterpret_cast<const Vec3f*>(&small.at(1, 1))) < 0.01);
    }

    TEST_CASE("texture forms: slopes keep their mean when halved, and are within half a level when stored") {
        Image<float> slopes(8, 8, 2);
        for (std::size_t i = 0; i < slopes.size(); ++i) slopes.data()[i] = float(i % 7) - 2.5f;
        double mean = 0;
        for (std::size_t i = 0; i < slopes.size(); i += 2) mean += double(slopes.data()[i]) / 64;
        CHECK(halvings_of(slopes)[3].at(0, 0, 0) == doctest::Approx(mean));
        for (const float largest : {3.5f, 1.f, 1e-3f}) { // the range of the levels is that of the slopes
            Image<float> scaled = copied(slopes);
            for (std::size_t i = 0; i < scaled.size(); ++i) scaled.data()[i] *= largest / 3.5f;
            const Image<float> read = stored(scaled, TextureUse::bump, {0, 8, 8, 2, 16});
            for (std::size_t i = 0; i < scaled.size(); ++i)
                CHECK(std::abs(read.data()[i] - scaled.data()[i]) <= 0.51f * largest / 32767);
        }
    }

    TEST_CASE("texture forms: a picture of 8 bits is held by 8 bits, a finer one is not") {
        Image<float> colours(16, 16, 3);
        for (std::size_t i = 0; i < colours.size(); ++i) colours.data()[i] = float(i % 256) / 255;
        srgb_to_linear(colours);
        CHECK(lossless_form(colours, TextureUse::albedo) == TextureForm{0, 16, 16, 3, 8});
        colours.at(3, 3) = 0.3f; // between two levels
        CHECK(lossless_form(colours, TextureUse::albedo).bits > 8);
        Image<float> grey(4, 4, 3);
        std::fill_n(grey.data(), grey.size(), 1.0f);
        CHECK(lossless_form(grey, TextureUse::albedo) == TextureForm{0, 4, 4, 1, 8});
        colours.at(3, 3) = 2; // brighter than white
        CHECK(stored(colours, TextureUse::albedo, {0, 16, 16, 3, 16, true}).at(3, 3) == 2);
    }
}
