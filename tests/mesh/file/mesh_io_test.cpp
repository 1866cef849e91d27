#include "bake/base/parallel.h"
#include "mesh/file/mesh_files.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <sstream>
#include <sys/resource.h>
#include <sys/stat.h>

namespace {
using namespace bake;
using namespace bake_tests;
using Indices = std::vector<std::uint32_t>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";

Mesh read_obj_text(const std::string& text) { return read_text("t.obj", text); }
std::string refusal(const std::string& text) { return outcome_of_text("t.obj", text).reason; }

/// Lines of the file whose first word is `word`, found without the reader's help.
std::size_t lines_of_word(const std::filesystem::path& path, const std::string& word) {
    std::ifstream in(path);
    std::size_t count = 0;
    for (std::string line, first; std::getline(in, line); first.clear()) {
        std::istringstream(line) >> first;
        count += first == word;
    }
    return count;
}

/// A mesh with everything a file can hold, larger than one piece of the parallel reader.
Mesh rich_mesh(std::uint32_t faces) {
    std::mt19937 random(3);
    const auto number = [&random] { return std::ldexp(float(random()) - 2147483648.0f, -40 + int(random() % 20)); };
    Mesh mesh;
    const std::uint32_t points = faces + 10;
    for (std::uint32_t i = 0; i < points; ++i) {
        mesh.positions.emplace_back(number(), number(), number());
        mesh.normals.emplace_back(number(), number(), number());
        mesh.uvs.emplace_back(number(), number());
    }
    mesh.groups = {"left side", "right#2"};
    mesh.materials = {"skin", "eye.001", "Metall-glänzend"};
    for (std::uint32_t f = 0; f < faces; ++f) {
        const std::uint32_t corners = 3 + random() % 4;
        for (std::uint32_t c = 0; c < corners; ++c) {
            mesh.corner_position.push_back(std::uint32_t(random() % points));
            mesh.corner_uv.push_back(random() % 5 ? std::uint32_t(random() % points) : no_index);
            mesh.corner_normal.push_back(random() % 5 ? std::uint32_t(random() % points) : no_index);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        mesh.face_group.push_back(f < faces / 2 ? 0 : f < faces - 3 ? 1 : no_index);
        mesh.face_material.push_back(f == 0 ? 0 : f == 1 ? 1 : f == 2 ? 2 : std::uint32_t(random() % 3));
    }
    return mesh;
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: OBJ corners of every form, missing uvs and normals are no_index") {
        const Mesh mesh = read_obj_text(square + "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//1 3//1\nf 1/1/1 2/ 3/3/ 4//\n");
        CHECK(mesh.face_begin == Indices{0, 3, 6, 9, 13});
        CHECK(mesh.corner_position == Indices{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 3});
        const std::uint32_t n = no_index;
        CHECK(mesh.corner_uv == Indices{n, n, n, 0, 1, 2, n, n, n, 0, n, 2, n});
        CHECK(mesh.corner_normal == Indices{n, n, n, n, n, n, 0, 0, 0, 0, n, n, n});
    }

    TEST_CASE("read_mesh: no corner with uvs or normals leaves their indices empty") {
        const Mesh mesh = read_obj_text(square + "f 1 2 3\n");
        CHECK(mesh.corner_uv.empty());
        CHECK(mesh.corner_normal.empty());
        CHECK(mesh.uvs.size() == 3);
    }

    TEST_CASE("read_mesh: negative indices count back from their own line, positive ones may point ahead") {
        const Mesh mesh =
            read_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nf 3 4 5\nv 0 1 0\nv 9 9 9\nf -5 -4 -1\n");
        CHECK(mesh.corner_position == Indices{0, 1, 2, 2, 3, 4, 0, 1, 4});
    }

    TEST_CASE("read_mesh: CRLF, tabs, comments, continued lines and a missing last newline change nothing") {
        const Mesh plain = read_obj_text("v 0 0 0\nv 1 0 0\nv 0.5 1 0\nf 1 2 3\n");
        CHECK(same_mesh(plain, read_obj_text("v 0 0 0\r\nv 1 0 0\r\nv 0.5 1 0\r\nf 1 2 3\r\n")));
        CHECK(same_mesh(plain, read_obj_text("\tv\t0\t0 0 \nv  1 0 0\n\n  v .5 1 0\n\tf 1\t2   3")));
        CHECK(same_mesh(plain, read_obj_text("#v 7 7 7\nv 0 0 0 # f 1 1 1\nv 1 0 0\nv 0.5 1 0\nf 1 2 3 # 4\n")));
        CHECK(same_mesh(plain, read_obj_text("v 0 \\\n0 0\nv 1 0 0\nv 0.5 1 0\nf 1 \\\r\n2 \\\n3")));
        CHECK(same_mesh(plain, read_obj_text("# C:\\meshes\\\nv 0 0 0\nv 1 0 0\nv 0.5 1 0\nf 1 2 3\\")));
        CHECK(same_mesh(plain, read_obj_text("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0.5 1 0\nf 1 2 3\n")));
    }

    TEST_CASE("read_mesh: numbers behind those asked for, and unknown keywords, are ignored") {
        const Mesh mesh = read_obj_text("vp 1 2\nmtllib a.mtl\ns off\nl 1 2\nv 0 0 0 1 .5 .25\nv 1 0 0 1\nv 0 1 0\nvt "
                                        "0.25\nvt 1 2 3\nf 1/1 2/2 3/1\nfoo\n");
        CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(mesh.uvs == std::vector<Vec2f>{{0.25f, 0}, {1, 2}});
    }

    TEST_CASE("read_mesh: a corner repeated within a face is kept") {
        CHECK(read_obj_text(square + "f 1 2 2 3\n").corner_position == Indices{0, 1, 1, 2});
    }

    TEST_CASE("read_mesh: groups and materials by name, in order of first use, none before the first") {
        const Mesh mesh =
            read_obj_text(square + "f 1 2 3\no box\ng  left side \nusemtl b\nf 1 2 3\nusemtl a\ng unused\ng\nf 1 2 3\n"
                                   "usemtl b\no box\nf 1 2 3\n");
        CHECK(mesh.groups == std::vector<std::string>{"left side", "box"});
        CHECK(mesh.face_group == Indices{no_index, 0, no_index, 1});
        CHECK(mesh.materials == std::vector<std::string>{"b", "a"});
        CHECK(mesh.face_material == Indices{no_index, 0, 1, 0});
    }

    TEST_CASE("read_mesh: refuses what is no face or no number, with the line and the reason") {
        const auto has = [](const std::string& text, const std::string& part) {
            const std::string reason = refusal(text);
            CHECK_MESSAGE(reason.find(part) != std::string::npos, reason);
        };
        has(square + "f 0/0/0 1 2\n", "t.obj:9: index 0 in '0/0/0'");
        has(square + "f 1/0 2 3\n", "t.obj:9: index 0 in '1/0'");
        has(square + "f 1 2 5\n", "t.obj:9: '5' asks for position 5 of 4");
        has(square + "f 1 2/4 3\n", "t.obj:9: '2/4' asks for uv 4 of 3");
        has(square + "f 1 2//2 3\n", "t.obj:9: '2//2' asks for normal 2 of 1");
        has(square + "f -5 2 3\n", "t.obj:9: '-5' asks for position -5 with 4 above");
        has(square + "f 1 2 99999999999999999999\n", "t.obj:9: '99999999999999999999' asks for position");
        has(square + "f 1 2\n", "t.obj:9: face of 2 corners");
        has(square + "f\n", "t.obj:9: face of 0 corners");
        has(square + "f 1 2 x\n", "t.obj:9: 'x' is not a face corner");
        has(square + "f 1 2 3/1/1/1\n", "t.obj:9: '3/1/1/1' is not a face corner");
        has(square + "f 1 2 1.5\n", "t.obj:9: '1.5' is not a face corner");
        has("v 0 0 0\nv 0 \\\n 0 nan\n", "t.obj:2: 'nan' is not a finite");
        has("v 0 0 0\r\n\r\nv 0 0 1e40\r\n", "t.obj:3: '1e40' is not a finite");
        has("v 0 0 0\nv 1,5 0 0\n", "t.obj:2: '1,5' is not a number");
        has("v 1.#QNAN 0 0\n", "t.obj:1: '1.#QNAN' is not a number");
        has("v 0 0 # 0\n", "t.obj:1: position has 2 numbers and needs 3");
        has("vn 0 0\n", "t.obj:1: normal has 2 numbers");
        has("vt\n", "t.obj:1: uv has 0 numbers");
    }

    TEST_CASE("read_mesh: the first wrong line of a large file is named, whatever thread meets it") {
        std::string text = square;
        for (int i = 0; i < 300000; ++i) text += i == 123456 || i == 250000 ? "f 1 2 77\n" : "f 1 2 3\n";
        for (int repeat = 0; repeat < 5; ++repeat) CHECK(refusal(text).substr(0, 13) == "t.obj:123465:");
    }

    TEST_CASE("read_mesh: continued lines are not torn where the parallel reader cuts the file") {
        std::string text = square;
        for (int i = 0; i < 200000; ++i) text += i % 3 ? "f 1 \\\n2 \\\r\n3\n" : "f 1 2 3 4\n";
        const Mesh mesh = read_obj_text(text);
        CHECK(mesh.faces() == 200000);
        CHECK(mesh.corners() == 666667);
    }

    TEST_CASE(
        "read_mesh: files that are missing, folders, pipes, of unknown format or without faces are refused by kind") {
        const TemporaryFolder folder;
        CHECK(outcome_of(folder.file("missing.obj")).reason.find("no such file") != std::string::npos);
        CHECK(outcome_of(folder.file("missing.obj")).code == 3);
        std::filesystem::create_directory(folder.file("folder.obj"));
        CHECK(outcome_of(folder.file("folder.obj")).reason.find("is a folder") != std::string::npos);
        REQUIRE(mkfifo(folder.file("pipe.ply").c_str(), 0600) == 0);
        CHECK(outcome_of(folder.file("pipe.ply")).reason.find("not a regular file") != std::string::npos);
        const Outcome off = outcome_of(folder.write("a.off", "OFF\n"));
        CHECK(off.code == 3);
        CHECK(off.reason.find(".obj, .ply, .gltf or .glb") != std::string::npos);
        CHECK(outcome_of(folder.write("points.obj", "v 1 2 3\n")).code == 4);
        CHECK(outcome_of(folder.write("empty.obj", "")).code == 4);
        CHECK(outcome_of(folder.write("T.OBJ", square + "f 1 2 3")).code == 0);
    }

    TEST_CASE("write_mesh: an OBJ reads back the same, to the last bit, however many threads") {
        const TemporaryFolder folder;
        const Mesh mesh = rich_mesh(20000);
        write_mesh(folder.file("a.obj"), mesh);
        CHECK(same_mesh(read_mesh(folder.file("a.obj")), mesh));
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            write_mesh(folder.file("b.obj"), mesh);
            write_mesh(folder.file("b" + std::to_string(threads) + ".ply"), mesh);
            CHECK(bytes_of(folder.file("b.obj")) == bytes_of(folder.file("a.obj")));
            CHECK(bytes_of(folder.file("b" + std::to_string(threads) + ".ply")) == bytes_of(folder.file("b1.ply")));
            CHECK(same_mesh(read_mesh(folder.file("b.obj")), mesh));
        }
    }

