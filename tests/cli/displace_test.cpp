// bake displace from outside: what each base and format gives, what is refused, and what is left behind.
#include "bake/mesh/check/mesh_audit.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "cli/displacing.h"
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

nlohmann::json report(const Folder& folder, std::vector<std::string> arguments) {
    arguments.push_back("--json");
    return nlohmann::json::parse(displaced(folder, std::move(arguments)).out);
}

Connectivity topology(const std::string& file) {
    const Mesh mesh = read_mesh(file);
    return check_mesh(mesh, triangulate(mesh)).welded;
}

/// Displaces every mesh of the folder, as it is and as a cage: the result is whole, with finite points, or the refusal is
/// one line. Returns how many were displaced.
int displace_all(const fs::path& meshes) {
    const Folder folder;
    waves(folder);
    int done = 0;
    for (const auto& entry : fs::directory_iterator(meshes))
        for (const char* kind : {"linear", "catmark"}) {
            const fs::path& file = entry.path();
            CAPTURE(file.string());
            CAPTURE(kind);
            const Run run = run_bake(folder, {"displace", file.string(), "--height", waves(folder), "--amplitude", "1%",
                                              "--subdivide", kind, "--levels", "1", "-o", "a.ply"});
            CAPTURE(run.err);
            CHECK((run.code == 0 || run.code == 3 || run.code == 4));
            if (run.code != 0) {
                CHECK(lines(run.err) == 1);
                CHECK(run.err.starts_with("bake: " + file.string()));
                CHECK(!fs::exists(folder / "a.ply"));
                continue;
            }
            ++done;
            float worst = 0;
            for (const Vec3f& p : read_mesh(folder / "a.ply").positions)
                worst = std::max(worst, std::abs(glm::length(p)) * 0 == 0 ? 0.0f : 1.0f);
            CHECK(worst == 0);
            fs::remove(folder / "a.ply");
        }
    return done;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("displace: every base gives a closed mesh in every format") {
        const Folder folder;
        write_file(folder / "cube.obj", cube_obj);
        const std::vector<std::vector<std::string>> bases = {{torus},
                                                             {torus, "--levels", "1"},
                                                             {"cube.obj", "--subdivide", "linear"},
                                                             {"cube.obj", "--subdivide", "catmark"},
                                                             {"--shape", "sphere", "--levels", "0"}};
        for (const std::vector<std::string>& base : bases)
            for (const char* out : {"a.obj", "a.ply", "a.glb", "a.gltf"}) {
                std::vector<std::string> arguments = base;
                arguments.insert(arguments.end(), {"--height", waves(folder), "--amplitude", "1%", "-o", out});
                const nlohmann::json result = report(folder, arguments);
                const Connectivity t = topology(folder / out);
                CHECK(t.boundary_edges == 0);
                CHECK(t.nonmanifold_edges == 0);
                CHECK(t.flipped_faces == 0);
                CHECK(result["points"].get<int>() > 0);
                CHECK(result["height"]["max"].get<double>() > result["height"]["min"].get<double>());
                const auto beside = std::string(out) == "a.gltf" ? fs::file_size(folder / "a.bin") : 0;
                CHECK(result["file_bytes"] == fs::file_size(folder / out) + beside);
            }
        CHECK(folder.names().size() == 7); // four results, the .bin, the cube, the height
    }

    TEST_CASE("displace: a loop cage of triangles, and levels that multiply the faces by 4^N") {
        const Folder folder;
        write_file(folder / "octahedron.obj",
                   "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                   "f 1/1 3/2 5/3\nf 3/1 2/2 5/3\nf 2/1 4/2 5/3\nf 4/1 1/2 5/3\nf 3/1 1/2 6/3\nf 2/1 3/2 6/3\nf 4/1 "
                   "2/2 6/3\nf 1/1 4/2 6/3\n");
        for (const int levels : {0, 2, 3}) {
            const nlohmann::json result =
                report(folder, {"octahedron.obj", "--subdivide", "loop", "--levels", std::to_string(levels), "--height",
                                waves(folder), "-o", "a.ply"});
            CHECK(result["triangles"] == 8 << 2 * levels);
            CHECK(topology(folder / "a.ply").boundary_edges == 0);
        }
    }

    TEST_CASE("displace: --flip-v reads a mesh whose v runs the other way") {
        const Folder folder;
        const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", face = "f 1/1 2/2 3/3 4/4\n";
        write_file(folder / "up.obj", points + "vt 0 0.25\nvt 1 0.25\nvt 1 0.5\nvt 0 0.5\n" + face);
        write_file(folder / "down.obj", points + "vt 0 0.75\nvt 1 0.75\nvt 1 0.5\nvt 0 0.5\n" + face);
        const auto positions = [&](const char* mesh, std::vector<std::string> more) {
            more.insert(more.begin(), {mesh, "--height", waves(folder), "--levels", "2", "-o", "a.ply"});
            displaced(folder, more);
            return read_mesh(folder / "a.ply").positions;
        };
        const std::vector<Vec3f> up = positions("up.obj", {});
        CHECK((positions("down.obj", {"--flip-v"}) == up));
        CHECK((positions("down.obj", {}) != up));
    }

    TEST_CASE("displace: a constant height moves everything by amplitude (value - midlevel)") {
        const Folder folder;
        write_picture(folder / "white.tif", 2, 2, 1, [](int, int, int) { return 1; });
        const nlohmann::json result = report(folder, {"--shape", "sphere:R=2", "--levels", "0", "--height", "white.tif",
                                                      "--amplitude", "0.4", "--midlevel", "0.25", "-o", "a.ply"});
        CHECK(result["height"]["min"].get<double>() == doctest::Approx(0.3));
        for (const Vec3f& p : read_mesh(folder / "a.ply").positions)
            CHECK(glm::length(p) == doctest::Approx(2.3f).epsilon(1e-6));
        // Floats are lengths unless an amplitude is given; integers reach 1 % of the diagonal.
        CHECK(report(folder, {torus, "--height", "white.tif", "-o", "a.ply"})["amplitude"] == 1);
        const nlohmann::json by_default = report(folder, {torus, "--height", waves(folder), "-o", "a.ply"});
        CHECK(by_default["amplitude"].get<double>() == doctest::Approx(0.01 * by_default["diagonal"].get<double>()));
    }

    TEST_CASE("displace: vectors go along x, y, z or T, B, n; a float file's zero is no displacement") {
        const Folder folder;
        write_picture(folder / "v.tif", 2, 2, 3, [](int, int, int c) { return c == 0 ? 0.25 : c == 1 ? -0.5 : 0.125; });
        const std::vector<std::string> rest = {"--height", "v.tif",    "--amplitude", "1",       "-o",
                                               "a.ply",    "--levels", "0",           "--shape", "plane"};
        std::vector<std::string> object = rest, tangent = rest;
        object.insert(object.end(), {"--vector", "object"}), tangent.insert(tangent.end(), {"--vector", "tangent"});
        displaced(folder,
                  {"--shape", "plane", "--levels", "0", "--height", "v.tif", "--amplitude", "0", "-o", "flat.ply"});
        const Mesh flat = read_mesh(folder / "flat.ply");
        displaced(folder, object);
        const Mesh along_axes = read_mesh(folder / "a.ply");
        displaced(folder, tangent);
        const Mesh along_frame = read_mesh(folder / "a.ply");
        REQUIRE(flat.positions.size() == along_axes.positions.size());
        const Vec3f n = flat.normals[0], vector(0.25f, -0.5f, 0.125f);
        float worst = 0;
        for (std::size_t i = 0; i < flat.positions.size(); ++i) {
            const Vec3f moved = along_frame.positions[i] - flat.positions[i];
            worst =
                std::max({worst, glm::length(along_axes.positions[i] - flat.positions[i] - vector),
                          std::abs(glm::dot(moved, n) - vector.z), std::abs(glm::length(moved) - glm::length(vector))});
        }
        CHECK(worst < 1e-6f);
    }

    TEST_CASE("displace: rates by a camera cut finer where it is near; by error, until it is met") {
        const Folder folder;
        const auto points = [&](std::vector<std::string> rates) {
            std::vector<std::string> arguments = {torus, "--height", waves(folder), "--amplitude", "1%", "-o", "a.ply"};
            arguments.insert(arguments.end(), rates.begin(), rates.end());
            const nlohmann::json result = report(folder, arguments);
            CHECK(topology(folder / "a.ply").boundary_edges == 0);
            return result["points"].get<int>();
        };
        const int far = points({"--edge-px", "8", "--camera", "position=0,0,20"}),
                  near = points({"--edge-px", "8", "--camera", "position=0,0,5"});
        CHECK(near > far);
        CHECK(points({"--edge-px", "8", "--camera", "position=0,0,5:height=2160"}) > near);
        write_file(folder / "scene.toml",
                   "[render]\nsize = [100, 1080]\n[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n");
        CHECK(points({"--edge-px", "8", "--camera", "scene.toml"}) == near);
        write_file(folder / "cube.obj", cube_obj);
        const auto by_error = [&](const char* error) {
            return report(folder, {"cube.obj", "--subdivide", "catmark", "--height", waves(folder), "--amplitude", "2%",
                                   "--max-error", error, "-o", "a.ply"});
        };
        const nlohmann::json coarse = by_error("0.5%"), fine = by_error("0.05%");
        CHECK(fine["points"] > coarse["points"]);
        for (const auto& [result, share] : {std::pair(coarse, 0.005), {fine, 0.0005}})
            CHECK(result["measured_error"]["max"].get<double>() < 1.5 * share * result["diagonal"].get<double>());
    }

    TEST_CASE("displace: an error that no rate reaches is refused, with one that can be reached") {
        const Folder folder;
        write_file(folder / "sheet.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
        write_picture(folder / "ridges.tif", 64, 1, 1, [](int x, int, int) { return x * 37 % 64 / 64.0; });
        const std::vector<std::string> sheet = {"displace", "sheet.obj", "--height", "ridges.tif", "--subdivide",
                                                "linear",   "-o",        "out.ply",  "--max-error"};
        std::vector<std::string> arguments = sheet;
        arguments.push_back("1e-7");
        check_refused(folder, arguments, 4, "4096 are the most; set --max-error to ");
        arguments.back() = "1e-2";
        CHECK(run_bake(folder, arguments).code == 0);
    }

    TEST_CASE("displace: the same bytes for 1, 2 and 7 threads") {
        const Folder folder;
        write_file(folder / "cube.obj", cube_obj);
        const std::vector<std::vector<std::string>> runs = {
            {"cube.obj", "--subdivide", "catmark", "--levels", "4", "--seam", "blend"},
            {torus, "--max-error", "0.1%"},
            {"--shape", "moebius", "--levels", "1", "--margin"}};
        for (const auto& run : runs) {
            std::string first;
            for (const char* threads : {"1", "2", "7"}) {
                std::vector<std::string> arguments = run;
                arguments.insert(arguments.end(),
                                 {"--height", waves(folder), "--amplitude", "2%", "-o", "a.ply", "--threads", threads});
                displaced(folder, arguments);
                if (first.empty()) first = contents(folder / "a.ply");
                CHECK((contents(folder / "a.ply") == first));
            }
        }
    }

    TEST_CASE("displace: options that contradict each other are usage errors, named") {
        const Folder folder;
        waves(folder);
        const auto refused = [&](std::vector<std::string> arguments, const std::string& named, int code = 2) {
            arguments.insert(arguments.begin(), {"displace", "--height", waves(folder)});
            check_refused(folder, arguments, code, named);
        };
        refused({"-o", "a.ply"}, "neither a mesh nor a --shape");
        refused({torus, "--shape", "torus", "-o", "a.ply"}, "--shape: stands instead of a mesh");
        refused({"--shape", "torus", "--subdivide", "catmark", "-o", "a.ply"}, "--subdivide: a shape");
        refused({"--shape", "dodo", "-o", "a.ply"}, "dodo");
        refused({torus, "-o", "a.stl"}, "a.stl");
        refused({torus, "-o", "a.obj", "--margin"}, "--margin");
        refused({torus, "-o", "a.ply", "--levels", "2", "--max-error", "1"}, "give one");
        refused({torus, "-o", "a.ply", "--levels", "-1"}, "--levels");
        refused({torus, "-o", "a.ply", "--levels", "11"}, "--levels");
        refused({torus, "-o", "a.ply", "--subdivide", "none", "--levels", "2"}, "--subdivide none");
        refused({torus, "-o", "a.ply", "--edge-px", "2"}, "--camera");
        refused({torus, "-o", "a.ply", "--camera", "position=1,2,3"}, "--edge-px");
        refused({torus, "-o", "a.ply", "--edge-px", "0", "--camera", "position=1,2,3"}, "--edge-px 0");
        for (const char* camera : {"position=1,2", "target=1,2,3", "position=1,2,x", "position=0,0,0", "lens=3",
                                   "position=0,0,1:fov-deg=0", "position=0,0,1:height=0.5"})
            refused({torus, "-o", "a.ply", "--edge-px", "2", "--camera", camera}, std::string("--camera ") + camera);
        refused({torus, "-o", "a.ply", "--edge-px", "2", "--camera", "absent.toml"}, "absent.toml", 3);
        for (const char* error : {"0", "-1", "x", "1e13"})
            refused({torus, "-o", "a.ply", "--max-error", error}, std::string("--max-error ") + error);
        for (const char* amplitude : {"x", "1e13", "1e12", "nan"})
            refused({torus, "-o", "a.ply", "--amplitude", amplitude}, "--amplitude");
        for (const char* size : {"x", "0", "2X", "-1G"})
            refused({torus, "-o", "a.ply", "--max-memory", size}, "--max-memory");
        refused({torus, "-o", "a.ply", "--seam", "glue"}, "--seam");
        refused({torus, "-o", "a.ply", "--uv-smoothing", "all"}, "--uv-smoothing");
        refused({torus, "-o", "a.ply", "--vector", "tangent", "--channel", "r"}, "--vector");
        refused({torus, "-o", torus}, "would replace");
        check_refused(folder, {"displace", torus, "-o", "a.ply"}, 2, "--height");
    }

    TEST_CASE("displace, NaN texel: refused with the count and the first place") {
        const Folder folder;
        const auto refused = [&](const std::string& height, const std::vector<std::string>& more,
                                 const std::string& named) {
            std::vector<std::string> arguments = {"displace", torus, "--height", height, "-o", "a.ply"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            check_refused(folder, arguments, 4, named);
        };
        write_picture(folder / "nan.tif", 4, 4, 1, [](int x, int y, int) {
            return x == 2 && y == 1 ? std::numeric_limits<double>::quiet_NaN() : 0.5;
        });
        refused("nan.tif", {}, "nan.tif: 1 values");
        refused("nan.tif", {}, "(2, 1)");
        write_picture(folder / "nan3.tif", 4, 4, 3, [](int x, int y, int c) {
            return x == 2 && y == 1 && c == 1 ? std::numeric_limits<double>::infinity() : 0.5;
        });
        refused("nan3.tif", {"--vector", "tangent"}, "(2, 1)");
    }

    TEST_CASE("displace: files that do not fit the job are refused as unsuitable or unreadable") {
        const Folder folder;
        waves(folder);
        const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& named) {
            arguments.insert(arguments.begin(), "displace");
            arguments.insert(arguments.end(), {"-o", "a.ply"});
            check_refused(folder, arguments, code, named);
        };
        write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        refused({"bare.obj", "--height", waves(folder)}, 4, "bare.obj: has no uvs");
        refused({torus, "--height", waves(folder), "--vector", "object"}, 4, "waves.tif: has 1 colour channel");
        refused({"absent.obj", "--height", waves(folder)}, 3, "absent.obj");
        refused({torus, "--height", "absent.png"}, 3, "absent.png");
        write_file(
            folder / "fan.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\nf 2/1 1/1 4/1\nf 1/1 2/1 5/1\n");
        refused({"fan.obj", "--height", waves(folder), "--subdivide", "catmark"}, 4, "fan.obj");
        refused({torus, "--height", waves(folder), "--subdivide", "loop"}, 4, "torus.obj");
        // A plain mesh may be non-manifold.
        displaced(folder, {"fan.obj", "--height", waves(folder), "--levels", "2", "-o", "a.ply"});
    }

    TEST_CASE("displace: notes say when the amplitude is out of proportion, seams step and points fold") {
        const Folder folder;
        waves(folder);
        write_picture(folder / "ramp.tif", 64, 4, 1, [](int x, int, int) { return x / 63.0; });
        const auto notes = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), {"-o", "a.ply", "--subdivide", "linear", "--levels", "2"});
            return displaced(folder, arguments).err;
        };
        CHECK(notes({torus, "--height", waves(folder), "--amplitude", "0.1%"}) == "");
        const std::string vast = notes({torus, "--height", waves(folder), "--amplitude", "1e6"});
        CHECK(vast.find("of its diagonal") != std::string::npos);
        CHECK(vast.find("inside out") != std::string::npos);
        const std::vector<std::string> ramp = {torus, "--height", "ramp.tif", "--amplitude", "20%", "--wrap", "clamp"};
        CHECK(notes(ramp).find("--seam blend") == std::string::npos); // the default
        std::vector<std::string> stepped = ramp;
        stepped.insert(stepped.end(), {"--seam", "average"});
        CHECK(notes(stepped).find("--seam blend") != std::string::npos);
        CHECK(notes({torus, "--height", waves(folder)}).find("--amplitude sets it") != std::string::npos);
        CHECK(notes({torus, "--height", waves(folder), "--amplitude", "1e6", "--quiet"}) == "");
        for (const Vec3f& p : read_mesh(folder / "a.ply").positions) CHECK(std::isfinite(glm::length(p)));
    }

    TEST_CASE("displace: beyond the focal radius points are counted as folded, on both sides") {
        const Folder folder;
        write_picture(folder / "white.tif", 1, 1, 1, [](int, int, int) { return 1; });
        const auto fold = [&](const char* amplitude) {
            return report(folder, {"--shape", "torus:R=1,r=0.4", "--levels", "0", "--height", "white.tif", "--midlevel",
                                   "0", "--amplitude", amplitude, "-o", "a.ply"})["fold"];
        };
        // The tube folds inwards at b = -r, everywhere; outwards at b = R - r, at the inner equator first.
        const nlohmann::json all = fold("-0.41"), inner = fold("0.61");
        CHECK(fold("-0.39")["points"] == 0);
        CHECK(all["margin"].get<double>() == doctest::Approx(1 - 0.41 / 0.4));
        CHECK(all["points"] ==
              report(folder, {"--shape", "torus", "--levels", "0", "--height", "white.tif", "-o", "a.ply"})["points"]);
        CHECK(fold("0.59")["points"] == 0);
        CHECK(inner["margin"].get<double>() == doctest::Approx(1 - 0.61 / 0.6));
        CHECK(inner["points"].get<int>() > 0);
        CHECK(inner["points"] < all["points"]);
        const auto worst = inner["worst"].get<std::vector<double>>();
        CHECK(std::hypot(worst[0], worst[1], worst[2]) == doctest::Approx(0.6).epsilon(1e-6));
    }

    TEST_CASE("displace: --margin writes 1 + b a, and its smallest is the report's") {
        const Folder folder;
        const nlohmann::json result = report(folder, {"--shape", "torus:R=1,r=0.4", "--levels", "0", "--height",
                                                      waves(folder), "--amplitude", "0.3", "--margin", "-o", "a.ply"});
        const Mesh mesh = read_mesh(folder / "a.ply");
        REQUIRE(mesh.attributes.size() == 1);
        CHECK(mesh.attributes[0].name == "fold_margin");
        const auto& values = mesh.attributes[0].values;
        CHECK(*std::min_element(values.begin(), values.end()) ==
              doctest::Approx(result["fold"]["margin"].get<double>()));
        CHECK(result["fold"]["points"] == 0);
    }

    TEST_CASE("displace: the least heights there are, and an unwritable place") {
        const Folder folder;
        for (const auto& [width, height] : {std::pair(1, 1), {1, 5}, {5, 1}})
            for (const char* interpolation : {"bilinear", "catmull-rom", "c2"}) {
                write_picture(
                    folder / "h.tif", width, height, 1, [](int x, int y, int) { return (x + y) / 8.0; }, Depth::u16);
                displaced(folder, {torus, "--height", "h.tif", "--amplitude", "1%", "--interpolation", interpolation,
                                   "-o", "a.ply"});
                for (const Vec3f& p : read_mesh(folder / "a.ply").positions) CHECK(std::isfinite(glm::length(p)));
            }
        fs::create_directory(folder.path / "taken.ply");
        write_file(folder / "file", "");
        for (const char* out : {"taken.ply", "nowhere/a.ply", "file/a.glb"})
            check_refused(folder, {"displace", torus, "--height", waves(folder), "-o", out}, 5, out);
    }

    TEST_CASE("displace: a full disk is exit 5, one line; the old file stays and no other is left") {
        for (const char* out : {"a.ply", "a.obj", "a.glb", "a.gltf"}) {
            const Folder folder;
            const std::vector<std::string> arguments = {"displace",    torus, "--height", waves(folder),
                                                        "--amplitude", "1%",  "-o",       out};
            REQUIRE(run_bake(folder, arguments).code == 0);
            const auto whole = (long long)fs::file_size(folder / out);
            fs::remove(folder / "a.bin");
            write_file(folder / out, "old");
            for (const long long most : {300LL, whole / 2, whole - 1}) {
                CAPTURE(most);
                check_refused(folder, arguments, 5, "", {.file_bytes = most});
                CHECK(contents(folder / out) == "old");
            }
        }
    }

    TEST_CASE("displace: --audit tells a clean result from one that cuts itself" *
              doctest::skip(!audit({}, {}).available)) {
        const Folder folder;
        write_file(folder / "cube.obj", cube_obj);
        const auto audited = [&](const char* amplitude) {
            return report(folder, {"cube.obj", "--subdivide", "catmark", "--levels", "3", "--height", waves(folder),
                                   "--amplitude", amplitude, "--audit", "-o", "a.ply"})["audit"];
        };
        const nlohmann::json clean = audited("0.01");
        CHECK(clean["self_intersections"] == 0);
        CHECK(clean["closed"] == true);
        CHECK(clean["outward"] == true);
        CHECK(audited("-8")["self_intersections"] > 0);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("displace: every mesh in trouble is displaced whole, with finite points, or refused in one line") {
        CHECK(displace_all(own_meshes() / "trouble") > 5);
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("displace: every bad mesh of others is displaced whole, with finite points, or refused in one line") {
        CHECK(displace_all(shared_data() / "bad/meshes") > 5);
    }

} // TEST_SUITE
