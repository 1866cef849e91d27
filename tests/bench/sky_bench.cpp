// sky_bench SKY [REFERENCE [CROP]]: error of the light of a sky against the number of samples and against time, beside directions
// that are drawn evenly over the sphere and in proportion to the cosine. SKY is a picture that read_environment() reads.
//
// The scene: a Lambert ball, a ball of ggx over Lambert (roughness 0.3) and a rough metal (0.4) on a Lambert ground; CROP x
// CROP pixels, 64 unless given, of direct light with shadows. Errors are of the radiance, over the mean of the picture: root
// mean square, 95th percentile, largest, against REFERENCE samples per pixel (16384 unless given) of multiple importance
// sampling with another seed. Size is the number of samples per pixel; the time is per sample. The ratio is the error over
// that of even directions at equal time, interpolated between their rows. The note has the order: the exponent with which the error falls from a quarter of the samples to these.
//
// Then one ball in that sky, lit from filtered levels, against 2048 samples per pixel; REFERENCE 0 measures this alone.
#include "bake/base/parallel.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/resample/resample.h"
#include "bake/light/frame.h"
#include "bake/preview/shape_mesh.h"
#include "bake/preview/surfel.h"
#include "bake/preview/tracer.h"
#include "bench.h"
#include "preview/trace_one.h"
#include <filesystem>

using namespace bake;

namespace {

void add(Scene& scene, const char* shape, const Reflectance& reflectance, const Placement& placement) {
    scene.shapes.push_back(make_shape(shape_mesh(shape)));
    scene.materials.push_back(std::make_unique<Material>());
    scene.materials.back()->reflectance = reflectance;
    add_instance(scene, *scene.shapes.back(), *scene.materials.back(), placement);
}

void set_sky(Scene& scene, const std::string& file, int pixels) {
    Environment sky = read_environment({file});
    if (!sky.is_cube() || sky.edge_samples)
        sky.cube = to_cube(sky, {std::max(1, sky.picture.width() / 4), false}, {Samples::one});
    for (std::size_t f = 0; f < 6; ++f) scene.sky.cube.faces[f] = to_rgb(sky.cube.faces[f]);
    scene.settings.width = scene.settings.height = pixels;
    build(scene);
}

Scene make_scene(const std::string& sky_file, int crop) {
    using Model = Reflectance::Model;
    Scene scene;
    add(scene, "plane", {.diffuse = Vec3f(0.5f)}, {.scale = Vec3f(40)});
    add(scene, "sphere", {.diffuse = Vec3f(0.8f)}, {.translate = {-2.2f, 1, 0}});
    add(scene, "sphere", {.model = Model::ggx, .diffuse = {0.6f, 0.2f, 0.1f}, .roughness = 0.3f},
        {.translate = {0, 1, 0}});
    add(scene, "sphere", {.model = Model::ggx, .diffuse = Vec3f(0.9f), .metallic = 1, .roughness = 0.4f},
        {.translate = {2.2f, 1, 0}});
    scene.camera = {.position = {0, 2.2f, 8}, .target = {0, 0.9f, 0}, .fov_deg = 40};
    set_sky(scene, sky_file, crop);
    return scene;
}

/// Direct light of the sky by one direction, drawn evenly over the sphere or in proportion to the cosine.
Vec3f simple(const Scene& scene, const Ray& ray, Sampler& sampler, bool cosine) {
    const Hit hit = scene.bvh->intersect(ray);
    if (!hit) return sky_radiance(scene.sky, ray.direction);
    const Surfel s = make_surfel(scene, hit, ray.direction);
    const Vec2f u = sampler.next2();
    const float turn = 2 * float(pi) * u.y;
    const float z = cosine ? std::sqrt(1 - u.x) : 1 - 2 * u.x, across = std::sqrt(std::max(0.f, 1 - z * z));
    const Vec3f local(across * std::cos(turn), across * std::sin(turn), z);
    const Vec3f l = cosine ? Frame(s.n).world(local) : local;
    const float pdf = cosine ? z / float(pi) : 1 / (4 * float(pi));
    const BsdfValue f = evaluate(s.bsdf, s.n, l, s.v);
    if (f.diffuse + f.specular == Vec3f(0) || !(pdf > 0)) return Vec3f(0);
    const float factor = light_factor(scene.settings.terminator, s.n, s.surface, l);
    if (factor == 0 || scene.bvh->occluded({offset_origin(s.light_at, s.facet), l})) return Vec3f(0);
    return (f.diffuse + f.specular) * (factor / pdf) * sky_radiance(scene.sky, l);
}

enum class Method { mis, even, cosine };
constexpr const char* names[] = {"mis", "even", "cosine"};

std::vector<Vec3f> render_by(const Scene& scene, Method method, int spp, std::uint32_t seed) {
    const int n = scene.settings.width;
    std::vector<Vec3f> out(std::size_t(n) * n);
    const CameraFrame frame = camera_frame(scene);
    for_rows(n, 1, [&](std::int64_t begin, std::int64_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < n; ++x) {
                Vec3d sum(0);
                for (int i = 0; i < spp; ++i) {
                    Sampler sampler(x, y, i, seed);
                    // Through the pixel's centre, so that edges in the picture have no part in the error.
                    sampler.next2();
                    const Ray ray = primary_ray(frame, x + 0.5, y + 0.5, n, n);
                    sum += Vec3d(method == Method::mis ? test::trace_one(scene, ray, 0, sampler).radiance.total()
                                                       : simple(scene, ray, sampler, method == Method::cosine));
                }
                out[std::size_t(y) * n + x] = Vec3f(sum / double(spp));
            }
    });
    return out;
}

