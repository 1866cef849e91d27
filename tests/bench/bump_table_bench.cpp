// bump_table_bench [SIZE ...]: time and error of every filter's kernel, memory to memory, beside the physical limit
// measured in turn: one pass that reads 4 and writes 8 bytes per texel by the same for_rows; for c2, whose spline is
// separable, that pass and one that reads and writes the height once more. Size counts texels along a side.
// The oracle is the closed form of the wave relief that the height holds, on a plane of extent 1 x 1.
#include "waves.h"

using namespace bake;

namespace {

constexpr int grain = 16;

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
    const HeightTexture height = bench::wave_texture(size, bits);
    Image<float> table(size, size, 2), copy(size, size, 1);
    for (const Filter filter : all_filters) {
        const BumpTable kernel(height, {.filter = filter, .amplitude = 2 * bench::waves(size).A});
        const bool two_passes = filter == Filter::c2;
        const double texels = double(size) * size;
        const auto turns = bench::in_turn(7, {[&] {
                                              read_4_write_8(height.values, table);
                                              if (two_passes) read_4_write_4(height.values, copy);
                                          }},
                                          {{[&]() -> const Image<float>& {
                                                for_rows(size, grain, [&](std::int64_t begin, std::int64_t end) {
                                                    SlopeFilter<float>::Scratch scratch;
                                                    for (auto y = int(begin); y < int(end); ++y)
                                                        kernel.row(y, table.row(y), scratch);
                                                });
                                                return table;
                                            },
                                            [&](const Image<float>& found) {
                                                return bench::wave_errors(size, [&](int x, int y) {
                                                    return Vec2d(found.at(x, y, 0), found.at(x, y, 1));
                                                });
                                            }}});
        const bench::Measured& ours = turns.works[0];
        const double limit_ns = 1e9 * turns.limits[0].median() / texels;
        bench::print_row(ours, {"bump_table",
                                std::string(name(filter)) + (bits ? "_" + std::to_string(bits) + "bit" : "_float"),
                                size, texels, ours.ratio_to(turns.limits[0]),
                                two_passes ? "two read+write passes" : "read+write pass",
                                bench::text("limit %.3f ns; %.1f ms in all", limit_ns, 1e3 * ours.median())});
    }
}

} // namespace

int main(int argc, char** argv) {
    std::vector<int> sizes;
    for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
    if (sizes.empty()) sizes = {4096};
    for (const int size : sizes)
        if (size < 64 || size > 32768)
            return std::fprintf(stderr, "usage: bump_table_bench [SIZE ...], 64 to 32768\n"), 2;
    for (const int size : sizes) {
        for (const int threads : {1, 0}) rows(size, 16, threads);
        if (size == sizes[0]) rows(size, 8, 0), rows(size, 0, 0);
    }
}
