// bake normal-map --high from outside: options that make another mesh of what is read, or write one.
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/bake_target.h"
#include "cli/command.h"
#include "relief/transfer/voxel_meshes.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// Done, with no word on stderr.
Run good(const Folder& folder, const std::vector<std::string>& arguments) {
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(run.err == "");
    return run;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("high to low: a ball of cubes has normals of six directions, and smoothed those of a sphere") {
        const Folder folder;
        const Mesh cubes = voxel_mesh(40, [](const Vec3d& p) { return glm::length(p - 20.13) < 16; });
        write_mesh(folder / "cubes.ply", cubes);
        REQUIRE(
            run_bake(folder, {"surface", "--shape", "sphere:R=16", "--resolution", "24x12", "-o", "low.ply", "--quiet"})
                .code == 0);
        Mesh low = read_mesh(folder / "low.ply");
        for (Vec3f& p : low.positions) p += 20.13f;
        write_mesh(folder / "low.ply", low);
        const auto bake = [&](const char* option, const char* value) {
            const Run run =
                run_bake(folder, {"normal-map", "low.ply", "--high", "cubes.ply", "-o", "n.exr", "--depth", "float",
                                  "--space", "object", "--size", "64x32", "--padding", "0", "--json", option, value});
            REQUIRE(run.code == 0);
            return nlohmann::json::parse(run.out);
        };
        CHECK(bake("--high-normals", "facet")["high"]["smooth"] == 0);
        const Image<float> steps = read_image(folder / "n.exr");
        for (std::size_t i = 0; i < steps.size(); ++i)
            CHECK(std::abs(std::round(2 * steps.data()[i]) - 2 * steps.data()[i]) < 1e-3f);
        CHECK(bake("--high-smooth", "3")["high"]["smooth"] == 3);
        const Image<float> smooth = read_image(folder / "n.exr");
        const BakeTarget target = make_bake_target(low, "low.ply", 64, 32);
        std::vector<double> angles;
        for (int y = 1; y < 31; ++y)
            for (int x = 0; x < 64; ++x) {
                const TexelHit& at = target.raster.hits.at(x, y);
                const auto& corner = target.surface.triangles[at.triangle].corner;
                Vec3d p = -Vec3d(20.13);
                const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
                for (std::size_t k = 0; k < 3; ++k)
                    p += double(b[k]) * Vec3d(low.positions[low.corner_position[corner[k]]]);
                const Vec3d n = 2.0 * Vec3d(smooth.at(x, y, 0), smooth.at(x, y, 1), smooth.at(x, y, 2)) - 1.0;
                angles.push_back(std::acos(std::min(1.0, glm::dot(glm::normalize(n), glm::normalize(p)))) * 180 / pi);
            }
        std::sort(angles.begin(), angles.end());
        double mean = 0;
        for (const double angle : angles) mean += angle / double(angles.size());
        CHECK(mean < 0.5);
        CHECK(angles[angles.size() * 95 / 100] < 1);
    }

    TEST_CASE("high to low: the envelope comes out as a cage, and gives the same map") {
        const Folder folder;
        const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();
        REQUIRE(
            run_bake(folder, {"displace", torus, "--height", dots, "--levels", "1", "--quiet", "-o", "d.ply"}).code ==
            0);
        for (const char* cage : {"cage.ply", "cage.obj"}) {
            const auto bake = [&](const char* out, const char* option) {
                return nlohmann::json::parse(good(folder, {"normal-map", torus, "--high", "d.ply", "-o", out, "--size",
                                                           "96x48", "--json", option, cage})
                                                 .out);
            };
            const nlohmann::json first = bake("a.png", "--cage-out"), again = bake("b.png", "--cage");
            CHECK(first["high"]["cage_out"] == cage);
            CHECK(first["texels"]["missed"] == 0);
            CHECK(again["texels"]["missed"] == 0);
            CHECK(again["reach"]["front"].get<double>() >= first["reach"]["front"].get<double>() - 1e-6);
            const Image<float> a = read_image(folder / "a.png"), b = read_image(folder / "b.png");
            double sum = 0;
            for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a.data()[i]) - b.data()[i]);
            CHECK(sum / double(a.size()) < 1e-3);
        }
        const Run text = good(
            folder, {"normal-map", torus, "--high", "d.ply", "-o", "a.png", "--size", "16", "--cage-out", "cage.ply"});
        CHECK(text.out.find("envelope written as a cage to cage.ply") != std::string::npos);
    }

    TEST_CASE("high to low: --report-map writes a picture in which texels without detail are red") {
        const Folder folder;
        write_file(folder / "low.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
        write_file(folder / "half.obj", "v -1 -1 .01\nv .5 -1 .01\nv .5 2 .01\nv -1 2 .01\nf 1 2 3 4\n");
        const Run run = run_bake(folder, {"normal-map", "low.obj", "--high", "half.obj", "-o", "n.png", "--size", "16",
                                          "--report-map", "r.png"});
        CHECK(run.code == 0);
        const Image<float> map = read_image(folder / "r.png");
        REQUIRE(map.width() == 16);
        int red = 0, grey = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                const float* const rgb = &map.at(x, y);
                red += x >= 8 && rgb[0] == 1 && rgb[1] == 0 && rgb[2] == 0;
                grey += x < 8 && rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] < 0.2f;
            }
        CHECK(red == 128);
        CHECK(grey == 128);
        check_refused(folder, {"normal-map", "low.obj", "--high", "half.obj", "-o", "n.png", "--report-map", "r.jpg"},
                      2, "r.jpg");
        check_refused(folder,
                      {"normal-map", "low.obj", "--high", "half.obj", "-o", "n.<UDIM>.png", "--report-map", "r.png"}, 2,
                      "<UDIM> stands in the names of all files or in none");
    }

} // TEST_SUITE
