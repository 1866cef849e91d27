#include "bake/base/block_writer.h"
#include "bake/picture/bc6h.h"
#include "bake/picture/bc6h_fit.h"
#include "bake/picture/texture_file.h"
#include "picture/openimageio.h"
#include <cmath>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> decoded(const std::string& blocks, int width, int height) {
    Image<float> image(width, height, 3);
    bc6h_decode(blocks.data(), image);
    return image;
}

/// Root mean square over all samples of the errors, relative to the value plus `floor`.
double relative_rmse(const Image<float>& truth, double floor) {
    const Image<float> found = decoded(bc6h_encode(truth), truth.width(), truth.height());
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double v = double(truth.data()[i]), e = (double(found.data()[i]) - v) / (v + floor);
        sum += e * e;
    }
    return std::sqrt(sum / double(truth.size()));
}

template <class Value> Image<float> picture(int width, int height, Value&& value) {
    Image<float> image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(value(x, y, c));
    return image;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("bc6h_decode: OpenImageIO sees the same in blocks of random bits of all modes") {
        const Folder folder;
        std::mt19937 random(5);
        constexpr int across = 32;
        std::string blocks(across * across * 16, '\0');
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            blocks[i] = char(random());
            // Each of the 32 codes, the four reserved ones too, equally often.
            if (i % 16 == 0) blocks[i] = char((blocks[i] & ~31) | (i / 16 % 32));
        }
        BlockWriter out(folder / "random.dds");
        write_texture(out, TextureContainer::dds, TexelFormat::bc6h, {{4 * across, 4 * across, blocks}});
        out.commit();
        const Image<float> theirs = by_openimageio(folder, folder / "random.dds");
        const Image<float> ours = decoded(blocks, 4 * across, 4 * across);
        REQUIRE(theirs.width() == ours.width());
        REQUIRE(theirs.channels() == 3);
        std::size_t different = 0;
        for (std::size_t i = 0; i < ours.size(); ++i) different += ours.data()[i] != theirs.data()[i];
        CHECK(different == 0);
    }

    TEST_CASE("bc6h_decode: a block written by hand") {
        // Mode 11, code 00011: endpoints of ten bits. Red runs from 0 to the largest value, index 15 in the last texel.
        std::string block(16, '\0');
        block[0] = 3;
        for (int bit = 35; bit < 45; ++bit) block[std::size_t(bit / 8)] |= char(1 << bit % 8); // r1
        block[15] = char(0xf0);
        const Image<float> image = decoded(block, 4, 4);
        CHECK(image.at(0, 0, 0) == 0);
        CHECK(image.at(3, 3, 0) == 65504);
        CHECK(image.at(3, 3, 1) == 0);
    }
}

TEST_SUITE("unit") {
    TEST_CASE("bc6h: packing and unpacking of all modes are each other's inverse") {
        std::mt19937 random(7);
        for (int mode = 0; mode < 14; ++mode)
            for (int trial = 0; trial < 50; ++trial) {
                CAPTURE(mode);
                std::array<char, 16> bytes;
                for (char& byte : bytes) byte = char(random());
                const Bc6hMode& m = bc6h_modes[std::size_t(mode)];
                bytes[0] = char((bytes[0] & ~((1 << m.code_bits) - 1)) | m.code);
                Bc6hBlock block;
                REQUIRE(unpack(bytes.data(), block));
                CHECK(block.mode == mode);
                CHECK(pack(block) == bytes);
            }
    }

    TEST_CASE("bc6h_encode: constant and smooth radiance") {
        for (const double level : {1e-4, 0.02, 1.0, 900.0, 60000.0}) {
            CAPTURE(level);
            const auto flat = picture(8, 8, [&](int, int, int c) { return level * (1 - 0.2 * c); });
            CHECK(relative_rmse(flat, 0) < (level < 1e-3 ? 4e-3 : 4e-4)); // few half floats lie near 0
            const auto smooth = picture(
                32, 32, [&](int x, int y, int c) { return level * (0.6 + 0.3 * std::sin(0.1 * x + 0.07 * y + c)); });
            CHECK(relative_rmse(smooth, 0) < 8e-3); // the channels do not change alike
        }
    }

    TEST_CASE("bc6h_encode: a sun keeps its light, and an edge its two colours") {
        const auto sun =
            picture(16, 16, [](int x, int y, int c) { return x == 5 && y == 6 ? 30000.0 : 0.3 + 0.1 * c; });
        const Image<float> found = decoded(bc6h_encode(sun), 16, 16);
        for (int c = 0; c < 3; ++c) CHECK(double(found.at(5, 6, c)) == doctest::Approx(30000).epsilon(2e-3));
        double flux = 0, truth = 0;
        for (std::size_t i = 0; i < sun.size(); ++i) flux += double(found.data()[i]), truth += double(sun.data()[i]);
        CHECK(flux == doctest::Approx(truth).epsilon(2e-3));
        // Red above, blue below: one line in the space of colours does not hold both with their shades.
        const auto edge = picture(16, 16, [](int x, int y, int c) {
            return (y + x / 2) % 8 < 4 ? (c == 0 ? 4.0 + 0.3 * x : 0.5) : (c == 2 ? 2.0 + 0.2 * y : 0.2);
        });
        CHECK(relative_rmse(edge, 0.5) < 0.05);
    }

    TEST_CASE("bc6h_encode: sizes that are no multiples of four, and values that are no radiance") {
        auto odd = picture(5, 3, [](int x, int y, int) { return 1 + 0.1 * x + 0.2 * y; });
        CHECK(bc6h_encode(odd).size() == bc6h_bytes(5, 3));
        CHECK(relative_rmse(odd, 0) < 8e-3);
        odd.at(0, 0, 0) = -3, odd.at(1, 0, 1) = std::nanf(""), odd.at(4, 2, 2) = 1e9f;
        const Image<float> found = decoded(bc6h_encode(odd), 5, 3);
        for (std::size_t i = 0; i < found.size(); ++i) CHECK((found.data()[i] >= 0 && found.data()[i] <= 65504));
        CHECK(found.at(4, 2, 2) > 60000);
    }
}
