#include "mesh/gltf/gltf_files.h"
#include <glm/common.hpp>

namespace {
using namespace bake;
using namespace bake_tests;

const char* const half_turn = // the example of the specification: the lower left quarter of the picture, turned
    R"({"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]})";

std::string texture(const std::string& rest) { return R"({"index":0)" + rest + "}"; }
std::string transformed(const std::string& transform) {
    return texture(R"(,"extensions":{"KHR_texture_transform":)" + transform + "}");
}

/// The square with TEXCOORD_1, where u is 1 - v of TEXCOORD_0, and a material.
std::string text_of(const std::string& material, const std::string& attributes = R"("TEXCOORD_0":1,"TEXCOORD_1":3)") {
    Buffer buffer = square_buffer();
    buffer.put<float>({0, 0.5f, 0, 0.75f, 0.75f, 0.75f, 0.75f, 0.5f});
    std::string rest = square_rest;
    rest = replaced(rest, R"("byteLength":12}])", R"("byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":32}])");
    rest = replaced(rest, R"("type":"SCALAR"}])",
                    R"("type":"SCALAR"},{"bufferView":3,"componentType":5126,"count":4,"type":"VEC2"}])");
    rest = replaced(rest, R"("TEXCOORD_0":1)", attributes);
    rest = replaced(rest, R"("indices":2)", R"("indices":2,"material":0)");
    return gltf_text(buffer.bytes, rest + R"(,"textures":[{}],"materials":[)" + material + "]");
}

struct Read {
    Mesh mesh;
    std::vector<std::string> notes;

    Vec2f uv(std::size_t corner) const { return mesh.uvs[mesh.corner_uv[corner]]; }
    bool says(const std::string& part) const {
        return std::any_of(notes.begin(), notes.end(),
                           [&](const std::string& line) { return line.find(part) != std::string::npos; });
    }
};
Read read(const std::string& text, const MeshOptions& options = {}) {
    const TemporaryFolder folder;
    Read out;
    out.mesh = read_mesh(folder.write("t.gltf", text), options);
    out.notes = out.mesh.notes;
    return out;
}

