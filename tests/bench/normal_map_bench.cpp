// normal_map_bench [SIZE]
// normal_map_bench --make-torus MESH.obj | --make-height SIZE HEIGHT.exr | --errors MAP: the plain torus of 4096 triangles,
// its relief (--amplitude 0.02), and mean, p95 and max error in degrees of a map of them that any program has baked.
//
// Time and error of a bake on a mesh, for all four methods, at SIZE^2 (4096 unless given) on a
// torus fine enough not to matter, and at 1024^2 on the plain torus of 4096 triangles; the steps before the bake; and
// the bake on a plane. The oracle is the closed form of the torus relief (tests/relief/map/torus_relief.h), the map decoded
// in the frames a shader would have. Size counts texels along a side, or triangles. The limit is one pass that reads
// what a bake reads per texel, hit and height, 16 bytes, and writes the 12 of the map.
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/chart/tangent_space.h"
#include "bench.h"
#include "relief/map/torus_relief.h"

using namespace bake;

namespace {

/// As oracle::map_errors of floats, on all threads: every third row, and the last.
bench::Errors map_errors(const Image<float>& map, const BakeTarget& target) {
    const int size = map.width(), rows = (size + 2) / 3 + 1;
    std::vector<float> errors(std::size_t(rows) * size);
    for_rows(rows, 8, [&](std::int64_t begin, std::int64_t end) {
        for (auto j = int(begin); j < int(end); ++j) {
            const int y = std::min(3 * j, size - 1);
            for (int x = 0; x < size; ++x) {
                const TexelHit& hit = target.raster.hits.at(x, y);
                const auto& corner = target.surface.triangles[hit.triangle].corner;
                const double b[3] = {1.0 - hit.b1 - hit.b2, hit.b1, hit.b2};
                Vec3d T(0), N(0);
                for (int i = 0; i < 3; ++i) {
                    T += b[i] * Vec3d(Vec3f(target.tangents[corner[i]]));
                    N += b[i] * Vec3d(target.surface.n[corner[i]]);
                }
                const Vec3d t = 2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0;
                const Vec3d B = double(target.tangents[corner[0]].w) * glm::cross(N, T);
                const Vec3d truth = oracle::relief_normal({}, (x + 0.5) / size, 1 - (y + 0.5) / size);
                errors[std::size_t(j) * size + x] = float(oracle::angle_deg(t.x * T + t.y * B + t.z * N, truth));
            }
        }
    });
    return bench::errors_of(std::move(errors));
}

void read_16_write_12(const Image<TexelHit>& hits, const Image<float>& values, Image<float>& map) {
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const TexelHit* hit = hits.row(y);
            const float* value = values.row(y);
            float* to = map.row(y);
            for (int x = 0; x < map.width(); ++x) {
                to[3 * x] = hit[x].b1;
                to[3 * x + 1] = hit[x].b2;
                to[3 * x + 2] = value[x] + float(hit[x].triangle);
            }
        }
    });
}

void method_rows(const std::string& name, const Mesh& mesh, int size) {
    const HeightTexture height = oracle::relief_texture({}, size);
    const BakeTarget target = make_bake_target(mesh, "torus", size, size);
    const double texels = double(size) * size;
    Image<float> room(size, size, 3);
    for (const NormalMethod method : all_normal_methods) {
        const NormalMapOptions options = oracle::relief_options({}, size, Filter::c2, method);
        const HeightField field(height, options.height_options, options.filter, size, size);
        NormalMapReport report;
        const auto turns = bench::in_turn(3, {[&] { read_16_write_12(target.raster.hits, height.values, room); }},
                                          {{[&] { return normal_map(field, target, options, report); },
                                            [&](const Image<float>& map) { return map_errors(map, target); }}});
        const bench::Measured& bake = turns.works[0];
        bench::print_row(
            bake, {"normal_map", name + "_" + std::string(bake::name(method)), size, texels,
                   bake.ratio_to(turns.limits[0]), "read+write pass",
                   bench::text("limit %.2f ns; %.0f ms in all; %zu triangles", 1e9 * turns.limits[0].median() / texels,
                               1e3 * bake.median(), target.surface.triangles.size())});
    }
}

void plane_row(int size) {
    const oracle::TorusRelief r{0.001, size / 32, size / 32};
    const HeightTexture height = oracle::relief_texture(r, size);
    const NormalMapOptions options = oracle::relief_options(r, size, Filter::c2);
    const HeightField field(height, options.height_options, options.filter, size, size);
    Image<TexelHit> hits(size, size, 1);
    std::fill_n(hits.data(), hits.size(), TexelHit{0, 0, 0});
    Image<float> room(size, size, 3);
    const auto turns = bench::in_turn(
        3, {[&] { read_16_write_12(hits, height.values, room); }},
        {{[&] { return normal_map(field, Vec2d(1, 1), options); },
          [&](const Image<float>& map) {
              std::vector<float> errors;
              for (int y = 0; y < size; y += 3)
                  for (int x = 0; x < size; ++x) {
                      const Height<double> h = oracle::relief(r, (x + 0.5) / size, 1 - (y + 0.5) / size);
                      const Vec3f t = decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, false);
                      errors.push_back(float(oracle::angle_deg(Vec3d(t), {-h.b_u, -h.b_v, 1})));
                  }
              return bench::errors_of(std::move(errors));
          }}});
    const bench::Measured& bake = turns.works[0];
    bench::print_row(bake, {"normal_map", "plane_exact", size, double(size) * size, bake.ratio_to(turns.limits[0]),
                            "read+write pass", bench::text("%.0f ms in all", 1e3 * bake.median())});
}

