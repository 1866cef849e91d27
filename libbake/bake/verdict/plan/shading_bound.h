// How much light a surface can reflect more or less when its normal tilts.
//
// A normal n with the slope g against the base normal f is turned by t = atan g. Of a directional light l with the elevation a:
//   Lambert    |n.l - f.l| <= g cos a + sin a (1 - 1 / sqrt(1 + g^2))
//   Phong      the mirror direction turns by 2 t, and cos^e of an angle changes by 2 t times its steepest slope there
//   Blinn      the angle between n and h changes by t
// Below the horizon of the relief, tan a < 2 g, a light may be shadowed, and then all that it gives is the bound. Phong's and
// Blinn's plain forms jump where n.l = 0.
#pragma once
#include "bake/preview/scene.h"
#include <optional>
#include <vector>

namespace bake {

/// Directions towards the viewer: within `angle` radians of `axis`.
struct ViewCone {
    Vec3d axis{0, 0, 1};
    double angle = 0;
};

class ShadingBound {
public:
    /// For a surface of base normal f. Nothing if a light or a part of the material has no bound: lights that are not
    /// directional, a sky that lights, mirrors, glass, GGX, translucency, and textures.
    static std::optional<ShadingBound> of(const Scene& scene, const Material& material, const Vec3d& f,
                                          const ViewCone& view, float exposure);

    /// Upper bound of the change per channel, exposed and clamped to [0, 1], where the slope is at most g, on a surface whose
    /// steepest slope is `steepest`.
    Vec3d change(double g, double steepest) const noexcept;
    /// Upper bound of the radiance of the surface for any normal, exposed and clamped.
    Vec3d most() const noexcept;

private:
    struct Shone {
        double sine = 0, cosine = 1; ///< of the light's elevation
        Vec3d diffuse{0}, specular{0};
        double low = 0, high = 0; ///< angle between the lobe's axis and the viewer, or between f and h
    };
    Vec3d change_of(const Shone& light, double g, double steepest) const noexcept;
    double specular_change(const Shone& light, double tilt) const noexcept;

    std::vector<Shone> lights_;
    Vec3d constant_{0}; ///< emission and ambient light
    double exponent_ = 0, turns_ = 1;
    bool cosine_ = false; ///< the normalised lobes have a factor n.l
    bool shadows_ = true;
};

} // namespace bake
