// Construction of a limit surface in stages of refinement by OpenSubdiv's Far. Internal to this room.
//
// A stage refines a cage by up to ten levels, the depth that Far can address. Its patches become leaves. Irregular faces
// that are still too large become the cage of the next stage, together with the faces around them.
#pragma once
#include "bake/surface/subdivision/limit_patches.h"
#include "bake/surface/subdivision/refiner.h"
#include <opensubdiv/far/patchTable.h>

namespace bake {

inline constexpr int first_levels = 10;     ///< levels of the first stage
inline constexpr int further_levels = 4;    ///< levels of each later stage
inline constexpr int most_size_levels = 26; ///< sum of levels, for size alone
inline constexpr double smallest_irregular =
    1e-6; ///< of the diagonal; smaller irregular faces are not refined for size
// At high valence (from 10 under Loop, 8 under Catmull-Clark) the second eigenvalue of the scheme is close to the first, and
// the normal converges slowly: by a factor of .78 per level under Loop at valence 10. Smaller faces are refined there too.
inline constexpr int most_normal_levels = 38;
inline constexpr double most_turn_deg = 0.01;    ///< largest angle between a facet and its neighbours that is accepted
inline constexpr double smallest_turning = 5e-9; ///< of the diagonal; in smaller faces the angle is rounding noise

/// The part of a patch that a face of some level, or a leaf, covers.
struct Subdomain {
    std::int32_t patch = -1;
    LimitLeaf leaf{1, Vec2d(0)};
    int depth = 0;
};
/// The subdomain of a patch that `inner` is of the face with subdomain `outer`.
Subdomain within(const Subdomain& outer, const Subdomain& inner);

/// One stage: a cage and its refinement.
struct Stage {
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
    std::vector<Weighted<Vec3d>> points; ///< of the cage; after refinement of all levels and of the patches' own points
    std::vector<Weighted<Vec2d>> uvs;    ///< likewise
    std::vector<Subdomain> subdomains;   ///< per patch of the cage, in Far's order
    std::vector<int> first;              ///< per face of the cage: its first subdomain
    std::vector<int> faces;              ///< faces that get patches; empty: all
    int levels = 0;                      ///< levels of this stage
    int total_levels = 0;                ///< sum of the levels of all stages so far
};

/// The subdomain of Far's patch.
Subdomain subdomain_of(const Stage& stage, const OpenSubdiv::Far::PatchParam& param, bool triangles);
/// The subdomains of the faces of the last level.
std::vector<Subdomain> last_subdomains(const Stage& stage, bool triangles);

/// True for patches that only approximate the surface.
bool is_irregular(const OpenSubdiv::Far::PatchTable& table, int array);

/// Faces of the last level that the next stage refines, per patch of the table; -1 for patches that become leaves. These
/// are the irregular faces that are too large and the irregular faces that share a vertex with one of them, which keeps
/// neighbours at the same level. `diagonal` is that of the first cage.
std::vector<int> faces_to_refine(const Stage& stage, const OpenSubdiv::Far::PatchTable& table,
                                 const std::vector<Subdomain>& last, double diagonal, bool triangles);
/// The stage whose cage is these faces and the faces around them. The border of this cage is not a border of the surface,
/// but too far away to affect the patches.
Stage next_stage(const Stage& stage, const std::vector<int>& to_refine, const std::vector<Subdomain>& last,
                 const SubdivisionOptions& options, const LimitPatches& limit);

/// Appends the patches as leaves, except those with a face in `to_refine` (empty: no exceptions).
void add_leaves(const Stage& stage, const OpenSubdiv::Far::PatchTable& table, const std::vector<int>& to_refine,
                LimitPatches& limit);
/// Marks links of the quadtrees without a leaf.
inline constexpr std::int32_t missing_leaf = std::numeric_limits<std::int32_t>::min();
/// True if leaves cover the whole tree.
bool is_complete(const LimitPatches& limit, std::int32_t root) noexcept;

/// All patches of a cage.
void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit);

} // namespace bake
