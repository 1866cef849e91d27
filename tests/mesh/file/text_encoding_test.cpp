// OBJ and PLY in other encodings and with other line ends.
#include "mesh/file/mesh_files.h"

using namespace bake;
using namespace bake_tests;

namespace {

const std::string obj =
    "# H\xc3\xbcgel \xf0\x9f\x8f\x94\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 .5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "g gro\xc3\x9f\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// UTF-8 to units of `width` bytes.
std::string encoded(const std::string& text, int width, bool big, bool mark) {
    std::string out;
    const auto put = [&](std::uint32_t unit) {
        for (int k = 0; k < width; ++k) out += char(unit >> 8 * (big ? width - 1 - k : k) & 0xff);
    };
    if (mark) put(0xfeff);
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        std::uint32_t c = lead < 0x80 ? lead : lead < 0xe0 ? lead & 0x1f : lead < 0xf0 ? lead & 0x0f : lead & 0x07;
        for (int more = lead < 0x80 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3; more > 0; --more)
            c = c << 6 | (static_cast<unsigned char>(text[i++]) & 0x3f);
        if (width == 2 && c > 0xffff) {
            put(0xd800 + ((c - 0x10000) >> 10));
            put(0xdc00 + ((c - 0x10000) & 0x3ff));
        } else {
            put(c);
        }
    }
    return out;
}

std::string replaced(std::string text, const std::string& newline) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += newline.size())
        text.replace(at, 1, newline);
    return text;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: OBJ and ascii PLY in UTF-16 and UTF-32, with a byte order mark or without") {
        const Mesh plain = read_text("t.obj", obj), triangle = read_text("t.ply", ply);
        CHECK(plain.groups == std::vector<std::string>{"gro\xc3\x9f"});
        for (const int width : {2, 4})
            for (const bool big : {false, true})
                for (const bool mark : {false, true}) {
                    CHECK(same_mesh(read_text("t.obj", encoded(obj, width, big, mark)), plain));
                    CHECK(same_mesh(read_text("t.ply", encoded(ply, width, big, mark)), triangle));
                    // A file cut within a character is read as far as it goes, or refused.
                    const std::string bytes = encoded(obj, width, big, mark);
                    outcome_of_text("t.obj", bytes.substr(0, bytes.size() - 1));
                }
        CHECK(same_mesh(read_text("t.obj", "\xef\xbb\xbf" + obj), plain));
        CHECK(outcome_of_text("t.obj", encoded("v 1 2\n", 2, false, true)).reason ==
              "t.obj:1: position has 2 numbers and needs 3; complete the line");
    }

    TEST_CASE("read_mesh: lines end in CR, in CR LF or in both kinds") {
        const Mesh plain = read_text("t.obj", obj), triangle = read_text("t.ply", ply);
        for (const char* newline : {"\r", "\r\n", "\r\r\n"}) {
            CHECK(same_mesh(read_text("t.obj", replaced(obj, newline)), plain));
            CHECK(same_mesh(read_text("t.ply", replaced(ply, newline)), triangle));
        }
        const std::size_t half = obj.find("vt 0 0");
        CHECK(same_mesh(read_text("t.obj", replaced(obj.substr(0, half), "\r") + obj.substr(half)), plain));
        CHECK(same_mesh(read_text("t.obj", encoded(replaced(obj, "\r"), 2, true, false)), plain));
        CHECK(outcome_of_text("t.obj", "v 0 0 0\rv 1 0 0\rv 1 x 0\r").reason.rfind("t.obj:3: 'x'", 0) == 0);
    }

    TEST_CASE("read_mesh: a PLY header with CR alone before a binary body") {
        std::string bytes = replaced(ply.substr(0, ply.find("0 0 0")), "\r");
        bytes.replace(bytes.find("ascii"), 5, "binary_little_endian");
        const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        bytes.append(reinterpret_cast<const char*>(values), sizeof values);
        const std::uint32_t index[] = {0, 1, 2};
        bytes += char(3);
        bytes.append(reinterpret_cast<const char*>(index), sizeof index);
        CHECK(same_mesh(read_text("t.ply", bytes), read_text("t.ply", ply)));
    }
}
