// Values of PLY files that no bake uses, and the names of uvs.
#include "mesh/file/mesh_files.h"
#include <cstring>
#include <limits>

using namespace bake;
using namespace bake_tests;

namespace {

/// A triangle with uvs, tangents, a quality and a vector per vertex; `bad` is the last value of the second vertex.
std::string ascii(const std::string& quality, const std::string& tangent) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n";
    for (const char* name : {"x", "y", "z", "s", "t", "tx", "ty", "tz", "tw", "quality", "flow_0", "flow_1"})
        text += std::string("property float ") + name + "\n";
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    text +=
        "0 0 0 0 0 1 0 0 1 .5 1 2\n1 0 0 1 0 1 0 0 " + tangent + " " + quality + " 3 4\n0 1 0 0 1 1 0 0 1 .25 5 6\n";
    return text + "3 0 1 2\n";
}

std::string binary(float quality, float x, bool big) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                        "property double quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto put = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (big) std::reverse(raw, raw + sizeof value);
        bytes.append(raw, sizeof value);
    };
    for (const float f : {0.f, 0.f, 0.f}) put(f);
    put(0.5);
    for (const float f : {x, 0.f, 0.f}) put(f);
    put(double(quality));
    for (const float f : {0.f, 1.f, 0.f}) put(f);
    put(0.25);
    bytes += char(3);
    for (const std::int32_t i : {0, 1, 2}) put(i);
    return bytes;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: a PLY property that is not finite and in no bake is left out with a note") {
        const Mesh whole = read_text("t.ply", ascii("1", "1"));
        CHECK(whole.attributes.size() == 2);
        CHECK(whole.tangents.size() == 3);
        CHECK(whole.notes.empty());
        for (const char* bad :
             {"nan", "-nan", "NaN", "inf", "-inf", "-nan(ind)", "1.#QNAN", "-1.#IND00", "1.#INF", "1e99"}) {
            const Mesh mesh = read_text("t.ply", ascii(bad, "1"));
            REQUIRE(mesh.attributes.size() == 1);
            CHECK(mesh.attributes[0].name == "flow");
            CHECK(mesh.attributes[0].values == whole.attributes[1].values);
            CHECK(mesh.tangents == whole.tangents);
            CHECK(mesh.uvs == whole.uvs);
            CHECK(mesh.notes ==
                  std::vector<std::string>{"property 'quality' left out: some values are not finite 32-bit numbers"});
        }
        const Mesh mesh = read_text("t.ply", ascii("1", "nan"));
        CHECK(mesh.tangents.empty());
        CHECK(mesh.attributes.size() == 2);
        CHECK(outcome_of_text("t.ply", ascii("foo", "1")).reason.find("'foo' is not a number") != std::string::npos);
    }

    TEST_CASE("read_mesh: the same for binary PLY, where a bad position is refused as before") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const bool big : {false, true}) {
            CHECK(read_text("t.ply", binary(1, 1, big)).attributes.size() == 1);
            const Mesh mesh = read_text("t.ply", binary(nan, 1, big));
            CHECK(mesh.attributes.empty());
            CHECK(mesh.notes.size() == 1);
            CHECK(mesh.faces() == 1);
            CHECK(outcome_of_text("t.ply", binary(1, nan, big)).code == int(Refusal::unreadable));
        }
    }

    TEST_CASE("read_mesh: PLY uvs by all of their names, the usual ones first") {
        for (const auto& [u, v] : {std::pair{"u1", "v1"},
                                   {"texture_s", "texture_t"},
                                   {"texcoord_u", "texcoord_v"},
                                   {"tex_u", "tex_v"},
                                   {"tx", "ty"},
                                   {"U", "V"}}) {
            std::string text =
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
            for (const std::string name : {u, v}) text += "property float " + name + "\n";
            const std::string rest = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
            const Mesh mesh = read_text("t.ply", text + rest + "0 0 0 0 0\n1 0 0 .5 0\n0 1 0 0 .25\n3 0 1 2\n");
            CHECK(mesh.uvs == std::vector<Vec2f>{{0, 0}, {.5f, 0}, {0, .25f}});
            CHECK(mesh.attributes.empty());
        }
        const Mesh both =
            read_text("t.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty float u1\nproperty float v1\nproperty float u\n"
                               "property float v\nelement face 1\nproperty list uchar int vertex_indices\n"
                               "end_header\n0 0 0 9 9 0 0\n1 0 0 9 9 1 0\n0 1 0 9 9 0 1\n3 0 1 2\n");
        CHECK(both.uvs == std::vector<Vec2f>{{0, 0}, {1, 0}, {0, 1}});
        CHECK(both.attributes.size() == 2);
    }
}
