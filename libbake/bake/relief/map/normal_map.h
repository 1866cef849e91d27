// Normal maps of a height on a plane, or on a UV-mapped mesh with the metric and curvature of the mesh.
#pragma once
#include "bake/picture/pad_texels.h"
#include "bake/relief/map/bake_target.h"
#include "bake/relief/map/normal_code.h"
#include <optional>

namespace bake {

class Progress;

/// Counts of the texels of a map on a mesh, and of faces that are not baked.
struct NormalMapReport {
    std::int64_t covered = 0, border = 0, overlapped = 0; ///< as UvRaster
    std::int64_t outside_faces = 0, crossing_faces = 0;   ///< as UvRaster
    std::string tiles;                                    ///< as UvRaster
    std::int64_t flat_triangles = 0;                      ///< without area in uv
    std::int64_t triangles_without_uv = 0;
    std::int64_t padded = 0;     ///< empty texels filled from the nearest chart
    std::int64_t empty = 0;      ///< texels left at the flat normal
    std::int64_t degenerate = 0; ///< texels without a normal of their own (pole, chart without area): flat
    std::int64_t uncovered = 0;  ///< residual_map(): texels of the base that the displaced mesh does not cover
    std::int64_t folded = 0; ///< texels where the displaced surface is inside out (folds()): blinn replaces exact there
};

/// Height and slopes at the texel centres of a map.
class HeightField {
public:
    /// Slopes are computed by `filter`. If the map is smaller than the height, the height is first box-filtered by
    /// integer factors. If texel centres differ, values and filtered slopes are interpolated (Catmull-Rom; for c2 the
    /// spline itself). The height must outlive this object.
    HeightField(const HeightTexture& height, const HeightOptions& options, Filter filter, int width, int height_texels);
    /// The heights and slopes (per unit of u and v) of row y of the map.
    void row(int y, Height<float>* out, SlopeFilter<float>::Scratch& scratch) const;
    /// The height from which slopes are computed: the texture, or its minified copy.
    const Image<float>& values() const noexcept { return *values_; }
    int width() const noexcept { return width_; }
    int height() const noexcept { return map_height_; }

private:
    int width_, map_height_;
    HeightOptions options_;
    Image<float> minified_;
    const Image<float>* values_;
    SlopeFilter<float> slopes_;
    std::optional<HeightSampler<float>> value_sampler_, u_sampler_, v_sampler_;
    bool spline_ = false;
};

/// The normal map of a height on a flat rectangle of extent (object units): three channels, encoded.
Image<float> normal_map(const HeightField& field, const Vec2d& extent, const NormalMapOptions& options,
                        Progress* progress = nullptr);

/// The normal map of a height on a mesh: three channels, encoded.
Image<float> normal_map(const HeightField& field, const BakeTarget& target, const NormalMapOptions& options,
                        NormalMapReport& report, Progress* progress = nullptr);

/// The two steps of that function. First the texels: `owned` says which have a normal of their own; the others are flat.
Image<float> bake_texels(const HeightField& field, const BakeTarget& target, const NormalMapOptions& options,
                         Image<unsigned char>& owned, NormalMapReport& report, Progress* progress = nullptr);
/// Then the texels around those that have one.
void pad_rest(Image<float>& map, const Image<unsigned char>& owned, int padding, NormalMapReport& report);

} // namespace bake
