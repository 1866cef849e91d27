// cubemap_bench [WIDTH]: time and error of every way to resample a lat-long of WIDTH (2048) to faces of WIDTH / 4, memory
// to memory, in turn; the ratio is to one look per texel. Errors are of radiance, relative to its mean, against the smooth
// sky in closed form (spherical harmonics of bands 0 to 2 and 8); the note has the standard deviation of the flux of 250
// one-texel suns. size counts texels along a face.
// cubemap_bench --make WIDTH OUT.exr: the smooth sky as a lat-long, three float channels, texel-centred.
// cubemap_bench --make-edges WIDTH OUT.exr: the same with OpenEXR's edge samples, tagged.
// cubemap_bench --errors FILE: mean, 95th percentile and largest error of a file that holds it; a lat-long is texel-centred
// unless tagged.
#include "bake/base/vec.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/solid_angle.h"
#include "bake/picture/image_io.h"
#include "bench.h"
#include "environment/smooth_skies.h"
#include <cstring>
#include <random>

using namespace bake;
using test::texel_direction;

namespace {

/// 250 suns of one texel and of one unit of flux, on a spiral, so that each is alone.
Environment suns(int width, std::vector<Vec3d>& directions) {
    const int height = width / 2;
    Environment sky;
    sky.picture = Image<float>(width, height, 1);
    std::fill_n(sky.picture.data(), sky.picture.size(), 0.0f);
    for (int i = 0; i < 250; ++i) {
        const double up = 1 - (2 * i + 1) / 250.0, phi = i * 2.399963229728653, across = std::sqrt(1 - up * up);
        const Vec2d at =
            picture_point(Projection::latlong, width, height, {across * std::sin(phi), up, across * std::cos(phi)});
        const int x = std::min(width - 1, int(at.x)), y = std::min(height - 1, int(at.y));
        directions.push_back(picture_direction(Projection::latlong, width, height, x + 0.5, y + 0.5));
        sky.picture.at(x, y) =
            float(1 / (2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height))));
    }
    return sky;
}

double flux_deviation(const Cube& cube, const std::vector<Vec3d>& directions) {
    double square = 0;
    for (const double f : test::fluxes(cube, directions)) square += (f - 1) * (f - 1) / double(directions.size());
    return std::sqrt(square);
}

Environment smooth_rgb(Projection p, int width) {
    Environment sky;
    sky.projection = p;
    const Environment grey = test::smooth_picture(p, width, width / 2);
    sky.picture = to_rgb(grey.picture);
    return sky;
}

void rows(int width, int threads) {
    const ThreadLimit limit(threads);
    const int n = width / 4;
    const Environment sky = smooth_rgb(Projection::latlong, width);
    std::vector<Vec3d> directions;
    const Environment spots = suns(width, directions);
    const std::pair<const char*, Samples> ways[] = {
        {"one", Samples::one}, {"4x4", Samples::grid4}, {"exact", Samples::exact}};
    std::vector<bench::Work> works;
    for (const auto& way : ways)
        works.push_back({[&sky, n, samples = way.second] {
                             return to_cube(sky, {n, false}, {samples});
                         },
                         [](const Cube& cube) { return bench::errors_of(test::smooth_errors(cube, false)); }});
    const auto found = bench::in_turn(width > 4096 ? 1 : 3, {}, works).works;
    for (std::size_t i = 0; i < 3; ++i) {
        const double deviation = flux_deviation(to_cube(spots, {n, false}, {ways[i].second}), directions);
        bench::print_row(found[i],
                         {"cubemap", ways[i].first, n, 6.0 * n * n, found[i].ratio_to(found[0]), "one look per texel",
                          bench::text("radiance relative to its mean; flux of 250 suns off by %.3g rms; %.2f Mtexel/s",
                                      deviation, 6e-6 * n * n / found[i].median())});
    }
}

int print_errors(const char* file) {
    const Environment sky = read_environment({file});
    const bench::Errors e = bench::errors_of(sky.is_cube() ? test::smooth_errors(sky.cube, sky.edge_samples)
                                                           : test::smooth_errors(sky.picture, sky.projection));
    std::printf("%.4g,%.4g,%.4g\n", e.mean, e.p95, e.max);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first == "--errors" && argc == 3) return print_errors(argv[2]);
    const bool edges = first == "--make-edges";
    if ((first == "--make" || edges) && argc == 4) {
        const Environment sky = smooth_rgb(edges ? Projection::latlong_edges : Projection::latlong, std::atoi(argv[2]));
        write_image(argv[3], sky.picture,
                    {.depth = Depth::float32, .environment = edges ? EnvironmentTag::latlong : EnvironmentTag::none});
        return 0;
    }
    const int width = argc > 1 ? std::atoi(argv[1]) : 2048;
    if (width < 64 || width > 16384 || argc > 2)
        return std::fprintf(
                   stderr,
                   "usage: cubemap_bench [WIDTH] | --make WIDTH FILE | --make-edges WIDTH FILE | --errors FILE\n"),
               2;
    for (const int threads : {1, 0}) rows(width, threads);
    return 0;
}
