// From the control points of OpenSubdiv's patches to polynomials in powers. Within its room only.
//
// Gregory patches stand in for the surface where the splitting ends. Their three or four pairs of inner points are
// averaged, which makes them polynomials with the same corners, tangents and borders.
#pragma once
#include "bake/surface/subdivision/refiner.h"
#include <opensubdiv/far/patchTable.h>

namespace bake {

/// Coefficients (limit_patches.h) from control points: weights, terms x points.
struct Conversion {
    int points = 0;
    std::vector<double> weight;
};

/// The conversions of one patch table, each worked out when it is first asked for.
class Conversions {
public:
    Conversions(const OpenSubdiv::Far::PatchTable& table, bool triangles);

    /// `array` and `patch` as the table has them, `index` counts patches through all arrays. The patch's own points, or
    /// its uvs' with `face_varying`.
    const Conversion& of(int array, int patch, int index, bool face_varying);

private:
    const OpenSubdiv::Far::PatchTable& table_;
    bool triangles_;
    Conversion gregory_, linear_;
    Conversion spline_[32]; ///< by the sides that are borders
};

template <class V>
void convert(const Conversion& conversion, const std::vector<Weighed<V>>& points,
             const OpenSubdiv::Far::ConstIndexArray& index, double* out) noexcept {
    for (auto weight = conversion.weight.begin(); weight != conversion.weight.end();) {
        V sum(0);
        for (int i = 0; i < conversion.points; ++i, ++weight)
            if (*weight != 0) sum += *weight * points[std::size_t(index[i])].value;
        for (int k = 0; k < V::length(); ++k) *out++ = sum[k];
    }
}

} // namespace bake
