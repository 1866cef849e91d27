// tangent_space_bench [FOLDER]: time and error of corner_tangents on a torus of 250,000 triangles, the oracle being the
// closed-form dp/du, and on each FOLDER/*.f32, the oracle being the reference tangents stored there.
// Rows: bench,case,size,threads,ns_per_item,error_mean_deg,error_p95_deg,error_max_deg,ratio,against,note
// size counts triangles; ratio is the time over that of reading the input once and writing the output once.
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/surface/chart/tangent_space.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

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

template <class Work> double seconds(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void row(const std::string& name, const Corners& mesh, int threads) {
    const ThreadLimit limit(threads);
    const std::size_t corners = mesh.positions.size();
    std::vector<std::uint32_t> face_begin;
    for (std::size_t c = 0; c <= corners; c += 3) face_begin.push_back(std::uint32_t(c));

    std::vector<Vec4f> tangents, copy;
    std::vector<double> times, passes;
    for (int run = 0; run < 5; ++run) {
        times.push_back(
            seconds([&] { tangents = corner_tangents(mesh.positions, mesh.normals, mesh.uvs, face_begin); }));
        passes.push_back(seconds([&] {
            copy = std::vector<Vec4f>(corners);
            for (std::size_t c = 0; c < corners; ++c)
                copy[c] = Vec4f(mesh.positions[c] + mesh.normals[c], mesh.uvs[c].x + mesh.uvs[c].y);
        }));
    }
    const double first = times[0];
    std::sort(times.begin(), times.end());
    std::sort(passes.begin(), passes.end());

    std::vector<double> errors;
    double sum = 0, difference = 0;
    int signs = 0;
    for (std::size_t c = 0; c < corners; ++c) {
        const Vec3d a(tangents[c]), b(mesh.oracle[c]);
        errors.push_back(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / pi);
        sum += errors.back();
        difference = std::max(difference, glm::length(a - b));
        signs += tangents[c].w != mesh.oracle[c].w;
    }
    std::sort(errors.begin(), errors.end());
    std::printf("tangent_space,%s,%zu,%d,%.1f,%.3g,%.3g,%.3g,%.1f,read+write pass,", name.c_str(), corners / 3,
                thread_count(), times[2] * 1e9 / double(corners / 3), sum / double(corners), errors[corners * 95 / 100],
                errors.back(), times[2] / passes[2]);
    std::printf("first run %.2f ms; median %.2f ms; max |dT| %.2g; %d signs differ\n", first * 1e3, times[2] * 1e3,
                difference, signs);
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
