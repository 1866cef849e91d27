// The input of error_budget for each kind of bake: its surface, its filter and the depth of its file.
#pragma once
#include "bake/relief/map/error_budget.h"
#include "bake/relief/map/normal_map.h"

namespace bake {

/// The value that is read back from a file of this depth in which an encoded normal was written.
Vec3f stored_normal(const Vec3f& rgb, Depth depth) noexcept;

/// For a normal map on a flat rectangle of `extent` object units. `depth` is that of the file, not automatic. Arguments
/// passed by reference must outlive the result.
BudgetInput plane_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                         const Vec2d& extent, Depth depth);
/// For a normal map on a mesh.
BudgetInput mesh_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                        const BakeTarget& target, Depth depth);
/// For a bump table on a flat rectangle of the extent in `options`. `code` is required for a 16-bit file.
BudgetInput table_budget(const HeightTexture& height, const BumpTableOptions& options, Depth depth,
                         const std::optional<SlopeCode>& code = {});

} // namespace bake
