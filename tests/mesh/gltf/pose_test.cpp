// What places the vertices of a glTF besides their positions: morph targets, skins, instances.
#include "mesh/gltf/gltf_files.h"

namespace {
using namespace bake;
using namespace bake_tests;

/// The square with more accessors over floats that follow in its buffer: `more` are their floats and types.
struct More {
    std::string type;
    std::vector<float> values;
};
std::string square_with(const std::vector<More>& more, int vertices = 4) {
    Buffer buffer = square_buffer();
    std::string views, accessors;
    for (std::size_t i = 0; i < more.size(); ++i) {
        const std::string offset = std::to_string(buffer.bytes.size());
        for (const float value : more[i].values) buffer.put<float>({value});
        const std::string bytes = std::to_string(4 * more[i].values.size());
        const std::size_t count = more[i].type == "MAT4" ? more[i].values.size() / 16 : std::size_t(vertices);
        views += R"(,{"buffer":0,"byteOffset":)" + offset + R"(,"byteLength":)" + bytes + "}";
        accessors += R"(,{"bufferView":)" + std::to_string(3 + i) + R"(,"componentType":5126,"count":)" +
                     std::to_string(count) + R"(,"type":")" + more[i].type + "\"}";
    }
    std::string rest = replaced(square_rest, R"("byteLength":12}])", R"("byteLength":12})" + views + "]");
    return gltf_text(buffer.bytes, replaced(rest, R"("type":"SCALAR"}])", R"("type":"SCALAR"})" + accessors + "]"));
}

