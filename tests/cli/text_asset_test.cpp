// Baked materials as text: normal-map -o asset.usda and -o asset.mtlx.
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/triangulate.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "mesh/gltf/gltf_files.h"
#include <charconv>
#include <nlohmann/json.hpp>

namespace {

using namespace bake;
using namespace bake::test;
using bake_tests::replaced;
using nlohmann::json;

const std::string bricks = (own_meshes() / "bricks.png").string();

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
}

/// Bakes a map of 32 texels into `out`, and returns what the command reports.
json bake_to(const Folder& folder, const std::string& mesh, const std::string& out,
             const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"normal-map", mesh, "--height", bricks, "--amplitude", "1%",
                                      "--size",     "32", "-o",       out,    "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Run run = run_bake(folder, words, {.seconds = 60});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return json::parse(run.out);
}

/// The numbers of `<name> = [...]` of the first such line.
std::vector<float> numbers(const std::string& text, const std::string& name) {
    const std::size_t at = text.find(name + " = [");
    REQUIRE_MESSAGE(at != std::string::npos, name);
    const char* p = text.data() + at + name.size() + 4;
    const char* const end = text.data() + text.find(']', at + name.size());
    std::vector<float> out;
    while (p < end) {
        float value = 0;
        const auto [next, error] = std::from_chars(p, end, value);
        if (error == std::errc()) out.push_back(value), p = next;
        else ++p;
    }
    return out;
}

