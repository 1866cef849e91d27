// Conversion of OpenSubdiv's patches to polynomials in the power basis. Internal to this room.
//
// Gregory patches approximate the surface where refinement ends. Their three or four pairs of inner points are averaged,
// which makes them polynomials with the same corners, tangents and borders.
#pragma once
#include "bake/surface/subdivision/refiner.h"
#include <opensubdiv/far/patchTable.h>

namespace bake {

/// Matrix of weights (terms x points) from control points to coefficients (limit_patches.h).
struct Conversion {
    int points = 0;
    std::vector<double> weight;
};

/// The conversions of one patch table, computed on first use.
class Conversions {
public:
    Conversions(const OpenSubdiv::Far::PatchTable& table, bool triangles);

    /// `array` and `patch` are those of the table; `index` counts patches over all arrays. The result converts the points
    /// of the patch or, if `face_varying`, its uvs.
    const Conversion& of(int array, int patch, int index, bool face_varying);

private:
    const OpenSubdiv::Far::PatchTable& table_;
    bool triangles_;
    Conversion gregory_, linear_;
    Conversion spline_[32]; ///< indexed by the bits of the sides that are borders
};

template <class V>
void convert(const Conversion& conversion, const std::vector<Weighted<V>>& points,
             const OpenSubdiv::Far::ConstIndexArray& index, double* out) noexcept {
    for (auto weight = conversion.weight.begin(); weight != conversion.weight.end();) {
        V sum(0);
        for (int i = 0; i < conversion.points; ++i, ++weight)
            if (*weight != 0) sum += *weight * points[std::size_t(index[i])].value;
        for (int k = 0; k < V::length(); ++k) *out++ = sum[k];
    }
}

} // namespace bake
