#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/chart/tangent_space.h"
#include "folders.h"
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>

using namespace bake;

namespace {

struct Corners {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<std::uint32_t> face_begin{0};

    void add(const Vec3f& p, const Vec2f& uv, const Vec3f& n = {0, 0, 1}) {
        positions.push_back(p);
        normals.push_back(n);
        uvs.push_back(uv);
    }
    void close() { face_begin.push_back(std::uint32_t(positions.size())); }
    std::vector<Vec4f> tangents() const { return corner_tangents(positions, normals, uvs, face_begin); }
};

// A face whose uv is its x and y.
Corners& flat_face(Corners& mesh, std::initializer_list<Vec2f> points) {
    for (const Vec2f& p : points) mesh.add({p, 0}, p);
    mesh.close();
    return mesh;
}

// A bumpy sheet of quads with uneven uvs, the last columns mirrored; some uvs lose their area.
Corners sheet(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> jitter(-0.3f, 0.3f);
    std::vector<Vec3f> p, normal;
    std::vector<Vec2f> uv;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            p.emplace_back(float(i) + jitter(random), float(j) + jitter(random), jitter(random));
            normal.push_back(glm::normalize(Vec3f(jitter(random), jitter(random), 1)));
            const float u = float(i < n * 3 / 4 ? i : n * 3 / 2 - i) + jitter(random);
            uv.push_back(jitter(random) > 0.29f ? Vec2f(0.5f) : Vec2f(u, float(j) + jitter(random)));
        }
    Corners mesh;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int at = j * (n + 1) + i;
            for (const int k : {at, at + 1, at + n + 2, at + n + 1}) mesh.add(p[k], uv[k], normal[k]);
            mesh.close();
        }
    return mesh;
}

// Picks corners of a mesh as triangles.
Corners picked(const Corners& mesh, const std::vector<std::uint32_t>& corners) {
    Corners out;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        out.add(mesh.positions[corners[k]], mesh.uvs[corners[k]], mesh.normals[corners[k]]);
        if (k % 3 == 2) out.close();
    }
    return out;
}

double difference(const Vec4f& a, const Vec4f& b) { return glm::length(Vec4<double>(a) - Vec4<double>(b)); }

bool all_unit(const std::vector<Vec4f>& tangents) {
    for (const Vec4f& t : tangents)
        if (!(std::abs(glm::length(Vec3f(t)) - 1) < 1e-5f) || std::abs(t.w) != 1) return false;
    return true;
}

