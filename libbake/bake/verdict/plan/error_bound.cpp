// Upper bounds of the error of a method against true displacement.
//
// Proved are three cases:
// - The object cannot be in the picture. All its points, displaced or not, lie beyond one side of the picture.
// - Its height is 0 everywhere, and displacement leaves the mesh as it is.
// - No relief at all, on a flat and convex polygon that is the only object. A ray that meets the relief meets the polygon at
//   most `shift` pixels away, or crosses the border within that distance. So the error has two parts, whose roots of the mean
//   squares add up at most:
//     shading: what a tilted normal reflects more or less (shading_bound.h), where both pictures show the patch. The mean square
//     is at most that of the steepest slope; and, as every texel is seen at most once per tile, that of all slopes of a tile
//     times the tiles and the largest density of pixels. A ray meets a slope g on the relief where the picture is
//     stretched by up to 1 + g tan(view angle).
//     border: at most 1, or the brighter of object and background, in a band of `shift` pixels on both sides. A pixel's error
//     is the mean over its area, so that a thin band in a pixel counts squared.
//
// The last case is loose, as slopes and borders that average out within a pixel count in full. Of 744 configurations of
// plan_experiment_set.h it has a bound for 17, the planes under a sun alone, and none of these is below .01.
#include "bake/base/text.h"
#include "bake/verdict/plan/flat_patch.h"
#include "bake/verdict/plan/height_bounds.h"
#include "bake/verdict/plan/relief_facts.h"
#include "bake/verdict/plan/shading_bound.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

constexpr double slack = 5e-5; ///< of slopes and errors: floats, and the tolerances of flat_patch()

double mean(const Vec3d& v) noexcept { return (v.x + v.y + v.z) / 3; }

/// The largest |b|; infinite if a value is not finite.
double most_height(const FactsInput& input) {
    if (!input.relief || input.relief->values.empty()) return 0;
    const Image<float>& values = input.relief->values;
    double most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double b = std::abs(double(values.data()[i]) - input.options.height.midlevel);
        if (!std::isfinite(b)) return INFINITY;
        most = std::max(most, b);
    }
    return most * std::abs(input.options.height.amplitude);
}

