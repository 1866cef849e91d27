// glTF files kept whole: surface, displace and normal-map change what they compute and nothing else.
#include "bake/mesh/gltf/io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "mesh/gltf/gltf_files.h"
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
using namespace bake;
using namespace bake::test;
using bake_tests::Buffer;
using nlohmann::json;

bool no_python() { return std::system("python3 -c 'import sys' 2>/dev/null") != 0; }
bool no_validator() { return !fs::exists(source_folder() / "build/gltf_validator/node_modules/gltf-validator"); }
/// The options of scripts/gltf_round_trip for the programs that are installed.
std::string checks() {
    const bool inspect = fs::exists(source_folder() / "build/gltf_inspect/node_modules/@gltf-transform");
    return std::string(no_validator() ? "" : "--validate ") + (inspect ? "--inspect " : "");
}
bool no_viewer() {
    return !fs::exists(source_folder() / "build/three_viewer/node_modules/three") ||
           std::system("command -v chromium >/dev/null") != 0;
}

/// What scripts/gltf_round_trip finds; "" if nothing is lost.
std::string round_trip(const Folder& folder, const std::string& options) {
    const std::string out = folder / "said.txt";
    const std::string command = "'" + (source_folder() / "scripts/gltf_round_trip").string() + "' '" +
                                std::getenv("BAKE") + "' '" + (folder / "out") + "' " + options + " > '" + out +
                                "' 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : contents(out);
}

json root_of(const std::string& file) {
    const std::string bytes = contents(file);
    if (bytes.rfind("glTF", 0) != 0) return json::parse(bytes);
    const auto byte = [&](int i) { return std::size_t(static_cast<unsigned char>(bytes[std::size_t(i)])); };
    return json::parse(bytes.substr(20, byte(12) | byte(13) << 8 | byte(14) << 16));
}

/// A square whose material has a texture, under two nodes, of which `second` places the other.
std::string square(const std::string& second) {
    std::string text = bake_tests::square_text();
    text = bake_tests::replaced(text, "\"indices\":2}", "\"indices\":2,\"material\":0}");
    text = bake_tests::replaced(text, R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])",
                                R"("materials":[{"name":"m","extras":7,"doubleSided":true}],)"
                                R"("nodes":[{"mesh":0,"name":"a"},{"mesh":0)" +
                                    second + R"(}],"scenes":[{"nodes":[0,1],"name":"s"}])");
    return text;
}

json run_json(const Folder& folder, std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const Run run = run_bake(folder, arguments, {.seconds = 60});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return json::parse(run.out);
}
const std::string bricks = (own_meshes() / "bricks.png").string();
} // namespace

