// bake displace on meshes of which some faces have no uvs.
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/file/mesh_io.h"
#include "cli/displacing.h"
#include "cli/gltf_parts.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// A height that moves every uv, and moves (0, 0) by 0.03.
std::string ramp(const Folder& folder) {
    write_picture(
        folder / "ramp.tif", 16, 16, 1, [](int x, int, int) { return 0.8 + 0.01 * x; }, Depth::u16);
    return "ramp.tif";
}

struct Range {
    double least = 1e9, most = -1e9;
};
/// The z of the positions from `left` to `left` + 1.
Range heights(const Mesh& mesh, float left) {
    Range out;
    for (const Vec3f& p : mesh.positions)
        if (p.x > left - 0.5f && p.x < left + 1.5f)
            out = {std::min(out.least, double(p.z)), std::max(out.most, double(p.z))};
    return out;
}

std::vector<std::string> notes(const Run& run) {
    return nlohmann::json::parse(run.out)["notes"].get<std::vector<std::string>>();
}

/// The cube with one face, or a part of its uvs, bare.
std::string bare_cube(bool partly) {
    return bake_tests::replaced(cube_obj, "f 5/1 6/2 7/3 8/4", partly ? "f 5/1 6 7/3 8/4" : "f 5 6 7 8");
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("displace: faces without uvs stay where they are, as they are and finer, and a note counts them") {
        const Folder folder;
        const std::string quads = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\n"
                                  "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
        write_file(folder / "half.obj", quads + "f 5 6 7 8\n");
        write_file(folder / "partly.obj", quads + "f 5/1 6 7/3 8/4\n");
        for (const std::string file : {"half.obj", "partly.obj"})
            for (const std::vector<std::string>& kind : {std::vector<std::string>{"--subdivide", "none"},
                                                         {"--levels", "2"},
                                                         {"--subdivide", "catmark", "--levels", "2"},
                                                         {"--seam", "average", "--levels", "1"},
                                                         {"--max-error", "0.001"}})
                for (const std::string out : {"o.obj", "o.glb"}) {
                    CAPTURE(file);
                    CAPTURE(kind.back());
                    std::vector<std::string> all = {file, "--height", ramp(folder), "--amplitude", "0.1", "-o", out};
                    all.insert(all.end(), kind.begin(), kind.end());
                    const Run run = displaced(folder, all);
                    CHECK(run.err.find(file + ": 1 of 2 faces have no uvs and stay where they are") !=
                          std::string::npos);
                    const Mesh mesh = read_mesh(folder / out);
                    const Range moved = heights(mesh, 0), bare = heights(mesh, 2);
                    CHECK(moved.least > 0.025);
                    CHECK(bare.least == 0);
                    CHECK(bare.most == 0);
                }
        const Mesh mesh = read_mesh(folder / "o.obj");
        CHECK(std::count(mesh.corner_uv.begin(), mesh.corner_uv.end(), no_index) > 0);
        CHECK(mesh.uvs.size() < mesh.positions.size()); // none is left of those that no face has
        const Run run = displaced(folder, {"half.obj", "--height", ramp(folder), "-o", "o.ply", "--json"});
        CHECK(nlohmann::json::parse(run.out)["faces_without_uv"] == 1);
        const std::vector<std::string> all = notes(run);
        CHECK(std::count(all.begin(), all.end(), "half.obj: 1 of 2 faces have no uvs and stay where they are") == 1);
    }

    TEST_CASE("displace: vectors do not move faces without uvs either") {
        const Folder folder;
        write_file(folder / "half.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\n"
                                        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf 5 6 7 8\n");
        write_picture(folder / "v.tif", 4, 4, 3, [](int, int, int) { return 0.25; });
        for (const char* space : {"tangent", "object"}) {
            displaced(folder, {"half.obj", "--height", "v.tif", "--vector", space, "--levels", "1", "-o", "o.obj"});
            const Mesh mesh = read_mesh(folder / "o.obj");
            CHECK(heights(mesh, 0).least == doctest::Approx(0.25));
            CHECK(heights(mesh, 2).most == 0);
        }
    }

    TEST_CASE("displace: a set of uvs that some primitives of a glTF file lack moves the others alone") {
        const Folder folder;
        write_file(folder / "a.gltf", square_parts({{{0, 1}, 0}, {{0}, 1}}, {"a", "b"}));
        for (const std::string levels : {"0", "2"}) {
            const Run run = displaced(folder, {"a.gltf", "--height", ramp(folder), "--amplitude", "0.1", "--uv-set",
                                               "1", "--levels", levels, "-o", "o.glb"});
            CHECK(run.err.find("a.gltf: 2 of 4 faces have no uvs and stay where they are") != std::string::npos);
            const Mesh mesh = read_mesh(folder / "o.glb");
            CHECK(heights(mesh, 0).least > 0.025);
            CHECK(heights(mesh, 2).most == 0);
            CHECK(!mesh.corner_uv.empty()); // TEXCOORD_0 of the file is kept
            CHECK(std::count(mesh.corner_uv.begin(), mesh.corner_uv.end(), no_index) == 0);
        }
        write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2 3\n");
        check_refused(folder, {"displace", "bare.obj", "--height", ramp(folder), "-o", "x.obj"}, 4,
                      "bare.obj: has no uvs");
    }

    TEST_CASE("displace: where faces with and without uvs meet there is no crack") {
        const Folder folder;
        for (const bool partly : {false, true})
            for (const char* seam : {"blend", "average", "owner"})
                for (const std::vector<std::string>& kind : {std::vector<std::string>{"--subdivide", "none"},
                                                             {"--levels", "3"},
                                                             {"--subdivide", "catmark", "--levels", "3"},
                                                             {"--max-error", "0.005"}}) {
                    CAPTURE(partly);
                    CAPTURE(seam);
                    CAPTURE(kind.back());
                    write_file(folder / "cube.obj", bare_cube(partly));
                    std::vector<std::string> all = {"cube.obj", "--height", waves(folder), "--amplitude", "0.1",
                                                    "--seam",   seam,       "-o",          "o.obj"};
                    all.insert(all.end(), kind.begin(), kind.end());
                    CHECK(displaced(folder, all).err.find("1 of 6 faces have no uvs") != std::string::npos);
                    const Mesh mesh = read_mesh(folder / "o.obj");
                    const Connectivity whole = check_mesh(mesh, triangulate(mesh)).welded;
                    CHECK(whole.boundary_edges == 0);
                    CHECK(whole.components == 1);
                }
        // The middle of the bare face is a face away from the seams of one that is cut, and stays.
        displaced(folder, {"cube.obj", "--height", waves(folder), "--amplitude", "0.1", "--seam", "average", "--levels",
                           "3", "-o", "o.obj"});
        double most = 0;
        for (const Vec3f& p : read_mesh(folder / "o.obj").positions)
            if (std::abs(p.x - 0.5f) < 0.4f && std::abs(p.y - 0.5f) < 0.4f && p.z > 0.8f)
                most = std::max(most, std::abs(double(p.z) - 1));
        CHECK(most == 0);
    }
}
