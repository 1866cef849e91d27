// What bake cubemap --for three writes, shown by three.js in a headless Chromium without a filter of its own.
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
#include "browser.h"
#include "cli/command.h"
#include "oracle/zonal.h"
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

using namespace bake;
using namespace bake::test;

namespace {

constexpr int side = 128;
/// Of levels 1 to 6 of a cube of 512: between levels, three.js interpolates, whoever filtered them.
double of_level(int level) { return 1 - std::sqrt(1 - level / 6.0); }
const double roughnesses[] = {of_level(1), of_level(2), of_level(3), of_level(4), of_level(5), 1};
constexpr double even = 0.2;
const oracle::Sun sun{.amplitude = 40, .kappa = 300};
const Vec3d sun_direction = glm::normalize(Vec3d(0.35, 0.45, 0.82));

/// A lat-long: ahead, +z of the world, in the middle; cube space's +x, the world's -x, to the right.
void write_sky(const std::string& path) {
    Image<float> sky(1024, 512, 3);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) {
            const double azimuth = 2 * pi * ((x + 0.5) / 1024 - 0.5), polar = pi * (y + 0.5) / 512;
            const Vec3d d(-std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
            for (int c = 0; c < 3; ++c) sky.at(x, y, c) = float(even + sun.radiance(glm::dot(d, sun_direction)));
        }
    write_image(path, sky, {.depth = Depth::float32});
}

Image<float> floats(const std::string& path) {
    const std::string bytes = contents(path);
    Image<float> image(side, side, 4);
    REQUIRE(bytes.size() == image.size() * sizeof(float));
    std::memcpy(image.data(), bytes.data(), bytes.size());
    return image;
}

/// Pictures of the sphere for each roughness, and of the directions.
struct Shown {
    std::vector<Image<float>> lobes, directions;
};

Shown shown(const Folder& folder, const nlohmann::json& sky) {
    nlohmann::json outputs = nlohmann::json::array();
    for (const double r : roughnesses) {
        const std::string name = std::to_string(r);
        outputs.push_back({{"what", "lobe"}, {"roughness", r}, {"file", name + ".f32"}});
        outputs.push_back({{"what", "lobe"}, {"roughness", r}, {"file", name + "_d.f32"}, {"directions", true}});
    }
    const nlohmann::json job = {{"sky", sky},
                                {"size", {side, side}},
                                {"camera", {{"position", {0, 0, 6}}, {"target", {0, 0, 0}}, {"fov_deg", 20}}},
                                {"outputs", outputs}};
    write_file(folder / "job.json", job.dump());
    const std::string log = folder / "three.log";
    const int status = std::system(("'" + (source_folder() / "scripts/three_viewer").string() + "' '" +
                                    (folder / "job.json") + "' >'" + log + "' 2>&1")
                                       .c_str());
    REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
    CHECK(contents(log) == ""); // three.js and the browser complain of nothing
    Shown out;
    for (const double r : roughnesses) {
        out.lobes.push_back(floats(folder / (std::to_string(r) + ".f32")));
        out.directions.push_back(floats(folder / (std::to_string(r) + "_d.f32")));
    }
    return out;
}

/// Root mean square over the sphere of the error against the closed form, over its mean, for each roughness.
std::vector<double> errors_of(const Shown& pictures) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < std::size(roughnesses); ++k) {
        const double alpha = roughnesses[k] * roughnesses[k];
        const oracle::ConvolvedSun expected(sun, [&](double c) { return oracle::ggx_kernel(c, alpha); });
        double squares = 0, mean = 0;
        int count = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Image<float>& at = pictures.directions[k];
                if (at.at(x, y, 3) < 1) continue;
                const Vec3d d = glm::normalize(Vec3d(at.at(x, y, 0), at.at(x, y, 1), at.at(x, y, 2)));
                const double right = even + expected(glm::dot(d, sun_direction)) / expected.norm;
                const double error = double(pictures.lobes[k].at(x, y, 1)) - right;
                squares += error * error, mean += right, ++count;
            }
        REQUIRE(count > side * side / 4);
        errors.push_back(std::sqrt(squares / count) / (mean / count));
    }
    return errors;
}

void run(const Folder& folder, const std::vector<std::string>& line) {
    const Run done = run_bake(folder, line);
    REQUIRE_MESSAGE(done.code == 0, done.err);
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE(
        "cubemap --for three: nearer to the closed form than three.js' own filter at the roughness of each level" *
        doctest::skip(no_browser())) {
        const Folder folder;
        write_sky(folder / "sky.exr");
        run(folder, {"cubemap", "sky.exr", "--for", "three", "--size", "512", "-o", "env.dds"});
        run(folder, {"cubemap", "sky.exr", "--for", "three", "--size", "512", "--texels", "half", "-o", "env.ktx2"});
        run(folder, {"cubemap", "sky.exr", "--size", "512", "--depth", "float", "-o", "face_%s.exr"});
        CHECK(fs::file_size(folder / "env.dds") <= 2'100'000);
        const std::vector<double> blocks = errors_of(shown(folder, {"env.dds"}));
        const std::vector<double> halves = errors_of(shown(folder, {"env.ktx2"}));
        nlohmann::json faces;
        for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
            faces.push_back("face_" + std::string(face) + ".exr");
        const std::vector<double> theirs = errors_of(shown(folder, faces));
        for (std::size_t k = 0; k < std::size(roughnesses); ++k) {
            MESSAGE("roughness " << roughnesses[k] << ": rmse over the mean " << halves[k] << ", in BC6H " << blocks[k]
                                 << ", three.js' own filter " << theirs[k]);
            CHECK(halves[k] < 0.5 * theirs[k]);
            CHECK(blocks[k] < theirs[k]);
        }
    }

    TEST_CASE("cubemap --for three: a lat-long lights from where the sky is in bake" * doctest::skip(no_browser())) {
        const Folder folder;
        write_sky(folder / "sky.exr");
        for (const std::string file : {"for_three.hdr", "for_three.exr"}) {
            CAPTURE(file);
            // Of this width three.js makes a cube of 512, which it filters itself.
            run(folder, {"cubemap", "sky.exr", "--for", "three", "--size", "2048", "-o", file});
            for (const double error : errors_of(shown(folder, {file}))) CHECK(error < 0.03);
        }
    }

    TEST_CASE("cubemap --for three: KTX2 is read by ktx-parse and shows the same" * doctest::skip(no_browser())) {
        const Folder folder;
        write_sky(folder / "sky.exr");
        std::vector<double> errors[2];
        for (const std::string texels : {"bc6h", "half"}) {
            run(folder, {"cubemap", "sky.exr", "--for", "three", "--size", "64", "--texels", texels, "-o", "env.ktx2"});
            errors[texels == "half"] = errors_of(shown(folder, {"env.ktx2"}));
        }
        for (std::size_t k = 0; k < std::size(roughnesses); ++k) {
            CHECK(std::abs(errors[0][k] - errors[1][k]) < 0.1); // their texels are coarser than the sun
        }
    }
}
