#include "bake/base/parallel.h"
#include "bake/mesh/triangulate.h"
#include "mesh/gltf/gltf_files.h"
#include <cmath>
#include <glm/trigonometric.hpp>
#include <random>

namespace {
using namespace bake;
using namespace bake_tests;
using Indices = std::vector<std::uint32_t>;

const std::string png = std::string("\x89PNG\r\n\x1a\n") + "not looked at";

GltfImage image_of(const std::string& name, const std::string& uri, const std::string& bytes = png) {
    return {name, "image/png", uri, {bytes.begin(), bytes.end()}};
}

std::string refusal(const std::string& text) { return outcome_of_text("t.gltf", text).reason; }

/// What lies behind the JSON, which names the file.
std::string binary_chunk(const std::string& path) {
    const std::string bytes = bytes_of(path);
    return bytes.substr(bytes.find("BIN"));
}

Vec3d facet_normal(const Mesh& mesh, std::size_t face) {
    const auto p = [&](std::size_t k) {
        return Vec3d(mesh.positions[mesh.corner_position[mesh.face_begin[face] + k]]);
    };
    return glm::cross(p(1) - p(0), p(2) - p(0));
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("gltf: what is written reads back the same, whole, from .glb and .gltf, whatever the threads") {
        const TemporaryFolder folder;
        const Mesh mesh = rich_triangles(90, 60); // more vertices than one block holds rows
        for (const std::string name : {"a.glb", "a.gltf"}) {
            write_mesh(folder.file(name), mesh);
            CHECK(same_mesh(read_mesh(folder.file(name)), mesh));
            for (const int threads : {1, 2, 7}) {
                const ThreadLimit limit(threads);
                write_mesh(folder.file("b" + name.substr(1)), mesh);
                if (name == "a.glb") CHECK(binary_chunk(folder.file("b.glb")) == binary_chunk(folder.file(name)));
                CHECK(same_mesh(read_mesh(folder.file("b" + name.substr(1))), mesh));
            }
        }
        CHECK(bytes_of(folder.file("a.bin")) == bytes_of(folder.file("b.bin")));
        CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 6);
    }

    TEST_CASE("gltf: v is turned at this door alone, and the tangent's sign is not") {
        const Gltf down = read_gltf_text(square_text());
        REQUIRE(down.mesh.uvs.size() == 4);
        CHECK(down.mesh.uvs[down.mesh.corner_uv[0]] == Vec2f(0, 0));
        CHECK(down.mesh.uvs[down.mesh.corner_uv[2]] == Vec2f(1, 0.75f));
        const Gltf up = read_gltf_text(square_text(), {.flip_v = false});
        CHECK(up.mesh.uvs[up.mesh.corner_uv[0]] == Vec2f(0, 1));
        const TemporaryFolder folder;
        CHECK(read_mesh(folder.write("t.gltf", square_text()), {.flip_v = true}).uvs == up.mesh.uvs);

        Mesh mesh = rich_triangles(2, 1);
        write_mesh(folder.file("a.gltf"), mesh);
        // In the file's own order the sign is that of the mesh, and v is not.
        const Gltf raw = read_gltf(folder.file("a.gltf"), {.flip_v = false});
        for (std::size_t c = 0; c < mesh.corners(); ++c) {
            CHECK(raw.mesh.tangents[c].w == mesh.tangents[c].w);
            CHECK(raw.mesh.uvs[raw.mesh.corner_uv[c]].y == 1 - mesh.uvs[mesh.corner_uv[c]].y);
        }
    }

