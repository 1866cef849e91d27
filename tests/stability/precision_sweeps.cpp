// Kernels in float against the same in double, over what makes floats too coarse.
#include "bake/light/light.h"
#include "bake/preview/sky.h"
#include "bake/ray/camera.h"
#include "environment/skies.h"
#include "stability/themes.h"
#include <random>

using namespace bake;

namespace stability {
namespace {

constexpr double eps = 0x1p-24; ///< half a step of floats at 1

Vec3d any_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3d(normal(random), normal(random), normal(random)));
}

/// Lookups of the tracer's sky against those in double: what the rounding of the point on a face does.
std::vector<Row> lookup_rows(int steps) {
    std::vector<Row> rows;
    for (const double x : geometric_steps(1, 256, steps)) {
        const int n = int(std::lround(x));
        const Cube sky = test::rough_sky(n, 3);
        std::mt19937 random(3);
        double worst = 0, steepest = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3f d(any_direction(random));
            float wide[3], beside[3];
            lookup(sky, Vec3d(d), wide);
            lookup(sky, Vec3d(d) + Vec3d(1e-4 / n, -1e-4 / n, 1e-4 / n), beside);
            const double scale = std::abs(double(wide[0])) + 1e-3;
            worst = std::max(worst, std::abs(double(fast_lookup(sky, d).x) - double(wide[0])) / scale);
            steepest = std::max(steepest, std::abs(double(beside[0]) - double(wide[0])) / scale / (1e-4 / n));
        }
        rows.push_back({"", double(n), worst, std::max(4.0, steepest) * eps,
                        "float: a point on a face is right to 1e-7 of the face"});
    }
    return rows;
}

/// A point light at the distance 1 from a point that is x away from the origin.
std::vector<Row> light_rows(int steps) {
    std::vector<Row> rows;
    for (const double x : geometric_steps(1, 1e8, steps)) {
        std::mt19937 random(4);
        double worst = 0;
        for (int i = 0; i < 400; ++i) {
            Light<double> light;
            light.kind = LightKind::point, light.falloff = {0, 0, 1};
            const Vec3d p = x * any_direction(random);
            light.position = p + any_direction(random);
            Light<float> narrow;
            narrow.kind = LightKind::point, narrow.falloff = {0, 0, 1};
            narrow.position = Vec3f(light.position);
            worst = std::max(worst, std::min(2.0, glm::length(Vec3d(sample(narrow, Vec3f(p)).l) - sample(light, p).l)));
        }
        // Both points are rounded; their steps grow by powers of two.
        rows.push_back({"", x, worst, std::min(2.0, 2 * x * eps),
                        x < 10 ? "as it is" : "a far scene is moved to its own centre before it is traced"});
    }
    return rows;
}

/// Rays through the pixels of a wide picture: how far, in pixels, a ray is off that of the closed form.
std::vector<Row> ray_rows(int steps) {
    std::vector<Row> rows;
    const Camera camera{.position = {0, 0, 5}, .target = {1, 2, -3}, .fov_deg = 40};
    const CameraFrame frame = camera_frame(camera);
    for (const double x : geometric_steps(16, 1e8, steps)) {
        const int n = int(x);
        std::mt19937 random(6);
        const double half = std::tan(20 * pi / 180);
        const Vec3d forward = glm::normalize(Vec3d(1, 2, -8)),
                    right = glm::normalize(glm::cross(forward, Vec3d(0, 1, 0)));
        const Vec3d up = glm::cross(right, forward);
        double worst = 0;
        for (int i = 0; i < 400; ++i) {
            const double px = double(random() % 100000) / 100000 * n, py = double(random() % 100000) / 100000 * n;
            const Vec3d d(primary_ray(frame, px, py, n, n).direction);
            // Back onto the picture plane.
            const double at_x = (glm::dot(d, right) / glm::dot(d, forward) / half + 1) / 2 * n;
            const double at_y = (1 - glm::dot(d, up) / glm::dot(d, forward) / half) / 2 * n;
            worst = std::max({worst, std::abs(at_x - px), std::abs(at_y - py)});
        }
        rows.push_back({"", x, worst, 0.5 * x * eps / half,
                        x <= 65536 ? "rays are floats: less than a hundredth of a pixel up to 65536 pixels"
                                   : "wider than the widest picture that can be written"});
    }
    return rows;
}

} // namespace

std::vector<Sweep> precision_sweeps() {
    const char* const test = "stability/precision_test";
    return {
        {.name = "float_lookup",
         .construction =
             "the tracer's lookup in a sky of random texels, in float, against that in double; faces of x texels",
         .x_label = "texels along an edge",
         .y_label = "largest relative error",
         .log_x = true,
         .log_y = true,
         .limit = 1e-3,
         .closed_form = "the steepest slope of the sky times 2^-24",
         .test = test,
         .rows = lookup_rows},
        {.name = "float_light",
         .construction = "direction to a point light at the distance 1 from a point x away from the origin",
         .x_label = "distance from the origin",
         .y_label = "error of the direction",
         .log_x = true,
         .log_y = true,
         .limit = 1e-3,
         .closed_form = "2 x 2^-24",
         .test = test,
         .rows = light_rows},
        {.name = "float_ray",
         .construction = "rays of a camera of 40 deg through a picture of x pixels against the closed form in double",
         .x_label = "pixels along an edge",
         .y_label = "largest error (pixels)",
         .log_x = true,
         .log_y = true,
         .limit = 0.1,
         .closed_form = "x 2^-25 / tan 20 deg",
         .test = test,
         .rows = ray_rows},
    };
}

} // namespace stability
