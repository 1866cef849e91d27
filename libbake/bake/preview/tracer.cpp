#include "bake/preview/tracer.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

/// A hit prepared for shading, in world space. facet and n are on the side of the viewer.
struct Surfel {
    HitPoint at;          ///< origin of mirror rays
    HitPoint light_at;    ///< origin of shadow rays, on the smooth surface
    Vec3f facet{0}, n{0}; ///< unit
    Vec3f v{0};           ///< unit, towards the viewer
    BlinnPhong<float> bsdf;
};

Surfel surfel(const Scene& scene, const Hit& hit, const Vec3f& direction) noexcept {
    const Instance& instance = scene.instances[hit.mesh];
    const Shape& shape = *instance.shape;
    const ShapePoint where{hit.triangle, hit.b1, hit.b2};
    Surfel s;
    s.at = scene.bvh->point(hit);
    s.v = -unit_or_zero(direction);
    s.facet = s.at.normal;
    // Normals define the outside. The winding of faces is less reliable, and mirroring reverses it.
    const Vec3f outside = instance.normals * normal_at(shape, where);
    if (glm::dot(s.facet, outside) < 0) s.facet = -s.facet;
    s.n = unit_or_zero(instance.normals * shading_normal(*instance.material, shape, where));
    if (s.n == Vec3f(0)) s.n = s.facet;
    float outward = 1;
    if (glm::dot(s.facet, s.v) < 0) {
        s.facet = -s.facet;
        s.n = -s.n;
        outward = -1;
    }
    s.light_at = s.at;
    s.light_at.p += instance.linear * smooth_offset(shape, where, outward);
    s.bsdf = bsdf_at(*instance.material, shape, where);
    return s;
}

bool is_visible(const Scene& scene, const Light<float>& light, const Surfel& s) noexcept {
    Ray ray;
    ray.origin = offset_origin(s.light_at, s.facet);
    ray.direction = light.from;
    if (light.kind == LightKind::point) {
        ray.direction = light.position - ray.origin;
        ray.t_max = 0.9999f; // ends before the light, which may be on a surface
    }
    return !scene.bvh->occluded(ray);
}

std::uint64_t hash(std::uint64_t z) noexcept { // the finaliser of splitmix64 (Steele, Lea, Flood 2014)
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double reversed_bits(std::uint32_t i) noexcept {
    double value = 0, digit = 0.5;
    for (; i; i >>= 1, digit *= 0.5)
        if (i & 1) value += digit;
    return value;
}

bool finite(const Vec3f& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

Vec3f radiance(const Scene& scene, const Ray& ray, int bounces, std::int64_t& rays) noexcept {
    ++rays;
    const Hit hit = scene.bvh->intersect(ray);
    if (!hit) return sky_radiance(scene.sky, ray.direction);
    const Surfel s = surfel(scene, hit, ray.direction);
    Vec3f sum = s.bsdf.emission + s.bsdf.ambient * scene.ambient;
    for (const Light<float>& light : scene.lights) {
        const LightSample<float> from_light = sample(light, s.at.p);
        const Vec3f part = reflected(s.bsdf, s.n, from_light.l, s.v) * from_light.radiance;
        if (part == Vec3f(0)) continue;
        if (scene.settings.shadows) {
            ++rays;
            if (!is_visible(scene, light, s)) continue;
        }
        sum += part;
    }
    const Vec3f& reflect = scene.instances[hit.mesh].material->reflect;
    if (reflect != Vec3f(0)) {
        const Ray mirrored{offset_origin(s.at, s.facet), mirror_above(s.v, s.n, s.facet)};
        sum += reflect * (bounces > 0 ? radiance(scene, mirrored, bounces - 1, rays)
                                      : sky_radiance(scene.sky, mirrored.direction));
    }
    return sum;
}

// Hammersley points with a random shift per pixel (Cranley, Patterson 1976).
Vec2d pixel_sample(int x, int y, int i, int spp) noexcept {
    if (spp <= 1) return Vec2d(0.5);
    const std::uint64_t bits = hash((std::uint64_t(std::uint32_t(y)) << 32) | std::uint32_t(x));
    const double u = (i + 0.5) / spp + double(bits >> 32) * 0x1p-32;
    const double v = reversed_bits(std::uint32_t(i)) + double(bits & 0xffffffffu) * 0x1p-32;
    return {u - std::floor(u), v - std::floor(v)};
}

Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    Image<float> image(settings.width, settings.height, 3);
    const CameraFrame frame = camera_frame(scene.camera);
    std::vector<RenderStats> per_row(settings.height);
    if (progress) progress->start("render", settings.height);
    const auto render_rows = [&](std::int64_t begin, std::int64_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < settings.width; ++x) {
                Vec3d sum(0);
                for (int i = 0; i < settings.spp; ++i) {
                    const Vec2d at = pixel_sample(x, y, i, settings.spp);
                    const Ray ray = primary_ray(frame, x + at.x, y + at.y, settings.width, settings.height);
                    const Vec3f value = radiance(scene, ray, settings.bounces, per_row[y].rays);
                    if (finite(value)) sum += Vec3d(value);
                    else ++per_row[y].bad_samples;
                }
                const Vec3f mean(sum / double(settings.spp));
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = mean[c];
            }
    };
    for_rows(settings.height, 2, render_rows, progress);
    if (stats)
        for (const RenderStats& row : per_row) {
            stats->rays += row.rays;
            stats->bad_samples += row.bad_samples;
        }
    return image;
}

} // namespace bake