/// Compares ours with the reference tangents of every .f32 file of a folder (tests/data/mikktspace/README.md has the
/// format); returns the number of files.
int check_reference(const std::filesystem::path& folder) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".f32") continue;
        ++files;
        std::ifstream in(entry.path(), std::ios::binary);
        Corners mesh;
        std::vector<Vec4f> reference;
        float c[12];
        while (in.read(reinterpret_cast<char*>(c), sizeof c)) {
            mesh.add({c[0], c[1], c[2]}, {c[6], c[7]}, {c[3], c[4], c[5]});
            reference.emplace_back(c[8], c[9], c[10], c[11]);
            if (mesh.positions.size() % 3 == 0) mesh.close();
        }
        REQUIRE(reference.size() >= 36);
        const auto tangents = mesh.tangents();
        double worst = 0;
        int signs = 0;
        for (std::size_t k = 0; k < reference.size(); ++k) {
            // Where the sum of a corner is 0 the reference gives no tangent, ours is that of a vertex without one.
            const Vec3d expected = Vec3f(reference[k]) == Vec3f(0) ? Vec3d(1, 0, 0) : Vec3d(reference[k]);
            worst = std::max(worst, glm::length(Vec3d(tangents[k]) - expected));
            signs += tangents[k].w != reference[k].w;
        }
        const std::string name = entry.path().filename().string();
        CHECK_MESSAGE(worst <= 1e-5, name << ": largest difference of a tangent " << worst);
        CHECK_MESSAGE(signs == 0, name << ": " << signs << " signs of " << reference.size() << " differ");
    }
    return files;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("tangent_space: a unit square in the xy plane has T = +x, sign +1 and B along +v") {
        Corners mesh;
        for (const Vec4f& t : flat_face(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}).tangents()) {
            CHECK(t == Vec4f(1, 0, 0, 1));
            CHECK(t.w * glm::cross(Vec3f(0, 0, 1), Vec3f(t)) == Vec3f(0, 1, 0));
        }
    }

    TEST_CASE("tangent_space: a mirrored u turns T and the sign round, and B still runs along +v") {
        Corners mesh;
        flat_face(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        for (Vec2f& uv : mesh.uvs) uv.x = -uv.x;
        for (const Vec4f& t : mesh.tangents()) {
            CHECK(t == Vec4f(-1, 0, 0, -1));
            CHECK(t.w * glm::cross(Vec3f(0, 0, 1), Vec3f(t)) == Vec3f(0, 1, 0));
        }
    }

    TEST_CASE("tangent_space: rotating the mesh rotates the tangents") {
        const Corners mesh = sheet(12, 1);
        Corners turned = mesh;
        // A turn that permutes the axes is exact in floats.
        const auto turn = [](const Vec3f& v) { return Vec3f(v.z, v.x, v.y); };
        for (Vec3f& p : turned.positions) p = turn(p);
        for (Vec3f& n : turned.normals) n = turn(n);
        const auto a = mesh.tangents(), b = turned.tangents();
        double worst = 0;
        int borrowed = 0;
        for (std::size_t c = 0; c < a.size(); ++c) {
            if (a[c] == Vec4f(1, 0, 0, -1)) ++borrowed; // no chart, nothing to turn
            else worst = std::max(worst, difference(Vec4f(turn(Vec3f(a[c])), a[c].w), b[c]));
        }
        CHECK(worst < 1e-5); // sums of products in another order: some roundings
        CHECK(borrowed < 8);
    }

    TEST_CASE("tangent_space: T is unit, and perpendicular to a unit normal") {
        const Corners mesh = sheet(20, 2);
        const auto tangents = mesh.tangents();
        CHECK(all_unit(tangents));
        for (std::size_t c = 0; c < tangents.size(); ++c)
            if (tangents[c] != Vec4f(1, 0, 0, -1))
                CHECK(std::abs(glm::dot(Vec3f(tangents[c]), mesh.normals[c])) < 1e-5f);
    }

    TEST_CASE("tangent_space: a triangle counts by its angle at the vertex") {
        // Two triangles fold at x = 0; at their shared corners (0,0) the angles are 90 and 45 degrees.
        Corners mesh;
        const Vec3f n(0, 0, 1), o(0), up(0, 1, 0);
        mesh.add(o, {0, 0}, n), mesh.add({1, 0, 0}, {1, 0}, n), mesh.add(up, {0, 1}, n), mesh.close();
        mesh.add(o, {0, 0}, n), mesh.add(up, {0, 1}, n), mesh.add({-1, 1, 0}, {-1, 0.5f}, n), mesh.close();
        const auto tangents = mesh.tangents();
        // dp/du of the second is (1, -1/2): 1/2 of v is gone where u falls by 1 and y should have gone with it.
        const Vec3d first(1, 0, 0), second = glm::normalize(Vec3d(1, -0.5, 0));
        const double pi = std::acos(-1.0);
        const Vec3d expected = glm::normalize(pi / 2 * first + pi / 4 * second);
        CHECK(glm::length(Vec3d(tangents[0]) - expected) < 1e-6);
        CHECK(tangents[0] == tangents[3]);
        CHECK(glm::length(Vec3d(tangents[5]) - second) < 1e-6);
    }

    TEST_CASE("tangent_space: corners are one vertex only where position, normal and uv are all equal") {
        Corners mesh;
        flat_face(mesh, {{0, 0}, {1, 0}, {0, 1}});
        flat_face(mesh, {{0, 0}, {0, 1}, {-1, 0}});
        mesh.uvs[5] = {-1, 1}; // the second triangle's dp/du is slanted
        const auto joined = mesh.tangents();
        CHECK(joined[0] == joined[3]);
        CHECK(joined[0] != Vec4f(1, 0, 0, 1));
        for (const int part : {0, 1, 2}) {
            Corners cut = mesh;
            for (const int c : {3, 4}) {
                if (part == 0) cut.positions[c].z = 0.001f;
                if (part == 1) cut.normals[c] = glm::normalize(Vec3f(0, 0.001f, 1));
                if (part == 2) cut.uvs[c].x += 1;
            }
            CHECK(cut.tangents()[0] == Vec4f(1, 0, 0, 1));
        }
        Corners minus = mesh;
        minus.positions[3].z = -0.0f;
        minus.uvs[3] = {-0.0f, 0};
        CHECK(minus.tangents() == joined);
    }

    TEST_CASE("tangent_space: sides of a mirrored seam do not mix at their common vertices") {
        Corners mesh; // the uv folds back at x = 0
        flat_face(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        flat_face(mesh, {{0, 0}, {0, 1}, {-1, 1}, {-1, 0}});
        mesh.uvs[6] = {1, 1}, mesh.uvs[7] = {1, 0};
        const auto tangents = mesh.tangents();
        for (int c = 0; c < 4; ++c) CHECK(tangents[c] == Vec4f(1, 0, 0, 1));
        for (int c = 4; c < 8; ++c) CHECK(tangents[c] == Vec4f(-1, 0, 0, -1));
    }

    TEST_CASE("tangent_space: triangles that meet only at a vertex do not mix") {
        Corners mesh;
        flat_face(mesh, {{0, 0}, {1, 0}, {1, 1}});
        flat_face(mesh, {{0, 0}, {-1, 0}, {-1, -1}});
        mesh.uvs[4] = {0, -1}, mesh.uvs[5] = {1, -1}; // turned a quarter
        const auto tangents = mesh.tangents();
        CHECK(tangents[0] == Vec4f(1, 0, 0, 1));
        CHECK(glm::length(Vec3f(tangents[3]) - Vec3f(0, -1, 0)) < 1e-6f);
    }

    TEST_CASE("tangent_space: quads are their two triangles along the diagonal that is shorter in uv, then in space") {
        const Corners quads = sheet(24, 3);
        std::vector<std::uint32_t> corners;
        int first = 0, second = 0;
        for (std::uint32_t c = 0; c < quads.positions.size(); c += 4) {
            const double a = glm::length(quads.uvs[c] - quads.uvs[c + 2]);
            const double b = glm::length(quads.uvs[c + 1] - quads.uvs[c + 3]);
            using Six = std::array<std::uint32_t, 6>;
            const auto tris = a < b ? Six{0, 1, 2, 0, 2, 3} : Six{0, 1, 3, 1, 2, 3};
            ++(a < b ? first : second);
            for (const std::uint32_t k : tris) corners.push_back(c + k);
        }
        CHECK(first > 100);
        CHECK(second > 100);
        const auto a = quads.tangents(), b = picked(quads, corners).tangents();
        int close = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) close += difference(a[corners[k]], b[k]) < 1e-6;
        // Quads folded in uv are forced to one side, which two triangles are not; on other quads nothing differs.
        CHECK(close > int(corners.size() * 85 / 100));

        Corners square; // equal in uv; corners 1 and 3 are nearer in space
        const Vec3f n(0, 0, 1);
        square.add({-2, 0, 0}, {0, 0}, n), square.add({0, -1, 0}, {1, 0}, n);
        square.add({2, 0, 0}, {1, 1}, n), square.add({0, 2, 0}, {0, 1}, n), square.close();
        const auto diagonal = square.tangents(), triangles = picked(square, {0, 1, 3, 1, 2, 3}).tangents();
        CHECK(difference(diagonal[0], triangles[0]) < 1e-6);
        CHECK(difference(diagonal[2], triangles[4]) < 1e-6);
        CHECK(difference(diagonal[0], diagonal[2]) > 0.1);
    }

    TEST_CASE("tangent_space: a quad folded in uv stands on the side of its larger half") {
        Corners mesh;
        flat_face(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        mesh.uvs = {{0, 0}, {1, 0}, {0.2f, 0.2f}, {0.5f, 0.05f}}; // 0-1-2 is upright; 0-2-3 is not, and smaller
        for (const Vec4f& t : mesh.tangents()) CHECK(t.w == 1);
    }

    TEST_CASE("tangent_space: the corner of a quad with an unsound half copies the coinciding corner") {
        for (std::uint32_t twin = 0; twin < 4; ++twin) { // corner twin + 1 falls on corner twin
            Corners mesh;
            flat_face(mesh, {{0, 0}, {1, 0}, {1.5f, 1}, {0, 1}});
            const std::uint32_t other = (twin + 1) % 4;
            mesh.positions[other] = mesh.positions[twin];
            const auto tangents = mesh.tangents();
            CHECK(all_unit(tangents));
            CHECK(tangents[twin] == tangents[other]);
            for (const Vec4f& t : tangents) CHECK(t.w == 1);
        }
    }

    TEST_CASE("tangent_space: triangles without area in uv or in space borrow the space of the vertex") {
        Corners mesh;
        flat_face(mesh, {{0, 0}, {1, 0}, {0, 1}});
        mesh.add({1, 0, 0}, {1, 0}), mesh.add({1, 1, 0}, {1, 0}), mesh.add({0, 1, 0}, {0, 1}),
            mesh.close(); // no uv area
        mesh.add({0, 0, 0}, {0, 0}), mesh.add({0, 0, 0}, {0, 0}), mesh.add({1, 0, 0}, {1, 0}), mesh.close(); // no area
        for (Vec2f& uv : mesh.uvs) uv = {-uv.x, uv.y};
        const auto tangents = mesh.tangents();
        for (const int c : {0, 1, 2, 3, 5, 6, 7, 8}) CHECK(tangents[c] == Vec4f(-1, 0, 0, -1));
        CHECK(tangents[4] == Vec4f(1, 0, 0, -1)); // a vertex of its own
    }

    TEST_CASE("tangent_space: a triangle without uv area goes with the first group that reaches it") {
        // The flat triangle a-b-c lies between an upright one over a-b and a mirrored one over b-c.
        const Vec3f a(0, 0, 0), b(2, 0, 0), c(2, 2, 0);
        const Vec2f uv_a(0, 0), uv_b(1, 1), uv_c(2, 2);
        for (const bool mirrored_first : {false, true}) {
            Corners mesh;
            const auto upright = [&] {
                mesh.add(b, uv_b), mesh.add(a, uv_a), mesh.add({1, -1, 0}, {1, -1}), mesh.close();
            };
            const auto mirrored = [&] {
                mesh.add(c, uv_c), mesh.add(b, uv_b), mesh.add({3, 1, 0}, {1, 2}), mesh.close();
            };
            mesh.add(a, uv_a), mesh.add(b, uv_b), mesh.add(c, uv_c), mesh.close();
            mirrored_first ? (mirrored(), upright()) : (upright(), mirrored());
            for (const std::size_t k : {3, 6}) // the second and third triangles' uv run as meant
                CHECK((mesh.tangents()[k].w == 1) == ((k == 3) != mirrored_first));
            const auto tangents = mesh.tangents();
            // Only one end of it is reached, and the other must not be taken by the other side.
            CHECK((tangents[0] == Vec4f(1, 0, 0, -1)) == mirrored_first);
            CHECK((tangents[2] == Vec4f(1, 0, 0, -1)) == !mirrored_first);
            CHECK(tangents[mirrored_first ? 2 : 0] == tangents[mirrored_first ? 3 : 4]);
        }
    }

    TEST_CASE(
        "tangent_space: a quad's corner is the mean where its halves are in two groups, the sign that of the later") {
        Corners mesh; // a mirrored triangle, then a quad whose flat half 0-2-3 goes with it
        mesh.add({0, 1, 0}, {0.5f, 0}), mesh.add({1, 1, 0}, {1, 0}), mesh.add({1, 2, 0}, {0.75f, -1}), mesh.close();
        mesh.add({0, 0, 0}, {0, 0}), mesh.add({1, 0, 0}, {0.5f, -2});
        mesh.add({1, 1, 0}, {1, 0}), mesh.add({0, 1, 0}, {0.5f, 0}), mesh.close();
        const auto tangents = mesh.tangents();
        const float slanted = std::sqrt(0.5f);
        CHECK(difference(tangents[1], {1, 0, 0, -1}) < 1e-6);
        CHECK(difference(tangents[6], {1, 0, 0, -1}) < 1e-6);
        CHECK(difference(tangents[3], {slanted, slanted, 0, 1}) < 1e-6);
        CHECK(difference(tangents[5], Vec4f(glm::normalize(Vec3f(1 + slanted, slanted, 0)), 1)) < 1e-6);
    }

    TEST_CASE("tangent_space: triangles of one group whose tangents are exactly opposite do not cancel") {
        Corners mesh; // a square pyramid from above, u running round it
        const Vec3f rim[] = {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
        for (int k = 0; k < 4; ++k) {
            mesh.add({0, 0, 0}, {0, 1}), mesh.add(rim[k], {k, 0}), mesh.add(rim[k + 1], {k + 1, 0});
            mesh.close();
        }
        const auto tangents = mesh.tangents();
        for (int k = 0; k < 4; ++k) CHECK(difference(tangents[3 * k], Vec4f((rim[k + 1] - rim[k]) / 2.0f, 1)) < 1e-6);
    }

    TEST_CASE(
        "tangent_space: a mesh's triangles, quads and larger faces share one space; faces off the chart have none") {
        // Five corners at left, a quad at right, and a triangle on top without uv at its tip.
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5f, 1.5f, 0},
                          {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1.5f, 2, 0}};
        for (const Vec3f& p : mesh.positions) mesh.uvs.emplace_back(-p.y, p.x); // u along -y
        mesh.face_begin = {0, 5, 9, 12};
        mesh.corner_position = {0, 1, 2, 3, 4, 1, 5, 6, 2, 2, 6, 7};
        mesh.corner_uv = {0, 1, 2, 3, 4, 1, 5, 6, 2, 2, 6, no_index};
        const std::vector<Triangle> triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}, {{0, 3, 4}, 0},
                                                 {{5, 6, 7}, 1}, {{5, 7, 8}, 1}, {{9, 10, 11}, 2}};
        const std::vector<Vec3f> normals(12, {0, 0, 1});
        const auto tangents = corner_tangents(mesh, triangles, normals);
        REQUIRE(tangents.size() == 12);
        for (int c = 0; c < 9; ++c) CHECK(difference(tangents[c], {0, -1, 0, 1}) < 1e-6);
        for (int c = 9; c < 12; ++c) CHECK(tangents[c] == Vec4f(1, 0, 0, 1));
        mesh.corner_uv.clear();
        CHECK(corner_tangents(mesh, triangles, normals) == std::vector<Vec4f>(12, Vec4f(1, 0, 0, 1)));
    }

    TEST_CASE("tangent_space: add_tangents gives a mesh those of its corners, and normals where it has none; without "
              "uvs nothing") {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        mesh.face_begin = {0, 4};
        mesh.corner_position = {0, 1, 2, 3};
        Mesh bare = mesh;
        add_tangents(bare);
        CHECK(bare.tangents.empty());
        CHECK(bare.corner_normal.empty());
        mesh.uvs = {{0, 0}, {0, -1}, {1, -1}, {1, 0}}; // u along y, v along -x
        mesh.corner_uv = mesh.corner_position;
        add_tangents(mesh);
        CHECK(mesh.corner_normal == mesh.corner_position);
        for (const Vec3f& n : mesh.normals) CHECK(n == Vec3f(0, 0, 1));
        CHECK(mesh.tangents == std::vector<Vec4f>(4, Vec4f(0, 1, 0, 1)));
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("tangent_space: equals MikkTSpace's reference implementation at every corner of three small meshes") {
        CHECK(check_reference(test::source_folder() / "tests/data/mikktspace") == 3);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("tangent_space: no input, one triangle, and triangles with nothing in them") {
        CHECK(Corners{}.tangents().empty());
        CHECK(corner_tangents({}, {}, {}, {}).empty());
        CHECK(corner_tangents(Mesh{}, {}, {}).empty());

        Corners one;
        for (const Vec4f& t : flat_face(one, {{0, 0}, {2, 0}, {0, 1}}).tangents()) CHECK(t == Vec4f(1, 0, 0, 1));
        Corners chartless = one;
        for (Vec2f& uv : chartless.uvs) uv = Vec2f(0);
        for (const Vec4f& t : chartless.tangents()) CHECK(t == Vec4f(1, 0, 0, -1));
        Corners point = one;
        for (Vec3f& p : point.positions) p = Vec3f(0);
        for (const Vec4f& t : point.tangents()) CHECK(t == Vec4f(1, 0, 0, -1));
        Corners normalless = one;
        for (Vec3f& n : normalless.normals) n = Vec3f(0);
        CHECK(all_unit(normalless.tangents()));
        Corners along = one; // dp/du along the normal: nothing is left in the plane
        for (Vec3f& n : along.normals) n = {1, 0, 0};
        for (const Vec4f& t : along.tangents()) CHECK(t == Vec4f(1, 0, 0, 1));
    }

    TEST_CASE("tangent_space: values of any size give unit tangents") {
        for (const float scale : {1e-38f, 1e-30f, 1e-20f, 1e-10f, 1e10f, 1e18f, 1e30f, 3e38f})
            for (const bool space : {true, false}) {
                Corners mesh = sheet(4, 4);
                for (Vec3f& p : mesh.positions)
                    if (space) p = glm::clamp(p, -1.0f, 1.0f) * scale;
                for (Vec2f& uv : mesh.uvs)
                    if (!space) uv = glm::clamp(uv, -1.0f, 1.0f) * scale;
                CHECK_MESSAGE(all_unit(mesh.tangents()), scale);
            }
    }

    TEST_CASE(
        "tangent_space: a triangle whose slopes along one axis are beyond all floats leaves its neighbour alone") {
        // Derivatives are 1e18 on the left, and 1e18 / 2e-38 along one axis on the right.
        const float size = 1e18f, narrow = 2e-38f;
        for (const bool swapped : {false, true}) {
            const auto corner = [&](Corners& mesh, const Vec2f& p, const Vec2f& uv) {
                mesh.add(Vec3f(size * p, 0), swapped ? Vec2f(uv.y, uv.x) : uv);
            };
            Corners mesh;
            corner(mesh, {0, 0}, {0, 0}), corner(mesh, {1, 0}, {1, 0}), corner(mesh, {0, 1}, {0, 1}), mesh.close();
            const auto alone = mesh.tangents();
            corner(mesh, {0, 0}, {0, 0}), corner(mesh, {0, 1}, {0, 1}), corner(mesh, {-1, 0.5f}, {-narrow, 0});
            mesh.close();
            const auto both = mesh.tangents();
            for (std::size_t c = 0; c < 3; ++c) CHECK(both[c] == alone[c]);
            CHECK(all_unit(both));
        }
    }

    TEST_CASE("tangent_space: an edge shared by three faces joins the first two that fit") {
        Corners mesh;
        const Vec3f a(0), b(0, 1, 0), n(0, 0, 1);
        mesh.add(a, {0, 0}, n), mesh.add({1, 0, 0}, {1, 0}, n), mesh.add(b, {0, 1}, n), mesh.close();
        mesh.add(a, {0, 0}, n), mesh.add(b, {0, 1}, n), mesh.add({-1, 1, 0}, {-1, 0.5f}, n), mesh.close();
        const auto two = mesh.tangents();
        mesh.add(a, {0, 0}, n), mesh.add(b, {0, 1}, n), mesh.add({-1, -3, 0}, {-1, 0.9f}, n), mesh.close();
        const auto three = mesh.tangents();
        for (int c = 0; c < 6; ++c) CHECK(three[c] == two[c]);
        CHECK(three[6] != three[3]);
        CHECK(all_unit(three));
    }

    TEST_CASE("tangent_space: hundreds of thousands of triangles around one vertex take no longer than elsewhere") {
        Corners mesh; // a cone whose tip has one uv, so that its tangents point everywhere
        const int n = 200000;
        const auto rim = [&](int k) {
            const double angle = 2 * std::acos(-1.0) * (k % n) / n;
            mesh.add({float(std::cos(angle)), float(std::sin(angle)), 0}, {float(k) / n, 0}, {0, 0, 1});
        };
        for (int k = 0; k < n; ++k) {
            rim(k), rim(k + 1);
            mesh.add({0, 0, 0.1f}, {0.5f, 1}, {0, 0, 1});
            mesh.close();
        }
        CHECK(all_unit(mesh.tangents())); // the square of n would be minutes: the test's time limit fails it
    }

    TEST_CASE("tangent_space: the number of threads does not change a bit") {
        const Corners mesh = sheet(150, 5);
        std::vector<Vec4f> one;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const auto tangents = mesh.tangents();
            if (threads == 1) one = tangents;
            CHECK(std::memcmp(one.data(), tangents.data(), one.size() * sizeof(Vec4f)) == 0);
        }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("tangent_space: equals the reference at every corner of real meshes") {
        CHECK(check_reference(test::shared_data() / "mikktspace") >= 9);
    }

    TEST_CASE("tangent_space: agrees with the tangents that Blender wrote into a glTF, mirrored triangles too") {
        const auto file = test::shared_data() / "meshes/gltf/armor.gltf";
        const Mesh authored = read_mesh(file.string());
        Mesh ours = authored;
        add_tangents(ours);
        REQUIRE(ours.tangents.size() == authored.tangents.size());
        std::size_t mirrored = 0, signs = 0, far = 0;
        double sum = 0;
        for (std::size_t c = 0; c < ours.corners(); ++c) {
            const Vec3d a(ours.tangents[c]), b(authored.tangents[c]);
            mirrored += ours.tangents[c].w < 0;
            signs += ours.tangents[c].w == authored.tangents[c].w;
            const double degrees = glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
            sum += degrees;
            far += degrees > 1;
        }
        const auto corners = double(ours.corners());
        MESSAGE("armor: signs agree at " << 100 * double(signs) / corners << " %, mean angle " << sum / corners
                                         << " deg, over 1 deg at " << 100 * double(far) / corners << " %");
        CHECK(mirrored > ours.corners() / 3);
        CHECK(signs == ours.corners());
        CHECK(sum / corners < 0.005); // Blender wrote them as floats; one corner borrows from another neighbour
    }
}
