#include "bake/verdict/plan/sky_use.h"
#include "bake/environment/filter/convolve.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace bake {
namespace {

constexpr int lattice = 64; ///< rays along an edge of the picture that look for the sky

bool sees_sky(const Scene& scene, const Camera& camera) {
    const int width = scene.settings.width, height = scene.settings.height;
    const int columns = std::min(width, lattice), rows = std::min(height, lattice);
    CameraFrame frame = camera_frame(camera);
    frame.position -= scene.origin;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double x = std::floor((i + 0.5) * width / columns) + 0.5;
            const double y = std::floor((j + 0.5) * height / rows) + 0.5;
            if (!scene.bvh->intersect(primary_ray(frame, x, y, width, height))) return true;
        }
    return false;
}

/// The extreme of a channel of a map that is a factor; 1 without a map.
template <class Choose> float extreme(const SurfaceMap& map, int channel, const Choose& choose) {
    if (!map) return 1;
    const Image<float>& image = *map.texture;
    float value = image.data()[channel];
    for (std::size_t i = std::size_t(channel); i < image.size(); i += std::size_t(image.channels()))
        value = choose(value, image.data()[i]);
    return value;
}

/// As sharp as it is anywhere on the surface.
Reflectance sharpest_of(const Material& material) {
    Reflectance r = material.reflectance;
    if (!material.maps) return r;
    r.shininess *= extreme(material.maps->shininess, 0, [](float a, float b) { return std::max(a, b); });
    r.roughness *= extreme(material.maps->roughness, 1, [](float a, float b) { return std::min(a, b); });
    return r;
}

} // namespace

double lobe_width(const Lobe& lobe) noexcept {
    switch (lobe.kind) {
    case LobeKind::lambert: return 2;
    case LobeKind::phong:
    case LobeKind::normalised_phong: return double(width_of(PhongLobe{lobe.exponent}));
    case LobeKind::blinn:
    case LobeKind::normalised_blinn: return double(width_of(PhongLobe{lobe.exponent / 4}));
    case LobeKind::ggx:
        return double(width_of(GgxLobe::of_alpha(std::max(1e-3, double(lobe.roughness) * double(lobe.roughness)))));
    case LobeKind::mirror:
    case LobeKind::dielectric: break;
    }
    return 0;
}

int face_for(double width, int most) noexcept {
    // A texel at the centre of a face of n texels subtends 2 / n.
    const double texels = 8 / std::max(width, 1e-6);
    return texels >= most ? most : std::min(most, int(std::bit_ceil(unsigned(std::ceil(texels)))));
}

SkyUse sky_use(const Scene& scene, std::span<const PartOptions::View> views) {
    SkyUse use;
    if (scene.sky.cube.empty() || !(scene.sky.scale > 0)) return use;
    for (const PartOptions::View& view : views) use.seen = use.seen || sees_sky(scene, view.camera);
    const bool lights = scene.settings.sky_light != SkyLighting::off && !scene.sky_light.is_black();
    for (const Instance& instance : scene.instances) {
        const Material& material = *instance.material;
        const Bsdf bsdf = make_bsdf(sharpest_of(material));
        double width = material.reflect != Vec3f(0) ? 0 : 2;
        for (int i = 0; i < bsdf.count; ++i) {
            const Lobe& lobe = bsdf.lobes[std::size_t(i)];
            const bool passes = lobe.kind == LobeKind::dielectric;
            if (!passes && (!lights || lobe.weight == Vec3f(0))) continue;
            use.lit = use.lit || lights;
            width = std::min(width, lobe_width(lobe));
        }
        use.mirrored = use.mirrored || width == 0;
        if (width < use.lobe_width || use.sharpest.empty())
            use.lobe_width = std::min(width, use.lobe_width), use.sharpest = material.name;
    }
    return use;
}

} // namespace bake
