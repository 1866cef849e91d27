#include "bake/mesh/weld.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/seams.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

Image<float> constant(int width, int height, const Vec3f& t) {
    Image<float> map(width, height, 3);
    const Vec3f code = encode_normal(t, false);
    for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = code[int(i % 3)];
    return map;
}

/// The box shaded smooth, each side with its chart.
Mesh smooth_box() {
    Mesh box = sharp_box();
    box.normals.clear(), box.corner_normal.clear();
    weld_positions(box);
    return box;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "seams: a flat map on a box with the normals of its sides differs by 90 degrees at each of its 12 edges") {
        const Mesh box = sharp_box();
        const BakeTarget target = make_bake_target(box, "box", 96, 64);
        const SeamDisagreement flat = seam_disagreement(target, constant(96, 64, {0, 0, 1}), Space::tangent, false);
        CHECK(flat.seams == 12);
        CHECK(flat.samples > 12 * 25);
        CHECK(flat.mean == doctest::Approx(90));
        CHECK(flat.max == doctest::Approx(90));
        CHECK(flat.percentile_95 == doctest::Approx(90));
    }

    TEST_CASE("seams: normals that both sides share agree under a flat map, and so does any map in object space") {
        const Mesh box = smooth_box();
        const BakeTarget target = make_bake_target(box, "box", 96, 64);
        const SeamDisagreement flat = seam_disagreement(target, constant(96, 64, {0, 0, 1}), Space::tangent, false);
        CHECK(flat.seams == 12);
        CHECK(flat.max < 1e-3);
        const Vec3f any = glm::normalize(Vec3f(0.3f, -0.5f, 1));
        CHECK(seam_disagreement(target, constant(96, 64, any), Space::object, false).max < 1e-3);
        CHECK(seam_disagreement(target, constant(96, 64, any), Space::tangent, false).max > 10);
    }

    TEST_CASE("seams: an edge inside of a chart is none; a mesh without any has no samples") {
        const Mesh plane = unit_plane(0, 4);
        const BakeTarget target = make_bake_target(plane, "plane", 8, 8);
        const SeamDisagreement none = seam_disagreement(target, constant(8, 8, {0, 0.6f, 0.8f}), Space::tangent, false);
        CHECK(none.seams == 0);
        CHECK(none.samples == 0);
        CHECK(none.max == 0);
    }

    TEST_CASE("seams: normals of two sides make a seam of an edge inside of a chart") {
        Mesh mesh;
        for (const int side : {0, 1})
            add_patch(mesh, 1, 1, [&](double s, double t) {
                return PatchPoint{{side + s, t, 0}, glm::normalize(Vec3d(side, 0, 1)), {(side + s) / 2, t}};
            });
        const BakeTarget target = make_bake_target(mesh, "mesh", 8, 8);
        const SeamDisagreement seam = seam_disagreement(target, constant(8, 8, {0, 0, 1}), Space::tangent, false);
        CHECK(seam.seams == 1);
        CHECK(seam.max == doctest::Approx(45));
    }

    TEST_CASE("seams: the mean, the percentile and the largest of a seam whose sides part linearly") {
        // Two squares side by side with charts of their own; the right one's map turns by x degrees at the height y.
        Mesh mesh;
        for (const int side : {0, 1})
            add_patch(mesh, 1, 1, [&](double s, double t) {
                return PatchPoint{{side + s, t, 0}, {0, 0, 1}, {(side + 0.25 + 0.5 * s) / 2, t}};
            });
        constexpr int size = 256;
        const BakeTarget target = make_bake_target(mesh, "mesh", size, size);
        Image<float> map(size, size, 3);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double turn = x < size / 2 ? 0 : glm::radians(20 * (1 - (y + 0.5) / size));
                const Vec3f code = encode_normal(Vec3f(Vec3d(0, std::sin(turn), std::cos(turn))), false);
                for (int c = 0; c < 3; ++c) map.at(x, y, c) = code[c];
            }
        const SeamDisagreement seam = seam_disagreement(target, map, Space::tangent, false);
        CHECK(seam.seams == 1);
        CHECK(seam.samples == size);
        CHECK(seam.mean == doctest::Approx(10).epsilon(0.01));
        CHECK(seam.percentile_95 == doctest::Approx(19).epsilon(0.01));
        CHECK(seam.max == doctest::Approx(20).epsilon(0.01));
    }

    TEST_CASE("seams: a sphere whose quads at the poles repeat a vertex has one from pole to pole") {
        const Mesh sphere = lat_long_sphere(24, 12);
        const BakeTarget target = make_bake_target(sphere, "sphere", 48, 24);
        const SeamDisagreement flat = seam_disagreement(target, constant(48, 24, {0, 0, 1}), Space::tangent, false);
        CHECK(flat.seams == 12);
        CHECK(flat.max < 1e-3);
    }

    TEST_CASE("shaded_normal: a flat map gives the interpolated normal, a turned one the frame's; green down turns it "
              "round") {
        const Mesh sphere = lat_long_sphere(24, 12);
        const BakeTarget target = make_bake_target(sphere, "sphere", 48, 24);
        const TexelHit& at = target.raster.hits.at(11, 9);
        const auto& corner = target.surface.triangles[at.triangle].corner;
        Vec3d n(0), t(0);
        const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
        for (std::size_t k = 0; k < 3; ++k) {
            n += double(b[k]) * Vec3d(target.surface.n[corner[k]]);
            t += double(b[k]) * Vec3d(Vec3f(target.tangents[corner[k]]));
        }
        const auto shaded = [&](const Vec3f& value, bool directx) {
            return Vec3d(shaded_normal(target, constant(48, 24, value), at, Space::tangent, directx));
        };
        CHECK(oracle::angle_deg(shaded({0, 0, 1}, false), n) < 1e-3);
        CHECK(oracle::angle_deg(shaded({0.6f, 0, 0.8f}, false), 0.6 * t + 0.8 * n) < 1e-3);
        const Vec3d b_up = double(target.tangents[corner[0]].w) * glm::cross(n, t);
        CHECK(oracle::angle_deg(shaded({0, 0.6f, 0.8f}, false), 0.6 * b_up + 0.8 * n) < 1e-3);
        CHECK(oracle::angle_deg(shaded({0, 0.6f, 0.8f}, true), -0.6 * b_up + 0.8 * n) < 1e-3);
        CHECK(glm::length(shaded({0.6f, 0, 0.8f}, false)) == doctest::Approx(1));
        // On a chart that is mirrored in u, green still points along v.
        Mesh mirrored = unit_plane();
        for (Vec2f& uv : mirrored.uvs) uv.x = 1 - uv.x;
        const BakeTarget turned = make_bake_target(mirrored, "mirrored", 8, 8);
        const Vec3f up = shaded_normal(turned, constant(8, 8, {0, 0.6f, 0.8f}), {0, 0.3f, 0.3f}, Space::tangent, false);
        CHECK(glm::length(up - Vec3f(0, 0.6f, 0.8f)) < 1e-6f);
    }

} // TEST_SUITE

TEST_SUITE("oracle") {

    TEST_CASE("seams: a box with the detail of a rounded one agrees within a degree, and does not without padding") {
        const auto seams = [](int padding) {
            // Cells of 120 texels, whose charts begin at 2.4: a bilinear filter reads a texel there that is not the chart's.
            JobOptions options = job_options(360, 240);
            options.transfer.padding = padding;
            const Job job(sharp_box(), {rounded_box(80, 0.08)}, options);
            return seam_disagreement(job.target, job.result.map, Space::tangent, false);
        };
        const SeamDisagreement padded = seams(16), bare = seams(0);
        CHECK(padded.seams == 12);
        CHECK(padded.max <= 1);
        CHECK(bare.max > 5);
    }

} // TEST_SUITE
