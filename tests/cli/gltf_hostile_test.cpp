// glTF files whose JSON names bytes that are not there, copied by bake surface.
#include "cli/command.h"

using namespace bake::test;

namespace {

/// A triangle; `views` follows its bufferView, `inside` stands in it, `more` at the end of the root.
std::string triangle(const std::string& inside, const std::string& views, const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36)" +
           inside + "}" + views +
           R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],)"
           R"("scene":0)" +
           more + "}";
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("gltf: bytes that no buffer has are refused, wherever the file names them") {
        const Folder folder;
        const auto copy = [&](const std::string& text, int code, const std::string& named) {
            write_file(folder / "a.gltf", text);
            for (const char* out : {"b.gltf", "b.glb"})
                check_refused(folder, {"surface", "a.gltf", "-o", out}, code, named);
        };
        copy(triangle("", R"(,{"buffer":0,"byteOffset":1000000,"byteLength":4})"), 3, "ends behind its buffer");
        copy(triangle("", R"(,{"buffer":0,"byteOffset":18446744073709551600,"byteLength":100})"), 3, "a.gltf");
        copy(triangle(R"(,"extensions":{"X_y":{"buffer":0,"byteOffset":40,"byteLength":4}})", ""), 3,
             "ends behind its buffer");
        copy(triangle(R"(,"extensions":{"X_y":{"buffer":0,"byteOffset":-5,"byteLength":8}})", ""), 3,
             "is no number of bytes");
        copy(triangle(R"(,"extensions":{"X_y":{"buffer":0,"byteOffset":"a","byteLength":8}})", ""), 3,
             "is no number of bytes");
        std::string keys = R"(,"extras":{"a":0)";
        for (int i = 0; i < 3000; ++i) keys += ",\"" + std::to_string(i) + "\":0";
        copy(triangle("", "", keys + "}"), 4, "more than 2000 keys");
        write_file(folder / "a.gltf", triangle("", ""));
        CHECK(run_bake(folder, {"surface", "a.gltf", "-o", "b.glb"}).code == 0);
    }
}