/// Angles to the closed form of dp/du at the corners.
template <class Vectors> bench::Errors tangent_errors(const Mesh& mesh, const Vectors& found) {
    std::vector<float> errors;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const Vec2d uv(mesh.uvs[mesh.corner_uv[c]]);
        errors.push_back(float(oracle::angle_deg(Vec3d(Vec3f(found[c])), oracle::unit_torus(uv.x, uv.y).p_u)));
    }
    return bench::errors_of(std::move(errors));
}

bench::Errors raster_errors(const Mesh& mesh, const MeshSurface& surface, const UvRaster& raster) {
    const int size = raster.hits.width();
    std::vector<float> errors;
    for (int y = 0; y < size; y += 7)
        for (int x = 0; x < size; x += 7) {
            const TexelHit& hit = raster.hits.at(x, y);
            const auto& corner = surface.triangles[hit.triangle].corner;
            const auto uv = [&](int k) { return Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]); };
            const Vec2d found = uv(0) + double(hit.b1) * (uv(1) - uv(0)) + double(hit.b2) * (uv(2) - uv(0));
            errors.push_back(float(360 * glm::length(found - Vec2d((x + 0.5) / size, 1 - (y + 0.5) / size))));
        }
    return bench::errors_of(std::move(errors));
}

/// What make_bake_target does, step by step; the tangents' oracle is the closed form of dp/du.
void step_rows(const Mesh& mesh, int size) {
    const MeshSurface surface = make_mesh_surface(mesh); // what the second and the third step start from
    const auto found =
        bench::in_turn(3, {},
                       {{[&] { return make_mesh_surface(mesh); },
                         [&](const MeshSurface& s) { return tangent_errors(mesh, s.p_u); }},
                        {[&] { return corner_tangents(mesh, surface.triangles, surface.n); },
                         [&](const std::vector<Vec4f>& tangents) { return tangent_errors(mesh, tangents); }},
                        {[&] { return uv_raster(mesh, surface.triangles, size, size); },
                         [&](const UvRaster& raster) { return raster_errors(mesh, surface, raster); }}})
            .works;
    const auto triangles = std::int64_t(surface.triangles.size());
    const auto row = [&](const char* name, std::int64_t counted, double items, const bench::Measured& step,
                         const char* note) {
        bench::print_row(step, {"normal_map", name, counted, items, 0, "",
                                bench::text("%.0f ms in all; %s", 1e3 * step.median(), note)});
    };
    row("step_surface", triangles, double(triangles), found[0], "per triangle; error of p_u at the corners");
    row("step_tangents", triangles, double(triangles), found[1], "per triangle; error of T at the corners");
    row("step_raster", size, double(size) * size, found[2], "per texel; error in uv as if one unit were 360 deg");
}

} // namespace

namespace {

int make_or_measure(const std::string& what, int argc, char** argv) {
    const Mesh torus = oracle::torus_mesh(64, 32);
    if (what == "--make-torus" && argc == 3) return write_mesh(argv[2], torus), 0;
    if (what == "--make-height" && argc == 4)
        return write_image(argv[3], oracle::relief_texture({}, std::atoi(argv[2])).values, {.depth = Depth::float32}),
               0;
    if (what != "--errors" || argc != 3) return 2;
    const Image<float> read = read_image(argv[2]);
    Image<float> map(read.width(), read.height(), 3);
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            for (int c = 0; c < 3; ++c) map.at(x, y, c) = read.at(x, y, c);
    const bench::Errors errors = map_errors(map, make_bake_target(torus, "torus", map.width(), map.height()));
    return std::printf("%.4g,%.4g,%.4g\n", errors.mean, errors.p95, errors.max), 0;
}

} // namespace

int main(int argc, char** argv) try {
    if (argc > 1 && std::string(argv[1]).starts_with("--")) return make_or_measure(argv[1], argc, argv);
    const int size = argc > 1 ? std::atoi(argv[1]) : 4096;
    if (size < 64 || size > 16384) return std::fprintf(stderr, "usage: normal_map_bench [SIZE], 64 to 16384\n"), 2;
    const Mesh fine = oracle::torus_mesh(512, 256), coarse = oracle::torus_mesh(64, 32);
    step_rows(fine, size);
    method_rows("torus_262k", fine, size);
    method_rows("torus_4k", coarse, 1024);
    plane_row(size);
    return 0;
} catch (const Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), int(error.refusal);
}
