#include "bake/preview/render.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <cmath>

namespace bake {
namespace {

bool finite(const Vec3f& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Sums over the samples of a pixel.
struct PixelSums {
    Vec3d total{0}, emitted{0}, diffuse{0}, specular{0}, reflected{0}, albedo{0}, normal{0}, facet{0};
    double hits = 0, lit = 0, repaired = 0, rays = 0;
    FirstHit first; ///< of the first sample

    void add(const Radiance& value, const FirstHit& hit) noexcept {
        total += Vec3d(value.total());
        emitted += Vec3d(value.emitted), diffuse += Vec3d(value.diffuse);
        specular += Vec3d(value.specular), reflected += Vec3d(value.reflected);
        albedo += Vec3d(hit.albedo), normal += Vec3d(hit.normal), facet += Vec3d(hit.facet);
        hits += bool(hit.hit), lit += hit.lit, repaired += hit.repaired;
    }
};

/// Writes the values of a pixel, in the order of layer_channels().
void write_layers(const PixelSums& s, int spp, float* to) noexcept {
    const double share = 1.0 / spp;
    // Extreme materials have an albedo beyond what floats hold, which is no reason to drop the radiance.
    const auto put = [&](double value) { *to++ = std::isfinite(float(value)) ? float(value) : 0; };
    const auto put3 = [&](const Vec3d& value) { put(value.x), put(value.y), put(value.z); };
    put3(s.total * share);
    put(s.hits * share);
    for (const Vec3d& part : {s.emitted, s.diffuse, s.specular, s.reflected, s.albedo}) put3(part * share);
    put3(unit_or_zero(s.normal));
    put3(unit_or_zero(s.facet));
    const bool hit(s.first.hit);
    put(hit ? s.first.depth : 0);
    put3(Vec3d(s.first.position));
    put(s.first.uv.x), put(s.first.uv.y);
    put(hit ? double(s.first.hit.mesh) + 1 : 0), put(hit ? double(s.first.hit.triangle) + 1 : 0);
    put(s.lit * share), put(s.repaired * share), put(s.rays * share);
}

/// Calls write(sums, x, y) for every pixel of the settings' part.
template <class Write>
void for_pixels(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress,
                const Write& write) {
    const PixelRect part = settings.part.value_or(PixelRect{0, 0, settings.width, settings.height});
    const CameraFrame frame = camera_frame(scene);
    std::vector<RenderStats> per_row(part.height);
    if (progress) progress->start("render", part.height);
    for_rows(
        part.height, 2,
        [&](std::int64_t begin, std::int64_t end) {
            for (int row = int(begin); row < int(end); ++row)
                for (int column = 0; column < part.width; ++column) {
                    const int x = part.x + column, y = part.y + row;
                    PixelSums sums;
                    RenderStats counts;
                    for (int i = 0; i < settings.spp; ++i) {
                        Sampler sampler(x, y, i, settings.seed);
                        const Vec2d at = pixel_sample(settings.spp, sampler);
                        const Ray ray = primary_ray(frame, x + at.x, y + at.y, settings.width, settings.height);
                        FirstHit hit;
                        const Radiance value = radiance(scene, ray, settings.bounces, sampler, counts, &hit);
                        if (finite(value.total())) sums.add(value, hit);
                        else ++counts.bad_samples;
                        if (i == 0) sums.first = hit;
                    }
                    sums.rays = double(counts.rays);
                    per_row[row] += counts;
                    write(sums, column, row);
                }
        },
        progress);
    if (stats)
        for (const RenderStats& row : per_row) *stats += row;
}

Image<float> new_image(const RenderSettings& settings, int channels) {
    if (settings.part) return {settings.part->width, settings.part->height, channels};
    return {settings.width, settings.height, channels};
}

} // namespace

const std::vector<std::string>& layer_channels() {
    static const std::vector<std::string> channels = [] {
        std::vector<std::string> all = {"R", "G", "B", "A"};
        const auto add = [&](const char* layer, const char* names) {
            for (; *names; ++names) all.push_back(std::string(layer) + "." + *names);
        };
        for (const char* layer : {"emission", "diffuse", "specular", "reflection", "albedo"}) add(layer, "RGB");
        add("N", "XYZ"), add("Ng", "XYZ");
        all.push_back("Z");
        add("P", "XYZ"), add("uv", "XY");
        for (const char* name : {"id.object", "id.triangle", "lit.Y", "repaired.Y", "rays.Y"}) all.push_back(name);
        return all;
    }();
    return channels;
}

Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    Image<float> image = new_image(settings, 3);
    for_pixels(scene, settings, stats, progress, [&](const PixelSums& sums, int x, int y) {
        const Vec3f mean(sums.total / double(settings.spp));
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = mean[c];
    });
    return image;
}

Image<float> render_layers(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    Image<float> image = new_image(settings, int(layer_channels().size()));
    for_pixels(scene, settings, stats, progress,
               [&](const PixelSums& sums, int x, int y) { write_layers(sums, settings.spp, &image.at(x, y)); });
    return image;
}

} // namespace bake
