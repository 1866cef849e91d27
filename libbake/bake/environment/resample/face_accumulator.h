// Resampling by overlap area onto the face of a cube (Samples::exact in resample.h).
#pragma once
#include "bake/environment/resample/overlap.h"
#include "bake/environment/sky/environment.h"
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

namespace bake {

class Progress;

/// Accumulates the radiance of all texels of a source on the texels of one face. The source must outlive the accumulator.
/// `turn`: rotation from source to result.
class FaceAccumulator {
public:
    FaceAccumulator(const Environment& source, const FaceGrid& grid, CubeFace face, const glm::dmat3& turn);
    ~FaceAccumulator();
    /// Rows [low, high) of the face: (high - low) * texels * channels() values. A row has the same bits in every range.
    void rows(int low, int high, float* values, Progress* progress) const;
    /// The border texels of the face, by border_index: channels() fluxes and the solid angle of each.
    std::vector<double> border() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Index of a border texel of a face of n x n texels, in [0, 4 n); -1 for inner texels. Corners have one index.
int border_index(int n, int x, int y) noexcept;

} // namespace bake