Vec3f corner(const Mesh& mesh, std::size_t c) { return mesh.positions[mesh.corner_position[c]]; }
bool near(const Vec3f& a, const Vec3f& b) { return glm::length(a - b) < 1e-5f; }
bool says(const Gltf& gltf, const std::string& part) {
    return std::any_of(gltf.notes.begin(), gltf.notes.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

const More up{"VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2}};
const More normals{"VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}};
const More bend{"VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}};

std::string morphed(const std::string& mesh_weights, const std::string& node_weights = "") {
    std::string text = square_with({up, normals, bend});
    text = replaced(text, R"("TEXCOORD_0":1},"indices":2})",
                    R"("TEXCOORD_0":1,"NORMAL":4},"indices":2,"targets":[{"POSITION":5},{"POSITION":3,"NORMAL":5}]})");
    text = replaced(text, R"(}]}],"nodes")", "}]" + mesh_weights + R"(}],"nodes")");
    return replaced(text, R"({"mesh":0})", R"({"mesh":0)" + node_weights + "}");
}

/// Two joints, nodes 1 and 2; the first places the left side of the square, the second the right.
std::string skinned(const std::string& node, const std::string& joint, const std::string& inverse_bind = "") {
    std::string text = square_with(
        {{"VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}},
         {"VEC4", {1, 0, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0}}, // weights are to have the sum 1, or not
         {"MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1}}});
    text = replaced(text, R"("TEXCOORD_0":1})", R"("TEXCOORD_0":1,"JOINTS_0":3,"WEIGHTS_0":4})");
    return replaced(text, R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])",
                    R"("nodes":[{"mesh":0,"skin":0)" + node + R"(},{"translation":[0,0,3]},{"translation":[0,0,3])" +
                        joint + R"(}],"skins":[{"joints":[1,2])" + inverse_bind + R"(}],"scenes":[{"nodes":[0]}])");
}
const std::string bound = R"(,"inverseBindMatrices":5)";
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("gltf: morph targets are applied with the weights of the mesh, or of the node") {
        const Gltf plain = read_gltf_text(morphed(""));
        CHECK(near(corner(plain.mesh, 0), {0, 0, 0}));
        CHECK(plain.notes.empty());
        for (const auto& [mesh, node] : {std::pair<std::string, std::string>{R"(,"weights":[0,0.5])", ""},
                                         {R"(,"weights":[1,1])", R"(,"weights":[0,0.5])"},
                                         {"", R"(,"weights":[0,0.5])"}}) {
            const Gltf got = read_gltf_text(morphed(mesh, node));
            CHECK(near(corner(got.mesh, 0), {0, 0, 0.5f}));
            CHECK(near(corner(got.mesh, 5), {0, 1, 1}));
            const Vec3f n = got.mesh.normals[got.mesh.corner_normal[0]];
            CHECK(near(n, glm::normalize(Vec3f(0.5f, 0, 1)))); // unit again
            CHECK(says(got, "1 node with morph targets"));
        }
        CHECK(near(corner(read_gltf_text(morphed(R"(,"weights":[2])")).mesh, 1), {3, 0, 0}));
        CHECK(outcome_of_text("t.gltf",
                              replaced(morphed(R"(,"weights":[1])"), R"([{"POSITION":5})", R"([{"POSITION":1})"))
                  .code == 3);
    }

    TEST_CASE("gltf: the transform of a skinned node is ignored; its joints place the mesh") {
        const Gltf still = read_gltf_text(skinned(R"(,"translation":[7,7,7],"scale":[2,2,2])", "", bound));
        CHECK(same_mesh(flatten(still), read_gltf_text(square_text()).mesh));
        CHECK(says(still, "1 node with a skin"));
        // Without inverse bind matrices they are 1, and both joints move the square.
        const Mesh moved = flatten(read_gltf_text(skinned(R"(,"translation":[7,7,7])", "")));
        CHECK(near(corner(moved, 2), {1, 1, 3}));
        // The pose of the file is not that of the binding: the right side is turned about y, which takes x to -z.
        const Mesh posed = flatten(read_gltf_text(skinned("", R"(,"rotation":[0,0.70710678,0,0.70710678])", bound)));
        CHECK(near(corner(posed, 0), {0, 0, 0}));
        CHECK(near(corner(posed, 1), {-3, 0, 3 - 1}));
        CHECK(near(corner(posed, 5), {0, 1, 0}));
    }

    TEST_CASE("gltf: joints outside the scene place a mesh too; what a skin lacks is refused") {
        CHECK(outcome_of_text("t.gltf", skinned("", "")).code == 0);
        CHECK(outcome_of_text("t.gltf", replaced(skinned("", ""), R"("joints":[1,2])", R"("joints":[1,9])")).code == 3);
        CHECK(outcome_of_text("t.gltf", replaced(skinned("", ""), R"("joints":[1,2])", R"("joints":[1])")).code == 3);
        CHECK(outcome_of_text("t.gltf", replaced(skinned("", ""), R"("skin":0)", R"("skin":1)")).code == 3);
        CHECK(outcome_of_text("t.gltf", replaced(skinned("", ""), R"("WEIGHTS_0":4)", R"("WEIGHTS_0":0)")).code == 3);
    }

    TEST_CASE("gltf: instances of EXT_mesh_gpu_instancing are meshes, each where its node places it") {
        const std::string extension =
            R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":3,"SCALE":4}}})";
        const std::string text =
            replaced(square_with({{"VEC3", {0, 0, 0, 0, 0, 5, 0, 0, 9}}, {"VEC3", {1, 1, 1, 2, 2, 2, -1, 1, 1}}}, 3),
                     R"({"mesh":0})", R"({"mesh":0,"name":"crowd","scale":[10,10,10])" + extension + "}");
        const Gltf got = read_gltf_text(text);
        REQUIRE(got.nodes.size() == 3);
        const Mesh mesh = flatten(got);
        CHECK(near(corner(mesh, 2), {10, 10, 0}));
        CHECK(near(corner(mesh, 8), {20, 20, 50}));
        CHECK(near(corner(mesh, 12), {0, 0, 90}));
        CHECK(mesh.groups == std::vector<std::string>{"crowd"});
        CHECK(says(got, "1 node with EXT_mesh_gpu_instancing: placed 3 times"));
        CHECK(outcome_of_text("t.gltf", replaced(text, R"("SCALE":4)", R"("SCALE":1)")).code == 3);
        CHECK(outcome_of_text("t.gltf", replaced(text, R"("SCALE":4)", R"("ROTATION":4)")).code == 3);
    }

    TEST_CASE("gltf: hidden nodes are left out, with their children") {
        const std::string hidden = R"("extensions":{"KHR_node_visibility":{"visible":false}})";
        const std::string text = replaced(square_text(), R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])",
                                          R"("nodes":[{"mesh":0},{"children":[2],)" + hidden +
                                              R"(},{"mesh":0}],"scenes":[{"nodes":[0,1]}])");
        const Gltf got = read_gltf_text(text);
        CHECK(got.nodes.size() == 1);
        CHECK(says(got, "1 node hidden"));
        CHECK(read_gltf_text(replaced(text, "false", "true")).nodes.size() == 2);
    }
} // unit
