// Pictures between a method that shows an object's relief and the reference that displaces it: five causes of their
// difference, each of which a picture can have as in the one or as in the other.
//
// For a primary ray, B is the point of the object as the method shows it and D the corresponding point of the displaced
// surface. With the cause as in the reference (on), or as in the method (off):
//
//   parallax     on: the ray hits the displaced mesh at D; off: the ray hits the method's mesh at B. The other point
//                corresponds. Light falls on the point that is hit
//   normal       on: the shading normal is that of the displaced mesh at D; off: that of the method's material at B
//   self_shadow  on: all further rays (to lights and sky, mirrored, refracted) start at D and see the displaced scene; off:
//                they start at B and see the method's
//   filtering    on: textures, and the slopes from which a method makes its normal, are looked up as the reference's
//                scene filters them; off: as the method's
//   silhouette   on: where the object covers a sample in one scene alone, or in neither, the sample is the reference's; off:
//                it is the method's
//
// What a method widens a highlight by, because slopes were averaged away, applies where neither the normal nor the
// filtering is on: it stands for what these two bring. Shadows that the object casts on others belong to the silhouette.
#pragma once
#include "bake/preview/pixel_samples.h"
#include "bake/preview/surfel.h"
#include "bake/verdict/compare/twin_points.h"
#include <map>

namespace bake {

enum class Cause { silhouette, self_shadow, parallax, normal, filtering };
inline constexpr int cause_count = 5;
const char* name(Cause cause) noexcept;

/// One bit for each cause that is on; 0 is the method's picture, all_causes the reference's.
using CauseSet = unsigned;
inline constexpr CauseSet all_causes = (1u << cause_count) - 1;
constexpr CauseSet only(Cause cause) noexcept { return 1u << int(cause); }

/// Two built scenes of the same entries, with the same instances, lights, sky and camera, and the object by its instances.
struct CauseScenes {
    const Scene* method = nullptr;
    const Scene* reference = nullptr;   ///< filters nothing, if filtering is to be a cause
    const Scene* method_base = nullptr; ///< without heights, see without_heights(); null: the method does not displace
    const Scene* reference_base = nullptr; ///< likewise
    std::vector<std::uint32_t> object;     ///< indices of instances
};

/// The samples of one pixel of all hybrids, half by half.
struct HybridSums {
    std::array<std::array<Vec3d, 1u << cause_count>, 2> half{}; ///< sums of radiance
    bool object = false; ///< some sample sees the object, in one of the two scenes at least
};

/// Pixels whose samples are traced together.
struct PixelGroup {
    std::array<int, packet_size> x{}, y{};
    PacketMask inside = 0; ///< those that are in the picture
};
/// Of a picture that is cut into squares of stride x stride pixels, one pixel of each: a group has those of 4 x 4 squares,
/// from the square (column, row) on. The place in a square varies, so that regular patterns are met as often as they
/// occur. With a stride of 1 a group is the block of the picture.
PixelGroup pixel_group(const RenderSettings& settings, int column, int row, int stride) noexcept;

/// Renders all hybrids at once with common random numbers: a sample's primary rays are traced once in each scene.
class HybridTracer {
public:
    /// The camera is the reference's. Throws the errors of TwinPoints.
    HybridTracer(const CauseScenes& scenes, const RenderSettings& settings);

    /// The sums of settings.spp samples (rounded up to an even number) of every pixel of a group, those of
    /// render_halves(). With `object_only`, pixels that do not see the object are left at 0. Called from any thread.
    std::array<HybridSums, packet_size> sums(const PixelGroup& group, bool object_only = true) const;
    int samples_per_half() const noexcept { return settings_.spp / 2; }

private:
    struct Points;
    struct Sample;
    using Values = std::array<Vec3f, 1u << cause_count>;

    bool is_object(const Hit& hit) const noexcept { return hit && is_object_[hit.mesh]; }
    std::vector<Sample> trace_group(const PixelGroup& group) const;
    Hit twin(const Hit& hit, bool to_reference) const noexcept;
    Vec3f seen(const Scene& scene, const Hit& hit, const PrimaryRay& ray) const noexcept;
    void shade_points(const Points& points, bool parallax, const Sample& sample, Values& values) const noexcept;
    Values values(const Sample& sample) const noexcept;

    const Scene &method_, &reference_;
    RenderSettings settings_;
    CameraFrame frame_;  ///< relative to the origin of the reference
    Vec3f to_method_{0}; ///< from the reference's origin to the method's coordinates
    std::vector<bool> is_object_;
    std::map<std::pair<const Shape*, const Shape*>, std::array<std::unique_ptr<TwinPoints>, 2>> made_;
    std::vector<const TwinPoints*> to_reference_, to_method_points_; ///< instances; null: not the object
    std::vector<Material>
        unwidened_; ///< instances: the method's textures on the reference's reflectance, without relief
};

/// The picture of one hybrid.
Image<float> render_hybrid(const HybridTracer& tracer, const RenderSettings& settings, CauseSet on);

} // namespace bake
