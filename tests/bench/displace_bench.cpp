// displace_bench: time and error of displace() on the torus R = 1, r = 0.4 with a relief of 0.01 in 24 x 12 waves, each of
// its 4 x 4 patches cut into 2^level x 2^level. The oracle is the displaced torus in closed form; the error is the angle of
// the normal that a shader shows at the middle of a face, interpolated from its corners. The limit is writing as many bytes
// as the mesh has. Rows as in bench.h; size counts faces. Rows named blend are those of Seam::blend, the default; in the others
// the points at seams take the mean of both sides.
#include "bake/relief/displace/displace.h"
#include "bench.h"
#include "relief/map/torus_relief.h"
#include <cstring>

using namespace bake;

namespace {

// In the coordinates of the product: y up.
Vec3d y_up(const Vec3d& v) { return {v.x, v.z, -v.y}; }

struct Found {
    bench::Errors normals;
    double farthest = 0; ///< of the middles of faces from the displaced surface
};

Found found(const Mesh& mesh, const oracle::TorusRelief& relief) {
    Found result;
    std::vector<float> angles;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t first = mesh.face_begin[f], count = mesh.face_begin[f + 1] - first;
        Vec3d p(0), n(0);
        Vec2d uv(0);
        for (std::uint32_t c = first; c < first + count; ++c) {
            p += Vec3d(mesh.positions[mesh.corner_position[c]]) / double(count);
            n += Vec3d(mesh.normals[mesh.corner_normal[c]]);
            uv += Vec2d(mesh.uvs[mesh.corner_uv[c]]) / double(count);
        }
        const Jet<double> s = oracle::unit_torus(uv.x, uv.y);
        const Vec3d exact = y_up(s.p + oracle::relief(relief, uv.x, uv.y).b * s.n);
        const Vec3d N = y_up(oracle::relief_normal(relief, uv.x, uv.y));
        angles.push_back(float(oracle::angle_deg(n, N)));
        result.farthest =
            std::max(result.farthest, std::abs(glm::dot(p - exact, N))); // along the normal, to first order
    }
    result.normals = bench::errors_of(std::move(angles));
    return result;
}

std::size_t bytes(const Mesh& mesh) {
    return sizeof(Vec3f) * (mesh.positions.size() + mesh.normals.size()) + sizeof(Vec2f) * mesh.uvs.size() +
           sizeof(std::uint32_t) * (mesh.face_begin.size() + mesh.corner_position.size() + mesh.corner_normal.size() +
                                    mesh.corner_uv.size());
}

void run(const BaseSurface& base, const Relief& height, const oracle::TorusRelief& relief, int levels, Seam seam) {
    DisplaceOptions options;
    options.rates.levels = levels;
    options.seam = seam;
    double farthest = 0;
    const bench::Work work([&] { return displace(base, height, options); },
                           [&](const Displaced& result) {
                               const Found error = found(result.mesh, relief);
                               farthest = error.farthest;
                               return error.normals;
                           });
    std::vector<char> room;
    const Mesh like = displace(base, height, options).mesh;
    const auto turns = bench::in_turn(5, {[&] {
                                          room = std::vector<char>();
                                          room.resize(bytes(like));
                                      }},
                                      {work});
    const bench::Measured& ours = turns.works[0];
    bench::print_row(
        ours, {"displace", bench::text(seam == Seam::blend ? "torus_levels_%d_blend" : "torus_levels_%d", levels),
               std::int64_t(like.faces()), double(like.faces()), ours.ratio_to(turns.limits[0]), "write pass",
               bench::text("%.3g ms in all; farthest %.2g of the diagonal", 1e3 * ours.median(),
                           farthest / std::sqrt(2 * 2.8 * 2.8 + 0.8 * 0.8))});
}

} // namespace

int main() {
    const oracle::TorusRelief relief;
    Relief height;
    height.values = oracle::relief_texture(relief, 1024).values;
    height.height = {.amplitude = 2 * relief.A, .midlevel = 0.5};
    const BaseSurface base(ParametricSurface("torus:R=1,r=0.4"), 4, 4);
    for (int levels = 4; levels <= 9; ++levels)
        for (const Seam seam : {Seam::average, Seam::blend}) run(base, height, relief, levels, seam);
}
