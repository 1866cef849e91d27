#include "bake/base/error.h"
#include "bake/environment/engine/encoding_error.h"
#include "bake/environment/engine/engine_levels.h"
#include "bake/environment/file/cube_levels.h"
#include "bake/picture/ktx1_writer.h"
#include "bake/picture/rgbe_writer.h"
#include "bake/picture/texture_file.h"
#include "environment/between.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include "picture/openimageio.h"

using namespace bake;
using namespace bake::test;

namespace {

const oracle::Sun sun{.amplitude = 20, .kappa = 60};
const Vec3d sun_direction = glm::normalize(Vec3d(0.3, 0.5, 0.7));

Cube sunny(int size) {
    return sky_of(size, 3,
                  [](const Vec3d& d, int c) { return 0.3 + (1 + c) * sun.radiance(glm::dot(d, sun_direction)); });
}

std::vector<TextureLevel> packed(const std::vector<Cube>& levels, TexelFormat format) {
    std::vector<TextureLevel> out;
    for (const Cube& cube : levels) {
        out.push_back({cube.size(), cube.size()});
        for (const Image<float>& face : cube.faces) out.back().bytes += pack_level(face, format).bytes;
    }
    return out;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("engine_levels: each level is the sky under the lobe of the engine's ladder") {
        for (const Consumer consumer : {Consumer::three, Consumer::bevy, Consumer::babylon, Consumer::filament}) {
            CAPTURE(int(consumer));
            const EngineLevels made = engine_levels(sunny(64), {.consumer = consumer, .size = 64});
            REQUIRE(made.levels.size() == made.roughness.size());
            CHECK(made.levels.back().size() == entry_of(consumer).levels->least_edge);
            for (std::size_t k = 1; k < made.levels.size(); ++k) {
                const double alpha = made.roughness[k];
                const oracle::ConvolvedSun exact(sun, [=](double c) { return oracle::ggx_kernel(c, alpha); });
                const auto right = [&](const Vec3d& d) {
                    return 0.3 + 2 * exact(glm::dot(d, sun_direction)) / exact.norm;
                };
                // Nearer than texels without any error, which are off between their centres.
                const int n = made.levels[k].size();
                const Cube samples = sky_of(n, 3, [&](const Vec3d& d, int) { return right(d); });
                const Between plain = between(samples, 1, right), found = between(made.levels[k], 1, right);
                CAPTURE(n);
                CHECK(found.rms < (n >= 8 ? 0.6 : 1.0) * plain.rms);
            }
            // Irradiance over pi is the level of roughness 1.
            const oracle::ConvolvedSun even(sun, oracle::clamped_cosine);
            const double right = 0.3 + even(glm::dot(texel_direction(32, 2, 5, 9), sun_direction)) / even.norm;
            CHECK(double(made.irradiance.faces[2].at(5, 9, 0)) == doctest::Approx(right).epsilon(2e-3));
        }
    }

    TEST_CASE("write_rgbe: OpenImageIO reads what was written") {
        const Folder folder;
        for (const int width : {5, 200}) {
            Image<float> image(width, 7, 3);
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < width; ++x)
                    for (int c = 0; c < 3; ++c)
                        image.at(x, y, c) = y == 3 ? 0.5f : float((1 + c) * std::exp(0.05 * (x * 7 % 90) - 2));
            BlockWriter out(folder / "a.hdr");
            write_rgbe(out, image);
            out.commit();
            const Image<float> read = by_openimageio(folder, folder / "a.hdr");
            REQUIRE(read.width() == width);
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < width; ++x)
                    for (int c = 0; c < 3; ++c)
                        CHECK(std::abs(read.at(x, y, c) - image.at(x, y, c)) <= image.at(x, y, 2) / 255);
        }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("mirrored_x: x changes sign, and twice it is the sky itself") {
        const Cube sky = rough_sky(8, 3), turned = mirrored_x(sky), again = mirrored_x(turned);
        for (const Vec3d& d : {Vec3d(1, 0.2, 0.1), Vec3d(-0.3, 1, 0.4), Vec3d(0.2, -0.5, -1)}) {
            double a[3], b[3];
            float value[3];
            lookup(sky, d, value);
            std::copy_n(value, 3, a);
            lookup(turned, Vec3d(-d.x, d.y, d.z), value);
            std::copy_n(value, 3, b);
            for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]));
        }
        for (int face = 0; face < 6; ++face)
            CHECK(std::equal(sky.faces[face].data(), sky.faces[face].data() + sky.faces[face].size(),
                             again.faces[face].data()));
    }

    TEST_CASE("encoding_error: what is stored exactly has none, and twice the light is an error of one") {
        const Cube sky = sunny(8);
        Image<float> stored(8, 48, 3);
        for (int face = 0; face < 6; ++face)
            std::copy_n(sky.faces[face].data(), sky.faces[face].size(), stored.row(8 * face));
        std::vector<Image<float>> levels;
        levels.push_back(std::move(stored));
        const EncodingError none = encoding_error({&sky, 1}, levels, 1.0f);
        CHECK(none.rmse == 0);
        CHECK(none.flux == 0);
        CHECK(none.over > 0);
        for (std::size_t i = 0; i < levels[0].size(); ++i) levels[0].data()[i] *= 2;
        const EncodingError twice = encoding_error({&sky, 1}, levels, 1e6f);
        CHECK(twice.flux == doctest::Approx(1));
        CHECK(twice.over == 0);
    }

    TEST_CASE("read_cube_levels: every level of every form, and no flat pictures") {
        const Folder folder;
        std::vector<Cube> levels;
        for (const int size : {16, 8, 4}) levels.push_back(sunny(size));
        for (const char* file : {"a.dds", "a.ktx2"})
            for (const TexelFormat format : {TexelFormat::rgb9e5, TexelFormat::rgba16f, TexelFormat::bc6h}) {
                BlockWriter out(folder / file);
                write_texture(out, *texture_container(file), format, packed(levels, format), 6);
                out.commit();
                const std::vector<Cube> read = read_cube_levels(folder / file);
                REQUIRE(read.size() == 3);
                for (std::size_t k = 0; k < 3; ++k) {
                    REQUIRE(read[k].size() == levels[k].size());
                    CHECK(double(read[k].faces[4].at(1, 2, 1)) ==
                          doctest::Approx(double(levels[k].faces[4].at(1, 2, 1))).epsilon(0.15));
                }
            }
        BlockWriter out(folder / "flat.ktx2");
        write_texture(out, TextureContainer::ktx2, TexelFormat::rgba16f,
                      {pack_level(Image<float>(levels[0].faces[0].width(), 4, 3), TexelFormat::rgba16f)});
        out.commit();
        CHECK_THROWS_AS(read_cube_levels(folder / "flat.ktx2"), Error);
    }

    TEST_CASE("write_ktx1_cube: header, keys and levels as the specification has them") {
        const Folder folder;
        std::vector<Cube> levels;
        for (const int size : {4, 2}) levels.push_back(sunny(size));
        const std::vector<TextureLevel> bytes = packed(levels, TexelFormat::rgba16f);
        BlockWriter out(folder / "a.ktx");
        write_ktx1_cube(out, bytes, {{"sh", "1 2 3\n"}});
        out.commit();
        const std::string file = contents(folder / "a.ktx");
        const auto word = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, &file[at], 4);
            return value;
        };
        CHECK(file.substr(0, 12) == std::string("\xabKTX 11\xbb\r\n\x1a\n", 12));
        CHECK(word(12) == 0x04030201);
        CHECK(word(16) == 0x140b); // GL_HALF_FLOAT
        CHECK(word(28) == 0x881a); // GL_RGBA16F
        CHECK(word(52) == 6);
        CHECK(word(56) == 2);
        const std::size_t first = 64 + word(60);
        CHECK(file.find(std::string("sh\0"
                                    "1 2 3\n",
                                    9)) != std::string::npos);
        CHECK(word(first) == 4 * 4 * 8); // of one face
        CHECK(file.size() == first + 4 + 6 * 128 + 4 + 6 * 32);
        CHECK(halves_of(bytes[1], 6).at(1, 3, 0) == doctest::Approx(levels[1].faces[1].at(1, 1, 0)).epsilon(1e-3));
    }
}