TEST_SUITE("cli") {
    TEST_CASE("gltf asset: nothing of seven files is lost by surface, displace and normal-map" *
              doctest::skip(no_python())) {
        const Folder folder;
        CHECK(round_trip(folder, checks()) == "");
    }

    TEST_CASE("gltf asset: a mesh of two nodes stays shared if both displace it alike, and is copied if not") {
        const Folder folder;
        const auto displaced = [&](const std::string& second, const std::string& levels) {
            write_file(folder / "a.gltf", square(second));
            run_json(folder, {"displace", "a.gltf", "--height", bricks, "--amplitude", "0.1", "--levels", levels, "-o",
                              "b.glb"});
            return root_of(folder / "b.glb");
        };
        for (const std::string levels : {"0", "2"}) {
            json root = displaced(R"(,"translation":[3,0,0],"rotation":[0,0.6,0,0.8])", levels);
            CHECK(root["meshes"].size() == 1);
            CHECK(root["materials"][0]["extras"] == 7);
            CHECK(root["nodes"][1]["rotation"] == json::array({0, 0.6, 0, 0.8}));
            CHECK(root["scenes"][0]["name"] == "s");
            root = displaced(R"(,"scale":[1,1,4])", levels); // the height is in world units
            REQUIRE(root["meshes"].size() == 2);
            CHECK(root["nodes"][0]["mesh"] == 0);
            CHECK(root["nodes"][1]["mesh"] == 1);
            const auto depth = [&](int mesh) {
                const json& a =
                    root["accessors"][root["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"].get<int>()];
                return a["max"][2].get<double>();
            };
            CHECK(depth(0) == doctest::Approx(4 * depth(1)));
            CHECK(std::abs(depth(0)) > 0.01);
        }
    }

    TEST_CASE("gltf asset: what is displaced in place of the file's mesh is what displace writes of the mesh alone") {
        const Folder folder;
        write_file(folder / "a.gltf", square(R"(,"scale":[-1,2,1],"translation":[5,1,2])"));
        for (const std::string levels : {"0", "3"}) {
            const std::vector<std::string> rest = {"--height", bricks, "--amplitude", "0.1",
                                                   "--levels", levels, "--tangents",  "-o"};
            for (const char* out : {"kept.glb", "mesh.ply"}) {
                std::vector<std::string> all = {"displace", "a.gltf"};
                all.insert(all.end(), rest.begin(), rest.end());
                all.emplace_back(out);
                run_json(folder, all);
            }
            const Mesh kept = read_mesh(folder / "kept.glb"), alone = read_mesh(folder / "mesh.ply");
            REQUIRE(kept.corners() == alone.corners());
            double position = 0, normal = 0, uv = 0, tangent = 0;
            for (std::size_t c = 0; c < kept.corners(); ++c) {
                const auto between = [&](const auto& a, const auto& b) { return double(glm::length(a - b)); };
                position = std::max(position, between(kept.positions[kept.corner_position[c]],
                                                      alone.positions[alone.corner_position[c]]));
                normal = std::max(normal,
                                  between(kept.normals[kept.corner_normal[c]], alone.normals[alone.corner_normal[c]]));
                uv = std::max(uv, between(kept.uvs[kept.corner_uv[c]], alone.uvs[alone.corner_uv[c]]));
                tangent = std::max(tangent, between(kept.tangents[c], alone.tangents[c]));
            }
            CHECK(position < 1e-5);
            CHECK(normal < 1e-5);
            CHECK(uv < 1e-6);
            CHECK(tangent < 1e-4);
        }
    }

    TEST_CASE("gltf asset: a finer mesh has all sets of uvs of the file, wherever the height was sampled") {
        const Folder folder;
        Buffer buffer = bake_tests::square_buffer();
        buffer.put<float>({0, 0, 0.5f, 0, 0.5f, 0.25f, 0, 0.25f}); // (x / 2, y / 4), as in the file
        std::string text = bake_tests::gltf_text(buffer.bytes, bake_tests::square_rest);
        text = bake_tests::replaced(text, R"("byteLength":12}])",
                                    R"("byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":32}])");
        text =
            bake_tests::replaced(text, R"("accessors":[)",
                                 R"("extensionsUsed":["KHR_texture_transform"],"images":[{"uri":"x.png"}],)"
                                 R"("textures":[{"source":0}],"materials":[{"normalTexture":{"index":0,"texCoord":1,)"
                                 R"("extensions":{"KHR_texture_transform":{"offset":[0.25,0.5]}}}}],"accessors":[)");
        text =
            bake_tests::replaced(text, R"("type":"SCALAR"}])",
                                 R"("type":"SCALAR"},{"bufferView":3,"componentType":5126,"count":4,"type":"VEC2"}])");
        text = bake_tests::replaced(text, R"("TEXCOORD_0":1},"indices":2})",
                                    R"("TEXCOORD_0":1,"TEXCOORD_1":3},"indices":2,"material":0})");
        write_file(folder / "a.gltf", text);
        for (const std::vector<std::string>& kind :
             {std::vector<std::string>{"--levels", "2"}, {"--subdivide", "catmark", "--levels", "2"}}) {
            std::vector<std::string> all = {"displace",    "a.gltf", "--height", bricks,
                                            "--amplitude", "0.01",   "-o",       "b.glb"};
            all.insert(all.end(), kind.begin(), kind.end());
            CHECK(run_json(folder, all).dump().find("TEXCOORD_1") != std::string::npos); // a note on the uvs
            const Mesh mesh = read_gltf(folder / "b.glb").mesh;
            CHECK(mesh.positions.size() >= 25);
            REQUIRE(mesh.attributes.size() == 1);
            // A limit surface lies within the square, and its values are those of the square's faces.
            const bool limit = kind.size() > 2;
            double most = 0;
            for (std::size_t c = 0; c < mesh.corners(); ++c) {
                const Vec2f first = mesh.uvs[mesh.corner_uv[c]];
                const Vec2f second(mesh.attributes[0].values[2 * c], mesh.attributes[0].values[2 * c + 1]);
                const Vec3f p = mesh.positions[mesh.corner_position[c]];
                const Vec2f at = limit ? Vec2f(2 * second.x, 4 * (1 - second.y)) : Vec2f(p.x, p.y);
                // TEXCOORD_0 is (x, 1 - 3 y / 4) at three corners of each triangle.
                most = std::max({most, double(glm::length(second - Vec2f(at.x / 2, 1 - at.y / 4))),
                                 double(std::abs(first.x - at.x)), double(std::abs(first.y - 0.75f * at.y))});
            }
            CHECK(most < 1e-5);
        }
    }

    TEST_CASE("gltf asset: values of a limit surface lie where its uvs that are not smoothed lie") {
        const Folder folder;
        write_file(folder / "a.gltf", bake_tests::replaced(bake_tests::square_text(), R"("TEXCOORD_0":1)",
                                                           R"("TEXCOORD_0":1,"TEXCOORD_1":1)"));
        for (const char* scheme : {"catmark", "loop"}) {
            run_json(folder, {"displace", "a.gltf", "--height", bricks, "--amplitude", "0.01", "--subdivide", scheme,
                              "--levels", "2", "--uv-smoothing", "none", "-o", "b.glb"});
            const Mesh mesh = read_gltf(folder / "b.glb").mesh;
            REQUIRE(mesh.attributes.size() == 1);
            double most = 0;
            for (std::size_t c = 0; c < mesh.corners(); ++c) {
                const float* const second = &mesh.attributes[0].values[2 * c];
                most = std::max(most, double(glm::length(mesh.uvs[mesh.corner_uv[c]] - Vec2f(second[0], second[1]))));
            }
            CHECK(most < 1e-5);
        }
    }

    TEST_CASE("gltf asset: surface --attributes tangent adds tangents and leaves the rest") {
        const Folder folder;
        write_file(folder / "a.gltf", square(R"(,"translation":[3,0,0])"));
        run_json(folder, {"surface", "a.gltf", "--attributes", "tangent", "-o", "b.gltf"});
        const json before = root_of(folder / "a.gltf"), after = root_of(folder / "b.gltf");
        for (const char* same : {"nodes", "scenes", "materials"}) CHECK(after[same] == before[same]);
        const json& attributes = after["meshes"][0]["primitives"][0]["attributes"];
        CHECK(attributes["POSITION"] == 0);
        CHECK(attributes.contains("TANGENT"));
        CHECK(attributes.contains("NORMAL")); // which tangents are told from
        CHECK(after["asset"]["generator"].get<std::string>().rfind("bake ", 0) == 0);
    }

    TEST_CASE("gltf asset: normal-map writes the map into the file, or into a new one with a plain material") {
        const Folder folder;
        write_file(folder / "a.gltf", square(""));
        const auto bake = [&](const std::string& mesh, const std::string& out, std::vector<std::string> more = {}) {
            std::vector<std::string> all = {"normal-map", mesh,     "--height", bricks, "--amplitude",
                                            "1%",         "--size", "32",       "-o",   out};
            all.insert(all.end(), more.begin(), more.end());
            run_json(folder, all);
            return root_of(folder / out);
        };
        json root = bake("a.gltf", "b.glb", {"--depth", "16"});
        CHECK(root["materials"][0]["normalTexture"]["index"] == 0);
        CHECK(root["materials"][0]["doubleSided"] == true);
        CHECK(root["nodes"].size() == 2);
        CHECK(root["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
        const Gltf read = read_gltf(folder / "b.glb");
        REQUIRE(read.images.size() == 1);
        run_json(folder, {"normal-map", "a.gltf", "--height", bricks, "--amplitude", "1%", "--size", "32", "--depth",
                          "16", "-o", "n.png"});
        write_file(folder / "inside.png", std::string(read.images[0].bytes.begin(), read.images[0].bytes.end()));
        const Image<float> inside = read_image(folder / "inside.png"), beside = read_image(folder / "n.png");
        REQUIRE(inside.size() == beside.size());
        CHECK(std::equal(inside.data(), inside.data() + inside.size(), beside.data()));
        root = bake("b.glb", "c.glb"); // the new map takes the place of the old one
        CHECK(root["images"].size() == 1);
        CHECK(root["textures"].size() == 1);
        CHECK(contents(folder / "c.glb").size() < contents(folder / "b.glb").size());

        root = bake((own_meshes() / "torus.obj").string(), "d.gltf");
        CHECK(root["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] == 0);
        CHECK(folder.names().contains("d_normal.png"));
        check_refused(folder, {"normal-map", "a.gltf", "--height", bricks, "-o", "e.glb", "--space", "object"}, 2,
                      "tangent");
        check_refused(folder, {"normal-map", "a.gltf", "--height", bricks, "-o", "e.glb", "--directx"}, 2, "green");
        check_refused(folder, {"normal-map", "a.gltf", "--height", bricks, "-o", "e.glb", "--depth", "float"}, 2,
                      "--depth");
        check_refused(folder, {"normal-map", bricks, "-o", "e.glb"}, 2, "no mesh");
        check_refused(folder, {"normal-map", "a.gltf", "--height", bricks, "-o", "e<UDIM>.glb"}, 2, "picture");
    }

    TEST_CASE("gltf asset: a high-poly bake writes the map and the occlusion") {
        const Folder folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        run_json(folder, {"normal-map", torus, "--high", torus, "--maps", "ambient-occlusion", "--sky-rays", "4",
                          "--size", "32", "-o", "b.glb"});
        const json root = root_of(folder / "b.glb");
        CHECK(root["images"].size() == 2);
        CHECK(root["materials"][0]["normalTexture"]["index"] != root["materials"][0]["occlusionTexture"]["index"]);
        CHECK(folder.names() == std::set<std::string>{"b.glb"});
    }

    TEST_CASE("gltf asset: an image beside the file replaces no file that has nothing to do with it") {
        const Folder folder;
        const std::string one = contents((own_meshes() / "dots.png").string());
        const auto source = [&](const std::string& image) {
            std::string text =
                bake_tests::replaced(square(""), R"("name":"m",)", R"("name":"m","normalTexture":{"index":0},)");
            text = bake_tests::replaced(text, R"("materials":[)",
                                        R"("textures":[{"source":0}],"images":[{"uri":"dots.png"}],"materials":[)");
            fs::create_directories(folder / "in");
            write_file(folder / "in/a.gltf", text);
            write_file(folder / "in/dots.png", image);
        };
        const std::vector<std::string> words = {"surface", "in/a.gltf", "-o", "b.gltf"};
        source(one);
        write_file(folder / "dots.png", "somebody else's");
        check_refused(folder, words, 2, "dots.png: is there already");
        CHECK(contents(folder / "dots.png") == "somebody else's");
        write_file(folder / "dots.png", one); // the same image
        run_json(folder, words);
        const std::string two = contents((own_meshes() / "ripples.png").string());
        source(two);
        run_json(folder, words); // b.gltf is replaced, and the image is its own
        CHECK(contents(folder / "dots.png") == two);
    }
} // cli

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("gltf asset: nothing of the sample files is lost" * doctest::skip(no_shared_data() || no_python())) {
        const Folder folder;
        std::string files;
        std::vector<std::string> samples = {"gltf/NormalTangentTest.glb", "gltf/armor.gltf"};
        // With sanitizers the large ones take a quarter of an hour, and pictures of the same bytes show nothing new.
        if (!sanitized)
            samples.insert(samples.end(),
                           {"leeperrysmith/LeePerrySmith.glb", "materialx/boombox.glb", "materialx/shaderball.glb"});
        for (const std::string& sample : samples) files += "'" + (shared_data() / "meshes" / sample).string() + "' ";
        const bool pictures = !sanitized && !no_viewer();
        CHECK(round_trip(folder, files + checks() + (pictures ? "--pictures" : "")) == "");
    }

    TEST_CASE("gltf asset: three.js shows the seven files as before" *
              doctest::skip(sanitized || no_python() || no_viewer())) {
        const Folder folder;
        CHECK(round_trip(folder, "--pictures") == "");
    }
} // real
