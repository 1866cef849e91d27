// displace_shapes_bench [LEVELS_MORE [CAGE]]: time and error of displacement, memory to memory, per point of the result: shapes whose
// displaced form is known, and cages under the same height. Rows named blend are those of Seam::blend, the default; in the others
// the points at seams take the mean of both sides. ratio is against one pass that writes as many bytes as the
// mesh has, by the same for_rows, measured in turn.
//
// error_*_deg: angles of the normals in the mesh that was timed: on shapes against the closed form; on cages against
// Max's normals of its own faces (those at seams left out), themselves of order 2 in the edge's length. note: worst position error over
// the diagonal (shapes), bytes, milliseconds in all.
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/displace/displace.h"
#include "waves.h"
#include <cstring>
#include <filesystem>

using namespace bake;

namespace {

struct Case {
    std::string name;
    BaseSurface base;
    int levels;
    std::function<Jet<double>(double, double)> form; ///< of uv; empty: a cage
    double diagonal = 1;
};

Jet<double> y_up(Jet<double> s, double du, double dv) {
    const auto turn = [](const Vec3d& v) { return Vec3d(v.x, v.z, -v.y); };
    s.p = turn(s.p), s.n = turn(s.n);
    s.p_u = du * turn(s.p_u), s.p_v = dv * turn(s.p_v), s.n_u = du * turn(s.n_u), s.n_v = dv * turn(s.n_v);
    return s;
}

Mesh cube() {
    Mesh mesh;
    mesh.positions = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.corner_position = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5, 0, 4, 7, 3};
    for (std::uint32_t c = 0; c < 24; ++c) mesh.corner_uv.push_back(c % 4);
    for (std::uint32_t f = 1; f <= 6; ++f) mesh.face_begin.push_back(4 * f);
    return mesh;
}

bench::Errors normal_errors(const Case& c, const oracle::TorusRelief& r, const Mesh& mesh, double& position) {
    std::vector<Vec3d> own;
    if (!c.form) {
        own.assign(mesh.normals.size(), Vec3d(0));
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const std::uint32_t first = mesh.face_begin[f], n = mesh.face_begin[f + 1] - first;
            for (std::uint32_t k = 0; k < n; ++k) {
                const auto at = [&](std::uint32_t i) {
                    return Vec3d(mesh.positions[mesh.corner_position[first + i % n]]);
                };
                const Vec3d a = at(k + 1) - at(k), b = at(k + n - 1) - at(k);
                own[mesh.corner_normal[first + k]] += glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
            }
        }
    }
    // At a seam with two heights the displaced cage has an edge, and the faces at it a step.
    std::vector<std::uint32_t> uv(c.form ? 0 : mesh.positions.size(), no_index);
    std::vector<bool> seam(uv.size()), step(uv.size());
    for (std::size_t corner = 0; corner < mesh.corners() && !c.form; ++corner) {
        std::uint32_t& known = uv[mesh.corner_position[corner]];
        if (known != no_index && known != mesh.corner_uv[corner]) seam[mesh.corner_position[corner]] = true;
        known = mesh.corner_uv[corner];
    }
    for (std::size_t f = 0; f < mesh.faces() && !c.form; ++f) {
        const auto corners =
            std::span(mesh.corner_position).subspan(mesh.face_begin[f], mesh.face_begin[f + 1] - mesh.face_begin[f]);
        if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t p) { return seam[p]; }))
            for (const std::uint32_t p : corners) step[p] = true;
    }
    std::vector<float> errors;
    position = 0;
    for (std::size_t corner = 0; corner < mesh.corners(); corner += 3) {
        const Vec3d n(mesh.normals[mesh.corner_normal[corner]]);
        if (!c.form) {
            if (step[mesh.corner_position[corner]]) continue;
            errors.push_back(float(oracle::angle_deg(n, own[mesh.corner_normal[corner]])));
            continue;
        }
        const Vec2d at(mesh.uvs[mesh.corner_uv[corner]]);
        if (at.y <= 0 || at.y >= 1) continue; // poles: their uv is that of a face
        const Jet<double> s = c.form(at.x, at.y);
        const Height<double> h = oracle::relief(r, at.x, at.y);
        position = std::max(
            position, glm::length(Vec3d(mesh.positions[mesh.corner_position[corner]]) - s.p - h.b * s.n) / c.diagonal);
        errors.push_back(float(
            oracle::angle_deg(n, glm::cross(s.p_u + h.b_u * s.n + h.b * s.n_u, s.p_v + h.b_v * s.n + h.b * s.n_v))));
    }
    return bench::errors_of(std::move(errors));
}

