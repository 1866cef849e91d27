// Warnings and notes of the reports on meshes.
#include "bake/base/text.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/inspect.h"
#include <cmath>

namespace bake {
namespace {

/// With two digits, not below the value.
std::string rounded_up(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return format("%.2g", std::ceil(value / unit + 0.01) * unit);
}

void judge_topology(const MeshCheck& c, Findings& out) {
    const Connectivity& t = c.welded;
    add_if(out.warnings, t.nonmanifold_edges, "non-manifold edge",
           "shared by three faces or more; normals and subdivision are undefined there");
    if (t.nonmanifold_edges == 0)
        add_if(out.warnings, t.nonmanifold_vertices, "non-manifold vertex",
               "shared by more than one fan of faces; split it");
    add_if(out.warnings, t.flipped_faces, "flipped face",
           "oriented against the adjacent faces; relief would go inwards there");
    if (t.unorientable_edges > 0)
        out.warnings.push_back("the surface is one-sided (" + counted(t.unorientable_edges, "edge") +
                               " without a consistent orientation): it has no outside");
    add_if(out.warnings, t.inside_out_components, "inside-out component",
           "closed, with normals that point inwards; reverse its faces");
    add_if(out.warnings, c.duplicate_faces, "duplicate face", "uses the positions of another face; delete one of them");
    add_if(out.warnings, c.repeated_corners, "face|with a position used twice",
           "it has an edge of length zero, or touches itself");
    add_if(out.warnings, c.zero_area_faces, "zero-area face", "without a normal");
    add_if(out.warnings, c.bad_normals, "normal|of length zero", "computed from the faces instead");
    add_if(out.warnings, c.opposed_normals, "corner|with a normal over 90 degrees off its face",
           "shading is black or inverted there");
    add_if(out.notes, c.unused_positions, "unused position", "not used by any face");
    if (c.coincident_positions > 0 && c.topology.boundary_edges != c.welded.boundary_edges)
        out.notes.push_back("not welded: " + counted(c.coincident_positions, "position") +
                            " repeat another position; according to the indices there are " +
                            counted(c.topology.boundary_edges, "boundary edge") + " and " +
                            counted(c.topology.components, "component"));
    if (c.gaps.edges > 0)
        out.notes.push_back("borders nearly touch: " + counted(c.gaps.edges, "boundary edge") +
                            " lie on others, up to " + number(c.gaps.widest) +
                            " apart; displace and surface join them if `weld` is " + rounded_up(c.gaps.widest));
    if (c.faces_without_normal == c.faces)
        out.notes.push_back("no normals: smooth normals are computed from the faces");
    else
        add_if(out.warnings, c.faces_without_normal, "face|without normals",
               "other faces have normals; theirs are computed from the faces");
}

void judge_tiles(const UvCheck& uv, Findings& out) {
    switch (uv.tiles.placement) {
    case ChartPlacement::as_they_are: break;
    case ChartPlacement::one_tile:
        out.notes.push_back("the charts lie in one tile, " + names(uv.tiles.tiles) + ": a bake takes them modulo 1");
        break;
    case ChartPlacement::modulo_1:
        out.notes.push_back(
            "the charts lie in tiles " + names(uv.tiles.tiles) + ": a bake takes them modulo 1" +
            (uv.tiles.clash > 0 ? ", where " + percent(uv.tiles.clash) + " of their area overlaps" : ""));
        break;
    case ChartPlacement::several:
        out.warnings.push_back("the charts lie in several tiles (" + names(uv.tiles.tiles) +
                               ") and overlap modulo 1: a bake takes one tile, which `tile` names");
        add_if(out.warnings, uv.outside_faces, "face|outside the UDIM tiles", "u below 0 or above 10, or v below 0");
        add_if(out.warnings, uv.crossing_faces, "face|across the border of a UDIM tile", "baked only inside the tile");
    }
}

void judge_uvs(const MeshReport& report, Findings& out) {
    const UvCheck& uv = report.uv;
    if (report.check.faces_without_uv == report.check.faces) {
        out.warnings.push_back("no uvs: nothing can be baked");
        return;
    }
    add_if(out.warnings, report.check.faces_without_uv, "face|without uvs", "skipped by every bake");
    add_if(out.warnings, uv.degenerate_triangles, "triangle|without uv area",
           "they cover no texel, and take their tangents from adjacent triangles");
    if (uv.overlap > 0.001)
        out.warnings.push_back(
            "overlapping uvs: " + percent(uv.overlap) +
            " of the covered area belongs to more than one face; the first of them in the file is baked");
    judge_tiles(uv, out);
    add_if(out.notes, uv.mirrored_triangles, "mirrored triangle",
           "relief and tangents are correct (sigma = -1), text is mirrored");
    if (double(uv.mirrored_triangles) > 0.9 * double(uv.triangles - uv.degenerate_triangles))
        out.notes.push_back(
            "nearly all triangles are mirrored: perhaps v does not follow the rule of the format; see `flip_v`");
    if (uv.density.p5 > 0 && uv.density.p95 / uv.density.p5 > 4)
        out.notes.push_back("texel density varies " + number(uv.density.p95 / uv.density.p5) +
                            " times between its 5th and 95th percentile");
}

void judge_audit(const MeshReport& report, Findings& out) {
    if (report.audited && !report.audit.available) out.notes.push_back("no audit: this build has no CGAL");
    if (report.audit.available) {
        const MeshAudit& a = report.audit;
        if (a.self_intersections > 0)
            out.warnings.push_back(counted(a.self_intersections, "pair|of intersecting triangles") +
                                   ": the surface intersects itself, first in faces " +
                                   std::to_string(a.first_faces[0]) + " and " + std::to_string(a.first_faces[1]) +
                                   " near (" + number(a.first_place.x) + " " + number(a.first_place.y) + " " +
                                   number(a.first_place.z) + ")");
        add_if(out.warnings, a.inverted_components, "closed component|inside out",
               a.nested_components > 0 ? "outer shells must be oriented outward, walls of cavities inward"
                                       : "its normals point inwards: it bounds no volume");
    }
}

} // namespace

Findings judge(const MeshReport& report) {
    Findings out;
    judge_topology(report.check, out);
    judge_uvs(report, out);
    if (const auto& gltf = report.gltf) {
        out.notes.insert(out.notes.end(), gltf->notes.begin(), gltf->notes.end());
        add_if(out.warnings, gltf->missing_images, "missing image", "the textures that use it are missing too");
        if (gltf->normal_textures > 0 && !gltf->tangents)
            out.notes.push_back(
                "a normal texture without tangents: viewers compute tangents, by MikkTSpace if they follow the format");
    }
    judge_audit(report, out);
    return out;
}

Findings judge(const DistanceReport& report) {
    Findings out;
    const MeshDistance& d = report.distance;
    if (report.over_limit())
        out.warnings.push_back("over the limit: the upper bound is " + number(d.upper) + ", the limit " +
                               number(report.limit) +
                               (d.lower > report.limit ? "" : "; the lower bound is within the limit"));
    if (d.upper > 1.5 * d.lower && d.upper > 1e-6 * d.diagonal)
        out.notes.push_back(
            "the bounds are far apart: refinement reached its limit, because the meshes differ too much");
    return out;
}

} // namespace bake
