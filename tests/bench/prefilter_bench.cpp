// prefilter_bench [FACES]: time and error of mips, irradiance and specular prefilter, memory to memory. FACES, 256 unless
// given, is the size of the sky's faces for the lobes; mips and irradiance take twice that, as from a lat-long of 2K.
//
// The sky is a sun, exp(5000 (c - 1)) * 1000, alone or on a smooth sky. Error columns are |error| over the mean of the
// right answer, not angles: mean, 95th percentile, largest; the note has the root mean square over the mean. Oracles: flux
// for mips, the zonal series of tests/oracle/zonal.h for the rest, which shares no code with what is timed. The limit is a
// pass that reads the sky and writes the result, or, for the lobes, the plain sum over all texels of the sky, timed on
// a few directions and scaled.
//
// prefilter_bench --make FACES FILE: the sun at +Y as a horizontal cross of floats. It is symmetric about the y axis, so
// that it does not matter how a program orients its cubes.
// prefilter_bench --errors ALPHA FACES ...: mean, 95th percentile and largest error of one or more levels of GGX, FACES
// being a name with %s; on stderr the root mean square of each level.
// prefilter_bench --errors-ktx FILE: the same of what is looked up in the levels after the first of a KTX (version 1) for
// Filament, with bilinear interpolation, 16 times per texel. Of half floats or of R11F_G11F_B10F, which cmgen writes.
#include "bake/base/file_bytes.h"
#include "bake/base/vec.h"
#include "bake/environment/engine/roughness_ladder.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/filter/convolve.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/environment/sky/layout.h"
#include "bench.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include <ctime>

using namespace bake;

