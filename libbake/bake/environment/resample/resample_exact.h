// Resampling by overlap area (resample.h says what it does).
#pragma once
#include "bake/environment/resample/overlap.h"
#include "bake/environment/sky/environment.h"
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

namespace bake {

class Progress;

/// What the texels of a source, which must outlive it, throw on a face of a cube. `turn`: source to result.
class FaceRain {
public:
    FaceRain(const Environment& source, const FaceGrid& grid, CubeFace face, const glm::dmat3& turn);
    ~FaceRain();
    /// Rows [low, high) of the face: (high - low) * texels * channels() values, the same bits whatever the rows asked for.
    void rows(int low, int high, float* values, Progress* progress) const;
    /// channels() + 1 values, flux and solid angle, for each of the texels at the face's edges, by frame_index.
    std::vector<double> frame() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Places of the frame of a face of n texels: 4 n of them, corners once each; -1 inside.
int frame_index(int n, int x, int y) noexcept;

/// A picture gathered from a cube.
Image<float> gather_picture(const Environment& cube, Projection projection, int width, int height,
                            const glm::dmat3& turn, Progress* progress);

} // namespace bake