/// Points of a smooth shape between those of its mesh are at most as far from them as edges are long.
double longest_edge(const Shape& shape) noexcept {
    if (!shape.smooth) return 0;
    const Mesh& mesh = shape.mesh;
    double longest = 0;
    for (const Triangle& t : shape.surface.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            longest =
                std::max(longest, double(glm::length(mesh.positions[mesh.corner_position[t.corner[k]]] -
                                                     mesh.positions[mesh.corner_position[t.corner[(k + 1) % 3]]])));
    return longest;
}

/// Whether all points lie beyond one side of the picture, or behind the camera. Cubic splines reach at most 2.4 times as far as
/// their values: the square of the largest norm of interpolation, 1.55, along one axis (Richards, 1973).
bool out_of_picture(const FactsInput& input, const PictureView& view) {
    const Instance& placed = input.scene->instances[input.instance];
    const glm::dmat3 linear(placed.linear);
    double scale = 0;
    for (int k = 0; k < 3; ++k) scale += glm::dot(linear[k], linear[k]);
    const double reach = std::sqrt(scale) * (2.5 * most_height(input) + longest_edge(*placed.shape));
    if (!std::isfinite(reach)) return false;
    const CameraFrame& frame = view.frame();
    if (frame.forward == Vec3f(0) || view.width() <= 0 || view.height() <= 0) return true;
    const Vec3d right(frame.right), up(frame.up), forward(frame.forward), c(frame.position);
    const double y = frame.half_height, x = y * view.width() / view.height();
    const Vec3d translate = Vec3d(placed.translate) - Vec3d(input.scene->origin) - c;
    bool beyond[5] = {true, true, true, true, true};
    for (const Vec3f& p : placed.shape->mesh.positions) {
        const Vec3d at = linear * Vec3d(p) + translate;
        const Vec3d local(glm::dot(at, right), glm::dot(at, up), glm::dot(at, forward));
        const auto outside = [&](double across, double limit) {
            if (frame.orthographic) return across - limit > reach;
            return (across - limit * local.z) / std::sqrt(1 + limit * limit) > reach;
        };
        beyond[0] = beyond[0] && outside(local.x, x), beyond[1] = beyond[1] && outside(-local.x, x);
        beyond[2] = beyond[2] && outside(local.y, y), beyond[3] = beyond[3] && outside(-local.y, y);
        beyond[4] = beyond[4] && -local.z > reach;
    }
    return std::any_of(std::begin(beyond), std::end(beyond), [](bool all) { return all; });
}

/// Whether displacement by a height of 0 gives the mesh that is shown. Quads are displaced as bilinear patches, and shown as two
/// triangles.
bool is_its_own_base(const FactsInput& input) {
    const Shape& shape = *input.scene->instances[input.instance].shape;
    if (flat_patch(*input.scene, input.instance)) return true;
    const std::vector<std::uint32_t>& begin = shape.mesh.face_begin;
    for (std::size_t f = 0; f + 1 < begin.size(); ++f)
        if (begin[f + 1] - begin[f] == 4) return false;
    return !shape.smooth;
}

ViewCone view_cone(const PictureView& view) noexcept {
    const CameraFrame& frame = view.frame();
    ViewCone cone{-Vec3d(frame.forward), 0};
    if (!frame.orthographic)
        cone.angle = std::atan(frame.half_height * std::hypot(1.0, double(view.width()) / view.height()));
    return cone;
}

/// Of the tiles that a range of a coordinate touches.
double tiles(double low, double high) noexcept {
    return std::max(1.0, std::ceil(high - 1e-6) - std::floor(low + 1e-6));
}

/// The mean square error of shading over the visible patch.
double shading_square(const ShadingBound& shading, const HeightBounds& height, const FlatPatch& patch,
                      const PatchInPicture& seen) {
    const double steepest = height.steepest + slack;
    double largest = 0, sum = 0;
    for (const HeightBounds::Bin& bin : height.slopes) {
        const Vec3d change = shading.change(bin.slope + slack, steepest);
        const double square = mean(change * change);
        largest = std::max(largest, square);
        sum += bin.share * square * (1 + steepest * seen.most_tangent);
    }
    const double tile_pixels = 1.2 * seen.most_density * glm::length(glm::cross(patch.p_u, patch.p_v));
    const double count = tiles(seen.uv_low.x, seen.uv_high.x) * tiles(seen.uv_low.y, seen.uv_high.y);
    return std::min(largest, sum * tile_pixels * count / seen.area);
}

double border_square(const Scene& scene, const ShadingBound& shading, const PatchInPicture& seen, float exposure) {
    if (seen.edges == 0) return 0;
    const Vec3d behind =
        scene.sky.cube.empty() ? std::exp2(double(exposure)) * glm::abs(Vec3d(scene.sky.background)) : Vec3d(1);
    const Vec3d change = glm::max(shading.most(), glm::min(behind, Vec3d(1)));
    const double h = seen.shift, disc = pi * h * h;
    // The border of a convex polygon in a square with the edge 1 + 2 h is at most as long as that of the square.
    const double in_pixel = std::min(1.0, 2 * h * 4 * (1 + 2 * h) + seen.edges * disc);
    return mean(change * change) * in_pixel * (2 * h * seen.border + seen.edges * disc) / seen.area;
}

std::optional<ErrorBound> flat_patch_bound(const FactsInput& input, const PictureView& view) {
    const Scene& scene = *input.scene;
    if (scene.instances.size() != 1) return {}; // others cast shadows on it, and it on them
    const auto patch = flat_patch(scene, input.instance);
    if (!patch) return {};
    const auto [g_u, g_v] = patch->slopes();
    const auto height = height_bounds(*input.relief, input.options.height, g_u, g_v);
    if (!height) return {};
    const auto seen = in_picture(*patch, height->most_height * patch->lift, view);
    if (!seen || !(seen->area > 0)) return {};
    const Material& material = *scene.instances[input.instance].material;
    const auto shading = ShadingBound::of(scene, material, seen->n, view_cone(view), input.exposure);
    if (!shading) return {};
    const double shade = std::sqrt(shading_square(*shading, *height, *patch, *seen));
    const double border = std::sqrt(border_square(scene, *shading, *seen, input.exposure));
    if (!std::isfinite(shade + border)) return {};
    ErrorBound bound{shade + border + slack, ""};
    bound.why =
        format("a flat surface whose slopes of at most %.2g change its light by at most %.2g", height->steepest, shade);
    if (seen->edges > 0) bound.why += format(", with a border that moves by at most %.2g px", seen->shift);
    return bound;
}

} // namespace

std::optional<ErrorBound> error_bound(Shade shade, const FactsInput& input, const ReliefFacts& facts) {
    const PictureView view(*input.scene, input.camera, input.width, input.height);
    if (!facts.in_view && out_of_picture(input, view)) return ErrorBound{0, "no part of it lies in the picture"};
    if (most_height(input) == 0) {
        const bool no_relief = shade == Shade::plain || shade == Shade::roughness;
        if (!no_relief || !is_its_own_base(input)) return {};
        return ErrorBound{0, "its height is 0 everywhere"};
    }
    if (shade != Shade::plain) return {};
    return flat_patch_bound(input, view);
}

} // namespace bake