namespace {

const oracle::Sun sun{.amplitude = 1000, .kappa = 5000};
const Vec3d sun_direction = glm::normalize(Vec3d(0.37, 0.61, 0.53));

/// Bands 0 to 2, on top of which comes the sun.
double smooth(const Vec3d& d) { return 1 + 0.5 * d.y + 0.3 * d.x * d.z; }

Cube sun_sky(int n, bool on_smooth) {
    return test::sky_of(n, 3, [=](const Vec3d& d, int) {
        return sun.radiance(glm::dot(d, sun_direction)) + (on_smooth ? smooth(d) : 0);
    });
}

struct Found {
    bench::Errors errors;
    double rmse = 0; ///< all over the mean
};
template <class Expected>
Found measure(const Cube& out, Expected&& expected, std::vector<float>* errors_out = nullptr) {
    std::vector<double> right;
    double mean = 0;
    test::for_each_texel(out, [&](int face, int x, int y, const float*) {
        right.push_back(expected(test::texel_direction(out.size(), face, x, y)));
        mean += right.back();
    });
    mean /= double(right.size());
    std::vector<float> errors;
    double squares = 0;
    test::for_each_texel(out, [&](int, int, int, const float* value) {
        const double error = std::abs(double(value[0]) - right[errors.size()]) / mean;
        errors.push_back(float(error)), squares += error * error;
    });
    if (errors_out) *errors_out = errors;
    return {bench::errors_of(errors), std::sqrt(squares / double(errors.size()))};
}

double texels(const Cube& cube) { return 6.0 * cube.size() * cube.size(); }

/// The row of a work beside a yardstick, timed in turn. The work's time is on the clock and of all threads together, and its
/// result is measured by found_of(result). scale is what the ratio is multiplied by.
template <class Run, class FoundOf>
void row(const std::string& what, int size, double items, const std::function<void()>& yardstick, Run&& run,
         FoundOf&& found_of, const std::string& against, double scale = 1) {
    std::vector<double> cpu;
    double rmse = 0;
    const auto turns = bench::in_turn(3, {yardstick},
                                      {{[&] {
                                            const std::clock_t start = std::clock();
                                            auto result = run();
                                            cpu.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
                                            return result;
                                        },
                                        [&](const std::invoke_result_t<Run&>& result) {
                                            const Found found = found_of(result);
                                            rmse = found.rmse;
                                            return found.errors;
                                        }}});
    cpu.erase(cpu.begin()); // of the round that is not counted
    const bench::Measured& ours = turns.works[0];
    bench::print_row(ours, {"prefilter", what, size, items, scale * ours.ratio_to(turns.limits[0]), against,
                            bench::text("%.3g s and %.3g CPU s; errors over the mean; RMSE/mean %.3g", ours.median(),
                                        bench::median_of(cpu), rmse)});
}

/// Reads every value once and writes as many as a mip chain has.
void read_and_write(const Cube& sky, std::vector<float>& to) {
    for (int face = 0; face < 6; ++face) {
        const float* from = sky.faces[face].data();
        const std::size_t size = sky.faces[face].size();
        for (std::size_t i = 0; i + 4 <= size; i += 4)
            to[face * (size / 4) + i / 4] = from[i] + from[i + 1] + from[i + 2] + from[i + 3];
    }
}

std::vector<Cube> box_chain(const Cube& sky) {
    std::vector<Cube> chain;
    for (int size = sky.size(); size > 0; size /= 2)
        chain.push_back(resize_by_area(chain.empty() ? sky : chain.back(), size));
    return chain;
}

void mip_rows(const Cube& sky) {
    std::vector<float> scratch(6 * (sky.faces[0].size() / 4));
    for (const bool tent : {true, false}) {
        const auto found = [&](const std::vector<Cube>& chain) -> Found {
            std::vector<float> errors;
            double squares = 0;
            for (const Cube& level : chain) {
                errors.push_back(float(std::abs(test::flux(level) / test::flux(sky) - 1)));
                squares += double(errors.back()) * double(errors.back());
            }
            return {bench::errors_of(errors), std::sqrt(squares / double(errors.size()))};
        };
        row(
            tent ? "mips_tent_flux" : "mips_box_flux", sky.size(), texels(sky), [&] { read_and_write(sky, scratch); },
            [&] { return tent ? mip_chain(sky) : box_chain(sky); }, found, "read+quarter write pass");
    }
}

void irradiance_rows(const Cube& sky, bool on_smooth) {
    const oracle::ConvolvedSun exact(sun, oracle::clamped_cosine);
    const auto expected = [&](const Vec3d& n) {
        return exact(glm::dot(n, sun_direction)) +
               (on_smooth ? pi + 2 * pi / 3 * 0.5 * n.y + pi / 4 * 0.3 * n.x * n.z : 0);
    };
    std::vector<float> scratch(6 * (sky.faces[0].size() / 4));
    using enum IrradianceMethod;
    const std::pair<const char*, IrradianceOptions> cases[] = {{"sh3", {.method = sh, .bands = 3}},
                                                               {"sh9", {.method = sh, .bands = 9}},
                                                               {"sh33", {.method = sh, .bands = 33}},
                                                               {"direct", {.method = direct}}};
    for (const auto& one : cases)
        row(
            std::string("irradiance_") + one.first + (on_smooth ? "_sun_and_sky" : "_sun"), sky.size(), texels(sky),
            [&] { read_and_write(sky, scratch); }, [&] { return irradiance(sky, one.second); },
            [&](const Cube& out) { return measure(out, expected); }, "read+quarter write pass");
}

template <class Lobe, class Kernel>
void lobe_row(const std::string& name, const Cube& sky, int size, const Lobe& lobe, double roughness, SpecularLobe kind,
              Kernel&& kernel) {
    const oracle::ConvolvedSun exact(sun, kernel);
    constexpr int few = 2; // texels along a face of the plain sum, which takes long
    const RadianceTree tree(sky);
    row(
        name, size, 6.0 * size * size, [&] { convolve(tree, lobe, few, {.node_width = 0, .tolerance = 0}); },
        [&] { return prefilter(sky, {.lobe = kind, .roughness = {roughness}, .size = size}); },
        [&](const std::vector<Cube>& chain) {
            return measure(chain[0], [&](const Vec3d& n) { return exact(glm::dot(n, sun_direction)) / exact.norm; });
        },
        "sum over every texel", double(few * few) / (double(size) * size));
}

void lobe_rows(const Cube& sky) {
    int size = sky.size();
    for (const double alpha : {0.018, 0.086, 0.25, 1.0}) {
        size /= 2;
        for (const int edge : {size, sky.size()})
            lobe_row("ggx_" + bench::text("%g", alpha), sky, edge, GgxLobe::of_alpha(alpha), alpha, SpecularLobe::ggx,
                     [=](double c) { return oracle::ggx_kernel(c, alpha); });
    }
    for (const auto& [exponent, edge] : {std::pair{500.0, 2}, {50.0, 4}, {5.0, 8}})
        lobe_row("phong_" + bench::text("%g", exponent), sky, sky.size() / edge, PhongLobe{float(exponent)}, exponent,
                 SpecularLobe::phong, [e = exponent](double c) { return oracle::phong_kernel(c, e); });
}

void make_cross(int faces, const char* file) {
    const Cube sky = test::sky_of(faces, 3, [](const Vec3d& d, int) { return sun.radiance(d.y); });
    write_image(file, paste_faces(sky, CubeLayout::hcross), {.depth = Depth::float32});
}

/// The errors of levels, one after the other.
class LevelErrors {
public:
    void add(double alpha, const Cube& cube) {
        const oracle::ConvolvedSun exact(sun, [=](double c) { return oracle::ggx_kernel(c, alpha); });
        const auto expected = [&](const Vec3d& n) { return exact(n.y) / exact.norm; };
        std::vector<float> errors;
        const Found measured = measure(cube, expected, &errors);
        std::fprintf(stderr, "%s%.3g: %.2g", all_.empty() ? "" : ", ", alpha, measured.rmse);
        all_.insert(all_.end(), errors.begin(), errors.end());
    }
    void print() const {
        const bench::Errors e = bench::errors_of(all_);
        std::printf("%.4g,%.4g,%.4g\n", e.mean, e.p95, e.max);
    }

private:
    std::vector<float> all_;
};

/// `levels`: alpha, name of the faces, alpha, name, ...
void print_errors(char** levels, int count) {
    LevelErrors errors;
    for (int i = 0; i + 1 < count; i += 2)
        errors.add(std::atof(levels[i]), read_faces(find_faces(levels[i + 1]).files));
    errors.print();
}

void print_ktx_errors(const char* path) {
    const FileBytes file = read_file(path);
    const std::string_view bytes(file.begin(), file.size);
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= std::uint32_t(static_cast<unsigned char>(bytes.at(at + i))) << 8 * i;
        return value;
    };
    const auto half = [](std::uint32_t bits) { // positive and finite
        const int exponent = int(bits >> 10);
        return std::ldexp(float((bits & 1023) + (exponent > 0 ? 1024 : 0)), std::max(exponent, 1) - 25);
    };
    const bool halves = word(16) == 0x140b;
    const std::vector<double> ladder = roughness_ladder(Consumer::filament, int(word(36)));
    std::size_t at = 64 + word(60);
    LevelErrors errors;
    for (std::size_t level = 0; level < std::min<std::size_t>(ladder.size(), word(56)); ++level) {
        at += 4;
        Cube cube = make_cube(std::max(1, int(word(36)) >> level), 3);
        for (Image<float>& face : cube.faces)
            for (std::size_t i = 0; i < face.size(); i += 3, at += halves ? 8 : 4) {
                const std::uint32_t w = word(at),
                                    v = halves ? word(at + 4) : 0; // floats of 11, 11 and 10 bits, or of 16
                face.data()[i] = half(halves ? w & 0xffff : (w & 0x7ff) << 4);
                face.data()[i + 1] = half(halves ? w >> 16 : (w >> 11 & 0x7ff) << 4);
                face.data()[i + 2] = half(halves ? v & 0xffff : w >> 22 << 5);
            }
        // As a graphics card looks it up, between the texels too.
        const auto between = [&](const Vec3d& d, int) {
            float value[3];
            lookup(cube, d, value);
            return value[0];
        };
        if (level > 0) errors.add(ladder[level], test::sky_of(4 * cube.size(), 1, between));
    }
    errors.print();
}

} // namespace

int main(int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first == "--make" && argc == 4) return make_cross(std::atoi(argv[2]), argv[3]), 0;
    if (first == "--errors" && argc > 3) return print_errors(argv + 2, argc - 2), 0;
    if (first == "--errors-ktx" && argc == 3) return print_ktx_errors(argv[2]), 0;
    const int faces = argc > 1 ? std::atoi(argv[1]) : 256;
    if (argc > 2 || faces < 32 || faces > 2048)
        return std::fprintf(
                   stderr,
                   "usage: prefilter_bench [FACES], 32 to 2048 | --make FACES FILE | --errors ALPHA FACES ...\n"),
               2;
    const Cube sun_alone = sun_sky(faces, false), sun_2k = sun_sky(2 * faces, false),
               sun_and_sky_2k = sun_sky(2 * faces, true);
    for (const int threads : {1, 0}) {
        const ThreadLimit limit(threads);
        mip_rows(sun_2k);
        irradiance_rows(sun_2k, false);
        if (threads == 1) irradiance_rows(sun_and_sky_2k, true);
        lobe_rows(sun_alone);
    }
}
