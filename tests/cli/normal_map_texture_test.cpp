// bake normal-map into DDS and KTX2, from outside.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;
using nlohmann::json;

namespace {

const std::string torus = (own_meshes() / "torus.obj").string(), dots = (own_meshes() / "dots.png").string();

json bake_map(const Folder& folder, std::vector<std::string> options) {
    options.insert(options.begin(), {"normal-map", "--json"});
    const Run run = run_bake(folder, options);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return json::parse(run.out);
}

/// Waves of 32 x 16 texels, slopes up to about .3 on a plane 1 wide with amplitude .02.
void write_waves(const Folder& folder) {
    Image<float> height(64, 64, 1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            height.at(x, y) = float(0.5 + 0.5 * std::sin(2 * 3.14159265358979 * (x + 0.5) / 32) *
                                              std::cos(2 * 3.14159265358979 * (y + 0.5) / 64));
    write_image(folder / "h.exr", height, {.depth = Depth::float32});
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("normal-map: textures hold the picture's normals; their error is what is read back from the file") {
        const Folder folder;
        write_waves(folder);
        bake_map(folder, {"h.exr", "--amplitude", "0.02", "-o", "n.exr", "--depth", "float"});
        const Image<float> truth = read_image(folder / "n.exr");
        for (const char* end : {"dds", "ktx2"})
            for (const char* depth : {"auto", "bc5", "8", "16"}) {
                CAPTURE(end);
                CAPTURE(depth);
                const std::string name = std::string("n.") + end;
                const json said = bake_map(folder, {"h.exr", "--amplitude", "0.02", "-o", name, "--depth", depth});
                const Image<float> read = read_image(folder / name);
                double squares = 0, most = 0;
                for (int y = 0; y < 64; ++y)
                    for (int x = 0; x < 64; ++x) {
                        double dot = 0, a = 0, b = 0;
                        for (int c = 0; c < 3; ++c) {
                            const double p = 2.0 * read.at(x, y, c) - 1, q = 2.0 * truth.at(x, y, c) - 1;
                            dot += p * q, a += p * p, b += q * q;
                        }
                        const double angle = 180 / 3.14159265358979 * std::acos(std::min(1.0, dot / std::sqrt(a * b)));
                        squares += angle * angle, most = std::max(most, angle);
                    }
                const double rms = std::sqrt(squares / (64 * 64));
                const json& stored = said["stored"];
                CHECK(stored["mips"] == 7);
                CHECK(stored["rms_deg"].get<double>() == doctest::Approx(rms).epsilon(0.01).scale(0.01));
                CHECK(stored["max_deg"].get<double>() == doctest::Approx(most).epsilon(0.01).scale(0.01));
                CHECK(stored["mean_deg"].get<double>() <= stored["rms_deg"].get<double>());
                CHECK(stored["p95_deg"].get<double>() <= stored["max_deg"].get<double>());
                const double encoding = said["error_budget"]["encoding_deg"];
                CHECK(encoding == doctest::Approx(rms).epsilon(0.05).scale(0.01));
                CHECK(said["error_budget"]["total_deg"].get<double>() >= 1.49 * encoding);
                // Blocks of float values are finer than 8 bits on what is smooth.
                if (std::string(depth) == "8") CHECK(rms > 0.15);
                if (std::string(depth) == "16") CHECK(rms < 0.002);
                if (std::string(depth) != "16") CHECK(rms < 0.5);
            }
    }
    TEST_CASE("normal-map: a texture is checked and rendered as any picture") {
        const Folder folder;
        write_waves(folder);
        for (const char* name : {"n.dds", "n.ktx2"}) {
            bake_map(folder, {"h.exr", "--amplitude", "0.02", "-o", name});
            const Run check = run_bake(folder, {"check", name});
            CHECK(check.code == 0);
            CHECK(check.out.find("tangent normal map") != std::string::npos);
            const Run render = run_bake(folder, {"render", torus, "-o", "r.png", "--size", "32x24", "--spp", "1",
                                                 "--material", std::string("normal=") + name});
            CHECK_MESSAGE(render.code == 0, render.err);
        }
    }
    TEST_CASE("normal-map --skip-mips: the file begins with a smaller level, which is the same") {
        const Folder folder;
        write_waves(folder);
        const auto bytes = [&](const char* name, const char* skipped) {
            const json said = bake_map(folder, {"h.exr", "--amplitude", "0.05", "-o", name, "--skip-mips", skipped,
                                                "--roughness-map", "r.dds"});
            const int size = 64 >> std::stoi(skipped);
            CHECK(said["stored"]["width"] == size);
            CHECK(said["stored"]["mips"] == 7 - std::stoi(skipped));
            CHECK(read_image(folder / name).width() == size);
            CHECK(read_image(folder / "r.dds").width() == size);
            CHECK(said["stored"]["rms_deg"].get<double>() < 2);
            return contents(folder / name);
        };
        const std::string all = bytes("n.dds", "0"), some = bytes("n.dds", "2");
        const std::size_t two = 16 * (16 * 16 + 8 * 8); // bytes of the levels 64 x 64 and 32 x 32
        REQUIRE(all.size() == some.size() + two);
        CHECK(all.substr(148 + two) == some.substr(148)); // behind the header
        CHECK(bytes("n.ktx2", "6").size() < bytes("n.ktx2", "0").size());
        const auto refused = [&](const char* out, const char* skipped, const std::string& named) {
            check_refused(folder, {"normal-map", "h.exr", "-o", out, "--skip-mips", skipped}, 2, named);
        };
        refused("m.dds", "7", "--skip-mips 7: a map of 64 x 64 has 7 levels");
        refused("m.png", "1", "--skip-mips: m.png has one level");
        refused("m.dds", "16", "--skip-mips");
    }
    TEST_CASE("normal-map --roughness-map: the base roughness at level 0, more where levels lose slopes") {
        const Folder folder;
        write_waves(folder);
        for (const char* name : {"r.dds", "r.ktx2"}) {
            const json said = bake_map(
                folder, {"h.exr", "--amplitude", "0.1", "-o", "n.png", "--roughness-map", name, "--roughness", "0.2"});
            CHECK(said["roughness_map"] == name);
            const Image<float> finest = read_image(folder / name);
            REQUIRE(finest.channels() == 1);
            for (std::size_t i = 0; i < finest.size(); ++i) CHECK(finest.data()[i] == doctest::Approx(51 / 255.0));
        }
        // The last level: one texel of all slopes.
        const std::string bytes = contents(folder / "r.dds");
        const Image<float> normals = read_image(folder / "n.png");
        double uu = 0, vv = 0, u = 0, v = 0;
        const double count = 64 * 64;
        for (std::size_t i = 0; i < normals.size(); i += 3) {
            const double z = 2.0 * normals.data()[i + 2] - 1, a = (2.0 * normals.data()[i] - 1) / z,
                         b = (2.0 * normals.data()[i + 1] - 1) / z;
            u += a / count, v += b / count, uu += a * a / count, vv += b * b / count;
        }
        const double truth = std::pow(std::pow(0.2, 4) + uu - u * u + vv - v * v, 0.25);
        CHECK(double(static_cast<unsigned char>(bytes.back())) / 255 == doctest::Approx(truth).epsilon(0.01));
    }
    TEST_CASE("normal-map --dither: stores 8 bits whose means are those of the map, and says what that costs") {
        const Folder folder;
        write_waves(folder);
        bake_map(folder, {"h.exr", "--amplitude", "0.02", "-o", "n.exr", "--depth", "float"});
        const Image<float> exact = read_image(folder / "n.exr");
        for (const char* name : {"n.png", "n.tif", "n.dds", "n.ktx2"}) {
            CAPTURE(name);
            const json said =
                bake_map(folder, {"h.exr", "--amplitude", "0.02", "-o", name, "--depth", "8", "--dither"});
            const double cost = said["stored"]["mean_deg"], rounding = said["stored"]["undithered"]["mean_deg"];
            CHECK(cost > 1.2 * rounding);
            CHECK(cost < 2 * rounding);
            CHECK(rounding == doctest::Approx(0.18).epsilon(0.2));
            const Image<float> stored = read_image(folder / name);
            double sum[3] = {}, angle = 0;
            for (std::size_t i = 0; i < 64 * 64; ++i) {
                const auto colour = [i](const Image<float>& map) { // textures have four channels
                    const float* const rgb = map.data() + i * std::size_t(map.channels());
                    return Vec3d(rgb[0], rgb[1], rgb[2]);
                };
                const Vec3d a = colour(stored), b = colour(exact);
                for (int c = 0; c < 3; ++c) sum[c] += a[c] - b[c];
                angle += oracle::angle_deg(2.0 * a - 1.0, 2.0 * b - 1.0) / (64 * 64);
            }
            for (const double s : sum) CHECK(std::abs(s) * 255 / (64 * 64) < 0.02);
            CHECK(angle == doctest::Approx(cost).epsilon(0.01));
        }
    }
    TEST_CASE("normal-map: what textures cannot hold is refused before any work") {
        const Folder folder;
        const auto refused = [&](std::vector<std::string> options, const std::string& named) {
            options.insert(options.begin(), {"normal-map", torus, "--height", dots});
            check_refused(folder, options, 2, named);
        };
        refused({"-o", "n.dds", "--depth", "float"}, "8 or 16 bits or bc5");
        refused({"-o", "n.ktx2", "--depth", "half"}, "8 or 16 bits or bc5");
        refused({"-o", "n.png", "--depth", "bc5"}, "write .dds or .ktx2 for bc5");
        refused({"-o", "n.ktx2", "--space", "object"}, "sign of z");
        refused({"-o", "n.png", "--roughness-map", "r.png"}, "write .dds or .ktx2");
        refused({"-o", "n.png", "--roughness-map", "r.dds", "--space", "object"}, "--roughness-map");
        refused({"-o", "n.png", "--roughness", "0.5"}, "--roughness");
        refused({"-o", "n.png", "--roughness-map", "r.dds", "--roughness", "1.5"}, "--roughness");
        refused({"-o", "n.dds", "--roughness-map", "n.dds"}, "n.dds");
        refused({"-o", "n.png", "--dither"}, "--dither: is for maps of 8 bits");
        refused({"-o", "n.dds", "--dither"}, "--dither: is for maps of 8 bits");
        refused({"-o", "n.jpg"}, ".dds or .ktx2");
    }
    TEST_CASE("normal-map: a texture's bytes do not depend on the number of threads") {
        const Folder folder;
        write_waves(folder);
        for (const char* name : {"n.dds", "n.ktx2"}) {
            bake_map(folder, {"h.exr", "-o", name, "--threads", "1"});
            const std::string one = contents(folder / name);
            bake_map(folder, {"h.exr", "-o", name, "--threads", "3"});
            CHECK(contents(folder / name) == one);
        }
    }
}