/// A square of two triangles with this material, whose textures are `red` and lie on TEXCOORD_0 unless it says otherwise.
void write_square(const Folder& folder, const std::string& material, const std::string& more = "") {
    write_image(folder / "red.png", Image<float>(2, 2, 3), {.depth = Depth::u8});
    std::string text = bake_tests::square_text();
    text = replaced(text, "\"indices\":2}", "\"indices\":2,\"material\":0}");
    text = replaced(text, R"("nodes":[)",
                    R"("images":[{"uri":"red.png"}],"textures":[{"source":0}],"materials":[)" + material + "]," + more +
                        R"("nodes":[)");
    write_file(folder / "a.gltf", text);
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("text asset: .usda has the numbers of the .glb, and the same map beside it") {
        const Folder folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        bake_to(folder, torus, "a.glb");
        const json report = bake_to(folder, torus, "a.usda");
        CHECK(report["outputs"] == json::array({"a_normal.png", "a.usda"}));
        CHECK(folder.names() == std::set<std::string>{"a.glb", "a.usda", "a_normal.png"});
        const Gltf glb = read_gltf(folder / "a.glb");
        const std::string usda = contents(folder / "a.usda");
        CHECK(usda.starts_with("#usda 1.0\n(\n"));
        const std::vector<float> points = numbers(usda, "point3f[] points"), normals = numbers(usda, "normals"),
                                 st = numbers(usda, "primvars:st"), corners = numbers(usda, "faceVertexIndices"),
                                 uv_of = numbers(usda, "primvars:st:indices");
        REQUIRE(corners.size() == glb.mesh.corners());
        CHECK(numbers(usda, "faceVertexCounts") == std::vector<float>(corners.size() / 3, 3));
        CHECK(has(usda, "interpolation = \"vertex\"")); // one normal at each point
        REQUIRE(normals.size() == points.size());
        const Mesh& mesh = glb.mesh;
        float uv = 0;
        bool same = true;
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const auto p = 3 * std::size_t(corners[c]), t = 2 * std::size_t(uv_of[c]);
            same = same && mesh.positions[mesh.corner_position[c]] == Vec3f(points[p], points[p + 1], points[p + 2]) &&
                   mesh.normals[mesh.corner_normal[c]] == Vec3f(normals[p], normals[p + 1], normals[p + 2]);
            uv = std::max(uv, glm::length(mesh.uvs[mesh.corner_uv[c]] - Vec2f(st[t], st[t + 1])));
        }
        CHECK(same);
        CHECK(uv < 1e-6f); // glTF turns v
        const Image<float> beside = read_image(folder / "a_normal.png");
        write_file(folder / "inside.png", {glb.images[0].bytes.begin(), glb.images[0].bytes.end()});
        const Image<float> inside = read_image(folder / "inside.png");
        REQUIRE(beside.size() == inside.size());
        CHECK(std::equal(beside.data(), beside.data() + beside.size(), inside.data()));
    }

    TEST_CASE(
        "text asset: a texture of normals is 2 rgb - 1, raw, and its scale is hidden from those who would double it") {
        const Folder folder;
        bake_to(folder, (own_meshes() / "torus.obj").string(), "a.usda");
        const std::string usda = contents(folder / "a.usda");
        CHECK(has(usda, "normal3f inputs:normal.connect = </asset/Materials/baked/normal.outputs:rgb>"));
        CHECK(has(usda, "\n                custom float4 inputs:scale = (2, 2, 2, 1)\n"));
        CHECK(has(usda, "\n                custom float4 inputs:bias = (-1, -1, -1, 0)\n"));
        CHECK(has(usda, "asset inputs:file = @./a_normal.png@"));
        CHECK(has(usda, "sourceColorSpace = \"raw\""));
        CHECK(has(usda, "upAxis = \"Y\""));
        CHECK(has(usda, "metersPerUnit = 1\n"));
        CHECK(has(usda, "subdivisionScheme = \"none\""));
        bake_to(folder, (own_meshes() / "torus.obj").string(), "b.usda", {"--depth", "16"});
        CHECK(read_image_info(folder / "a_normal.png").bits == 8);
        CHECK(read_image_info(folder / "b_normal.png").bits == 16);
        for (const std::string out : {"a.usda", "a.mtlx"}) {
            const Folder one, two;
            bake_to(one, (own_meshes() / "torus.obj").string(), out, {"--threads", "1"});
            bake_to(two, (own_meshes() / "torus.obj").string(), out, {"--threads", "2"});
            CHECK(contents(one / out) == contents(two / out));
        }
    }

    TEST_CASE("text asset: corners with normals of their own, several materials and odd names") {
        const Folder folder;
        write_file(folder / "cube [a--b.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nv 9 9 9\nvt 0 0\nvt .4 0\nvt .4 1\nvt 0 1\n"
                   "vt .5 0\nvt .9 0\nvt .9 1\nvt .5 1\nvn 0 0 2\nvn 1 0 0\nusemtl 2 <red> \"x\"\n"
                   "f 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl __red___x_\nf 2/5/2 5/6/2 6/7/2 3/8/2\n");
        bake_to(folder, "cube [a--b.obj", "a.usda");
        std::string text = contents(folder / "a.usda");
        CHECK(has(text, "interpolation = \"faceVarying\"\n        )\n        point3f[]"));
        CHECK(numbers(text, "point3f[] points").size() == 3 * 6); // one is used by no face
        CHECK(numbers(text, "normals") == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1,
                                                             1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
        CHECK(count(text, "def GeomSubset") == 2);
        CHECK(has(text, "def Material \"_2__red___x_\" (\n            displayName = \"2 <red> \\\"x\\\"\"\n"));
        CHECK(has(text, "rel material:binding = </asset/Materials/__red___x_>"));
        CHECK(has(text, "familyType = \"partition\""));
        CHECK(has(text, "cube \\x5ba--b.obj")); // USDLoader would look for the other bracket on the next lines
        bake_to(folder, "cube [a--b.obj", "a.mtlx");
        text = contents(folder / "a.mtlx");
        CHECK(count(text, "<surfacematerial ") == 2);
        CHECK(has(text, "name=\"_2__red___x_\" type=\"material\" doc=\"2 &lt;red&gt; &quot;x&quot;\""));
        CHECK(count(text, "--") == 2); // of the comment itself
        for (const char* file : {"a.usda", "a.mtlx"}) {
            const Run check = run_bake(folder, {"check", "--json", "--strict", file});
            REQUIRE_MESSAGE(check.code == 0, check.err);
            const json object = json::parse(check.out)["files"][0];
            CHECK(object["materials"] == 2);
            CHECK(object["pictures"] == json::array({"a_normal.png"}));
            CHECK(object["record"]["options"]["input"] == "cube [a--b.obj");
        }
        fs::remove(folder / "a_normal.png");
        const Run missing = run_bake(folder, {"check", "--strict", "a.usda"});
        CHECK(missing.code == 1);
        CHECK(has(missing.out, "the picture a_normal.png is missing"));
    }

    TEST_CASE("text asset: what a material of glTF has and both formats know") {
        const Folder folder;
        write_square(folder,
                     R"({"name":"m","doubleSided":true,"alphaMode":"BLEND","emissiveFactor":[1,0.5,0],)"
                     R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,0.25],"baseColorTexture":{"index":0},)"
                     R"("metallicFactor":0.5,"metallicRoughnessTexture":{"index":0}},)"
                     R"("occlusionTexture":{"index":0,"strength":0.75},"emissiveTexture":{"index":0,"texCoord":1},)"
                     R"("extensions":{"KHR_materials_sheen":{}}})",
                     R"("animations":[],"cameras":[{"type":"orthographic","orthographic":)"
                     R"({"xmag":1,"ymag":1,"zfar":1,"znear":0}}],)");
        const json report = bake_to(folder, "a.gltf", "b.usda");
        const std::string notes = report["notes"].dump();
        CHECK(has(notes, "KHR_materials_sheen"));
        CHECK(has(notes, "the emissive texture (it lies on other uvs than the map)"));
        CHECK(has(notes, "not kept in .usda: animations, cameras"));
        const std::string usda = contents(folder / "b.usda");
        CHECK(has(usda, "uniform bool doubleSided = 1"));
        CHECK(has(usda, "color3f inputs:diffuseColor.connect = </asset/Materials/m/base_color.outputs:rgb>"));
        CHECK(has(usda, "float inputs:opacity.connect = </asset/Materials/m/base_color.outputs:a>"));
        CHECK(has(usda, "float4 inputs:scale = (0.5, 1, 1, 0.25)"));
        CHECK(has(usda, "float4 inputs:scale = (1, 1, 0.5, 1)"));
        CHECK(has(usda, "color3f inputs:emissiveColor = (1, 0.5, 0)"));
        CHECK(has(usda, "float4 inputs:bias = (0.25, 0.25, 0.25, 0)"));
        CHECK(folder.names().contains("b_image0.png"));
        CHECK(contents(folder / "b_image0.png") == contents(folder / "red.png"));

        const json other = bake_to(folder, "a.gltf", "c.mtlx");
        CHECK(has(other["notes"].dump(), "occlusion"));
        const std::string mtlx = contents(folder / "c.mtlx");
        CHECK(has(mtlx, "<input name=\"in2\" type=\"color3\" value=\"0.5, 1, 1\" />"));
        CHECK(has(mtlx, "<input name=\"in2\" type=\"float\" value=\"0.5\" />"));
        CHECK(has(mtlx, "value=\"c_image0.png\" colorspace=\"srgb_texture\""));
        CHECK(has(mtlx, "value=\"c_normal.png\" colorspace=\"lin_rec709\""));
        CHECK(has(mtlx, "<input name=\"normal\" type=\"vector3\" nodegraph=\"m_graph\" output=\"normal_out\" />"));
    }

    TEST_CASE("text asset: the uvs are those of the map") {
        const Folder folder;
        write_square(folder,
                     R"({"normalTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}},)"
                     R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                     R"("extensionsUsed":["KHR_texture_transform"],)");
        const json report = bake_to(folder, "a.gltf", "b.usda");
        CHECK(has(report["notes"].dump(), "the base colour texture (it lies on other uvs than the map)"));
        CHECK(numbers(contents(folder / "b.usda"), "primvars:st")[0] == 0.5f);
        check_refused(folder, {"normal-map", "a.gltf", "--height", bricks, "--size", "32", "-o", "c.mtlx"}, 4,
                      "KHR_texture_transform");
        write_file(folder / "two.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "property float u\nproperty float v\nproperty float TEXCOORD_1_0\nproperty float TEXCOORD_1_1\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 0 0 0 0\n1 0 0 1 0 .5 0\n0 1 0 0 1 0 .5\n3 0 1 2\n");
        bake_to(folder, "two.ply", "d.mtlx", {"--uv-set", "1"});
        CHECK(has(contents(folder / "d.mtlx"), "<input name=\"index\" type=\"integer\" value=\"1\" />"));
        CHECK(has(contents(folder / "d.mtlx"), "<input name=\"texcoord\" type=\"vector2\" nodename=\"uv\" />"));
    }

    TEST_CASE("text asset: the occlusion of a high-poly bake") {
        const Folder folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        const auto bake = [&](const std::string& out) {
            const Run run = run_bake(folder, {"normal-map", torus, "--high", torus, "--maps", "ambient-occlusion",
                                              "--sky-rays", "4", "--size", "32", "-o", out});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            CHECK(folder.names().contains(out.substr(0, 1) + "_occlusion.png"));
            return run.err;
        };
        bake("a.usda");
        CHECK(has(contents(folder / "a.usda"),
                  "float inputs:occlusion.connect = </asset/Materials/baked/occlusion.outputs:r>"));
        CHECK(has(bake("b.mtlx"), "no input for occlusion"));
    }

    TEST_CASE("text asset: its pictures replace those of an asset of its name alone") {
        const Folder folder;
        const auto bake = [&](const std::string& out, const std::string& amplitude) {
            return run_bake(folder, {"normal-map", (own_meshes() / "torus.obj").string(), "--height",
                                     (own_meshes() / "dots.png").string(), "--size", "16", "--amplitude", amplitude,
                                     "-o", out});
        };
        for (const std::string ending : {".usda", ".mtlx"}) {
            write_file(folder / "stranger_normal.png", "mine");
            const Run run = bake("stranger" + ending, "1%");
            CHECK(run.code == 2);
            CHECK(run.err.find("stranger_normal.png: is there already") != std::string::npos);
            CHECK(contents(folder / "stranger_normal.png") == "mine");
            CHECK(!fs::exists(folder / ("stranger" + ending)));
            const std::string own = "own" + ending.substr(1);
            CHECK(bake(own + ending, "1%").code == 0);
            const std::string before = contents(folder / (own + "_normal.png"));
            CHECK(bake(own + ending, "2%").code == 0);
            CHECK(contents(folder / (own + "_normal.png")) != before);
        }
        CHECK(bake("a\nb.mtlx", "1%").code == 2);
    }

    TEST_CASE("text asset: what has no place in USD and MaterialX is refused, with no file left") {
        const Folder folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        for (const std::string out : {"a.usda", "a.mtlx"}) {
            const auto refused = [&](const std::vector<std::string>& more, const std::string& word) {
                std::vector<std::string> all = {"normal-map", torus, "--height", bricks, "-o", out};
                all.insert(all.end(), more.begin(), more.end());
                check_refused(folder, all, 2, word);
            };
            refused({"--directx"}, "green");
            refused({"--space", "object"}, "tangent space");
            refused({"--depth", "float"}, "--depth");
            refused({"--skip-mips", "1"}, "--skip-mips");
            refused({"--tile", "1002"}, "picture");
            check_refused(folder, {"normal-map", bricks, "-o", out}, 2, "no mesh");
        }
        check_refused(folder, {"normal-map", torus, "--height", bricks, "-o", "a@2.usda", "--size", "8"}, 2, "'@'");
        check_refused(folder, {"normal-map", torus, "--height", bricks, "-o", "a.mtlx", "--flip-v"}, 2, "--flip-v");
        write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        check_refused(folder, {"normal-map", "bare.obj", "--height", bricks, "-o", "a.usda"}, 4, "uv");
        write_file(folder / "text.usda", "PXR-USDC");
        CHECK(run_bake(folder, {"check", "text.usda"}).code == 3);
    }
} // cli
