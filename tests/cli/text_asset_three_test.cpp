// asset.glb, asset.usda and asset.mtlx of one bake in three.js in a headless Chromium: the normals that it shades with.
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "browser.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace {

using namespace bake;
using namespace bake::test;
using nlohmann::json;

constexpr int side = 256;

/// A folder with the three files of a bake, and a camera.
struct Assets {
    Folder folder;
    json camera;

    Assets(const fs::path& mesh, const std::string& amplitude, const Vec3f& from) {
        for (const char* out : {"asset.glb", "asset.usda", "asset.mtlx"}) {
            const Run run =
                run_bake(folder, {"normal-map", mesh.string(), "--height", (own_meshes() / "bricks.png").string(),
                                  "--amplitude", amplitude, "--size", "512", "-o", out});
            REQUIRE_MESSAGE(run.code == 0, run.err);
        }
        const Bounds box = bounds(read_mesh(mesh.string()));
        const Vec3f target = 0.5f * (box.min + box.max),
                    position = target + glm::normalize(from) * float(1.8 * diagonal(box));
        const auto triple = [](const Vec3f& v) { return json{v.x, v.y, v.z}; };
        camera = {{"position", triple(position)}, {"target", triple(target)}, {"fov_deg", 35}};
    }

    /// Normals as scripts/three_viewer draws them for the output.
    Image<float> normals(json output, bool nodes) const {
        output["what"] = "normals", output["file"] = "n.f32";
        const json job = {{"nodes", nodes}, {"size", {side, side}}, {"camera", camera}, {"outputs", {output}}};
        write_file(folder / "job.json", job.dump());
        const std::string log = folder / "three.log";
        const int status = std::system(("'" + (source_folder() / "scripts/three_viewer").string() + "' '" +
                                        (folder / "job.json") + "' >'" + log + "' 2>&1")
                                           .c_str());
        REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
        CHECK(contents(log) == ""); // three.js and the browser complain of nothing
        Image<float> image(side, side, 4);
        const std::string bytes = contents(folder / "n.f32");
        REQUIRE(bytes.size() == image.size() * sizeof(float));
        std::memcpy(image.data(), bytes.data(), bytes.size());
        return image;
    }
};

struct Angles {
    double mean = 0, p95 = 0, most = 0; ///< degrees
};

Angles between(const Image<float>& a, const Image<float>& b) {
    std::vector<double> all;
    const auto at = [](const Image<float>& n, int x, int y) {
        return Vec3d(n.at(x, y, 0), n.at(x, y, 1), n.at(x, y, 2));
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            if (a.at(x, y, 3) != 1 || b.at(x, y, 3) != 1) continue;
            const Vec3d n = at(a, x, y), m = at(b, x, y);
            const bool unit = std::abs(glm::length(n) - 1) < 1e-3 && std::abs(glm::length(m) - 1) < 1e-3;
            all.push_back(unit ? oracle::angle_deg(n, m) : 180); // a material that failed gives zeros or NaN
        }
    REQUIRE(all.size() > side * side / 10);
    std::sort(all.begin(), all.end());
    Angles out{0, all[all.size() * 95 / 100], all.back()};
    for (const double angle : all) out.mean += angle / double(all.size());
    return out;
}

/// The files of the bake against its .glb, within half a degree at every pixel, and how far USDLoader alone is from it.
Angles check_files(const Assets& assets) {
    const Image<float> glb = assets.normals({{"model", "asset.glb"}}, false);
    const Angles usda = between(glb, assets.normals({{"model", "asset.usda"}, {"tangents", true}}, false));
    const Angles mtlx = between(glb, assets.normals({{"model", "asset.glb"}, {"material", "asset.mtlx"}}, true));
    const Angles alone = between(glb, assets.normals({{"model", "asset.usda"}}, false));
    for (const auto& [name, angles] :
         {std::pair(std::string(".usda"), usda), {".mtlx", mtlx}, {"USDLoader alone", alone}})
        MESSAGE(name << ": mean " << angles.mean << ", p95 " << angles.p95 << ", max " << angles.most << " deg");
    CHECK(usda.most < 0.5);
    CHECK(mtlx.most < 0.5);
    return alone;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("text asset: three.js shades a torus with the normals of the .glb" * doctest::skip(no_browser())) {
        check_files(Assets(own_meshes() / "torus.obj", "1%", Vec3f(1.2f, 2.6f, 3.8f)));
    }
} // cli

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("text asset: three.js shades Spot with the normals of the .glb" *
              doctest::skip(no_shared_data() || no_browser())) {
        const Angles alone =
            check_files(Assets(shared_data() / "meshes/spot/spot_triangulated.obj", "0.5%", Vec3f(1.5f, 1.2f, -3.2f)));
        CHECK(alone.mean < 0.5); // USDLoader takes no tangents, and three.js estimates them from the pixels
    }
} // real