/// Over the mean radiance; the root of the mean square error in place of the mean error.
bench::Errors compare(const std::vector<Vec3f>& picture, const std::vector<Vec3f>& right) {
    double mean = 0, squares = 0;
    for (const Vec3f& v : right) mean += double(v.x + v.y + v.z) / 3 / double(right.size());
    std::vector<float> errors;
    for (std::size_t i = 0; i < right.size(); ++i) {
        const Vec3f d = (picture[i] - right[i]) / float(mean);
        squares += double(glm::dot(d, d)) / 3 / double(right.size());
        errors.push_back(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    }
    bench::Errors out = bench::errors_of(std::move(errors));
    out.mean = std::sqrt(squares);
    return out;
}

struct Row {
    int spp;
    bench::Measured measured;
    double seconds() const { return measured.median(); }
    double rmse() const { return measured.errors().mean; }
};

/// The error after these seconds, by a power law between two rows, and beyond the last as the square root of time.
double error_at(const std::vector<Row>& rows, double seconds) {
    std::size_t i = 0;
    while (i + 1 < rows.size() && rows[i + 1].seconds() < seconds) ++i;
    const Row& a = rows[i];
    double power = -0.5;
    if (i + 1 < rows.size() && seconds >= a.seconds())
        power = std::log(rows[i + 1].rmse() / a.rmse()) / std::log(rows[i + 1].seconds() / a.seconds());
    return a.rmse() * std::pow(seconds / a.seconds(), power);
}

void measure_sampling(const std::string& file, const std::string& sky, int reference, int crop) {
    const Scene scene = make_scene(file, crop);
    const std::vector<Vec3f> right = render_by(scene, Method::mis, reference, 77);
    std::vector<Row> rows[3];
    for (const Method method : {Method::even, Method::cosine, Method::mis})
        for (int spp = 1; spp <= 1024; spp *= 4)
            rows[int(method)].push_back(
                {spp, bench::once({[&, method, spp] { return render_by(scene, method, spp, 5); },
                                   [&](const std::vector<Vec3f>& picture) { return compare(picture, right); }})});
    for (const Method method : {Method::mis, Method::cosine, Method::even})
        for (std::size_t i = 1; i < rows[int(method)].size(); ++i) {
            const Row &row = rows[int(method)][i], &before = rows[int(method)][i - 1];
            const double order = std::log(row.rmse() / before.rmse()) / std::log(double(row.spp) / before.spp);
            bench::print_row(row.measured,
                             {"sky_light", sky + "_" + names[int(method)], row.spp, double(row.spp) * crop * crop,
                              row.rmse() / error_at(rows[int(Method::even)], row.seconds()),
                              "even directions at equal time",
                              bench::text("rmse p95 max over the mean radiance; order %.2f", order)});
        }
}

/// One ball alone: filtered levels against sampled light.
void measure_levels(const std::string& file, const std::string& sky, const char* name, const Reflectance& reflectance,
                    SkyLevels& levels) {
    constexpr int size = 32, spp = 1024;
    Scene scene;
    add(scene, "sphere", reflectance, {});
    scene.camera = {.position = {0, 0, 8}, .target = {0, 0, 0}, .fov_deg = 12};
    set_sky(scene, file, size);
    const std::vector<Vec3f> sampled = render_by(scene, Method::mis, spp, 5);
    complete(levels, scene.sky.cube);
    const CameraFrame frame = camera_frame(scene);
    std::vector<Surfel> ball;
    std::vector<Vec3f> right;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Ray ray = primary_ray(frame, x + 0.5, y + 0.5, size, size);
            const Hit hit = scene.bvh->intersect(ray);
            if (!hit) continue;
            ball.push_back(make_surfel(scene, hit, ray.direction)), right.push_back(sampled[std::size_t(y) * size + x]);
        }
    const bench::Measured measured =
        bench::once({[&] {
                         std::vector<Vec3f> filtered;
                         for (const Surfel& s : ball) {
                             const BsdfValue light = reflected(levels, scene.sky, s.bsdf, s.n, s.v);
                             filtered.push_back(light.diffuse + light.specular);
                         }
                         return filtered;
                     },
                     [&](const std::vector<Vec3f>& filtered) { return compare(filtered, right); }});
    bench::print_row(measured, {"sky_levels", sky + "_" + name, 1, double(ball.size()), 0, "sampled",
                                "rmse p95 max over the mean radiance of the ball"});
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return std::fprintf(stderr, "sky_bench SKY [REFERENCE [CROP]]\n"), 2;
    const int reference = argc > 2 ? std::atoi(argv[2]) : 16384, crop = argc > 3 ? std::atoi(argv[3]) : 64;
    const std::string sky = std::filesystem::path(argv[1]).stem().string();
    if (reference > 0) measure_sampling(argv[1], sky, reference, crop);
    using Model = Reflectance::Model;
    SkyLevels levels;
    measure_levels(argv[1], sky, "lambert", {.diffuse = Vec3f(0.8f)}, levels);
    for (const float roughness : {0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 1.f}) {
        const Reflectance metal{.model = Model::ggx, .diffuse = Vec3f(0.9f), .metallic = 1, .roughness = roughness};
        const Reflectance coat{.model = Model::ggx, .diffuse = Vec3f(0.5f), .roughness = roughness};
        measure_levels(argv[1], sky, bench::text("metal_%.2g", double(roughness)).c_str(), metal, levels);
        measure_levels(argv[1], sky, bench::text("coat_%.2g", double(roughness)).c_str(), coat, levels);
    }
}
