// Connectivity and geometry of a polygon mesh: what is in it, and what is wrong with it.
#pragma once
#include "bake/mesh/border_weld.h"
#include "bake/mesh/triangulate.h"

namespace bake {

/// Connectivity of the faces. Corners that repeat the position of the corner before them are skipped; a face that then
/// has fewer than three corners has no edges.
struct Connectivity {
    std::size_t edges = 0;
    std::size_t boundary_edges = 0;        ///< edges of one face
    std::size_t boundary_loops = 0;        ///< closed chains of boundary edges
    std::size_t nonmanifold_edges = 0;     ///< edges of three faces or more
    std::size_t nonmanifold_vertices = 0;  ///< positions on such an edge, or with more than one fan of faces
    std::size_t components = 0;            ///< sets of faces connected through edges
    std::size_t closed_components = 0;     ///< components without boundary, non-manifold edge or flipped face
    std::size_t inside_out_components = 0; ///< closed ones whose faces are oriented inwards (negative volume)
    std::size_t flipped_faces = 0;         ///< faces oriented against the majority of the faces connected to them
    std::size_t unorientable_edges =
        0; ///< edges whose faces disagree in orientation on a non-orientable surface (Moebius strip)
};

struct MeshCheckOptions {
    double zero_area = 1e-12; ///< largest area of a degenerate face, as a fraction of the squared bounding-box diagonal
};

struct MeshCheck {
    std::size_t positions = 0, faces = 0, corners = 0, triangles = 0;
    std::vector<std::size_t> faces_of_size; ///< [n]: faces with n corners; the last entry counts all larger ones too
    std::size_t materials = 0, groups = 0;
    Bounds box;
    double diagonal = 0;
    double area = 0;

    Connectivity topology;                ///< by the indices of the file
    std::size_t coincident_positions = 0; ///< positions bit-equal to an earlier one: the file is not welded there
    Connectivity welded;                  ///< with bit-equal positions welded

    BorderGaps gaps; ///< within 1e-4 of the diagonal, with bit-equal positions welded

    std::size_t unused_positions = 0;
    std::size_t repeated_corners = 0; ///< faces that use one position twice
    std::size_t duplicate_faces = 0;  ///< faces with the positions of an earlier face, in either orientation
    std::size_t zero_area_faces = 0;  ///< faces all of whose triangles have at most zero_area * diagonal^2
    std::size_t faces_without_uv = 0; ///< faces with a corner without uv
    std::size_t faces_without_normal = 0;
    std::size_t bad_normals = 0;     ///< corners with a normal of length zero
    std::size_t opposed_normals = 0; ///< corners whose normal is more than 90 degrees from the normal of their face
};

/// Largest entry of faces_of_size.
inline constexpr std::size_t largest_listed_face = 8;

/// `triangles` are those of triangulate(mesh). No mesh is refused.
MeshCheck check_mesh(const Mesh& mesh, const std::vector<Triangle>& triangles, const MeshCheckOptions& options = {});

} // namespace bake