void run(const Case& c, int threads, Seam seam) {
    const ThreadLimit limit(threads);
    const oracle::TorusRelief r{0.01, 12, 12};
    Relief height;
    height.values = oracle::relief_texture(r, 1024).values;
    height.height = {.amplitude = 2 * r.A, .midlevel = 0.5};
    DisplaceOptions options;
    options.rates.levels = c.levels;
    options.seam = seam;
    std::size_t bytes = 0;
    double points = 0, position = 0;
    {
        const Displaced out = displace(c.base, height, options);
        bytes = 12 * (out.mesh.positions.size() + out.mesh.normals.size() + out.mesh.corners()) +
                8 * out.mesh.uvs.size() + 4 * out.mesh.faces();
        points = double(out.mesh.positions.size());
    }
    const auto turns =
        bench::in_turn(5, {[&] {
                           const std::unique_ptr<char[]> fresh(new char[bytes]);
                           for_rows(std::int64_t(bytes >> 20), 1, [&](std::int64_t begin, std::int64_t end) {
                               std::memset(fresh.get() + (begin << 20), int(begin), std::size_t(end - begin) << 20);
                           });
                       }},
                       {{[&] { return displace(c.base, height, options); },
                         [&](const Displaced& out) { return normal_errors(c, r, out.mesh, position); }}});
    const bench::Measured& ours = turns.works[0];
    bench::print_row(ours, {"displace_shapes", c.name + (seam == Seam::blend ? "_blend" : ""), std::int64_t(points),
                            points, ours.ratio_to(turns.limits[0]), "writing the bytes",
                            (c.form ? bench::text("position %.2g of the diagonal; ", position) : std::string()) +
                                bench::text("%.0f MB; %.0f ms", double(bytes) / 1e6, 1e3 * ours.median())});
}

} // namespace

int main(int argc, char** argv) {
    const int more = argc > 1 ? std::atoi(argv[1]) : 0;
    if (more < 0 || more > 2)
        return std::fprintf(stderr, "usage: displace_shapes_bench [LEVELS_MORE [CAGE]], 0 to 2\n"), 2;
    std::vector<Case> cases;
    cases.push_back(
        {"torus", BaseSurface(ParametricSurface("torus:R=1,r=0.4"), 32, 32), 5 + more,
         [](double u, double v) { return y_up(oracle::torus(1, 0.4, 2 * pi * u, 2 * pi * v), 2 * pi, 2 * pi); },
         std::sqrt(2.8 * 2.8 * 2 + 0.8 * 0.8)});
    cases.push_back({"sphere", BaseSurface(ParametricSurface("sphere:R=1"), 32, 32), 5 + more,
                     [](double u, double v) { return y_up(oracle::sphere(1, 2 * pi * u, pi * (v - 0.5)), 2 * pi, pi); },
                     std::sqrt(12.0)});
    cases.push_back({"cube_limit", BaseSurface(cube(), SubdivisionOptions{}), 9 + more, {}});
    if (argc > 2)
        cases.push_back({std::filesystem::path(argv[2]).stem().string() + "_limit",
                         BaseSurface(read_mesh(argv[2]), SubdivisionOptions{}),
                         5 + more,
                         {}});
    for (const Case& c : cases)
        for (const int threads : {1, 0})
            for (const Seam seam : {Seam::average, Seam::blend}) run(c, threads, seam);
}
