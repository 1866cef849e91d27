// Kinds of mesh files that people have, from outside: far from zero, with gaps, with creases, in other encodings.
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// Waves that tile.
std::string waves(const Folder& folder) {
    Image<float> image(32, 32, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            image.at(x, y, 0) = float(0.5 + 0.3 * std::sin(x * pi / 16) + 0.2 * std::cos(y * pi / 8));
    write_image(folder / "waves.tif", image, {.depth = Depth::u16});
    return "waves.tif";
}

nlohmann::json checked(const Folder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "check");
    arguments.push_back("--json");
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    return nlohmann::json::parse(run.out)["files"][0];
}

Run good(const Folder& folder, const std::vector<std::string>& arguments) {
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    return run;
}

std::string all_of(const nlohmann::json& lines) {
    std::string text;
    for (const auto& line : lines) text += line.get<std::string>() + "\n";
    return text;
}

/// A tower of `rings` rings of 24 quads with a uv seam; every second ring is a crease.
std::string tower(int rings, const char* sharpness) {
    std::string text, faces, tags;
    const int n = 24;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < n; ++i) {
            const double radius = j % 2 ? 1.15 : 1, angle = 2 * pi * i / n;
            text += "v " + std::to_string(radius * std::cos(angle)) + " " + std::to_string(0.3 * j) + " " +
                    std::to_string(-radius * std::sin(angle)) + "\n";
        }
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i <= n; ++i)
            text += "vt " + std::to_string(i / double(n)) + " " + std::to_string(j / double(rings)) + "\n";
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < n; ++i) {
            faces += "f";
            for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                faces += " " + std::to_string((j + b) * n + (i + a) % n + 1) + "/" +
                         std::to_string((j + b) * (n + 1) + i + a + 1);
            faces += "\n";
            if (j % 2)
                tags += "t crease 2/1/0 " + std::to_string(j * n + i) + " " + std::to_string(j * n + (i + 1) % n) +
                        " " + sharpness + "\n";
        }
    return text + faces + tags;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("surface: semi-sharp creases cost little memory") {
        const Folder folder;
        write_file(folder / "tower.obj", tower(32, "7.9"));
        const Run run =
            good(folder, {"surface", "tower.obj", "--subdivide", "catmark", "--resolution", "2", "-o", "t.ply"});
#ifndef __SANITIZE_ADDRESS__
        CHECK(run.peak_mib < 60);
#endif
        CHECK(read_mesh(folder / "t.ply").faces() == 32u * 24 * 4);
    }

    TEST_CASE("displace, surface: --weld joins borders that nearly touch, whose distance check names") {
        const Folder folder;
        Mesh mesh = oracle::torus_mesh(16, 8, true);
        // The last column gets positions of its own, moved by rounding.
        const auto count = std::uint32_t(mesh.positions.size());
        for (std::uint32_t p = 0; p < count; ++p) mesh.positions.push_back(mesh.positions[p] + Vec3f(3e-6f, 0, -2e-6f));
        for (std::size_t c = mesh.corners() - 32; c < mesh.corners(); ++c) mesh.corner_position[c] += count;
        mesh.corner_normal.clear();
        mesh.normals.clear();
        write_mesh(folder / "gap.obj", mesh);
        const auto report = checked(folder, {"gap.obj"});
        CHECK(report["topology"]["boundary_edges"] == 32);
        const std::string notes = all_of(report["notes"]);
        CAPTURE(notes);
        CHECK(notes.find("borders nearly touch: 32 boundary edges") != std::string::npos);
        const std::size_t at = notes.find("--weld is ");
        REQUIRE(at != std::string::npos);
        const std::string distance = notes.substr(at + 10, notes.find_first_of(" \n", at + 10) - at - 10);
        const auto boundary = [&](const std::vector<std::string>& more) {
            std::vector<std::string> arguments = {"displace", "gap.obj",     "--height", waves(folder), "--levels",
                                                  "1",        "--amplitude", "0.05",     "-o",          "out.obj"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            good(folder, arguments);
            const Mesh out = read_mesh(folder / "out.obj");
            return check_mesh(out, triangulate(out)).welded.boundary_edges;
        };
        CHECK(boundary({}) == 64);
        CHECK(boundary({"--weld", distance}) == 0);
        CHECK(boundary({"--weld", "0.001%"}) == 0);
        CHECK(boundary({"--weld", "1e-7"}) == 64);
        CHECK(boundary({"--weld", distance, "--subdivide", "catmark"}) == 0);
        good(folder, {"surface", "gap.obj", "--weld", distance, "-o", "s.ply"});
        CHECK(checked(folder, {"s.ply"})["topology"]["boundary_edges"] == 0);
        // Three triangles around a narrow hole, the long sides of which the distance joins.
        write_file(folder / "hole.obj", "v 0 0 0\nv 1 0 0\nv 0 .001 0\nv .3 0 .5\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        check_refused(folder, {"surface", "hole.obj", "--weld", "0.01", "-o", "x.ply"}, 4,
                      "hole.obj: a --weld of 0.01 joins two corners of face 3");
        check_refused(folder, {"surface", "--shape", "sphere", "--weld", "1", "-o", "x.ply"}, 2, "--weld");
        check_refused(folder, {"surface", "gap.obj", "--weld", "no", "-o", "x.ply"}, 2, "--weld no");
    }

    TEST_CASE(
        "check, displace, surface, normal-map: meshes in coordinates of a map grid are right to 1e-6 of their size") {
        const Folder folder;
        const Mesh near =
            oracle::torus_mesh(32, 16); // of triangles: equal diagonals of quads would be chosen by rounding
        Mesh far = near;
        far.origin = Vec3d(448262, 120, 5411932);
        write_mesh(folder / "near.obj", near);
        for (const char* ending : {"obj", "ply", "glb"}) {
            const std::string mesh = std::string("far.") + ending;
            CAPTURE(mesh);
            write_mesh(folder / mesh, far);
            const auto report = checked(folder, {mesh}), expected = checked(folder, {"near.obj"});
            CHECK(report["diagonal"].get<double>() ==
                  doctest::Approx(expected["diagonal"].get<double>()).epsilon(1e-6));
            CHECK(report["min"][2].get<double>() ==
                  doctest::Approx(5411932 + expected["min"][2].get<double>()).epsilon(1e-12));
            CHECK(all_of(report["notes"]).find("32-bit") == std::string::npos);
            for (const std::string at : {"near.obj", mesh.c_str()}) {
                const std::string out = at.substr(0, at.find('.')) + "_out." + ending;
                good(folder,
                     {"displace", at, "--height", waves(folder), "--levels", "2", "--amplitude", "0.05", "-o", out});
                good(folder, {"normal-map", at, "--height", waves(folder), "--amplitude", "0.05", "--size", "64",
                              "--depth", "float", "-o", at + ".exr"});
            }
            const Mesh moved = read_mesh(folder / ("far_out." + std::string(ending))),
                       plain = read_mesh(folder / ("near_out." + std::string(ending)));
            REQUIRE(moved.corners() == plain.corners());
            double worst = 0;
            for (std::size_t c = 0; c < moved.corners(); ++c) {
                const Vec3d p = moved.origin + Vec3d(moved.positions[moved.corner_position[c]]) - far.origin;
                worst = std::max(worst, glm::distance(p, Vec3d(plain.positions[plain.corner_position[c]])));
            }
            CHECK(worst < 1e-6 * diagonal(bounds(near)));
            const Image<float> a = read_image(folder / "near.obj.exr"), b = read_image(folder / (mesh + ".exr"));
            float most = 0;
            for (int y = 0; y < a.height(); ++y)
                for (int i = 0; i < a.width() * a.channels(); ++i)
                    most = std::max(most, std::abs(a.row(y)[i] - b.row(y)[i]));
            CHECK(most < 1e-3f);
            const auto distance = checked(folder, {mesh, "--against", "far.obj"});
            CHECK(distance["hausdorff"]["upper"].get<double>() < 1e-6 * diagonal(bounds(near)));
        }
        good(folder, {"surface", "far.obj", "-o", "s.glb"});
        CHECK(checked(folder, {"s.glb", "--against", "far.ply"})["hausdorff"]["upper"].get<double>() < 1e-5);
        const Run maps = good(folder, {"surface", "far.obj", "--maps", "position", "--size", "32", "--maps-out", "m"});
        CHECK(maps.err.find("positions in the map are relative to (44826") != std::string::npos);
    }

    TEST_CASE(
        "surface, displace: a cage without a limit surface is refused in the same words, whatever is asked of it") {
        const Folder folder;
        const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                 "f 1/1 2/2 3/3 4/4\nt interpolateboundary 1/0/0 0\n";
        write_file(folder / "cage.obj", quad);
        const std::string why =
            "cage.obj: its boundary rule, interpolateboundary 0, leaves out the faces at the border";
        check_refused(folder, {"surface", "cage.obj", "--subdivide", "catmark", "-o", "s.ply"}, 4, why);
        check_refused(folder, {"surface", "cage.obj", "--subdivide", "catmark", "--maps-out", "m"}, 4, why);
        const std::vector<std::string> displace = {"displace", "cage.obj",    "--subdivide", "catmark",
                                                   "--height", waves(folder), "-o",          "d.ply"};
        for (const std::vector<std::string>& more :
             {std::vector<std::string>{}, {"--max-error", "0.01"}, {"--edge-px", "4", "--camera", "position=0,0,5"}}) {
            std::vector<std::string> arguments = displace;
            arguments.insert(arguments.end(), more.begin(), more.end());
            check_refused(folder, arguments, 4, why);
        }
    }

    TEST_CASE("check: Ctrl-C ends the splitting of a polygon with many corners") {
        const Folder folder;
        std::string text, face = "f";
        for (int i = 0; i < 400000; ++i) {
            const double angle = i * 0.01 * (i < 200000 ? 1 : -1) + (i < 200000 ? 0 : 4000), radius = 1 + angle / 200;
            text += "v " + std::to_string(radius * std::cos(angle) * (i < 200000 ? 1 : 1.002)) + " " +
                    std::to_string(radius * std::sin(angle) * (i < 200000 ? 1 : 1.002)) + " 0\n";
            face += " " + std::to_string(i + 1);
        }
        write_file(folder / "spiral.obj", text + face + "\n");
        const Run run = run_bake(folder, {"check", "spiral.obj"}, {.interrupt_after = 0.1});
        CHECK(run.code == 130);
        CHECK(run.seconds < 5);
    }

    TEST_CASE("check: notes of the reader stand among those of the check") {
        const Folder folder;
        write_file(folder / "s.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\ns off\nf 1 2 3\n");
        CHECK(all_of(checked(folder, {"s.obj"})["notes"]).find("smoothing groups of the file: 1 of 1 faces") !=
              std::string::npos);
    }
}
