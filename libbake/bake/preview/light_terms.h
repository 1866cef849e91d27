// What each light adds to a hit, recorded for an explanation of a pixel.
#pragma once
#include "bake/base/vec.h"
#include <vector>

namespace bake {

/// What a light, or the sky, adds to the radiance of a hit.
struct LightTerm {
    static constexpr int sky = -1; ///< a direction drawn where the sky is bright
    static constexpr int sky_by_surface =
        -2; ///< a direction drawn for the surface: the sky, or a mesh that is seen there
    static constexpr int filtered_sky = -3; ///< the sky as in real-time engines
    static constexpr int from_inside = -4;  ///< light that enters elsewhere and leaves a translucent body here
    static constexpr int others = 4;        ///< how many of these there are
    int light = sky;                        ///< index in Scene::lights, or one of the above
    Vec3f l{0};                             ///< of a light: unit vector towards it
    Vec3f radiance{0};                      ///< of a light: the irradiance at normal incidence over pi
    Vec3f diffuse{0}, specular{0};
};

/// While it lives, watches what is added to a diffuse and a specular sum for one light, and hands that to `terms`, if
/// given.
class TermRecord {
public:
    TermRecord(std::vector<LightTerm>* terms, const Vec3f& diffuse, const Vec3f& specular, int light,
               const Vec3f& l = Vec3f(0), const Vec3f& radiance = Vec3f(0)) noexcept
        : terms_(terms), diffuse_(diffuse), specular_(specular) {
        if (terms_) term_ = {light, l, radiance, diffuse, specular};
    }
    ~TermRecord() {
        if (!terms_) return;
        term_.diffuse = diffuse_ - term_.diffuse, term_.specular = specular_ - term_.specular;
        terms_->push_back(term_);
    }
    TermRecord(const TermRecord&) = delete;
    TermRecord& operator=(const TermRecord&) = delete;

private:
    std::vector<LightTerm>* terms_;
    const Vec3f &diffuse_, &specular_;
    LightTerm term_;
};

} // namespace bake
