// bump_table_bench [SIZE ...]: time and error of every filter's kernel, memory to memory, beside the physical limit
// measured in turn: one pass that reads 4 and writes 8 bytes per texel by the same for_rows; for c2, whose spline is
// separable, that pass and one that reads and writes the height once more. Size counts texels along a side.
// The oracle is the closed form of the wave relief that the height holds, on a plane of extent 1 x 1.
#include "bench.h"
#include "relief/torus_relief.h"
#include <cmath>

using namespace bake;

namespace {

constexpr int grain = 16;

/// Waves of 64 x 32 texels, steepest slope 0.5 along u.
oracle::TorusRelief waves(int size) { return {0.5 / (2 * oracle::pi * size / 64), size / 64, size / 32}; }

/// As oracle::relief_texture, from one sine per row and per column.
HeightTexture wave_texture(const oracle::TorusRelief& r, int size, int bits) {
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    height.levels = bits == 8 ? 256 : 257;
    const double largest = std::exp2(bits) - 1;
    for_rows(size, grain, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> along_u(size);
        for (int x = 0; x < size; ++x) along_u[x] = std::sin(2 * oracle::pi * r.k * (x + 0.5) / size);
        for (auto y = int(begin); y < int(end); ++y) {
            const double along_v = std::sin(2 * oracle::pi * r.m * (1 - (y + 0.5) / size));
            for (int x = 0; x < size; ++x) {
                const double value = along_u[x] * along_v / 2 + 0.5;
                height.values.at(x, y) = float(bits > 0 ? std::round(value * largest) / largest : value);
            }
        }
    });
    return height;
}

/// Angles between the normals (-b_u, -b_v, 1) of the table and of the closed form: every third row, and the last.
bench::Errors table_errors(const Image<float>& table, const oracle::TorusRelief& r) {
    const int size = table.width(), rows = (size + 2) / 3 + 1;
    std::vector<float> errors(std::size_t(rows) * size);
    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto j = int(begin); j < int(end); ++j) {
            const int y = std::min(3 * j, size - 1);
            for (int x = 0; x < size; ++x) {
                const Height<double> h = oracle::relief(r, (x + 0.5) / size, 1 - (y + 0.5) / size);
                errors[std::size_t(j) * size + x] = float(oracle::angle_deg({-table.at(x, y, 0), -table.at(x, y, 1), 1}, {-h.b_u, -h.b_v, 1}));
            }
        }
    });
    return bench::errors_of(std::move(errors));
}

void read_4_write_8(const Image<float>& from, Image<float>& to) {
    for_rows(from.height(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* a = from.row(y);
            float* b = to.row(y);
            for (int x = 0; x < from.width(); ++x) {
                b[2 * x] = a[x];
                b[2 * x + 1] = a[x];
            }
        }
    });
}

void read_4_write_4(const Image<float>& from, Image<float>& to) {
    for_rows(from.height(), grain, [&](std::int64_t begin, std::int64_t end) {
        std::copy(from.row(int(begin)), from.row(int(begin)) + (end - begin) * from.width(), to.row(int(begin)));
    });
}

void rows(int size, int bits, int threads) {
    const ThreadLimit limit(threads);
    const oracle::TorusRelief relief = waves(size);
    const HeightTexture height = wave_texture(relief, size, bits);
    Image<float> table(size, size, 2), copy(size, size, 1);
    for (const Filter filter : all_filters) {
        const BumpTable kernel(height, {.filter = filter, .amplitude = 2 * relief.A});
        const bool two_passes = filter == Filter::c2;
        const auto times = bench::in_turn(7, {
            [&] {
                read_4_write_8(height.values, table);
                if (two_passes) read_4_write_4(height.values, copy);
            },
            [&] {
                for_rows(size, grain, [&](std::int64_t begin, std::int64_t end) {
                    SlopeFilter<float>::Scratch scratch;
                    for (auto y = int(begin); y < int(end); ++y) kernel.row(y, table.row(y), scratch);
                });
            }});
        const double texels = double(size) * size;
        bench::print_row("bump_table", std::string(name(filter)) + (bits ? "_" + std::to_string(bits) + "bit" : "_float"), size,
                         1e9 * times[1].median() / texels, table_errors(table, relief), times[1].ratio_to(times[0]),
                         two_passes ? "two read+write passes" : "read+write pass",
                         bench::text("limit %.3f ns; %.1f ms in all", 1e9 * times[0].median() / texels, 1e3 * times[1].median()));
    }
}

} // namespace

int main(int argc, char** argv) {
    std::vector<int> sizes;
    for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
    if (sizes.empty()) sizes = {4096};
    for (const int size : sizes)
        if (size < 64 || size > 32768) return std::fprintf(stderr, "usage: bump_table_bench [SIZE ...], 64 to 32768\n"), 2;
    for (const int size : sizes) {
        for (const int threads : {1, 0}) rows(size, 16, threads);
        if (size == sizes[0]) rows(size, 8, 0), rows(size, 0, 0);
    }
}
