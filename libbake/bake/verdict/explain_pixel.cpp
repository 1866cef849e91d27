#include "bake/verdict/explain_pixel.h"
#include "bake/base/text.h"
#include "bake/preview/light_terms.h"
#include "bake/preview/pixel_samples.h"
#include "bake/preview/surfel.h"
#include <algorithm>
#include <glm/trigonometric.hpp>

namespace bake {
namespace {

std::vector<double> list(const Vec3d& v) { return {v.x, v.y, v.z}; }
std::vector<double> list(const Vec3f& v) {
    // One by one: of a vector that is rounded to float and back, gcc 12 leaves out the rounding at -O3.
    std::vector<double> values;
    for (int c = 0; c < 3; ++c) values.push_back(double(v[c]));
    return values;
}

/// What one light adds, over all samples of the pixel.
struct LightSum {
    LightTerm first; ///< of the first sample that hits a mesh
    int met = 0;     ///< samples for which it was looked at
    int lit = 0;     ///< of these, those to which it adds something
    Vec3d diffuse{0}, specular{0};
};

struct PixelShading {
    int samples = 0, hits = 0, bad = 0;
    int shown = 0;                                       ///< the first sample that hits a mesh, or else the first
    Ray ray;                                             ///< of that sample
    FirstHit first;                                      ///< of that sample
    Vec3d total{0}, emitted{0}, behind{0}, reflected{0}; ///< sums
    std::vector<LightSum> lights;                        ///< the scene's, and LightTerm::others
};

std::size_t place_of(const Scene& scene, int light) {
    return light >= 0 ? std::size_t(light) : scene.lights.size() + std::size_t(-1 - light);
}

PixelShading shade(const Scene& scene, int x, int y) {
    const RenderSettings& settings = scene.settings;
    const CameraFrame frame = camera_frame(scene);
    PixelShading pixel;
    pixel.samples = std::max(1, settings.spp);
    pixel.lights.resize(scene.lights.size() + LightTerm::others);
    std::vector<LightTerm> terms;
    terms.reserve(pixel.lights.size());
    const PixelBlock block = block_at(x, y, settings.width, settings.height);
    const int ours = (y - block.y) * block_edge + x - block.x;
    const auto set_ray = [&](const Vec2d& at, PrimaryRay& to) { set_camera_ray(frame, settings, at, to); };
    const auto add = [&](int lane, int i, const Ray& ray, const Radiance* value, const PrimaryHit& hit) {
        if (lane != ours) return;
        if (i == 0 || (!pixel.first.hit && hit.first.hit)) pixel.shown = i, pixel.ray = ray, pixel.first = hit.first;
        pixel.bad += int(hit.stats.bad_samples);
        if (!value) return;
        pixel.hits += bool(hit.first.hit);
        pixel.total += Vec3d(value->total());
        (hit.first.hit ? pixel.emitted : pixel.behind) += Vec3d(value->emitted);
        pixel.reflected += Vec3d(value->reflected);
        for (const LightTerm& term : terms) {
            LightSum& sum = pixel.lights[place_of(scene, term.light)];
            if (sum.met++ == 0) sum.first = term;
            sum.lit += term.diffuse + term.specular != Vec3f(0);
            sum.diffuse += Vec3d(term.diffuse), sum.specular += Vec3d(term.specular);
        }
    };
    add_samples(scene, settings, block, {0, pixel.samples}, set_ray, add, true, {ours, &terms});
    pixel.first.terms = nullptr;
    return pixel;
}

RouteStep camera_step(const Scene& scene, int x, int y, const PixelShading& pixel) {
    RouteStep step{"camera: a ray of the pixel", {}};
    step.entries.push_back({"pixel (x, y)", {double(x), double(y)}, "from the upper left corner"});
    step.entries.push_back({"picture", {double(scene.settings.width), double(scene.settings.height)}, "pixels"});
    step.entries.push_back(
        {"samples", {double(pixel.samples)}, format("the ray is that of number %d", pixel.shown + 1)});
    step.entries.push_back({"origin", list(pixel.ray.origin + scene.origin), ""});
    step.entries.push_back({"direction", list(pixel.ray.direction), "unit"});
    return step;
}

RouteStep hit_step(const Scene& scene, const PixelShading& pixel) {
    const FirstHit& first = pixel.first;
    RouteStep step{"bvh: what the ray hits", {}};
    step.entries.push_back({"samples on meshes", {double(pixel.hits)}, format("of %d", pixel.samples)});
    if (!first.hit) {
        step.entries.push_back({"no mesh", {}, "all samples see the sky"});
        return step;
    }
    step.entries.push_back(
        {"object, triangle", {double(first.hit.mesh) + 1, double(first.hit.triangle) + 1}, "from 1, as in the layers"});
    step.entries.push_back(
        {"barycentrics", {1.0 - first.hit.b1 - first.hit.b2, double(first.hit.b1), double(first.hit.b2)}, ""});
    step.entries.push_back({"distance", {double(first.depth)}, "from the camera"});
    step.entries.push_back({"p", list(first.position), "world space"});
    step.entries.push_back({"uv", {double(first.uv.x), double(first.uv.y)}, "v up"});
    const std::string& name = scene.instances[first.hit.mesh].material->name;
    step.entries.push_back({"material", {}, name.empty() ? "without a name" : name});
    return step;
}

RouteStep normal_step(const Surfel& s) {
    const auto tilt = [&](const Vec3f& n) {
        const float angle = glm::degrees(std::acos(std::clamp(glm::dot(n, s.surface), -1.0f, 1.0f)));
        return format("%.3f deg from the surface", double(angle));
    };
    RouteStep step{"surfel: normals, unit, on the side of the viewer", {}};
    step.entries.push_back({"facet", list(s.facet), tilt(s.facet)});
    step.entries.push_back({"surface", list(s.surface), "interpolated, without relief"});
    step.entries.push_back({"shading", list(s.n), tilt(s.n)});
    step.entries.push_back({"v", list(s.v), "towards the viewer"});
    step.entries.push_back(
        {"n . v", {double(glm::dot(s.n, s.v))}, s.tilted ? "relief faces away from the viewer" : ""});
    if (s.inside) step.entries.push_back({"seen from inside", {}, "the normals are flipped"});
    if (s.mirrored_below) step.entries.push_back({"mirror direction", {}, "points into the surface"});
    return step;
}

const char* name(LobeKind kind) {
    switch (kind) {
    case LobeKind::lambert: return "lambert";
    case LobeKind::phong: return "phong";
    case LobeKind::blinn: return "blinn";
    case LobeKind::normalised_phong: return "normalised phong";
    case LobeKind::normalised_blinn: return "normalised blinn";
    case LobeKind::ggx: return "ggx";
    case LobeKind::mirror: return "mirror";
    case LobeKind::dielectric: return "dielectric";
    }
    return "";
}

std::string parameter(const Lobe& lobe) {
    switch (lobe.kind) {
    case LobeKind::phong:
    case LobeKind::blinn:
    case LobeKind::normalised_phong:
    case LobeKind::normalised_blinn: return format("shininess %g", double(lobe.exponent));
    case LobeKind::ggx: return format("roughness %g", double(lobe.roughness));
    case LobeKind::dielectric: return format("index of refraction %g", double(lobe.ior));
    default: return "";
    }
}

RouteStep material_step(const Surfel& s) {
    RouteStep step{"material: at the point, maps included", {}};
    for (int i = 0; i < s.bsdf.count; ++i) {
        const Lobe& lobe = s.bsdf.lobes[std::size_t(i)];
        step.entries.push_back({name(lobe.kind), list(lobe.weight), parameter(lobe)});
    }
    step.entries.push_back({"ambient", list(s.bsdf.ambient), "factor on ambient light"});
    step.entries.push_back({"emission", list(s.bsdf.emission), ""});
    if (s.bsdf.translucent != Vec3f(0))
        step.entries.push_back({"translucent", list(s.bsdf.translucent), "reflectance of the light from inside"});
    if (s.occlusion != 1)
        step.entries.push_back({"occlusion", {double(s.occlusion)}, "factor on the sky's diffuse light"});
    step.entries.push_back({"reflect", list(s.reflect), "factor on the mirror ray"});
    return step;
}

const char* name(LightKind kind) {
    switch (kind) {
    case LightKind::directional: return "directional";
    case LightKind::point: return "point";
    case LightKind::spot: return "spot";
    case LightKind::quad: return "quad";
    }
    return "";
}

/// Why a light adds nothing to a sample, or what share of the samples it lights.
std::string visibility(const Surfel& s, const LightSum& light) {
    if (light.lit > 0) return format("lights %d of %d samples", light.lit, light.met);
    if (light.first.radiance == Vec3f(0)) return "does not shine here";
    if (glm::dot(s.n, light.first.l) <= 0) return "behind the shading normal";
    if (glm::dot(s.surface, light.first.l) <= 0) return "below the surface";
    return "in shadow";
}

void add_light(RouteStep& step, const Surfel& s, const LightSum& light, const std::string& label, double share) {
    step.entries.push_back({label + ": l", list(light.first.l), visibility(s, light)});
    step.entries.push_back(
        {label + ": radiance", list(light.first.radiance), "irradiance at normal incidence over pi"});
    step.entries.push_back({label + ": n . l", {double(glm::dot(s.n, light.first.l))}, ""});
    step.entries.push_back({label + ": diffuse", list(light.diffuse * share), ""});
    step.entries.push_back({label + ": specular", list(light.specular * share), ""});
}

RouteStep light_step(const Scene& scene, const Surfel& s, const PixelShading& pixel) {
    const double share = 1.0 / pixel.samples;
    RouteStep step{"tracer: radiance by light, mean over the samples", {}};
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (pixel.lights[i].met == 0) continue;
        add_light(step, s, pixel.lights[i], format("%s %zu", name(scene.lights[i].kind), i + 1), share);
    }
    const auto of = [&](int light) -> const LightSum& { return pixel.lights[place_of(scene, light)]; };
    const LightSum &bright = of(LightTerm::sky), &drawn = of(LightTerm::sky_by_surface);
    const LightSum &filtered = of(LightTerm::filtered_sky), &inside = of(LightTerm::from_inside);
    if (bright.met + drawn.met > 0) {
        const Vec3d diffuse = bright.diffuse + drawn.diffuse, specular = bright.specular + drawn.specular;
        step.entries.push_back(
            {"sky: diffuse", list(diffuse * share), format("%d of %d rays see it", bright.lit, bright.met)});
        step.entries.push_back({"sky: specular", list(specular * share), "glossy reflections of meshes included"});
    }
    if (filtered.met > 0) {
        step.entries.push_back({"filtered sky: diffuse", list(filtered.diffuse * share), "without shadows"});
        step.entries.push_back({"filtered sky: specular", list(filtered.specular * share), "without shadows"});
    }
    if (inside.met > 0)
        step.entries.push_back({"from inside: diffuse", list(inside.diffuse * share), "enters elsewhere"});
    return step;
}

RouteStep sum_step(const PixelShading& pixel) {
    const double share = 1.0 / pixel.samples;
    Vec3d lights(0);
    for (const LightSum& light : pixel.lights) lights += light.diffuse + light.specular;
    RouteStep step{"tracer: the sum", {}};
    step.entries.push_back({"emission, ambient", list(pixel.emitted * share), ""});
    step.entries.push_back({"lights and sky", list(lights * share), ""});
    step.entries.push_back({"reflections", list(pixel.reflected * share), "mirror and glass"});
    step.entries.push_back({"sky behind", list(pixel.behind * share), "samples that hit nothing"});
    step.entries.push_back({"radiance", list(Vec3f(pixel.total / double(pixel.samples))), "linear, as in an .exr"});
    if (pixel.bad > 0) step.entries.push_back({"bad samples", {double(pixel.bad)}, "too bright to store, black"});
    return step;
}

RouteStep tone_step(const RenderSettings& settings, const PixelShading& pixel, float exposure, bool automatic) {
    const Vec3f radiance(pixel.total / double(pixel.samples));
    RouteStep step{"tone: the value in a .png", {}};
    step.entries.push_back(
        {"exposure", {double(exposure)}, automatic ? "stops, chosen for the whole picture" : "stops"});
    step.entries.push_back({"exposed", list(radiance * std::exp2(exposure)), ""});
    std::vector<double> shown, levels;
    for (int c = 0; c < 3; ++c) {
        shown.push_back(double(shown_value(radiance[c], exposure, settings.tone)));
        levels.push_back(std::floor(shown.back() * 255 + 0.5));
    }
    step.entries.push_back({"shown", shown, settings.tone == Tone::aces ? "aces, sRGB-encoded" : "sRGB-encoded"});
    step.entries.push_back({"8 bit", levels, ""});
    return step;
}

} // namespace

std::vector<RouteStep> explain_pixel(const Scene& scene, int x, int y, float exposure, bool automatic) {
    const PixelShading pixel = shade(scene, x, y);
    std::vector<RouteStep> route = {camera_step(scene, x, y, pixel), hit_step(scene, pixel)};
    if (pixel.first.hit) {
        const Surfel s = make_surfel(scene, pixel.first.hit, pixel.ray.direction, pixel.first.cone);
        route.push_back(normal_step(s));
        route.push_back(material_step(s));
        route.push_back(light_step(scene, s, pixel));
    }
    route.push_back(sum_step(pixel));
    route.push_back(tone_step(scene.settings, pixel, exposure, automatic));
    return route;
}

} // namespace bake
