// Warnings and notes of the reports.
#include "bake/verdict/inspect.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bake {
namespace {

std::string number(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", v);
    return text;
}

std::string percent(double part) {
    char text[32];
    std::snprintf(text, sizeof text, part < 0.0095 ? "%.2g %%" : "%.3g %%", 100 * part);
    return text;
}

// counted(2, "face") is "2 faces". Words after a '|' are not inflected: counted(2, "face|without uvs") is "2 faces without
// uvs".
std::string counted(std::size_t count, const std::string& what) {
    const std::size_t bar = what.find('|');
    std::string noun = what.substr(0, bar);
    if (count != 1) noun = noun.ends_with("vertex") ? noun.substr(0, noun.size() - 2) + "ices" : noun + "s";
    return std::to_string(count) + " " + noun + (bar == std::string::npos ? "" : " " + what.substr(bar + 1));
}

void add_if(std::vector<std::string>& list, std::size_t count, const std::string& what, const std::string& rest) {
    if (count > 0) list.push_back(counted(count, what) + ": " + rest);
}

void judge_topology(const MeshCheck& c, Findings& out) {
    const Topology& t = c.welded;
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
    if (c.faces_without_normal == c.faces)
        out.notes.push_back("no normals: smooth normals are computed from the faces");
    else
        add_if(out.warnings, c.faces_without_normal, "face|without normals",
               "other faces have normals; theirs are computed from the faces");
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
    add_if(out.warnings, uv.outside_faces, "face|outside the UDIM tiles", "u below 0 or above 10, or v below 0");
    add_if(out.warnings, uv.crossing_faces, "face|across the border of a UDIM tile", "baked only inside the tile");
    add_if(out.notes, uv.mirrored_triangles, "mirrored triangle",
           "relief and tangents are correct (sigma = -1), text is mirrored");
    if (2 * uv.mirrored_triangles > report.check.triangles)
        out.notes.push_back(
            "most triangles are mirrored: perhaps v does not follow the rule of the format; see `flip_v`");
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

constexpr int few_levels = 100; // with fewer levels terraces are visible at useful amplitudes

std::size_t share_of(double part, int width, int height) { return std::size_t(part * width * height + 0.5); }

bool printable(const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](char ch) { return ch >= ' ' && ch <= '~'; });
}

bool is_lossy(const ImageCheck& c) { return c.info.format == "jpeg"; }

void add_image_notes(const ImageCheck& c, Findings& out) {
    if (c.looks == Looks::grey && c.colour_channels == 3 && c.tint > 0)
        out.notes.push_back("grey, but its channels differ by up to " + number(c.tint) +
                            " of 255 levels: the mean of the channels is used");
    if (c.looks == Looks::grey && is_lossy(c))
        out.notes.push_back("lossy compression: its blocks are visible in slopes; use the original if possible");
    if (c.looks == Looks::grey && (c.tiling.x > tiles_up_to || c.tiling.y > tiles_up_to))
        out.notes.push_back(std::string("does not tile in ") +
                            (c.tiling.x > tiles_up_to ? (c.tiling.y > tiles_up_to ? "x and y" : "x") : "y") +
                            ": as a height use `wrap" +
                            (c.tiling.x > tiles_up_to ? (c.tiling.y > tiles_up_to ? "" : "_u") : "_v") + "` clamp");
    if (c.info.alpha_channel >= 0 && std::size_t(c.info.alpha_channel) < c.channels.size()) {
        const ChannelCheck& alpha = c.channels[c.info.alpha_channel];
        if (alpha.min == alpha.max && alpha.min == 1) out.notes.push_back("alpha is 1 everywhere");
        else if (alpha.levels > 16 && c.channels.size() > 2)
            out.notes.push_back("alpha has " + (alpha.levels > most_levels ? "many" : std::to_string(alpha.levels)) +
                                " levels: perhaps packed data, such as a height (`grey` a)");
    }
}

} // namespace

Findings judge(const MeshReport& report) {
    Findings out;
    judge_topology(report.check, out);
    judge_uvs(report, out);
    if (const auto& gltf = report.gltf) {
        add_if(out.warnings, gltf->missing_images, "missing image", "the textures that use it are missing too");
        if (gltf->normal_textures > 0 && !gltf->tangents)
            out.notes.push_back(
                "a normal texture without tangents: viewers compute tangents, by MikkTSpace if they follow the format");
    }
    judge_audit(report, out);
    return out;
}