    TEST_CASE("write_mesh: names that would not read back are mended, not lost") {
        Mesh mesh = read_obj_text("g a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        mesh.groups[0] = " two\nlines\\";
        const TemporaryFolder folder;
        write_mesh(folder.file("a.obj"), mesh);
        CHECK(read_mesh(folder.file("a.obj")).groups == std::vector<std::string>{"_two_lines_"});
    }

    TEST_CASE(
        "write_mesh: values that are not finite, unknown endings and missing folders are refused, the old file stays") {
        const TemporaryFolder folder;
        Mesh mesh = read_obj_text(square + "f 1 2 3\n");
        const auto code = [&mesh](const std::string& path) {
            try {
                write_mesh(path, mesh);
            } catch (const Error& error) {
                return int(error.refusal);
            }
            return 0;
        };
        CHECK(code(folder.file("a.stl")) == 2);
        CHECK(code(folder.file("missing/a.obj")) == 5);
        CHECK(code(folder.file("a.obj")) == 0);
        const std::string old = bytes_of(folder.file("a.obj"));
        mesh.positions[1].y = NAN;
        CHECK(code(folder.file("a.obj")) == 4);
        CHECK(bytes_of(folder.file("a.obj")) == old);
        CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
    }
} // unit

TEST_SUITE("stability") {
    TEST_CASE("read_mesh: our own meshes in trouble are read whole or refused with their line") {
        const auto folder = source_folder() / "meshes/trouble";
        for (const char* name : {"mirrored_uvs", "overlapping_uvs", "nonmanifold_edge", "zero_area_face", "missing_uvs",
                                 "one_triangle", "bowtie_quad", "hole_on_a_bridge", "nonmanifold_vertex",
                                 "flipped_face", "duplicate_face", "crease_without_edge"}) {
            const auto path = folder / (std::string(name) + ".obj");
            CHECK_MESSAGE(read_mesh(path.string()).faces() == lines_of_word(path, "f"), name);
        }
        CHECK(outcome_of(folder / "nan_vertex.obj").reason.substr(0, 17) == "nan_vertex.obj:4:");
        CHECK(outcome_of(folder / "two_index_face.obj").reason.substr(0, 21) == "two_index_face.obj:6:");
        CHECK(outcome_of(folder / "index_zero.obj").reason.substr(0, 17) == "index_zero.obj:5:");
        CHECK(outcome_of(folder / "index_out_of_range.obj").reason.substr(0, 25) == "index_out_of_range.obj:5:");
        CHECK(outcome_of(folder / "cut_short.ply").reason.find("cut short") != std::string::npos);
        CHECK(outcome_of(folder / "looped_nodes.gltf").reason.find("its node 0 is met twice") != std::string::npos);
        CHECK(outcome_of(folder / "index_out_of_range.gltf").reason.find("has index 3 of 3 positions") !=
              std::string::npos);
        CHECK(outcome_of(folder / "huge_counts.ply").reason.find("4000000000 rows of 'vertex'") != std::string::npos);
    }

    TEST_CASE("read_mesh: a good file cut at any byte, or with any byte changed, is read or refused, never worse") {
        const TemporaryFolder folder;
        const Mesh mesh = rich_mesh(12);
        std::mt19937 random(4);
        for (const std::string name : {"a.obj", "a.ply"}) {
            write_mesh(folder.file(name), mesh);
            const std::string good = bytes_of(folder.file(name));
            for (std::size_t size = 0; size < good.size(); ++size) {
                const Outcome outcome = outcome_of(folder.write("cut_" + name, good.substr(0, size)));
                CHECK((outcome.code == 0 || outcome.code == 3 || outcome.code == 4));
                if (name == "a.ply") CHECK(outcome.code == 3);
                std::string wrong = good;
                wrong[size] = char(random());
                const Outcome other = outcome_of(folder.write("wrong_" + name, wrong));
                CHECK((other.code == 0 || other.code == 3 || other.code == 4));
                CHECK(other.reason.find('\n') == std::string::npos);
            }
        }
    }

    TEST_CASE("read_mesh: long lines, lines that all continue and thousands of groups take time in proportion") {
        std::string one_face = square + "f", continued = square, groups = square;
        for (int i = 0; i < 1000000; ++i) one_face += " 1";
        for (int i = 0; i < 500000; ++i) continued += "f 1 2 3 \\\n";
        for (int i = 0; i < 100000; ++i) groups += "g part" + std::to_string(i) + "\nf 1 2 3\n";
        const auto start = std::chrono::steady_clock::now();
        CHECK(read_obj_text(one_face).corners() == 1000000);
        CHECK(refusal(continued).find("t.obj:9: 'f' is not a face corner") == 0);
        CHECK(read_obj_text(groups).groups.size() == 100000);
        CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 5);
    }
} // stability

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("read_mesh: every mesh of the collection is read, with all its faces") {
        const auto folder = test::shared_data() / "meshes";
        const TemporaryFolder out;
        int files = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            const auto ending = entry.path().extension();
            if (ending != ".obj" && ending != ".ply") continue;
            const std::string name = entry.path().filename().string();
            const Mesh mesh = read_mesh(entry.path().string());
            if (ending == ".obj") {
                CHECK_MESSAGE(mesh.faces() == lines_of_word(entry.path(), "f"), name);
                CHECK_MESSAGE(mesh.positions.size() == lines_of_word(entry.path(), "v"), name);
            } else {
                CHECK_MESSAGE(mesh.faces() == 43368, name); // cycloidal.ply, by its header
            }
            write_mesh(out.file("back.obj"), mesh);
            CHECK_MESSAGE(same_mesh(read_mesh(out.file("back.obj")), mesh), name);
            write_mesh(out.file("back.ply"), mesh);
            CHECK_MESSAGE(same_corners(read_mesh(out.file("back.ply")), mesh), name);
            ++files;
        }
        CHECK(files >= 29);
    }

    TEST_CASE("read_mesh: every bad mesh is read whole or refused with the line, within 2 s and 1 GiB") {
        const auto folder = test::shared_data() / "bad/meshes";
        struct Expected {
            const char* name;
            int code;
            const char* reason; ///< or its beginning; "read" for one that is read
        };
        const Expected expected[] = {
            {"assimp_OutOfMemory.off", 3, "assimp_OutOfMemory.off: '.off' is not"},
            {"assimp_concave_polygon.obj", 0, "read"},
            {"assimp_crash-30d6d0f7.ply", 3, "assimp_crash-30d6d0f7.ply:7:"},
            {"assimp_empty.obj", 4, "assimp_empty.obj: has no faces"},
            {"assimp_empty.off", 3, "assimp_empty.off: '.off' is not"},
            {"assimp_empty.ply", 3, "assimp_empty.ply:1: an empty file"},
            {"assimp_invalid.off", 3, "assimp_invalid.off: '.off' is not"},
            {"assimp_malformed.obj", 3, "assimp_malformed.obj:23: '12' asks for position 12 of 8"},
            {"assimp_malformed2.obj", 3, "assimp_malformed2.obj:23: face of 0 corners"},
            {"assimp_point_cloud.obj", 4, "assimp_point_cloud.obj: has no faces"},
            {"osd_catmark_nonman_verts.obj", 0, "read"},
            {"tinyobj_invalid-face-definition.obj", 3, "tinyobj_invalid-face-definition.obj:15: face of 1 corner"},
            {"tinyobj_invalid-relative-vertex-index.obj", 3, "tinyobj_invalid-relative-vertex-index.obj:1: '-4' asks"},
            {"tinyobj_issue-140-zero-face-idx.obj", 3, "tinyobj_issue-140-zero-face-idx.obj:16: index 0"},
            {"tinyobj_issue-161-inconsistent-f.obj", 0, "read"},
            {"trimesh_jacked.obj", 0, "read"},
            {"trimesh_joined_tetrahedra.obj", 0, "read"},
            {"trimesh_negative_indices.obj", 0, "read"},
            {"trimesh_notenoughindices.obj", 3, "trimesh_notenoughindices.obj:9: face of 2 corners"},
            {"trimesh_tube.obj", 0, "read"},
        };
#if defined(__SANITIZE_ADDRESS__)
        const bool limited = false; // the sanitizer's shadow memory is larger than any limit
#else
        const bool limited = true;
#endif
        rlimit before{};
        getrlimit(RLIMIT_AS, &before);
        for (const Expected& e : expected) {
            const auto path = folder / e.name;
            REQUIRE_MESSAGE(std::filesystem::exists(path), e.name);
            std::size_t used = 0; // pages of address space that the process has already
            std::ifstream("/proc/self/statm") >> used;
            const rlimit limit{used * std::size_t(getpagesize()) + (std::size_t(1) << 30), before.rlim_max};
            if (limited) setrlimit(RLIMIT_AS, &limit);
            const auto start = std::chrono::steady_clock::now();
            const Outcome outcome = outcome_of(path);
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            setrlimit(RLIMIT_AS, &before);
            CHECK_MESSAGE(outcome.code == e.code, e.name);
            CHECK_MESSAGE(outcome.reason.rfind(e.reason, 0) == 0, outcome.reason);
            CHECK_MESSAGE(seconds < 2, e.name);
            if (e.code == 0) CHECK_MESSAGE(read_mesh(path.string()).faces() == lines_of_word(path, "f"), e.name);
        }
        const auto files = std::distance(std::filesystem::directory_iterator(folder), {});
        CHECK(files == std::ssize(expected));
    }
} // real
