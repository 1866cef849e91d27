// What a high-poly mesh is like where a ray from the low-poly mesh lands, besides its normal.
#pragma once
#include "bake/relief/transfer/casting.h"
#include "bake/relief/transfer/high_surface.h"
#include <span>

namespace bake {

enum class DetailMap {
    height,            ///< over the low-poly mesh along the cast, object units, outward positive
    position,          ///< of the hit, object units, relative to the origin of the low-poly mesh
    ambient_occlusion, ///< share of the light of a uniform sky that arrives: 1 where nothing is in the way
    bent_normal,    ///< mean direction from which that light comes, in the space of the normal map and encoded like it
    thickness,      ///< distance to the other side, straight inward from the hit, object units; 0 where there is none
    mean_curvature, ///< as surface/point/curvature.h, from the corners' normals
    gauss_curvature,
    id, ///< a colour for each mesh and each of its materials
};
inline constexpr DetailMap all_detail_maps[] = {
    DetailMap::height,    DetailMap::position,       DetailMap::ambient_occlusion, DetailMap::bent_normal,
    DetailMap::thickness, DetailMap::mean_curvature, DetailMap::gauss_curvature,   DetailMap::id};
/// The name in the command line and in file names: "height", "ambient-occlusion".
const char* name(DetailMap map) noexcept;
/// 3 for positions, bent normals and ids, else 1.
int channels(DetailMap map) noexcept;

struct DetailOptions {
    std::vector<DetailMap> maps;
    int sky_rays = 64;             ///< of ambient occlusion and bent normals, for each ray that lands; 1 to 4096
    float sky_distance = INFINITY; ///< beyond it nothing is in the way, object units
};

/// A ray that has landed.
struct Landing {
    const Cast& cast;
    const Hit& hit;
    Vec3f normal;       ///< of the high-poly mesh there
    std::uint64_t seed; ///< of the texel and its sample: rays to the sky are turned by it
};

/// Values of the maps at a landing.
class DetailProbe {
public:
    DetailProbe(const HighSurface& high, const DetailOptions& options);
    /// out: the values of maps[i] from values[4 i] on. Bent normals are in object space, zero where no light arrives.
    void at(const Landing& landing, std::span<float> values) const noexcept;

private:
    struct Sky {
        float open = 1; ///< share of the rays
        Vec3f bent{0};
    };
    Sky sky_at(const Landing& landing) const noexcept;
    float thickness_at(const Landing& landing) const noexcept;

    const HighSurface& high_;
    const DetailOptions& options_;
    bool needs_sky_;
};

/// Height over the low-poly mesh.
float height_of(const Cast& cast, const Vec3f& landed) noexcept;

} // namespace bake