bool near(const Vec2f& a, const Vec2f& b) { return glm::length(a - b) < 1e-6f; }
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("gltf: KHR_texture_transform moves the uvs as the specification's example says") {
        const Read got = read(text_of(R"({"name":"m","normalTexture":)" + transformed(half_turn) + "}"));
        // Uvs of the file: (0, 1), (1, 1), (1, 1/4). Scaled by 1/2, turned from v towards u, moved by 1 along v.
        CHECK(near(got.uv(0), {0.5f, 1 - 1.0f}));
        CHECK(near(got.uv(1), {0.5f, 1 - 0.5f}));
        CHECK(near(got.uv(2), {0.125f, 1 - 0.5f}));
        CHECK(got.says("KHR_texture_transform of 'm'"));
        // For a file whose v points up the transform holds for its values as they are.
        const Read up = read(text_of(R"({"normalTexture":)" + transformed(half_turn) + "}"), {.flip_v = true});
        CHECK(near(up.uv(1), {0.5f, 0.5f}));
        CHECK(near(up.uv(2), {0.125f, 0.5f}));
    }

    TEST_CASE("gltf: offset and scale of a packer make the uvs whole") {
        const Read got =
            read(text_of(R"({"normalTexture":)" + transformed(R"({"scale":[16,32],"offset":[0.25,-8]})") + "}"));
        CHECK(near(got.uv(2), {16.25f, 1 - 0.0f}));
        CHECK(near(got.uv(0), {0.25f, 1 - 24.0f}));
    }

    TEST_CASE("gltf: the uvs are those of the set that the normal texture names, itself or by its transform") {
        for (const std::string& normal : {texture(R"(,"texCoord":1)"), transformed(R"({"texCoord":1})")}) {
            const Read got = read(text_of(R"({"normalTexture":)" + normal + R"(,"occlusionTexture":{"index":0}})"));
            CHECK(got.uv(0) == Vec2f(0, 0.5f));
            CHECK(got.uv(2) == Vec2f(0.75f, 0.25f));
            CHECK(got.says("TEXCOORD_1"));
            // No set is lost.
            REQUIRE(got.mesh.attributes.size() == 1);
            CHECK(got.mesh.attributes[0].name == "TEXCOORD_1");
            CHECK(
                std::vector<float>(got.mesh.attributes[0].values.begin(), got.mesh.attributes[0].values.begin() + 6) ==
                std::vector<float>{0, 0, 1, 0, 1, 0.75f});
            const Read chosen = read(text_of(R"({"normalTexture":)" + normal + "}"), {.uv_set = 0});
            CHECK(chosen.uv(2) == Vec2f(1, 0.75f));
            CHECK(chosen.notes.empty());
        }
    }

    TEST_CASE("gltf: without a normal texture the base colour says which uvs; without both it is the first set") {
        const std::string colour =
            R"({"pbrMetallicRoughness":{"baseColorTexture":)" + transformed(R"({"scale":[0.5,1],"texCoord":1})") + "}}";
        CHECK(near(read(text_of(colour)).uv(2), {0.375f, 0.25f}));
        CHECK(read(text_of(R"({"occlusionTexture":)" + texture(R"(,"texCoord":1)") + "}")).uv(2) == Vec2f(1, 0.75f));
        // The transform of a further texture counts where it is the first on the set that is taken.
        CHECK(near(read(text_of(R"({"emissiveTexture":)" + transformed(R"({"scale":[0.5,1]})") + "}")).uv(2),
                   {0.5f, 0.75f}));
        // A set that is chosen keeps the transform of the textures on it.
        CHECK(near(read(text_of(colour), {.uv_set = 1}).uv(2), {0.375f, 0.25f}));
        CHECK(read(text_of(colour), {.uv_set = 0}).uv(2) == Vec2f(1, 0.75f));
    }

    TEST_CASE("gltf: a vertex that two materials share gets a uv of each") {
        std::string text = text_of(R"({"name":"a","normalTexture":)" + transformed(R"({"offset":[0.5,0]})") + "},{}");
        text = replaced(
            text, R"("count":6,"type":"SCALAR"})",
            R"("count":3,"type":"SCALAR"},{"bufferView":2,"byteOffset":6,"componentType":5123,"count":3,"type":"SCALAR"})");
        text = replaced(
            text, R"("TEXCOORD_1":3},"indices":2,"material":0})",
            R"("TEXCOORD_1":4},"indices":2,"material":0},{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":4},"indices":3,"material":1})");
        const Read got = read(text);
        REQUIRE(got.mesh.faces() == 2);
        CHECK(got.mesh.corner_position[0] == got.mesh.corner_position[3]);
        CHECK(got.uv(0) == Vec2f(0.5f, 0));
        CHECK(got.uv(3) == Vec2f(0, 0));
    }

    TEST_CASE("gltf: a set that is missing is refused where it is asked for, and said where a texture asks") {
        const std::string missing = text_of(R"({"normalTexture":)" + texture(R"(,"texCoord":4)") + "}");
        const Read got = read(missing);
        CHECK(got.uv(2) == Vec2f(1, 0.75f));
        CHECK(got.says("TEXCOORD_4, which is missing"));
        const auto refusal = [](const std::string& name, const std::string& text, int set) {
            const TemporaryFolder folder;
            try {
                read_mesh(folder.write(name, text), {.uv_set = set});
            } catch (const Error& error) {
                return std::to_string(int(error.refusal)) + error.what();
            }
            return std::string("read");
        };
        CHECK(refusal("t.gltf", missing, 4).find("no uvs of set 4; its sets are: 0, 1") != std::string::npos);
        CHECK(refusal("t.gltf", missing, 4)[0] == '4');
        const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
        CHECK(refusal("t.obj", obj, 0) == "read");
        CHECK(refusal("t.obj", obj, 1).find("its sets are: 0") != std::string::npos);
    }

    TEST_CASE("gltf: the second set of uvs survives PLY, where --uv-set finds it") {
        const TemporaryFolder folder;
        Mesh mesh = rich_triangles(4, 2);
        write_mesh(folder.file("a.ply"), mesh);
        const Mesh got = read_mesh(folder.file("a.ply"), {.uv_set = 1});
        for (std::size_t c = 0; c < mesh.corners(); ++c)
            CHECK(got.uvs[got.corner_uv[c]] ==
                  Vec2f(mesh.attributes[1].values[2 * c], mesh.attributes[1].values[2 * c + 1]));
    }

    TEST_CASE("gltf: transforms of textures come back from what is written, also of pictures that are not read") {
        const TemporaryFolder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        const std::string png = "\x89PNG\r\n\x1a\n of which nothing is looked at";
        gltf.images = {{"", "image/png", "", {png.begin(), png.end()}}};
        gltf.materials = {{.name = "brick"}, {.name = "plaster"}};
        gltf.materials[0].normal = GltfTexture{0, 1, 0.5, {}, {0.25, -1, 0.5, 2, 3}};
        write_gltf(folder.file("a.glb"), gltf);
        CHECK(read_gltf(folder.file("a.glb")).materials == gltf.materials);
        CHECK(bytes_of(folder.file("a.glb")).find(R"("extensionsUsed":["KHR_texture_transform"])") !=
              std::string::npos);
    }

    TEST_CASE("gltf: transforms that are not numbers, or beyond all floats, are refused") {
        const auto code = [](const std::string& transform) {
            return outcome_of_text("t.gltf", text_of(R"({"normalTexture":)" + transformed(transform) + "}")).code;
        };
        CHECK(code(R"({"scale":[2,2]})") == 0);
        CHECK(code(R"({"scale":[2]})") == 3);
        CHECK(code(R"({"offset":"far"})") == 3);
        CHECK(code(R"({"scale":[1e300,1]})") == 3);
        CHECK(code(R"({"texCoord":-1})") == 3);
    }
} // unit
