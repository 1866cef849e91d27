#include "mesh/file/mesh_files.h"
#include <algorithm>
#include <bit>
#include <cstring>

namespace {
using namespace bake;
using namespace bake_tests;
using Indices = std::vector<std::uint32_t>;

std::string refusal(const std::string& bytes) { return outcome_of_text("t.ply", bytes).reason; }

/// Binary PLY bytes, value by value.
struct Bytes {
    bool big;
    std::string bytes;
    template <class T> Bytes& operator<<(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
        bytes.append(raw, sizeof(T));
        return *this;
    }
};

const std::string ascii_square =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ascii_points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: ascii PLY, with CRLF, blank lines, comments and other elements between") {
        const Mesh mesh = read_text("t.ply", ascii_square + ascii_points + "3 0 1 2\n3 0 2 3\n");
        CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(mesh.face_begin == Indices{0, 3, 6});
        CHECK(mesh.corner_position == Indices{0, 1, 2, 0, 2, 3});
        const Mesh other = read_text(
            "t.ply",
            "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info none\r\n"
            "element camera 2\r\nproperty list int float view\r\nproperty int8 kind\r\nelement void 9\r\n"
            "element vertex 4\r\nproperty double z\r\nproperty uint8 red\r\nproperty int16 x\r\nproperty float32 y\r\n"
            "element face 2\r\nproperty int8 flag\r\nproperty list uint16 uint8 vertex_index\r\nend_header\r\n"
            "2 1.5 2.5 1\r\n\r\n0 1\r\n0 255 0 0\r\n0 0 1 0\r\n0 0 1 1\r\n0 0 0 1\r\n1 3 0 1 2\r\n1 3 0 2 3");
        CHECK(same_mesh(mesh, other));
    }

    TEST_CASE("read_mesh: every scalar type, list count and byte order of binary PLY gives the same mesh") {
        const Mesh expected = read_text("t.ply", ascii_square + ascii_points + "3 0 1 2\n3 0 2 3\n");
        const auto file = [](bool big, const std::string& number, const std::string& count, const std::string& index,
                             auto n, auto c, auto i) {
            Bytes out{big, {}};
            out.bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 4\nproperty uchar red\n" + "property " + number + " x\nproperty " +
                        number + " y\nproperty " + number + " z\nelement extra 2\n" + "property list " + count +
                        " double ignored\nelement face 2\nproperty short flag\nproperty list " + count + " " + index +
                        " vertex_indices\nproperty list " + count + " float more\nproperty double weight\nend_header\n";
            using N = decltype(n);
            using C = decltype(c);
            using I = decltype(i);
            for (const auto& p : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(1, 1, 0), Vec3f(0, 1, 0)})
                out << std::uint8_t(9) << N(p.x) << N(p.y) << N(p.z);
            out << C(2) << 1.0 << 2.0 << C(0);
            out << short(1) << C(3) << I(0) << I(1) << I(2) << C(1) << 5.0f << 2.0;
            out << short(1) << C(3) << I(0) << I(2) << I(3) << C(0) << 2.0;
            return out.bytes;
        };
        for (const bool big : {false, true}) {
            CHECK(same_mesh(expected, read_text("t.ply", file(big, "float", "uchar", "int", 0.f, std::uint8_t(), 0))));
            CHECK(same_mesh(expected, read_text("t.ply", file(big, "double", "char", "uint", 0., std::int8_t(), 0u))));
            CHECK(same_mesh(expected, read_text("t.ply", file(big, "int8", "uint16", "uint8", std::int8_t(),
                                                              std::uint16_t(), std::uint8_t()))));
            CHECK(same_mesh(expected, read_text("t.ply", file(big, "uint16", "short", "int8", std::uint16_t(),
                                                              std::int16_t(), std::int8_t()))));
            CHECK(
                same_mesh(expected, read_text("t.ply", file(big, "int32", "int32", "uint16", 0, 0, std::uint16_t()))));
            CHECK(same_mesh(expected, read_text("t.ply", file(big, "uint", "uint", "short", 0u, 0u, std::int16_t()))));
        }
    }

    TEST_CASE("read_mesh: vertices with lists among their properties") {
        Bytes out{
            false,
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty list uchar int bones\n"
            "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"};
        out << 0.f << std::uint8_t(2) << 7 << 8 << 0.f << 0.f << 1.f << std::uint8_t(0) << 0.f << 0.5f << 0.f
            << std::uint8_t(1) << 7 << 1.f << 0.f;
        out << std::uint8_t(3) << 0 << 1 << 2;
        CHECK(read_text("t.ply", out.bytes).positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0.5f}, {0, 1, 0}});
    }

    TEST_CASE("read_mesh: PLY normals and uvs per vertex, by any of their names") {
        for (const auto& [u, v] : {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}) {
            const Mesh mesh = read_text(
                "t.ply",
                std::string(
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                    "property float nx\nproperty float ny\nproperty float nz\nproperty float ") +
                    u + "\nproperty float " + v +
                    "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                    "0 0 0 0 0 1 .25 .5\n1 0 0 0 1 0 1 0\n0 1 0 1 0 0 0 1\n3 2 0 1\n");
            CHECK(mesh.uvs == std::vector<Vec2f>{{0.25f, 0.5f}, {1, 0}, {0, 1}});
            CHECK(mesh.normals == std::vector<Vec3f>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
            CHECK(mesh.corner_uv == Indices{2, 0, 1});
            CHECK(mesh.corner_normal == Indices{2, 0, 1});
        }
    }

    TEST_CASE("read_mesh: PLY texcoord lists give uvs per corner, shared where position and uv are equal") {
        const std::string header = ascii_square.substr(0, ascii_square.find("end_header")) +
                                   "property list uchar float texcoord\nend_header\n";
        const Mesh mesh =
            read_text("t.ply", header + ascii_points + "3 0 1 2 6 0 0 1 0 1 0\n3 0 2 3 6 .5 0 1 -0.0 0 1\n");
        REQUIRE(mesh.corner_uv.size() == 6);
        CHECK(mesh.uvs.size() == 5);
        CHECK(mesh.corner_uv[2] == mesh.corner_uv[4]); // the same point with the same uv, -0 being 0
        CHECK(mesh.corner_uv[0] != mesh.corner_uv[3]); // a seam
        CHECK(mesh.uvs[mesh.corner_uv[3]] == Vec2f(0.5f, 0));
        const Mesh half = read_text("t.ply", header + ascii_points + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n");
        CHECK(half.corner_uv[3] == no_index);

        std::string binary = header;
        binary.replace(binary.find("ascii"), 5, "binary_big_endian");
        Bytes out{true, binary};
        for (const float f : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) out << f;
        out << std::uint8_t(3) << 0 << 1 << 2 << std::uint8_t(6) << 0.f << 0.f << 1.f << 0.f << 1.f << 0.f;
        out << std::uint8_t(3) << 0 << 2 << 3 << std::uint8_t(6) << .5f << 0.f << 1.f << -0.f << 0.f << 1.f;
        CHECK(same_mesh(read_text("t.ply", out.bytes), mesh));
    }

    TEST_CASE("read_mesh: refuses a wrong PLY with its line or row") {
        const auto has = [](const std::string& bytes, const std::string& part) {
            const std::string reason = refusal(bytes);
            CHECK_MESSAGE(reason.find(part) != std::string::npos, reason);
        };
        has("", "t.ply:1: an empty file");
        has("plyx\n", "t.ply:1: does not begin with 'ply'");
        has("ply\nformat ascii 2.0\n", "t.ply:2: not format");
        has("ply\nformat ascii 1.0\nelement vertex -4\n", "t.ply:3: an element needs");
        has("ply\nformat ascii 1.0\nelement vertex 4\nproperty real x\n", "t.ply:4: 'real' is not a PLY type");
        has("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n", "t.ply:4: the header has no end_header");
        has(ascii_square.substr(0, 60) + "\nfoo\nend_header\n", "is not a word of a PLY header");
        has(ascii_square + ascii_points + "3 0 1 2\n", "t.ply:15: the file ends after 1 of 2 rows of 'face'");
        has(ascii_square + ascii_points + "3 0 1 4\n3 0 2 3\n", "t.ply:14: index 4 of 4 vertices");
        has(ascii_square + ascii_points + "3 0 1 -1\n3 0 2 3\n", "t.ply:14: index -1");
        has(ascii_square + ascii_points + "3 0 1 2\n2 0 2\n", "t.ply:15: face of 2 corners");
        has(ascii_square + ascii_points + "3 0 1\n3 0 2 3\n", "t.ply:14: the line ends before");
        has(ascii_square + ascii_points + "3 0 1 2 9\n3 0 2 3\n", "t.ply:14: '9' is more than");
        has(ascii_square + ascii_points + "3 0 1.0 2\n3 0 2 3\n", "t.ply:14: '1.0' is not an integer");
        has(ascii_square + "0 0 0\n1 inf 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n", "t.ply:11: 'inf' is not a finite");
        std::string no_z = ascii_square;
        no_z.erase(no_z.find("property float z\n"), 17);
        has(no_z + "0 0\n1 0\n1 1\n0 1\n3 0 1 2\n3 0 2 3\n", "no x, y and z");

        std::string header = ascii_square;
        header.replace(header.find("ascii"), 5, "binary_little_endian");
        Bytes good{false, header};
        for (const float f : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) good << f;
        good << std::uint8_t(3) << 0 << 1 << 2 << std::uint8_t(3) << 0 << 2 << 3;
        REQUIRE(refusal(good.bytes) == "read");
        const auto changed = [&](std::size_t offset, auto value) {
            std::string bytes = good.bytes;
            std::memcpy(&bytes[header.size() + offset], &value, sizeof value);
            return bytes;
        };
        has(changed(16, std::bit_cast<float>(0x7fc00000u)), "vertex 1 (of 0 to 3) has a value that is not a finite");
        has(changed(49, 4), "face 0 has an index outside its 4 vertices");
        has(changed(62, -1), "face 1 has an index outside its 4 vertices");
        has(changed(48, std::uint8_t(2)), "face"); // every later row shifts
        has(changed(61, std::uint8_t(255)), "row 1 of 2 of 'face'");
        Bytes two{false, good.bytes.substr(0, header.size() + 48)};
        two << std::uint8_t(3) << 0 << 1 << 2 << std::uint8_t(2) << 0 << 2;
        has(two.bytes, "face 1 has 2 corners");
        has(good.bytes.substr(0, good.bytes.size() - 1), "row 1 of 2 of 'face'");
    }

    TEST_CASE("read_mesh: counts that a PLY cannot hold are refused at once") {
        for (const char* count : {"5", "4294967295", "99999999999999999999"}) {
            std::string text = ascii_square;
            text.replace(text.find("vertex 4"), 8, std::string("vertex ") + count);
            CHECK(outcome_of_text("t.ply", text + "0 0 0\n").code == 3);
        }
        std::string faces = ascii_square;
        faces.replace(faces.find("face 2"), 6, "face 4000000000");
        CHECK(refusal(faces + ascii_points + "3 0 1 2\n").find("4000000000 rows of 'face'") != std::string::npos);
        CHECK(refusal("ply\nformat ascii 1.0\nelement nothing 999999999999999999\nend_header\n").find("no vertices") !=
              std::string::npos);
    }

    TEST_CASE("write_mesh: a PLY has one vertex per distinct corner and the same values at every corner") {
        const Mesh mesh =
            read_text("t.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
                               "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/2/1 4/3/1\n");
        const TemporaryFolder folder;
        write_mesh(folder.file("a.ply"), mesh);
        const Mesh back = read_mesh(folder.file("a.ply"));
        CHECK(same_corners(mesh, back));
        CHECK(back.positions.size() == 5); // 3 twice, by its uvs; the unused position is dropped
    }

    TEST_CASE(
        "read_mesh: floats of vertices by names of their own are attributes, tx ty tz tw tangents, integers neither") {
        const std::string header =
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float quality\nproperty float x\nproperty float y\n"
            "property float z\nproperty uchar red\nproperty float tx\nproperty float ty\nproperty float tz\nproperty "
            "float tw\n"
            "property double flow_0\nproperty double flow_1\nproperty float lone_0\nproperty list uchar float weights\n"
            "property float nx\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        const Mesh mesh =
            read_text("t.ply", header + "7 0 0 0 255 1 0 0 1 .5 .25 3 1 9 0\n8 1 0 0 255 0 1 0 -1 1 2 4 0 0\n"
                                        "9 0 1 0 255 0 0 1 1 0 0 5 2 1 1 1\n3 2 0 1\n");
        CHECK(mesh.tangents == std::vector<Vec4f>{{0, 0, 1, 1}, {1, 0, 0, 1}, {0, 1, 0, -1}});
        REQUIRE(mesh.attributes.size() == 4);
        const auto is = [&](std::size_t i, const std::string& name, int components, const std::vector<float>& values) {
            CHECK(mesh.attributes[i].name == name);
            CHECK(mesh.attributes[i].components == components);
            CHECK(mesh.attributes[i].values == values);
        };
        is(0, "quality", 1, {9, 7, 8}); // per corner, in the order of the face
        is(1, "flow", 2, {0, 0, .5f, .25f, 1, 2});
        is(2, "lone_0", 1, {5, 3, 4});
        is(3, "nx", 1, {1, 0, 0}); // no normal without ny and nz
        const std::string row = "7 0 0 0 255 1 0 0 1 nan .25 3 1 9 0\n";
        const Mesh without = read_text("t.ply", header + row + row + row + "3 0 1 2\n");
        REQUIRE(without.attributes.size() == 3); // flow is left out
        CHECK(without.attributes[1].name == "lone_0");
        CHECK(without.notes.size() == 1);
    }

    TEST_CASE("write_mesh: a PLY keeps tangents and attributes, whose seams split its vertices") {
        Mesh mesh = read_text("t.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
        mesh.tangents.assign(6, Vec4f(1, 0, 0, 1));
        mesh.attributes = {{"mean_curvature", 1, {1, 2, 3, 1, 3, 4}}, {"x", 3, std::vector<float>(18, 0.5f)}};
        const TemporaryFolder folder;
        write_mesh(folder.file("a.ply"), mesh);
        Mesh back = read_mesh(folder.file("a.ply"));
        CHECK(back.positions.size() == 4);
        REQUIRE(back.attributes.size() == 2);
        CHECK(back.attributes[1].name == "_x"); // x is taken
        back.attributes[1].name = "x";
        CHECK(same_mesh(back, mesh));

        mesh.tangents[3].w = -1; // a mirrored seam through the first position
        mesh.attributes[0].values[4] = 5;
        write_mesh(folder.file("a.ply"), mesh);
        back = read_mesh(folder.file("a.ply"));
        CHECK(back.positions.size() == 6);
        CHECK(same_corners(back, mesh));
        CHECK(back.tangents == mesh.tangents);
        CHECK(back.attributes[0].values == mesh.attributes[0].values);
    }

    TEST_CASE("write_mesh: a PLY of a face with more than 255 corners reads back") {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
        for (int i = 0; i < 300; ++i) text += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
        const Mesh mesh = read_text("t.obj", text);
        const TemporaryFolder folder;
        write_mesh(folder.file("a.ply"), mesh);
        CHECK(same_mesh(read_mesh(folder.file("a.ply")), mesh));
    }
} // unit