Findings judge(const ImageReport& report) {
    Findings out;
    const ImageCheck& c = report.check;
    for (const std::string& channel : c.info.channels)
        if (!printable(channel))
            out.warnings.push_back("a channel has a name that cannot be printed: the file is damaged");
    for (const ChannelCheck& channel : c.channels) {
        add_if(out.warnings, channel.nan, "NaN", "in channel " + channel.name);
        add_if(out.warnings, channel.inf, "infinite value", "in channel " + channel.name);
    }
    const ChannelCheck& first = c.channels.front();
    if (c.looks == Looks::constant) out.warnings.push_back("every texel has the same value, " + number(first.min));
    const bool whole = c.info.type == SampleType::u8 || c.info.type == SampleType::u16;
    const int stored = c.info.bits;
    // Content of up to 4 bits is usually a palette or a mask, not an export that lost its depth.
    if (c.looks != Looks::constant && c.true_bits > 4 && c.true_bits < stored)
        out.warnings.push_back(std::to_string(stored) + "-bit file with " + std::to_string(c.true_bits) +
                               "-bit content: " + counted(std::size_t(first.levels), "level"));
    if (c.looks == Looks::grey && whole && c.grey.levels > 16 && c.grey.levels < few_levels)
        out.warnings.push_back(
            "only " + std::to_string(c.grey.levels) + " levels in use, in [" + number(c.grey.min) + ", " +
            number(c.grey.max) +
            "]: slopes are quantised; export the height normalised, with 16 bits, or use `dequantise`");
    if (c.looks == Looks::normal_map) {
        if (c.not_unit > 0.1)
            out.warnings.push_back(percent(c.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                                   number(c.normal_length) + "); normalise them before use");
        add_if(out.warnings, share_of(c.inward, c.info.width, c.info.height), "normal|that point into the surface",
               "blue below half");
    }
    add_image_notes(c, out);
    return out;
}

bool PairReport::unexpected() const noexcept {
    const double corr = std::min(std::abs(check.corr_x), std::abs(check.corr_y));
    return directx && (check.flat || corr < pair_tells || check.directx != *directx);
}

Findings judge(const PairReport& report) {
    Findings out;
    const PairCheck& c = report.check;
    if (c.flat) {
        out.warnings.push_back("the height or the normal map is flat: there is nothing to compare");
        return out;
    }
    const double corr = std::min(std::abs(c.corr_x), std::abs(c.corr_y));
    if (corr < pair_tells)
        out.warnings.push_back("the two do not show the same relief (correlation " + number(corr) +
                               "): the rest is a guess");
    else if (corr < pair_agrees)
        out.warnings.push_back("the two agree only roughly (correlation " + number(corr) + ")");
    if (c.inverted)
        out.warnings.push_back("inverted height: the normal map is that of the negative height; bake with `invert`");
    if (report.directx && c.directx != *report.directx)
        out.warnings.push_back(std::string("green points ") +
                               (c.directx ? "down (DirectX), where OpenGL" : "up (OpenGL), where DirectX") +
                               " is expected; flip the green channel");
    else if (c.directx && !report.directx)
        out.warnings.push_back(
            "DirectX green: y points down in the normal map; bake with `directx` to match, or flip its green");
    if (c.not_unit > 0.1)
        out.warnings.push_back(percent(c.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                               number(c.normal_length) + "): normalised before use");
    add_if(out.warnings, share_of(c.inward, report.normal_width, report.normal_height),
           "normal|that point into the surface", "blue at or below half, which has no slope");
    if (report.height_width != report.normal_width || report.height_height != report.normal_height)
        out.warnings.push_back("sizes differ: compared at " + std::to_string(c.width) + " x " +
                               std::to_string(c.height));
    const double gap = std::abs(std::abs(c.scale_x) - std::abs(c.scale_y));
    if (corr >= pair_agrees && gap > 0.15 * c.scale)
        out.notes.push_back("the slopes along x and y have different scales: the texels may not be square");
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
