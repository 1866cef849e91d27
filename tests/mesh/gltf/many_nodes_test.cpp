// Scenes of many nodes and lists that many meshes share: what is read once and what is read again gives the same mesh.
#include "growth.h"
#include "mesh/gltf/gltf_files.h"

namespace {
using namespace bake;
using namespace bake_tests;

std::string repeated(int count, const std::string& what) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i ? "," : "") + what;
    return out;
}
std::string numbers(int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i ? "," : "") + std::to_string(i);
    return out;
}
std::string scene(const std::string& nodes, int count) {
    return R"("nodes":[)" + nodes + R"(],"scenes":[{"nodes":[)" + numbers(count) + "]}]";
}
const std::string one_node = R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])";

/// The square in `count` nodes.
std::string crowd(int count) {
    return replaced(square_text(), one_node, scene(repeated(count, R"({"mesh":0})"), count));
}

/// `count` triangles in one list of positions, each the mesh of a node. The first `replaced` positions come from a sparse
/// accessor, in descending order if asked for.
std::string shared_list(int count, int replaced = 0, bool descending = false) {
    Buffer buffer;
    for (int i = 0; i < 3 * count; ++i) {
        const float x = i < replaced ? 0 : float(i % 3 == 1), y = i < replaced ? 0 : float(i % 3 == 2);
        buffer.put<float>({x, y, float(i / 3)});
    }
    const std::size_t indices = buffer.bytes.size();
    for (int i = 0; i < 3 * count; ++i) buffer.put<std::uint32_t>({std::uint32_t(i)});
    const std::size_t sparse = buffer.bytes.size();
    const auto element = [&](int i) { return descending ? replaced - 1 - i : i; };
    for (int i = 0; i < replaced; ++i) buffer.put<std::uint32_t>({std::uint32_t(element(i))});
    for (int i = 0; i < replaced; ++i)
        buffer.put<float>({float(element(i) % 3 == 1), float(element(i) % 3 == 2), float(element(i) / 3)});
    const auto view = [](std::size_t from, std::size_t to) {
        return R"({"buffer":0,"byteOffset":)" + std::to_string(from) + R"(,"byteLength":)" + std::to_string(to - from) +
               "}";
    };
    std::string views = view(0, indices) + "," + view(indices, sparse);
    std::string accessors =
        R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + std::to_string(3 * count);
    if (replaced > 0) {
        views += "," + view(sparse, sparse + 4 * std::size_t(replaced)) + "," +
                 view(sparse + 4 * std::size_t(replaced), buffer.bytes.size());
        accessors += R"(,"sparse":{"count":)" + std::to_string(replaced) +
                     R"(,"indices":{"bufferView":2,"componentType":5125},"values":{"bufferView":3}})";
    }
    accessors += "}";
    std::string meshes, nodes;
    for (int i = 0; i < count; ++i) {
        accessors += R"(,{"bufferView":1,"byteOffset":)" + std::to_string(12 * i) +
                     R"(,"componentType":5125,"count":3,"type":"SCALAR"})";
        meshes += std::string(i ? "," : "") + R"({"primitives":[{"attributes":{"POSITION":0},"indices":)" +
                  std::to_string(i + 1) + "}]}";
        nodes += std::string(i ? "," : "") + R"({"mesh":)" + std::to_string(i) + "}";
    }
    return gltf_text(buffer.bytes, R"(,"bufferViews":[)" + views + R"(],"accessors":[)" + accessors +
                                       R"(],"meshes":[)" + meshes + "]," + scene(nodes, count));
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("gltf: a mesh in many nodes is the same as a mesh of their own in each") {
        // Three meshes with other attributes each, so that some corners have no normals, uvs, colours or groups.
        Buffer buffer = square_buffer();
        buffer.put<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0});
        std::string rest = replaced(square_rest, R"("byteLength":12}])",
                                    R"("byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":48}])");
        rest = replaced(rest, R"("type":"SCALAR"}])",
                        R"("type":"SCALAR"},{"bufferView":3,"componentType":5126,"count":4,"type":"VEC3"}])");
        const std::string kinds[] = {
            R"({"primitives":[{"attributes":{"POSITION":0},"indices":2,"material":0}]})",
            R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":3,"TEXCOORD_0":1},"indices":2,"extras":{"group":"a"}}]})",
            R"({"primitives":[{"attributes":{"POSITION":0,"COLOR_0":3},"indices":2,"material":1},)"
            R"({"attributes":{"POSITION":0,"COLOR_0":3,"TEXCOORD_1":1},"indices":2,"extras":{"group":"b"}}]})"};
        const int order[] = {0, 0, 1, 1, 0, 2, 1, 2, 2, 0};
        const auto text = [&](bool own) {
            std::string meshes, nodes;
            for (int i = 0; i < 10; ++i)
                nodes += std::string(i ? "," : "") + R"({"translation":[)" + std::to_string(i) + R"(,0,0],"mesh":)" +
                         std::to_string(own ? i : order[i]) + "}";
            for (int i = 0; i < (own ? 10 : 3); ++i) meshes += (i ? "," : "") + kinds[own ? order[i] : i];
            std::string all =
                replaced(rest, one_node, R"("materials":[{"name":"m"},{"name":"n"}],)" + scene(nodes, 10));
            const std::size_t from = all.find(R"("meshes":[)") + 10, to = all.find(R"(],"materials")");
            return gltf_text(buffer.bytes, all.replace(from, to - from, meshes));
        };
        const Gltf once = read_gltf_text(text(false)), each = read_gltf_text(text(true));
        CHECK(same_mesh(once.mesh, each.mesh));
        CHECK(once.nodes == each.nodes);
        CHECK(same_mesh(flatten(once), flatten(each)));
        CHECK(once.mesh.faces() == 26);
        CHECK(once.mesh.attributes.size() == 2);
    }

    TEST_CASE("gltf: meshes that share a list of vertices have their own vertices alone, replaced ones too") {
        const Mesh mesh = flatten(read_gltf_text(shared_list(100)));
        REQUIRE(mesh.faces() == 100);
        CHECK(mesh.positions.size() == 300);
        CHECK(mesh.positions[7] == Vec3f(1, 0, 2));
        for (const bool descending : {false, true})
            CHECK(same_mesh(mesh, flatten(read_gltf_text(shared_list(100, 150, descending)))));
        CHECK(flatten(read_gltf_text(shared_list(2, 3))).positions[1] == Vec3f(1, 0, 0)); // all of them are read
    }

    TEST_CASE("gltf: instances and attributes without end are refused before they are read") {
        std::string text = replaced(crowd(3000), R"("type":"SCALAR"}])",
                                    R"("type":"SCALAR"},{"componentType":5126,"count":16000000,"type":"VEC3"}])");
        const std::string extension =
            R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":3}}}})";
        text = replaced(text, repeated(3000, R"({"mesh":0})"), repeated(3000, extension));
        CHECK(outcome_of_text("t.gltf", text).code == 4);
        CHECK(outcome_of_text("t.gltf", text).reason.find("instances, more than fit here") != std::string::npos);

        std::string attributes;
        for (int i = 0; i < 1001; ++i) attributes += R"("_A)" + std::to_string(i) + R"(":1,)";
        text = replaced(square_text(), R"("TEXCOORD_0":1)", attributes + R"("TEXCOORD_0":1)");
        CHECK(outcome_of_text("t.gltf", text).code == 4);
        CHECK(outcome_of_text("t.gltf", text).reason.find("have 1001 different attributes") != std::string::npos);
    }
} // unit

TEST_SUITE("stability") {
    TEST_CASE("gltf: the time grows with the number of nodes, meshes and names, not with its square") {
        const TemporaryFolder folder;
        const auto read = [&](const std::string& text) { flatten(read_gltf(folder.write("t.gltf", text))); };
        CHECK(test::growth([&](int n) { read(crowd(n)); }, 10000) < test::most_growth);
        CHECK(test::growth([&](int n) { read(shared_list(n)); }, 2000) < test::most_growth);
        CHECK(test::growth([&](int n) { read(shared_list(n, 3 * n, true)); }, 2000) < test::most_growth);
    }
} // stability
