// What error_budget needs to know of each bake: its surface, its filter and its file's depth.
#pragma once
#include "bake/relief/map/error_budget.h"
#include "bake/relief/map/normal_map.h"

namespace bake {

/// An encoded normal as a file of that depth gives it back.
Vec3f stored_normal(const Vec3f& rgb, Depth depth) noexcept;

/// Of a normal map on a flat rectangle of `extent` object units. `depth` is the file's, not automatic. What is passed by
/// reference must outlive the input.
BudgetInput plane_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                         const Vec2d& extent, Depth depth);
/// Of a normal map on a mesh.
BudgetInput mesh_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                        const BakeTarget& target, Depth depth);
/// Of a bump table used on a flat rectangle of the options' extent. `code` is that of a 16-bit file, which needs one.
BudgetInput table_budget(const HeightTexture& height, const BumpTableOptions& options, Depth depth,
                         const std::optional<SlopeCode>& code = {});

} // namespace bake