    TEST_CASE("gltf: vertices split for their uvs or normals share their position, and nothing else is shared") {
        Buffer
            buffer; // two triangles that share no vertex; the second has another uv and, at one corner, another normal
        buffer.put<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, -0.0f, 0, 0, 1, 1, 0, 0, 1, 0});
        buffer.put<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1});
        buffer.put<float>({0, 0, 1, 0, 1, 1, 0.5f, 0, 1, 1, 0, 1});
        const Gltf gltf = read_gltf_text(gltf_text(
            buffer.bytes,
            R"(,"bufferViews":[{"buffer":0,"byteLength":192}],"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},)"
            R"({"bufferView":0,"byteOffset":72,"componentType":5126,"count":6,"type":"VEC3"},)"
            R"({"bufferView":0,"byteOffset":144,"componentType":5126,"count":6,"type":"VEC2"}],)"
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}])"));
        const Mesh& mesh = gltf.mesh;
        CHECK(mesh.positions.size() == 4);
        CHECK(mesh.corner_position == Indices{0, 1, 2, 0, 2, 3});
        CHECK(mesh.corner_normal[0] == mesh.corner_normal[3]);
        CHECK(mesh.corner_normal[2] != mesh.corner_normal[4]);
        CHECK(mesh.normals.size() == 5);
        CHECK(mesh.corner_uv[0] != mesh.corner_uv[3]);
        CHECK(mesh.corner_uv[2] == mesh.corner_uv[4]);
        CHECK(mesh.uvs.size() == 5);
    }

    TEST_CASE("gltf: strips and fans are the triangles of the specification, without those that join strips") {
        Buffer buffer;
        buffer.put<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
        buffer.put<std::uint8_t>({0, 1, 2, 3, 3, 4, 5, 0});
        const auto corners = [&](const std::string& primitive) {
            return read_gltf_text(
                       gltf_text(buffer.bytes,
                                 R"(,"bufferViews":[{"buffer":0,"byteLength":80}],)"
                                 R"("accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},)"
                                 R"({"bufferView":0,"byteOffset":72,"componentType":5121,"count":7,"type":"SCALAR"}],)"
                                 R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},)" +
                                     primitive + "}]}]"))
                .mesh.corner_position;
        };
        CHECK(corners(R"("mode":5)") == Indices{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4});
        CHECK(corners(R"("mode":6)") == Indices{1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0});
        // The strip 0 1 2 3 3 4 5: 2 3 3 and 3 3 4 are seams of the strip.
        CHECK(corners(R"("mode":5,"indices":1)") == Indices{0, 1, 2, 1, 3, 2, 3, 4, 5});
        CHECK(corners(R"("mode":4)") == Indices{0, 1, 2, 3, 4, 5});
    }

    TEST_CASE("gltf: interleaved, quantised and sparse values are what they stand for") {
        Buffer buffer; // stride 16: three shorts and two of padding, then two normalised shorts and padding
        for (const auto& [x, y, u, v] :
             {std::array<std::int16_t, 4>{0, 0, 0, -32768}, {100, 0, 32767, 0}, {0, 200, 0, 16384}}) {
            buffer.put<std::int16_t>({x, y, 0, 0});
            buffer.put<std::int16_t>({u, v, 0, 0});
        }
        buffer.put<std::uint16_t>({2}).align();        // sparse index, at 48
        buffer.put<std::int16_t>({0, 300, 7}).align(); // and its value, at 52
        const std::string rest =
            R"(,"extensionsRequired":["KHR_mesh_quantization"],"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":16},)"
            R"({"buffer":0,"byteOffset":48,"byteLength":12}],"accessors":[{"bufferView":0,"componentType":5122,"count":3,)"
            R"("type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},)"
            R"("values":{"bufferView":1,"byteOffset":4}}},)"
            R"({"bufferView":0,"byteOffset":8,"componentType":5122,"normalized":true,"count":3,"type":"VEC2"},)"
            R"({"componentType":5126,"count":3,"type":"SCALAR"}],)"
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"_Zero":2}}]}])";
        const Mesh mesh = read_gltf_text(gltf_text(buffer.bytes, rest), {.flip_v = false}).mesh;
        CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {100, 0, 0}, {0, 300, 7}});
        CHECK(mesh.uvs == std::vector<Vec2f>{{0, -1}, {1, 0}, {0, 16384 / 32767.0f}});
        REQUIRE(mesh.attributes.size() == 1);
        CHECK(mesh.attributes[0].name == "zero");
        CHECK(mesh.attributes[0].values == std::vector<float>{0, 0, 0});
    }

    TEST_CASE("gltf: nodes are placed through their parents, by matrix or by move, turn and stretch") {
        const float half = std::sqrt(0.5f);
        const std::string text = replaced(
            square_text(), R"("nodes":[{"mesh":0}])",
            R"("nodes":[{"children":[1,2],"translation":[10,0,0],"rotation":[0,0,)" + std::to_string(half) + "," +
                std::to_string(half) +
                R"(],"scale":[2,2,2]},{"mesh":0,"name":"first"},{"mesh":0,"matrix":[0,0,1,0,0,1,0,0,-1,0,0,0,0,0,5,1]}])");
        const Gltf gltf = read_gltf_text(text);
        REQUIRE(gltf.nodes.size() == 2); // once per node
        CHECK(gltf.nodes[0].name == "first");
        CHECK(gltf.nodes[1].first_face == 2);
        CHECK(gltf.nodes[1].end_face == 4);
        const Mesh mesh = flatten(gltf);
        const auto corner = [&](std::size_t c) { return mesh.positions[mesh.corner_position[c]]; };
        // x, turned by 90 degrees about z, is y; everything twice as large and 10 along x.
        CHECK(glm::length(corner(1) - Vec3f(10, 2, 0)) < 1e-5f);
        CHECK(glm::length(corner(2) - Vec3f(8, 2, 0)) < 1e-5f);
        // The second's x is z of its parent, 5 up.
        CHECK(glm::length(corner(7) - Vec3f(10, 0, 12)) < 1e-5f);
        CHECK(mesh.groups == std::vector<std::string>{"first", "node_1"});
        CHECK(mesh.face_group == Indices{0, 0, 1, 1});
    }

    TEST_CASE("gltf: a mirroring node turns its faces, its normals stay outside and its tangents change sign") {
        const TemporaryFolder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        gltf.nodes = {{"mirror", 0, gltf.mesh.faces(), {-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}};
        const Mesh before = gltf.mesh, after = flatten(gltf);
        for (std::size_t f = 0; f < after.faces(); ++f) {
            const auto c = after.face_begin[f];
            CHECK(after.positions[after.corner_position[c]].x == 3 - 2 * before.positions[before.corner_position[c]].x);
            CHECK(after.corner_uv[c + 1] == before.corner_uv[c + 2]);
            CHECK(after.tangents[c + 1].w == -before.tangents[c + 2].w);
            CHECK(glm::dot(facet_normal(after, f), Vec3d(after.normals[after.corner_normal[c]])) > 0);
            // B = sign (N x T) must be the mirrored B.
            const auto b = [](const Mesh& m, std::size_t k) {
                return Vec3d(m.tangents[k].w * glm::cross(m.normals[m.corner_normal[k]], Vec3f(m.tangents[k])));
            };
            const Vec3d mirrored = glm::normalize(Vec3d(-2, 1, 1) * b(before, c));
            CHECK(glm::dot(mirrored, glm::normalize(b(after, c))) > 0.5); // stretched, B = N x T is no longer its image
        }
        // The file keeps the node, so that what it shows is the same.
        write_gltf(folder.file("m.glb"), gltf);
        const Gltf back = read_gltf(folder.file("m.glb"));
        CHECK(back.nodes == gltf.nodes);
        CHECK(same_mesh(back.mesh, before));
    }

    TEST_CASE("gltf: the scene that the file shows is read; without scenes every root, without nodes every mesh") {
        const std::string two = replaced(
            square_text(), R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)",
            R"("nodes":[{"name":"a","mesh":0},{"name":"b","mesh":0}],"scenes":[{"nodes":[0]},{"nodes":[1]}],"scene":1)");
        CHECK(read_gltf_text(two).nodes.at(0).name == "b");
        CHECK(read_gltf_text(replaced(two, R"(,"scene":1)", "")).nodes.at(0).name == "a");
        CHECK(read_gltf_text(replaced(two, R"(,"scenes":[{"nodes":[0]},{"nodes":[1]}],"scene":1)", "")).nodes.size() ==
              2);
        CHECK(read_gltf_text(replaced(square_text(), R"(,"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)", ""))
                  .mesh.faces() == 2);
    }

    TEST_CASE(
        "gltf: materials, normal textures with their scale and pictures come back bit for bit, inside and beside") {
        const TemporaryFolder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        gltf.images = {image_of("height", "", png + "1"), image_of("", "a b%.png", png + "2")};
        GltfMaterial brick{.name = "brick"};
        brick.normal = GltfTexture{1, 0, 0.5, {33071, 33648, 9987, 9729}};
        brick.base_color = GltfTexture{0, 1, 1, {}};
        brick.occlusion = GltfTexture{0, 0, 0.25, {}};
        brick.base_color_factor = {0.5f, 0.25f, 1, 1};
        brick.roughness = 0.3f, brick.double_sided = true, brick.alpha_mode = "MASK", brick.alpha_cutoff = 0.7f;
        gltf.materials = {brick, {.name = "plaster"}};
        for (const std::string name : {"m.glb", "m.gltf"}) {
            const GltfWritten done = write_gltf(folder.file(name), gltf);
            CHECK(done.dropped_images + done.mended_normals + done.mended_tangents + done.moved_nodes == 0);
            const Gltf back = read_gltf(folder.file(name));
            CHECK(back.materials == gltf.materials);
            CHECK(same_mesh(back.mesh, gltf.mesh));
            REQUIRE(back.images.size() == 2);
            for (std::size_t i = 0; i < 2; ++i) CHECK(back.images[i].bytes == gltf.images[i].bytes);
            CHECK(back.images[1].uri == (name == "m.glb" ? "" : "a b%.png"));
        }
        CHECK(bytes_of(folder.file("a b%.png")) == png + "2");
        CHECK(bytes_of(folder.file("m_image0.png")) == png + "1");

        std::filesystem::remove(folder.file("a b%.png")); // of use without it
        const Gltf without = read_gltf(folder.file("m.gltf"));
        CHECK(without.images[1].bytes.empty());
        CHECK(write_gltf(folder.file("n.gltf"), without).dropped_images == 1);
        CHECK_FALSE(read_gltf(folder.file("n.gltf")).materials[0].normal);
        CHECK(read_gltf(folder.file("n.gltf")).materials[0].base_color == GltfTexture{0, 1, 1, {}});
    }

    TEST_CASE("gltf: normals and tangents that are not unit are mended in the file, and counted") {
        const TemporaryFolder folder;
        Mesh mesh = rich_triangles(2, 1);
        mesh.tangents.assign(mesh.corners(), Vec4f(1, 0, 0, 1));
        mesh.normals[0] = Vec3f(0), mesh.normals[1] *= 3.0f, mesh.corner_normal[4] = no_index;
        mesh.tangents[1] = Vec4f(0, 0, 0, 0.5f), mesh.tangents[2] *= 0.25f;
        const GltfWritten done = write_gltf(folder.file("a.glb"), mesh);
        const Mesh back = read_mesh(folder.file("a.glb"));
        CHECK(done.mended_normals >= 3);
        CHECK(done.mended_tangents == 2);
        for (std::size_t c = 0; c < back.corners(); ++c) {
            const Vec3f n = back.normals[back.corner_normal[c]], t(back.tangents[c]);
            CHECK(std::abs(glm::length(n) - 1) < 1e-6f);
            CHECK(std::abs(glm::length(t) - 1) < 1e-6f);
            CHECK(std::abs(back.tangents[c].w) == 1);
        }
        CHECK(std::abs(glm::dot(Vec3f(back.tangents[1]), back.normals[back.corner_normal[1]])) < 1e-6f);
        const Vec3d own = facet_normal(mesh, 0);
        CHECK(glm::length(Vec3d(back.normals[back.corner_normal[0]]) - own / glm::length(own)) < 1e-6);
    }

    TEST_CASE("gltf: polygons are written as the triangles that bakes use, and indices as wide as they need to be") {
        const TemporaryFolder folder;
        const Mesh quads = read_text("t.obj", "v 0 0 0\nv 3 0 0\nv 1 1 0\nv 0 3 0\nv 5 5 1\nf 1 2 3 4\nf 2 5 4 3 1\n");
        write_mesh(folder.file("q.glb"), quads);
        const Mesh back = read_mesh(folder.file("q.glb"));
        const std::vector<Triangle> triangles = triangulate(quads);
        REQUIRE(back.faces() == triangles.size());
        for (std::size_t f = 0; f < triangles.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(back.corner_position[3 * f + k] == quads.corner_position[triangles[f].corner[k]]);
        for (const std::uint32_t count : {65535u, 65536u}) { // 65535 as an index would restart a strip
            Mesh fan;
            for (std::uint32_t i = 0; i < count; ++i) fan.positions.emplace_back(float(i), float(i % 7), 0);
            for (std::uint32_t i = 0; i + 2 < count; i += 2) {
                for (const std::uint32_t k : {0u, 1u, 2u}) fan.corner_position.push_back(i + k);
                fan.face_begin.push_back(std::uint32_t(fan.corners()));
            }
            for (const std::uint32_t k : {3u, 2u, 1u}) fan.corner_position.push_back(count - k);
            fan.face_begin.push_back(std::uint32_t(fan.corners()));
            write_mesh(folder.file("fan.glb"), fan);
            const std::string bytes = bytes_of(folder.file("fan.glb"));
            CHECK((bytes.find("\"componentType\":5123") != std::string::npos) == (count == 65535));
            CHECK(read_mesh(folder.file("fan.glb")).corner_position.back() ==
                  read_mesh(folder.file("fan.glb")).positions.size() - 1);
        }
    }

    TEST_CASE("gltf: a node whose matrix shears is written where it stands; what it shows stays the same") {
        const TemporaryFolder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        gltf.nodes = {{"sheared", 0, 4, {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                      {"plain", 4, gltf.mesh.faces(), {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1}}};
        CHECK(write_gltf(folder.file("s.glb"), gltf).moved_nodes == 1);
        const Mesh expected = flatten(gltf), back = read_mesh(folder.file("s.glb"));
        REQUIRE(back.corners() == expected.corners());
        for (std::size_t c = 0; c < back.corners(); ++c) {
            CHECK(back.positions[back.corner_position[c]] == expected.positions[expected.corner_position[c]]);
            CHECK(glm::length(back.normals[back.corner_normal[c]] - expected.normals[expected.corner_normal[c]]) <
                  1e-6f);
        }
    }

    TEST_CASE("gltf: refuses what is wrong in one line that names it") {
        const auto has = [](const std::string& text, const std::string& part, int code = 3) {
            const Outcome outcome = outcome_of_text("t.gltf", text);
            CHECK_MESSAGE(outcome.reason.find(part) != std::string::npos, outcome.reason);
            CHECK_MESSAGE(outcome.code == code, outcome.reason);
            CHECK(outcome.reason.find('\n') == std::string::npos);
            CHECK(outcome.reason.rfind("t.gltf: ", 0) == 0);
            CHECK(outcome.reason.find("; ") != std::string::npos);
        };
        const std::string good = square_text();
        REQUIRE(refusal(good) == "read");
        REQUIRE(refusal(replaced(good, R"("scene":0)", R"("scene":0,"extras":"\"[)" + std::string(99, '[') + '"')) ==
                "read");
        const auto bad = [&](const std::string& from, const std::string& to, const std::string& part, int code = 3) {
            has(replaced(good, from, to), part, code);
        };
        has("", "is not a glTF");
        has("{}", "names no version");
        has("[1]", "is not a glTF");
        has(good.substr(0, good.size() - 3), "is not a glTF");
        has(R"({"asset":{"version":"1.0"}})", "is glTF '1.0'");
        has(std::string(100000, '['), "nested deeper than 64");
        bad(R"("scene":0)", R"("scene":0,"extras":)" + std::string(64, '[') + std::string(64, ']'),
            "nested deeper than 64");
        bad(R"("byteLength":92,)", R"("byteLength":93,)", "its buffer 0 has 92 of 93 bytes");
        bad(R"("byteLength":92,)", "", "its buffer 0 has no byteLength");
        bad("base64,A", "base64,*", "its buffer 0 is not written in base64");
        bad(R"("byteOffset":80)", R"("byteOffset":81)", "its bufferView 2 reaches behind the 92 bytes");
        bad(R"("byteOffset":80)", R"("byteOffset":18446744073709551615)", "its bufferView 2 reaches behind");
        bad(R"("count":4,"type":"VEC3")", R"("count":5,"type":"VEC3")", "its accessor 0 (POSITION) reaches behind");
        bad(R"("count":4,"type":"VEC3")", R"("count":3,"type":"VEC3")",
            "its TEXCOORD_0 has 4 elements for 3 positions");
        bad(R"("count":4,"type":"VEC3")", R"("count":4000000000,"type":"VEC3")",
            "its accessor 0 (POSITION) reaches behind");
        bad(R"("count":6)", R"("count":5)", "no multiple of 3");
        bad(R"("componentType":5123)", R"("componentType":5126)", "its accessor 2 (indices) reaches behind");
        bad(R"("indices":2)", R"("indices":3)", "accessor");
        bad(R"("indices":2)", R"("indices":1)", "has indices that are no unsigned integers");
        bad(R"("POSITION":0)", R"("POSITION":9)", "POSITION asks for accessor 9 of 3");
        bad(R"("POSITION":0)", R"("POSITION":1)", "its POSITION has 2 components");
        bad(R"({"buffer":0,"byteLength":48})", R"({"buffer":7,"byteLength":48})",
            "its bufferView 0 asks for buffer 7 of 1");
        bad(R"({"mesh":0})", R"({"mesh":1})", "asks for mesh 1 of 1");
        bad(R"({"mesh":0})", R"({"mesh":0,"children":[0]})", "its node 0 is met twice");
        bad(R"({"mesh":0})", R"({"children":[1]},{"children":[2],"mesh":0},{"children":[1]})", "is met twice");
        bad(R"("scene":0)", R"("scene":4)", "asks for scene 4 of 1");
        bad(R"("nodes":[0])", R"("nodes":[3])", "its node 3 is not one of 1");
        bad(R"({"mesh":0})", R"({"mesh":0,"matrix":[1e300,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})",
            "a transform that is not finite");
        bad(R"({"mesh":0})", R"({"mesh":0,"scale":[3e38,3e38,3e38],"translation":[3e38,0,0]})", "beyond all floats");
        bad(R"(,"scene":0)", R"(,"scene":0,"extensionsRequired":["KHR_draco_mesh_compression"])",
            "compressed by 'KHR_draco", 4);
        bad(R"("indices":2)", R"("indices":2,"mode":0)", "has no triangles", 4);
        bad(R"("indices":2)", R"("indices":2,"material":0)", "asks for material 0 of 0");
        has(replaced(good, "data:application", "http://example/data:application"), "no file beside it");
        Buffer nan = square_buffer();
        const float bytes = NAN;
        std::memcpy(&nan.bytes[4], &bytes, 4);
        has(gltf_text(nan.bytes, square_rest), "its POSITION has a value that is not finite");
        Buffer far = square_buffer();
        far.bytes[80] = 4;
        has(gltf_text(far.bytes, square_rest), "has index 4 of 4 positions");
        const TemporaryFolder folder;
        const Outcome absent = outcome_of(
            folder.write("t.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"gone.bin"}]})"));
        CHECK(absent.code == 3);
        CHECK(absent.reason.find("gone.bin: no such file") != std::string::npos);
    }

    TEST_CASE("gltf: scenes that take more memory than they are worth are refused before any is asked for") {
        std::string nodes, ids;
        for (int i = 0; i < 3000; ++i) {
            nodes += std::string(i ? "," : "") + R"({"mesh":0})";
            ids += (i ? "," : "") + std::to_string(i);
        }
        const std::string text =
            gltf_text("abcd", R"(,"accessors":[{"componentType":5126,"count":16000000,"type":"VEC3"}],)"
                              R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],"nodes":[)" +
                                  nodes + R"(],"scenes":[{"nodes":[)" + ids + "]}]");
        CHECK(outcome_of_text("t.gltf", text).code == 4);
        CHECK(refusal(text).find("more than fit here") != std::string::npos);
        CHECK(outcome_of_text("t.gltf", replaced(text, "16000000", "16777217000")).code == 4);
    }

    TEST_CASE("gltf: a mesh without faces, values that are not finite and folders that are not there are refused, "
              "nothing is left") {
        const TemporaryFolder folder;
        const auto code = [](const std::string& path, const Mesh& mesh) {
            try {
                write_mesh(path, mesh);
            } catch (const Error& error) {
                return int(error.refusal);
            }
            return 0;
        };
        Mesh mesh = rich_triangles(2, 1);
        CHECK(code(folder.file("a.glb"), Mesh{}) == 4);
        CHECK(code(folder.file("gone/a.glb"), mesh) == 5);
        CHECK(code(folder.file("gone/a.gltf"), mesh) == 5);
        mesh.attributes[2].values[3] = INFINITY;
        CHECK(code(folder.file("a.gltf"), mesh) == 4);
        mesh.attributes.clear();
        mesh.tangents[5].z = NAN;
        CHECK(code(folder.file("a.glb"), mesh) == 4);
        CHECK(std::filesystem::is_empty(folder.path));
    }
} // unit

TEST_SUITE("stability") {
    TEST_CASE("gltf: a good file cut at any byte, or with any byte changed, is read or refused, never worse") {
        const TemporaryFolder folder;
        Gltf gltf{rich_triangles(2, 1), {}, {}, {}};
        gltf.images = {image_of("a", "")};
        gltf.materials = {{.name = "brick"}, {.name = "plaster"}};
        gltf.materials[0].normal = GltfTexture{0, 0, 0.5, {}};
        write_gltf(folder.file("a.glb"), gltf);
        std::mt19937 random(5);
        for (const bool binary : {true, false}) {
            const std::string good = binary ? bytes_of(folder.file("a.glb")) : square_text();
            const std::string name = binary ? "x.glb" : "x.gltf";
            REQUIRE(outcome_of(folder.write(name, good)).code == 0);
            for (std::size_t at = 0; at < good.size(); ++at) {
                if (at % 4 == 0) CHECK(outcome_of(folder.write(name, good.substr(0, at))).code == 3);
                const char others[] = {char(random()), '9', '-', char(random())};
                std::string wrong = good;
                wrong[at] = others[random() % 4];
                const Outcome outcome = outcome_of(folder.write(name, wrong));
                CHECK((outcome.code == 0 || outcome.code == 3 || outcome.code == 4));
                CHECK(outcome.reason.find('\n') == std::string::npos);
            }
        }
    }

    TEST_CASE("gltf: a chain of a hundred thousand nodes is walked without calls within calls") {
        std::string nodes;
        for (int i = 0; i < 100000; ++i) nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
        const std::string text =
            replaced(square_text(), R"("nodes":[{"mesh":0}])", R"("nodes":[)" + nodes + R"({"mesh":0}])");
        CHECK(read_gltf_text(text).nodes.size() == 1);
    }
} // stability
