// What scripts/bench needs of the files of a table bake.
//
//   table_files_bench --make SIZE OUT                     the 16-bit wave height, one channel
//   table_files_bench --errors TABLE                      mean,p95,max error in degrees of a table of it in --units texel
//   table_files_bench --compare TABLE BUMPSLOPES          the largest difference to a maketx --bumpslopes file of the same
//                                                         height: inside, and on the ring of texels at the border
#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "waves.h"

using namespace bake;

namespace {

/// Slopes per texel, v up: the first two channels of a table of ours, channels 1 and 2 of bumpslopes, whose t is down.
Vec2d slopes(const Image<float>& table, int x, int y) {
    if (table.channels() == 6) return {table.at(x, y, 1), -table.at(x, y, 2)};
    return {table.at(x, y, 0), table.at(x, y, 1)};
}

void compare(const Image<float>& ours, const Image<float>& theirs) {
    double inside = 0, border = 0;
    for (int y = 0; y < ours.height(); ++y)
        for (int x = 0; x < ours.width(); ++x) {
            const Vec2d d = slopes(ours, x, y) - slopes(theirs, x, y);
            double& largest = x > 0 && y > 0 && x < ours.width() - 1 && y < ours.height() - 1 ? inside : border;
            largest = std::max({largest, std::abs(d.x), std::abs(d.y)});
        }
    std::printf("inside %.2g; border ring %.2g per texel\n", inside, border);
}

} // namespace

int main(int argc, char** argv) try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "--make" && argc == 4) {
        write_image(argv[3], bench::wave_texture(std::atoi(argv[2]), 16).values, {.depth = Depth::u16});
    } else if (what == "--errors" && argc == 3) {
        const Image<float> table = read_image(argv[2]);
        const double to_uv = 2 * bench::waves(table.width()).A * table.width();
        const bench::Errors e =
            bench::wave_errors(table.width(), [&](int x, int y) { return to_uv * slopes(table, x, y); });
        std::printf("%.4g,%.4g,%.4g\n", e.mean, e.p95, e.max);
    } else if (what == "--compare" && argc == 4) {
        compare(read_image(argv[2]), read_image(argv[3]));
    } else {
        return std::fprintf(stderr,
                            "usage: table_files_bench --make SIZE OUT | --errors TABLE | --compare TABLE BUMPSLOPES\n"),
               2;
    }
    return 0;
} catch (const Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), int(error.refusal);
}
