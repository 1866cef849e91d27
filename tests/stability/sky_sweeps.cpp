// Environments: edges and corners of the cube, degenerate directions, suns of one texel, poles of lat-long pictures.
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/solid_angle.h"
#include "environment/skies.h"
#include "stability/themes.h"
#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace bake;

namespace stability {
namespace {

std::vector<int> sizes(int most, int steps) {
    std::vector<int> all;
    for (const double x : geometric_steps(1, most, steps))
        if (const int n = int(std::lround(x)); all.empty() || n > all.back()) all.push_back(n);
    return all;
}

std::vector<Row> solid_angle_rows(int steps) {
    std::vector<Row> rows;
    for (const int n : sizes(1024, steps)) {
        const std::vector<double> omega = texel_solid_angles(n);
        const double sum = 6 * std::accumulate(omega.begin(), omega.end(), 0.0);
        rows.push_back({"sum", double(n), std::abs(sum / (4 * pi) - 1), 0.0, "differences of one table of corners"});
    }
    for (const int n : sizes(1024, steps)) {
        const std::vector<double> omega = texel_solid_angles(n);
        const auto two_triangles = [n](int x, int y) { return test::texel_solid_angle(n, x, y); };
        const double worst = std::max(std::abs(omega[std::size_t(n / 2 * n + n / 2)] / two_triangles(n / 2, n / 2) - 1),
                                      std::abs(omega[0] / two_triangles(0, 0) - 1));
        // A texel is (2 / n)^2 of a face or a fifth of that, and a difference of numbers of about 1.
        rows.push_back({"one texel", double(n), worst, double(n) * n * 0x1p-53, "differences of one table of corners"});
    }
    return rows;
}

/// The largest change of a lookup over a step of `step` rad, along great circles: those of them whose ends lie on two faces, or
/// on one.
struct Steps {
    double across = 0, inside = 0;
};

Steps largest_steps(const Cube& sky, const std::vector<Vec3d>& middles, double step) {
    Steps largest;
    for (const Vec3d& middle : middles)
        for (int turn = 0; turn < 8; ++turn) {
            const Vec3d aside = glm::normalize(glm::cross(middle, Vec3d(0.31, 0.77, -0.56)));
            const double angle = turn * pi / 8;
            const Vec3d along = std::cos(angle) * aside + std::sin(angle) * glm::cross(middle, aside);
            for (int i = -40; i < 40; ++i) {
                const Vec3d a = middle + (i + 0.5) * step * along, b = middle + (i + 1.5) * step * along;
                float at_a = 0, at_b = 0;
                lookup(sky, a, &at_a), lookup(sky, b, &at_b);
                double& most = cube_point(a).face != cube_point(b).face ? largest.across : largest.inside;
                most = std::max(most, std::abs(double(at_a) - double(at_b)));
            }
        }
    return largest;
}

std::vector<Row> seam_rows(int steps) {
    std::vector<Vec3d> edges, corners;
    for (int i = 0; i < 12; ++i) {
        const double part = 0.13 + 0.06 * i, sign = i % 2 ? 1 : -1;
        Vec3d d(0);
        d[i % 3] = 1, d[(i + 1) % 3] = sign, d[(i + 2) % 3] = 2 * part - 1;
        edges.push_back(glm::normalize(d));
    }
    for (int i = 0; i < 8; ++i)
        corners.push_back(glm::normalize(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    std::vector<Row> rows;
    for (const auto& [name, middles] : {std::pair("edges", &edges), {"corners", &corners}})
        for (const int n : sizes(256, steps)) {
            const Cube sky = test::rough_sky(n, 1);
            const Steps fine = largest_steps(sky, *middles, 1e-4 / n), finer = largest_steps(sky, *middles, 1e-6 / n);
            // Of a value that does not jump a step of a hundredth is a hundredth.
            rows.push_back({name, double(n), fine.across > 0 ? finer.across / fine.across : 0.0, 0.01,
                            "neighbours are found across edges; at a corner the fourth texel is the mean of three"});
        }
    return rows;
}

template <class T> double point_error(T scale) {
    double worst = 0;
    const Vec3d given(-3.2, 5.1, -8.4); // the lecture's example: nz at .690476, .196429
    const Vec3<T> d = Vec3<T>(given) / T(8.4) * scale;
    const CubePoint<T> point = cube_point(d);
    if (point.face != CubeFace::nz) return 1;
    worst = std::max(std::abs(double(point.s) - (3.2 / 8.4 + 1) / 2), std::abs(double(point.t) - (1 - 5.1 / 8.4) / 2));
    return worst;
}

std::vector<Row> short_rows(int steps) {
    std::vector<Row> rows;
    const auto told = [](double x, double least) {
        return std::string(x >= least ? "divided by the major axis: exact at any length"
                                      : "denormal components have few digits left; the zero vector is ahead: pz");
    };
    for (const double x : geometric_steps(1, 1e-44, steps)) {
        const double predicted = std::max(std::exp2(-25), 0.25 / (x / std::exp2(-149)));
        rows.push_back({"float", x, point_error(float(x)), std::min(1.0, predicted),
                        told(x, double(std::numeric_limits<float>::min()))});
    }
    for (const double x : geometric_steps(1, 1e-322, steps)) {
        const double predicted = std::max(std::exp2(-54), 0.25 / (x / std::numeric_limits<double>::denorm_min()));
        rows.push_back(
            {"double", x, point_error(x), std::min(1.0, predicted), told(x, std::numeric_limits<double>::min())});
    }
    return rows;
}

/// A sky that is black but for one texel of unit flux: on a face, at an edge, in a corner.
Cube one_texel(int n, int x, int y) {
    Cube sky = test::even_sky(n, 1, 0);
    sky.faces[4].at(x, y) = float(1 / test::texel_solid_angle(n, x, y));
    return sky;
}

double flux(const Cube& sky) {
    const std::vector<double> omega = texel_solid_angles(sky.size());
    double sum = 0;
    for (const Image<float>& face : sky.faces)
        for (std::size_t i = 0; i < omega.size(); ++i) sum += omega[i] * double(face.data()[i]);
    return sum;
}

std::vector<Row> sun_flux_rows(int steps) {
    std::vector<Row> rows;
    for (const auto& [name, x, y] : {std::tuple("middle", 0.5, 0.5), {"edge", 1.0, 0.5}, {"corner", 1.0, 1.0}})
        for (const int n : sizes(256, steps)) {
            const auto texel = [n](double part) { return std::min(n - 1, int(part * n)); };
            double worst = 0;
            for (const Cube& level : mip_chain(one_texel(n, texel(x), texel(y))))
                worst = std::max(worst, std::abs(flux(level) - 1));
            rows.push_back({name, double(n), worst, 0.0, "mips exchange flux and lose none, down to 1 x 1"});
        }
    return rows;
}

/// Irradiance of a far sun of unit flux towards it: the band factors of the clamped cosine, by their closed form.
double cosine_bands(int bands) {
    double sum = 0;
    for (int l = 0; l < bands; ++l) {
        if (l > 1 && l % 2) continue;
        double factor = l == 0 ? pi : 2 * pi / 3;
        if (l > 1) {
            factor = 2 * pi * (l / 2 % 2 ? 1.0 : -1.0) / double((l + 2) * (l - 1)); // Ramamoorthi and Hanrahan 2001
            for (int k = 1; k <= l; ++k) factor *= k <= l / 2 ? double(k + l / 2) / k / 4 : 1.0; // l! / (2^l (l/2)!^2)
        }
        sum += (2 * l + 1) / (4 * pi) * factor;
    }
    return sum;
}

std::vector<Row> sun_bands_rows(int steps) {
    const int n = 65; // the sun is at the centre of a texel, and of the face
    const Cube sky = one_texel(n, n / 2, n / 2);
    std::vector<Row> rows;
    std::vector<int> fewer = sizes(64, steps); // from many bands to one: the error grows
    std::reverse(fewer.begin(), fewer.end());
    const auto towards = [&](const Cube& light) { return double(light.faces[4].at(0, 0)); };
    for (const int bands : fewer) {
        const Cube light = irradiance(sky, {.method = IrradianceMethod::sh, .bands = bands, .size = 1});
        rows.push_back({"sh", double(bands), std::abs(towards(light) - 1), std::abs(cosine_bands(bands) - 1),
                        "--irradiance sh:N; three bands are 6 % off for one sun"});
    }
    const Cube light = irradiance(sky, {.method = IrradianceMethod::direct, .size = 1});
    for (const int bands : fewer)
        rows.push_back(
            {"direct", double(bands), std::abs(towards(light) - 1), 0.0, "--irradiance direct: a sum over all texels"});
    return rows;
}

std::vector<Row> pole_rows(int steps) {
    Environment sky;
    sky.picture = Image<float>(64, 32, 1);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < sky.picture.size(); ++i) sky.picture.data()[i] = float(random() % 1000) / 1000;
    std::vector<Row> rows;
    for (const double x : geometric_steps(1, 1e-12, steps)) {
        double worst = 0;
        for (int i = 0; i < 64; ++i) {
            const double a = 2 * pi * (i + 0.3) / 64;
            const Vec3d d(std::sin(x) * std::sin(a), std::cos(x), std::sin(x) * std::cos(a));
            const Vec2d p = picture_point(Projection::latlong, 64, 32, d);
            worst = std::max(worst, glm::length(picture_direction(Projection::latlong, 64, 32, p.x, p.y) - d));
        }
        rows.push_back({"direction to point and back (rad)", x, worst, std::max(0x1p-52, std::min(x, 0x1p-53 / x)),
                        "the height is an arc sine: right to 1e-8 rad"});
    }
    for (const double x : geometric_steps(1, 1e-12, steps)) {
        std::vector<float> values;
        for (int i = 0; i < 64; ++i) {
            const double a = 2 * pi * (i + 0.5) / 64; // opposite columns meet
            const Vec3d d(std::sin(x) * std::sin(a), std::cos(x), std::sin(x) * std::cos(a));
            values.push_back(0), sample(sky, &d, 1, &values.back());
        }
        double opposite = 0;
        for (int i = 0; i < 32; ++i)
            opposite =
                std::max(opposite, std::abs(double(values[std::size_t(i)]) - double(values[std::size_t(i + 32)])));
        rows.push_back({"difference to the opposite direction", x, opposite, std::min(1.0, 2 * 32 / pi * x),
                        "the row across the pole is the same row, half a turn on"});
    }
    return rows;
}

/// Those of the cube itself.
std::vector<Sweep> cube_sweeps() {
    const char* const test = "stability/sky_test";
    return {{.name = "texel_solid_angles",
             .construction =
                 "faces of x texels: error of the sum of all solid angles, and of those at the centre and in a corner",
             .x_label = "texels along an edge",
             .y_label = "relative error",
             .log_x = true,
             .log_y = true,
             .limit = 1e-9,
             .closed_form = "4 pi; two spherical triangles per texel, x^2 2^-53 by cancellation",
             .test = test,
             .rows = solid_angle_rows},
            {.name = "cube_seams",
             .construction =
                 "lookups in a sky of random texels along great circles across edges and corners of the cube: largest "
                 "change over a short step, relative to that over a step 100 times as long",
             .x_label = "texels along an edge",
             .y_label = "ratio (1: a jump)",
             .log_x = true,
             .log_y = true,
             .limit = 0.1,
             .closed_form = "1 / 100: the interpolation is continuous",
             .test = test,
             .rows = seam_rows},
            {.name = "short_directions",
             .construction = "the lecture's direction (-3.2, 5.1, -8.4), x long: error of its point on the face",
             .x_label = "length",
             .y_label = "error (faces)",
             .log_x = true,
             .log_y = true,
             .limit = 1e-3,
             .closed_form = "half a step of denormals over the length",
             .test = test,
             .rows = short_rows}};
}

} // namespace

std::vector<Sweep> sky_sweeps() {
    const char* const test = "stability/sky_test";
    const std::vector<Sweep> others = {
        {.name = "sun_flux",
         .construction = "one bright texel of a face of x texels: largest error of the flux over all mips",
         .x_label = "texels along an edge",
         .y_label = "relative error",
         .log_x = true,
         .log_y = true,
         .limit = 1e-4,
         .closed_form = "0",
         .test = test,
         .rows = sun_flux_rows},
        {.name = "sun_bands",
         .construction = "the irradiance of one bright texel towards it, by x bands of spherical harmonics",
         .x_label = "bands",
         .y_label = "relative error",
         .log_x = true,
         .log_y = true,
         .limit = 0.01,
         .closed_form = "sum of (2 l + 1) / (4 pi) A_l over l < x, less 1; direct: 0",
         .test = test,
         .rows = sun_bands_rows},
        {.name = "latlong_pole",
         .construction = "directions around the pole of a lat-long picture of random texels, at an angle x from it",
         .x_label = "angle from the pole (rad)",
         .y_label = "error, difference",
         .log_x = true,
         .log_y = true,
         .limit = 1.01,
         .closed_form = "2^-53 / x, at most x; two steps of rows over their height, which go to 0 at the pole",
         .test = test,
         .rows = pole_rows},
    };
    std::vector<Sweep> all = cube_sweeps();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

} // namespace stability
