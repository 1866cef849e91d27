// mesh_distance_bench: time and error of the distances of bake check --against by the number of samples. One mesh is a sheet of
// 65536 triangles with waves along x, the other one the plane beneath it, so that the mean and rms distance have a closed form:
// the height is linear on each triangle. Errors are those of the mean and of the rms, each over its value, not degrees. Size counts
// samples; ns per item is per sample. The ratio is to the fewest samples.
#include "bake/mesh/check/mesh_distance.h"
#include "bench.h"

using namespace bake;

namespace {

constexpr int across = 1024, along = 32;

double height(int i) { return 0.05 * (1.4 + std::sin(0.11 * i) + 0.3 * std::sin(0.031 * i)); }

Mesh sheet(int nx, int nz, bool waves) {
    Mesh mesh;
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i <= nx; ++i)
            mesh.positions.emplace_back(double(i) / nx, waves ? height(i) : 0.0, double(k) / nz);
    for (int k = 0; k < nz; ++k)
        for (int i = 0; i < nx; ++i) {
            const auto a = std::uint32_t(k * (nx + 1) + i), up = a + std::uint32_t(nx) + 1;
            for (const std::uint32_t c : {a, up, up + 1, a + 1}) mesh.corner_position.push_back(c);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
    return mesh;
}

/// Mean and rms of the height over the area of the sheet, strip by strip: it is linear in each.
void closed_form(const Mesh& mesh, double& mean, double& rms) {
    double area = 0, sum = 0, squares = 0;
    for (std::size_t i = 0; i < across; ++i) {
        const double a = double(mesh.positions[i].y), b = double(mesh.positions[i + 1].y);
        const double length = std::hypot(double(mesh.positions[i + 1].x) - double(mesh.positions[i].x), b - a);
        area += length;
        sum += length * (a + b) / 2;
        squares += length * (a * a + a * b + b * b) / 3;
    }
    mean = sum / area;
    rms = std::sqrt(squares / area);
}

} // namespace

int main() {
    const Mesh waves = sheet(across, along, true), plane = sheet(64, 64, false);
    const std::vector<Triangle> waves_triangles = triangulate(waves), plane_triangles = triangulate(plane);
    double mean = 0, rms = 0;
    closed_form(waves, mean, rms);
    const std::size_t counts[] = {1000, 62500, 250000, 1000000};
    std::vector<bench::Work> works;
    for (const std::size_t samples : counts)
        works.push_back({[&, samples] {
                             return mesh_distance(waves, waves_triangles, plane, plane_triangles, {.samples = samples});
                         },
                         [&](const MeshDistance& found) {
                             return bench::errors_of({float(std::abs(found.there.mean / mean - 1)),
                                                      float(std::abs(found.there.rms / rms - 1))});
                         }});
    const auto found = bench::in_turn(3, {}, works).works;
    for (std::size_t i = 0; i < found.size(); ++i)
        bench::print_row(found[i], {"mesh_distance", bench::text("samples_%zu", counts[i]), std::int64_t(counts[i]),
                                    double(counts[i]), found[i].ratio_to(found[0]), "the fewest samples",
                                    bench::text("%.0f ms in all; errors of mean and rms over their values; not degrees",
                                                1e3 * found[i].median())});
}
