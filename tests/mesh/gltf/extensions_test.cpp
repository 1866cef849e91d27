#include "mesh/gltf/gltf_files.h"

namespace {
using namespace bake;
using namespace bake_tests;

Outcome outcome(const std::string& text) { return outcome_of_text("t.gltf", text); }

std::string required(const std::string& text, const std::string& names) {
    return replaced(text, R"(,"scene":0)", R"(,"scene":0,"extensionsRequired":[)" + names + "]");
}

void check_refused(const std::string& text, const std::string& part) {
    const Outcome got = outcome(text);
    CHECK(got.code == 4);
    CHECK_MESSAGE(got.reason.find(part) != std::string::npos, got.reason);
}

/// The square, with an extension on its primitive.
std::string square_with_draco() {
    return replaced(square_text(), R"("indices":2)",
                    R"("indices":2,"extensions":{"KHR_draco_mesh_compression":{"bufferView":2,"attributes":{}}})");
}

/// The square whose buffer, or one more, is that of an uncompressed copy.
std::string square_with_meshopt(const std::string& buffer) {
    std::string text = square_text();
    for (int view = 0; view < 3; ++view) {
        const std::string plain = R"("buffer":0,"byteOffset":)" + std::to_string(view == 2 ? 80 : 48);
        const std::string packed =
            R"("buffer":0,"byteOffset":0,"byteLength":8,"byteStride":4,"count":1,"mode":"ATTRIBUTES")";
        const std::string extension = R"(,"extensions":{"EXT_meshopt_compression":{)" + packed + "}}";
        if (view > 0) text = replaced(text, plain, buffer + plain.substr(plain.find(',')) + extension);
    }
    return text;
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("gltf: an unknown required extension is named, before anything else of the file is judged") {
        check_refused(required(square_text(), R"("KHR_texture_transform","EXT_made_up")"), "'EXT_made_up'");
        const std::string broken = replaced(required(square_text(), R"("EXT_made_up")"), "base64,A", "base64,*");
        check_refused(broken, "'EXT_made_up'");
        CHECK(outcome(required(square_text(), "5")).code == 3);
    }

    TEST_CASE("gltf: required extensions that leave the mesh as it is, or are applied, are accepted") {
        for (const char* name :
             {"KHR_texture_transform", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility",
              "KHR_materials_unlit", "KHR_texture_basisu", "EXT_texture_webp", "KHR_lights_punctual"})
            CHECK_MESSAGE(outcome(required(square_text(), std::string("\"") + name + "\"")).code == 0, name);
    }

    TEST_CASE("gltf: Draco is refused by its name, unless the file has a whole uncompressed copy") {
        CHECK(outcome(square_with_draco()).code == 0);
        CHECK(same_mesh(read_gltf_text(square_with_draco()).mesh, read_gltf_text(square_text()).mesh));
        check_refused(required(square_with_draco(), R"("KHR_draco_mesh_compression")"), "(Draco)");
        // The compressed form alone: its accessors have no bytes.
        for (const std::string view : {R"("bufferView":0,)", R"("bufferView":1,)", R"("bufferView":2,)"})
            check_refused(replaced(square_with_draco(), "{" + view + "\"componentType\"", "{\"componentType\""),
                          "(Draco)");
    }

    TEST_CASE("gltf: meshoptimizer is refused by its name, unless its fallback has bytes") {
        const std::string read = square_with_meshopt(R"("buffer":0)");
        CHECK(same_mesh(read_gltf_text(read).mesh, read_gltf_text(square_text()).mesh));
        const std::string empty = replaced(
            square_with_meshopt(R"("buffer":1)"), R"("}],"bufferViews")",
            R"("},{"byteLength":92,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews")");
        check_refused(empty, "'EXT_meshopt_compression' (meshoptimizer)");
        check_refused(required(empty, R"("EXT_made_up","EXT_meshopt_compression")"), "(meshoptimizer)");
        check_refused(required(read, R"("EXT_meshopt_compression")"), "(meshoptimizer)");
        check_refused(required(read, R"("KHR_meshopt_compression")"), "(meshoptimizer)");
    }
} // unit
