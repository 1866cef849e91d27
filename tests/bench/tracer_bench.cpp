// tracer_bench: rays per second of the preview tracer beside bare loops over Embree, on the displaced torus R = 1, r = 0.4 in
// 1024 x 1024 pixels with one primary ray per pixel and one shadow ray per lit hit. The bare loops trace the same rays
// and shade nothing: rtcIntersect1 with rtcOccluded1, and rtcIntersect16 with rtcOccluded16 on tiles of 4 x 4 pixels.
//
// Rows as in bench.h: size counts triangles, an item is a ray, ratio is the time per ray over that of rtcIntersect1. The error columns
// hold the RMSE of a part of the picture, of one sample per pixel against 4096, in units of radiance, not degrees.
#include "bake/preview/render.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/bump_table.h"
#include "bench.h"
#include "relief/map/torus_relief.h"
#include <embree3/rtcore.h>

using namespace bake;

namespace {

constexpr int pixels = 1024;
const Vec3f to_light = glm::normalize(Vec3f(1, 2, 1.5f));

Relief waves(const oracle::TorusRelief& r, double amplitude) {
    Relief relief;
    relief.values = oracle::relief_texture(r, 1024).values;
    relief.height = {.amplitude = amplitude, .midlevel = 0.5};
    return relief;
}

/// 2^(2 levels + 10) triangles.
Mesh torus(const Relief& relief, int levels) {
    DisplaceOptions options;
    options.rates.levels = levels;
    return displace(BaseSurface(ParametricSurface("torus:R=1,r=0.4"), 32, 16), relief, options).mesh;
}

/// The scene of a mesh under one light, seen from above.
void complete(Scene& scene, Mesh mesh, const Material& material) {
    scene.shapes.push_back(make_shape(std::move(mesh)));
    scene.materials.push_back(std::make_unique<Material>(material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    Light<float> light;
    light.kind = LightKind::directional;
    light.from = to_light;
    scene.lights.push_back(light);
    scene.camera.position = {0, 2.4f, 2.4f}, scene.camera.fov_deg = 45;
    scene.settings.width = scene.settings.height = pixels;
    scene.settings.spp = 1;
    scene.settings.bounces = 0;
    scene.settings.sky_light = SkyLighting::off;
    build(scene);
}

Material phong() {
    Material material;
    material.reflectance.model = Reflectance::Model::phong;
    material.reflectance.diffuse = {0.6f, 0.5f, 0.4f};
    material.reflectance.specular = Vec3f(0.3f);
    return material;
}

/// The slopes of the relief, and a sky that is mirrored.
Material bump_and_mirror(const oracle::TorusRelief& r) {
    Material material = phong();
    BumpTableOptions options;
    options.amplitude = 2 * r.A;
    material.bump_table = std::make_shared<Image<float>>(bump_table(oracle::relief_texture(r, 1024), options));
    material.reflect = Vec3f(0.3f);
    return material;
}

Cube gradient_sky() {
    Cube cube = make_cube(256, 3);
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) {
                const float value[3] = {float(x) / 256, float(y) / 256, float(f) / 6};
                std::copy_n(value, 3, &cube.faces[f].at(x, y));
            }
    return cube;
}

/// An Embree scene of its own, with the triangles of one mesh.
class Bare {
public:
    explicit Bare(const Scene& scene) : frame_(camera_frame(scene)) {
        const Shape& shape = *scene.shapes[0];
        positions_.assign(shape.mesh.positions.begin(), shape.mesh.positions.end());
        positions_.emplace_back(0); // Embree loads 16 bytes at a time
        for (std::size_t f = 0; f < shape.mesh.faces(); ++f) {
            const std::uint32_t first = shape.mesh.face_begin[f], end = shape.mesh.face_begin[f + 1];
            for (std::uint32_t c = first + 2; c < end; ++c)
                triangles_.push_back({shape.mesh.corner_position[first], shape.mesh.corner_position[c - 1],
                                      shape.mesh.corner_position[c]});
        }
        device_ = rtcNewDevice(nullptr);
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0,
                                   sizeof(Vec3f), positions_.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_.data(), 0,
                                   sizeof(triangles_[0]), triangles_.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~Bare() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
    Bare(const Bare&) = delete;
    Bare& operator=(const Bare&) = delete;

    /// Rays traced.
    std::int64_t one_by_one() {
        std::vector<std::int64_t> rays(pixels);
        for_rows(pixels, 4, [&](std::int64_t begin, std::int64_t end) {
            for (auto y = begin; y < end; ++y)
                for (int x = 0; x < pixels; ++x) rays[std::size_t(y)] += one(x, int(y));
        });
        return sum(rays);
    }
    std::int64_t in_packets() {
        std::vector<std::int64_t> rays(pixels / 4);
        for_rows(pixels / 4, 1, [&](std::int64_t begin, std::int64_t end) {
            for (auto row = begin; row < end; ++row)
                for (int x = 0; x < pixels; x += 4) rays[std::size_t(row)] += sixteen(x, 4 * int(row));
        });
        return sum(rays);
    }
    std::size_t triangles() const { return triangles_.size(); }

private:
    static std::int64_t sum(const std::vector<std::int64_t>& rays) {
        std::int64_t all = 0;
        for (const std::int64_t n : rays) all += n;
        return all;
    }
    /// The ray from a hit to the light; false if the facet faces away from it.
    static bool shadow_ray(const Ray& ray, float t, Vec3f facet, Vec3f& origin) {
        if (glm::dot(facet, ray.direction) > 0) facet = -facet;
        origin = ray.origin + t * ray.direction + 1e-5f / glm::length(facet) * facet;
        return glm::dot(facet, to_light) > 0;
    }
    int one(int x, int y) const {
        const Ray ray = primary_ray(frame_, x + 0.5, y + 0.5, pixels, pixels);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit{};
        hit.ray.org_x = ray.origin.x, hit.ray.org_y = ray.origin.y, hit.ray.org_z = ray.origin.z;
        hit.ray.dir_x = ray.direction.x, hit.ray.dir_y = ray.direction.y, hit.ray.dir_z = ray.direction.z;
        hit.ray.tfar = std::numeric_limits<float>::infinity(), hit.ray.mask = 0xffffffffu;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &hit);
        Vec3f origin;
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ||
            !shadow_ray(ray, hit.ray.tfar, {hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z}, origin))
            return 1;
        RTCRay shadow{};
        shadow.org_x = origin.x, shadow.org_y = origin.y, shadow.org_z = origin.z;
        shadow.dir_x = to_light.x, shadow.dir_y = to_light.y, shadow.dir_z = to_light.z;
        shadow.tfar = std::numeric_limits<float>::infinity(), shadow.mask = 0xffffffffu;
        rtcOccluded1(scene_, &context, &shadow);
        return 2;
    }
    int sixteen(int x, int y) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        alignas(64) int valid[16];
        alignas(64) RTCRayHit16 hit{};
        Ray rays[16];
        for (int i = 0; i < 16; ++i) {
            rays[i] = primary_ray(frame_, x + i % 4 + 0.5, y + i / 4 + 0.5, pixels, pixels);
            valid[i] = -1;
            hit.ray.org_x[i] = rays[i].origin.x, hit.ray.org_y[i] = rays[i].origin.y;
            hit.ray.org_z[i] = rays[i].origin.z;
            hit.ray.dir_x[i] = rays[i].direction.x, hit.ray.dir_y[i] = rays[i].direction.y;
            hit.ray.dir_z[i] = rays[i].direction.z;
            hit.ray.tfar[i] = std::numeric_limits<float>::infinity(), hit.ray.mask[i] = 0xffffffffu;
            hit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, scene_, &context, &hit);
        alignas(64) RTCRay16 shadow{};
        int count = 16;
        for (int i = 0; i < 16; ++i) {
            Vec3f origin(0);
            const bool lit =
                hit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID &&
                shadow_ray(rays[i], hit.ray.tfar[i], {hit.hit.Ng_x[i], hit.hit.Ng_y[i], hit.hit.Ng_z[i]}, origin);
            valid[i] = lit ? -1 : 0;
            count += lit;
            shadow.org_x[i] = origin.x, shadow.org_y[i] = origin.y, shadow.org_z[i] = origin.z;
            shadow.dir_x[i] = to_light.x, shadow.dir_y[i] = to_light.y, shadow.dir_z[i] = to_light.z;
            shadow.tfar[i] = std::numeric_limits<float>::infinity(), shadow.mask[i] = 0xffffffffu;
        }
        if (count > 16) rtcOccluded16(valid, scene_, &context, &shadow);
        return count;
    }

