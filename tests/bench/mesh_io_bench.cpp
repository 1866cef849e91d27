// Seconds of read_mesh and write_mesh, beside the limit: one plain read or write of the same bytes, in turn in one run.
//
//   mesh_io_bench FILE [repeats]                                 median of each, MB/s, their ratio
//   mesh_io_bench --make-quads N OUT [--no-normals] [repeats]    a wavy grid of about N quads, by OUT's ending
//
// The error column of a reader is 0 by test: every number is the float nearest to its text (tests/mesh/file/mesh_io_test).
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/triangulate.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/resource.h>
#include <unistd.h>

namespace {
using namespace bake;

/// Of all threads: what a run takes whatever else the machine does.
double processor_seconds() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(use.ru_utime) + seconds(use.ru_stime);
}

template <class F> double seconds_of(F&& f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Reads the file through one small buffer per piece and looks at every byte.
std::uint64_t plain_read(const char* path, std::int64_t size) {
    const int file = open(path, O_RDONLY);
    const std::int64_t grain = 1 << 20;
    std::vector<std::uint64_t> sums(std::size_t((size + grain - 1) / grain));
    for_rows(size, grain, [&](std::int64_t begin, std::int64_t end) {
        static thread_local std::vector<std::uint64_t> words(grain / 8);
        const ssize_t got = pread(file, words.data(), std::size_t(end - begin), begin);
        std::uint64_t sum = 0;
        for (ssize_t i = 0; i < got / 8; ++i) sum += words[std::size_t(i)];
        sums[std::size_t(begin / grain)] = sum;
    });
    close(file);
    std::uint64_t sum = 0;
    for (const std::uint64_t s : sums) sum += s;
    return sum;
}

Mesh wavy_grid(std::size_t quads, bool normals) {
    const auto n = std::uint32_t(std::lround(std::sqrt(double(quads))));
    const auto rounded = [](double v, double decimals) { return float(std::round(v * decimals) / decimals); };
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = double(i) / n, z = double(j) / n;
            mesh.positions.emplace_back(rounded(x, 1e4), rounded(0.05 * std::sin(20 * x) * std::cos(17 * z), 1e4),
                                        rounded(z, 1e4));
            mesh.uvs.emplace_back(rounded(x, 1e4), rounded(z, 1e4));
            const Vec3d slope(-std::cos(20 * x) * std::cos(17 * z), 1, 0.85 * std::sin(20 * x) * std::sin(17 * z));
            const Vec3d unit = glm::normalize(slope);
            if (normals) mesh.normals.emplace_back(rounded(unit.x, 1e4), rounded(unit.y, 1e4), rounded(unit.z, 1e4));
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            for (const std::uint32_t c : {a, a + n + 1, a + n + 2, a + 1}) mesh.corner_position.push_back(c);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
    mesh.corner_uv = mesh.corner_position;
    if (normals) mesh.corner_normal = mesh.corner_position;
    return mesh;
}

/// Writes the file's bytes once more, from memory, in blocks: what cp does.
void plain_write(const std::string& path, const std::vector<char>& bytes) {
    std::FILE* const out = std::fopen(path.c_str(), "wb");
    for (std::size_t at = 0; at < bytes.size(); at += 1 << 20)
        std::fwrite(&bytes[at], 1, std::min<std::size_t>(1 << 20, bytes.size() - at), out);
    std::fclose(out);
}

void measure_write(const Mesh& mesh, const std::string& path, int repeats) {
    std::vector<double> write, limit, processor;
    std::vector<char> bytes;
    for (int i = 0; i < repeats; ++i) {
        const double before = processor_seconds();
        write.push_back(seconds_of([&] { write_mesh(path, mesh); }));
        processor.push_back(processor_seconds() - before);
        if (bytes.empty()) {
            bytes.resize(std::filesystem::file_size(path));
            std::FILE* const in = std::fopen(path.c_str(), "rb");
            if (std::fread(bytes.data(), 1, bytes.size(), in) != bytes.size()) std::abort();
            std::fclose(in);
        }
        limit.push_back(seconds_of([&] { plain_write(path + ".copy", bytes); }));
        std::filesystem::remove(path + ".copy");
    }
    const double mega = 1e-6 * double(bytes.size());
    std::printf("%s: %.1f MB, %zu faces, %d threads, median of %d\n", path.c_str(), mega, mesh.faces(), thread_count(),
                repeats);
    std::printf("write_mesh   %8.4f s  %8.0f MB/s  (%.4f s of processors)\n", median(write), mega / median(write),
                median(processor));
    std::printf("plain write  %8.4f s  %8.0f MB/s  (the limit; ratio %.1f)\n", median(limit), mega / median(limit),
                median(write) / median(limit));
}

void measure(const char* path, int repeats) {
    const auto size = std::int64_t(std::filesystem::file_size(path));
    std::vector<double> read, limit, split;
    std::uint64_t sum = plain_read(path, size); // warms the page cache
    std::size_t faces = 0, triangles = 0;
    for (int i = 0; i < repeats; ++i) {
        Mesh mesh;
        read.push_back(seconds_of([&] { mesh = read_mesh(path); }));
        limit.push_back(seconds_of([&] { sum += plain_read(path, size); }));
        split.push_back(seconds_of([&] { triangles = triangulate(mesh).size(); }));
        faces = mesh.faces();
    }
    const double mega = double(size) * 1e-6;
    std::printf("%s: %.1f MB, %zu faces, %d threads, median of %d\n", path, mega, faces, thread_count(), repeats);
    std::printf("read_mesh    %8.4f s  %8.0f MB/s\n", median(read), mega / median(read));
    std::printf("plain read   %8.4f s  %8.0f MB/s  (the limit; ratio %.1f, sum %llx)\n", median(limit),
                mega / median(limit), median(read) / median(limit), static_cast<unsigned long long>(sum));
    std::printf("triangulate  %8.4f s  %8.1f ns per triangle\n", median(split),
                1e9 * median(split) / double(triangles));
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc >= 4 && std::strcmp(argv[1], "--make-quads") == 0) {
            const bool normals = argc < 5 || std::strcmp(argv[4], "--no-normals") != 0;
            const Mesh mesh = wavy_grid(std::size_t(std::atoll(argv[2])), normals);
            const int repeats = std::atoi(argv[argc - 1]);
            measure_write(mesh, argv[3], argc > 4 && repeats > 0 ? repeats : 1);
            return 0;
        }
        if (argc == 2 || argc == 3) {
            measure(argv[1], argc == 3 ? std::max(1, std::atoi(argv[2])) : 5);
            return 0;
        }
        std::fprintf(stderr, "usage: mesh_io_bench FILE [repeats] | --make-quads N OUT [--no-normals] [repeats]\n");
        return 2;
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return int(error.refusal);
    }
}
