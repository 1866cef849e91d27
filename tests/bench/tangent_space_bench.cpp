// tangent_space_bench [FOLDER]: time and error of corner_tangents on a torus of 250,000 triangles, the oracle being the
// closed-form dp/du, and on each FOLDER/*.f32, the oracle being the reference tangents stored there.
// size counts triangles; ratio is the time over that of reading the input once and writing the output once.
#include "bake/base/vec.h"
#include "bake/surface/chart/tangent_space.h"
#include "bench.h"
#include <filesystem>
#include <fstream>

using namespace bake;

namespace {

struct Corners {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<Vec4f> oracle;
};

// R = 1, r = 0.4, split quads; u goes around the axis, v around the tube.
Corners torus(int around, int across) {
    Corners out;
    const double turn = 2 * pi;
    const auto add = [&](int i, int j) {
        const double a = turn * (i % around) / around, b = turn * (j % across) / across;
        out.positions.emplace_back((1 + 0.4 * std::cos(b)) * std::cos(a), (1 + 0.4 * std::cos(b)) * std::sin(a),
                                   0.4 * std::sin(b));
        out.normals.emplace_back(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
        out.uvs.emplace_back(double(i) / around, double(j) / across);
        out.oracle.emplace_back(-std::sin(a), std::cos(a), 0, 1);
    };
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < around; ++i) {
            add(i, j), add(i + 1, j), add(i + 1, j + 1);
            add(i, j), add(i + 1, j + 1), add(i, j + 1);
        }
    return out;
}

// Twelve floats per corner: position, normal, uv, tangent, sign.
Corners stored(const std::filesystem::path& file) {
    Corners out;
    std::ifstream in(file, std::ios::binary);
    float c[12];
    while (in.read(reinterpret_cast<char*>(c), sizeof c)) {
        out.positions.emplace_back(c[0], c[1], c[2]);
        out.normals.emplace_back(c[3], c[4], c[5]);
        out.uvs.emplace_back(c[6], c[7]);
        out.oracle.emplace_back(c[8], c[9], c[10], c[11]);
    }
    return out;
}

void row(const std::string& name, const Corners& mesh, int threads) {
    const ThreadLimit limit(threads);
    const std::size_t corners = mesh.positions.size();
    std::vector<std::uint32_t> face_begin;
    for (std::size_t c = 0; c <= corners; c += 3) face_begin.push_back(std::uint32_t(c));

    std::vector<Vec4f> copy;
    double difference = 0;
    int signs = 0;
    const auto turns = bench::in_turn(
        5, {[&] {
            copy = std::vector<Vec4f>(corners);
            for (std::size_t c = 0; c < corners; ++c)
                copy[c] = Vec4f(mesh.positions[c] + mesh.normals[c], mesh.uvs[c].x + mesh.uvs[c].y);
        }},
        {{[&] { return corner_tangents(mesh.positions, mesh.normals, mesh.uvs, face_begin); },
          [&](const std::vector<Vec4f>& tangents) {
              std::vector<float> errors;
              for (std::size_t c = 0; c < corners; ++c) {
                  const Vec3d a(tangents[c]), b(mesh.oracle[c]);
                  errors.push_back(float(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / pi));
                  difference = std::max(difference, glm::length(a - b));
                  signs += tangents[c].w != mesh.oracle[c].w;
              }
              return bench::errors_of(std::move(errors));
          }}});
    const bench::Measured& ours = turns.works[0];
    bench::print_row(
        ours, {"tangent_space", name, std::int64_t(corners / 3), double(corners / 3), ours.ratio_to(turns.limits[0]),
               "read+write pass",
               bench::text("median %.2f ms; max |dT| %.2g; %d signs differ", ours.median() * 1e3, difference, signs)});
}

} // namespace

int main(int argc, char** argv) {
    const Corners mesh = torus(500, 250);
    for (const int threads : {1, 2}) row("torus", mesh, threads);
    if (argc < 2) return 0;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
        if (entry.path().extension() == ".f32") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) row(file.stem().string(), stored(file), 0);
}
