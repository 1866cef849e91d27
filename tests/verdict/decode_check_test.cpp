// What other decodings make of a normal map: known rotations, and laws.
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/verdict/decode_check.h"
#include "cli/command.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A unit square, u to the right and v up, twice as wide as high in space if `wide`.
Mesh square(float wide = 1) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {wide, 0, 0}, {wide, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.corner_position = mesh.corner_uv = {0, 1, 2, 3};
    mesh.face_begin = {0, 4};
    return mesh;
}

/// One colour all over.
void write_map(const std::filesystem::path& path, const Vec3f& n) {
    Image<float> map(4, 4, 3);
    for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = 0.5f * n[int(i % 3)] + 0.5f;
    write_image(path.string(), map, {.depth = Depth::float32});
}

DecodeReport report_of(const test::Folder& folder, const Mesh& mesh, const Vec3f& n, bool directx = false) {
    write_mesh(folder / "mesh.obj", mesh);
    write_map(folder / "map.exr", n);
    return inspect_decoding(folder / "map.exr", folder / "mesh.obj", directx);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("decode_check: a normal tilted along v is mirrored by the other green, one along u is not") {
        const test::Folder folder;
        const auto angle = float(10 * pi / 180);
        const DecodeReport along_v = report_of(folder, square(), Vec3f(0, std::sin(angle), std::cos(angle)));
        REQUIRE(along_v.errors.size() == 3);
        CHECK(along_v.texels == 16);
        CHECK(along_v.relief_deg == doctest::Approx(10));
        CHECK(along_v.errors[0].decoding == Decoding::green_over);
        CHECK(along_v.errors[0].mean == doctest::Approx(20));
        CHECK(along_v.errors[0].max == doctest::Approx(20));
        const DecodeReport along_u = report_of(folder, square(), Vec3f(std::sin(angle), 0, std::cos(angle)));
        CHECK(along_u.errors[0].max < 1e-3);
        // On a square whose uvs are a square too, all frames are the same.
        for (const DecodeReport& report : {along_u, along_v})
            for (std::size_t k = 1; k < 3; ++k) CHECK(report.errors[k].max < 1e-3);
    }

    TEST_CASE("decode_check: frames from derivatives keep the stretch of the uvs, those of MikkTSpace do not") {
        const test::Folder folder;
        // p_u is twice as long as p_v, so that T, which grows with the slope along it, is half of B.
        const DecodeReport report = report_of(folder, square(2), glm::normalize(Vec3f(1, 0, 1)));
        CHECK(report.errors[2].mean == doctest::Approx(45 - std::atan(0.5) * 180 / pi).epsilon(1e-4));
        CHECK(report.errors[1].max < 1e-3);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("decode_check: with --expect directx green down is right") {
        const test::Folder folder;
        const Vec3f n = glm::normalize(Vec3f(0.1f, 0.3f, 1));
        const DecodeReport up = report_of(folder, square(), n), down = report_of(folder, square(), n, true);
        CHECK(down.directx);
        CHECK(down.errors[0].mean == doctest::Approx(up.errors[0].mean));
        CHECK(to_text(up).find("Unreal, DirectX)") != std::string::npos);
        CHECK(to_text(down).find("green down: Unreal, DirectX") != std::string::npos);
        CHECK(to_json(down).find("\"green\":\"down\"") != std::string::npos);
    }

    TEST_CASE("decode_check: frames that are not perpendicular differ from those made so") {
        const BakeTarget target = [] {
            static Mesh mesh = square();
            mesh.normals = {glm::normalize(Vec3f(0.5f, 0, 1)), {0, 0, 1}};
            mesh.corner_normal = {0, 1, 1, 0};
            return make_bake_target(mesh, "mesh", 8, 8);
        }();
        const TexelHit at = target.raster.hits.at(4, 4);
        const Vec3f t = glm::normalize(Vec3f(0.5f, 0.2f, 1));
        CHECK(glm::length(decoded(target, at, t, Decoding::mikktspace) - decoded(target, at, t, Decoding::unit_frame)) >
              1e-3f);
        for (const Decoding each : all_decodings)
            CHECK(glm::length(decoded(target, at, t, each)) == doctest::Approx(1));
    }
}

TEST_SUITE("stability") {

    TEST_CASE("decode_check: pictures and meshes that cannot be are refused") {
        const test::Folder folder;
        const auto refusal = [&](const std::string& map, const std::string& mesh) {
            try {
                inspect_decoding(folder / map, folder / mesh, false);
            } catch (const Error& error) {
                return int(error.refusal);
            }
            return 0;
        };
        write_mesh(folder / "mesh.obj", square());
        Mesh bare = square();
        bare.uvs.clear(), bare.corner_uv.clear();
        write_mesh(folder / "bare.obj", bare);
        write_map(folder / "map.exr", Vec3f(0, 0, 1));
        Image<float> grey(4, 4, 1);
        std::fill_n(grey.data(), grey.size(), 0.5f);
        write_image(folder / "grey.exr", grey);
        CHECK(refusal("map.exr", "mesh.obj") == 0);
        CHECK(refusal("map.exr", "bare.obj") == 4);
        CHECK(refusal("grey.exr", "mesh.obj") == 4);
        CHECK(refusal("none.exr", "mesh.obj") == 3);
    }
}