    CameraFrame frame_;
    std::vector<Vec3f> positions_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    RTCDevice device_;
    RTCScene scene_;
};

/// In the columns of errors: the RMSE of a part of the picture in each of them.
bench::Errors picture_error(const Scene& scene, const Image<float>& picture) {
    RenderSettings fine = scene.settings;
    fine.spp = 4096;
    fine.part = PixelRect{3 * pixels / 8, 5 * pixels / 8, 128, 128};
    const Image<float> right = render(scene, fine);
    double sum = 0;
    for (int y = 0; y < right.height(); ++y)
        for (int x = 0; x < right.width(); ++x)
            for (int c = 0; c < right.channels(); ++c)
                sum +=
                    std::pow(double(picture.at(fine.part->x + x, fine.part->y + y, c)) - double(right.at(x, y, c)), 2);
    const double rmse = std::sqrt(sum / double(right.size()));
    return {rmse, rmse, rmse, right.size()};
}

void run(int levels) {
    const oracle::TorusRelief r{0.01, 24, 12};
    Scene displaced, bumpy;
    complete(displaced, torus(waves(r, 2 * r.A), levels), phong());
    bumpy.sky.cube = gradient_sky();
    complete(bumpy, torus(waves(r, 0), levels), bump_and_mirror(r));
    Bare bare(displaced), bare_flat(bumpy);
    RenderStats phong_stats, bump_stats;
    std::int64_t rays[2] = {};
    const auto rendering = [](const Scene& scene, RenderStats& stats) {
        return bench::Work([&] { return stats = {}, render(scene, scene.settings, &stats); },
                           [&](const Image<float>& picture) { return picture_error(scene, picture); });
    };
    const auto turns = bench::in_turn(
        5,
        {[&] { rays[0] = bare.one_by_one(); }, [&] { bare.in_packets(); }, [&] { rays[1] = bare_flat.one_by_one(); }},
        {rendering(displaced, phong_stats), rendering(bumpy, bump_stats)});
    // Of a time, its rays, and the bare loop it is compared with.
    const auto row = [&](const char* name, const bench::Times& times, std::int64_t count, int against,
                         std::int64_t their_count) {
        const double ratio = times.ratio_to(turns.limits[std::size_t(against)]) * double(their_count) / double(count);
        return bench::Row{
            "tracer",
            name,
            std::int64_t(bare.triangles()),
            double(count),
            ratio,
            "rtcIntersect1",
            bench::text("%.2f M rays/s; %.0f %% of rtcIntersect1", 1e-6 * double(count) / times.median(), 100 / ratio)};
    };
    const char* const bare_loop = "it traces rays and makes no picture";
    bench::print_row_without_error(turns.limits[0], row("rtcIntersect1", turns.limits[0], rays[0], 0, rays[0]),
                                   bare_loop);
    bench::print_row_without_error(turns.limits[1], row("rtcIntersect16", turns.limits[1], rays[0], 0, rays[0]),
                                   bare_loop);
    const auto rendered = [&](const char* name, const bench::Measured& ours, std::int64_t count, int against,
                              std::int64_t their_count) {
        bench::Row line = row(name, ours.times(), count, against, their_count);
        line.note += "; error: RMSE against 4096 spp";
        bench::print_row(ours, line);
    };
    rendered("phong", turns.works[0], phong_stats.rays, 0, rays[0]);
    rendered("bump_table_mirror", turns.works[1], bump_stats.rays, 2, rays[1]);
}

} // namespace

int main(int argc, char** argv) {
    const int levels = argc > 1 ? std::atoi(argv[1]) : -1;
    if (levels > 7)
        return std::fprintf(stderr, "usage: tracer_bench [LEVELS], up to 7: 2^(2 LEVELS + 10) triangles\n"), 2;
    if (levels >= 0) run(levels);
    else
        for (const int l : {2, 3, 4, 5, 6}) run(l);
}
