#include "bake/verdict/inspect.h"
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/io.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>

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

// counted(1, "face") is "1 face", counted(2, "face") "2 faces"; a '|' parts what stays singular: "face|without uvs".
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
               "more than one fan of faces meets there; split it");
    add_if(out.warnings, t.flipped_faces, "flipped face",
           "turned against the neighbours; relief would go inwards there");
    if (t.unorientable_edges > 0)
        out.warnings.push_back("the surface has one side only (" + counted(t.unorientable_edges, "edge") +
                               " cannot agree): it has no outside");
    add_if(out.warnings, t.inside_out_components, "inside-out component",
           "closed, and the faces look inwards; turn them round");
    add_if(out.warnings, c.duplicate_faces, "duplicate face",
           "over the very positions of another face; delete one of them");
    add_if(out.warnings, c.repeated_corners, "face|with a position used twice",
           "an edge of no length, or a face that touches itself");
    add_if(out.warnings, c.zero_area_faces, "zero-area face", "no normal of their own");
    add_if(out.warnings, c.bad_normals, "normal|of length zero", "computed from the faces instead");
    add_if(out.warnings, c.opposed_normals, "corner|with a normal over 90 degrees off its face",
           "shading goes black or inside out there");
    add_if(out.notes, c.unused_positions, "unused position", "in no face");
    if (c.coincident_positions > 0 && c.topology.boundary_edges != c.welded.boundary_edges)
        out.notes.push_back("not welded: " + counted(c.coincident_positions, "position") +
                            " repeat another; by the indices alone there are " +
                            counted(c.topology.boundary_edges, "boundary edge") + " and " +
                            counted(c.topology.components, "component"));
    if (c.faces_without_normal == c.faces) out.notes.push_back("no normals: smooth ones are computed from the faces");
    else
        add_if(out.warnings, c.faces_without_normal, "face|without normals",
               "others have them; computed from the faces instead");
}

void judge_uvs(const MeshReport& report, Findings& out) {
    const UvCheck& uv = report.uv;
    if (report.check.faces_without_uv == report.check.faces) {
        out.warnings.push_back("no uvs: nothing can be baked onto it");
        return;
    }
    add_if(out.warnings, report.check.faces_without_uv, "face|without uvs", "left out of every bake");
    add_if(out.warnings, uv.degenerate_triangles, "triangle|without uv area",
           "no texel shows them, and their tangents are borrowed");
    if (uv.overlap > 0.001)
        out.warnings.push_back("overlapping uvs: " + percent(uv.overlap) +
                               " of the covered area lies under more than one face; the lowest face is baked there");
    add_if(out.warnings, uv.outside_faces, "face|outside the UDIM tiles", "u below 0 or above 10, or v below 0");
    add_if(out.warnings, uv.crossing_faces, "face|across the border of a UDIM tile",
           "baked only as far as the tile goes");
    add_if(out.notes, uv.mirrored_triangles, "mirrored triangle",
           "relief and tangents follow (sigma = -1), text would not read");
    if (2 * uv.mirrored_triangles > report.check.triangles)
        out.notes.push_back("most triangles are mirrored: perhaps v does not run as the format says; see --flip-v");
    if (uv.density.p5 > 0 && uv.density.p95 / uv.density.p5 > 4)
        out.notes.push_back("texel density varies " + number(uv.density.p95 / uv.density.p5) +
                            " times between its 5th and 95th percentile");
}

constexpr int few_levels = 100; // below it terraces show at any amplitude worth baking

std::size_t share_of(double part, int width, int height) { return std::size_t(part * width * height + 0.5); }

bool printable(const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](char ch) { return ch >= ' ' && ch <= '~'; });
}

bool is_lossy(const ImageCheck& c) { return c.info.format == "jpeg"; }

} // namespace

bool named_like_a_mesh(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    constexpr std::array<const char*, 9> endings = {".obj",  ".ply", ".off", ".stl", ".fbx",
                                                    ".gltf", ".glb", ".usd", ".abc"};
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

Findings judge(const MeshReport& report) {
    Findings out;
    judge_topology(report.check, out);
    judge_uvs(report, out);
    if (const auto& gltf = report.gltf) {
        add_if(out.warnings, gltf->missing_images, "image|that is not there", "its textures are not either");
        if (gltf->normal_textures > 0 && !gltf->tangents)
            out.notes.push_back(
                "a normal texture and no tangents: viewers make their own, by MikkTSpace if they keep to the format");
    }
    if (report.audited && !report.audit.available) out.notes.push_back("no audit: this build has no CGAL");
    if (report.audit.available) {
        const MeshAudit& a = report.audit;
        if (a.self_intersections > 0)
            out.warnings.push_back(counted(a.self_intersections, "pair|of triangles that cut each other") +
                                   ": the surface intersects itself, first in faces " +
                                   std::to_string(a.first_faces[0]) + " and " + std::to_string(a.first_faces[1]) +
                                   " near (" + number(a.first_place.x) + " " + number(a.first_place.y) + " " +
                                   number(a.first_place.z) + ")");
        add_if(out.warnings, a.inverted_components, "closed component|inside out",
               a.nested_components > 0 ? "shells must look outwards, and walls of hollows inwards"
                                       : "its faces look inwards: it bounds no volume");
    }
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
    // Up to 4 bits a palette or a mask is meant, not an export that lost its depth.
    if (c.looks != Looks::constant && c.true_bits > 4 && c.true_bits < stored)
        out.warnings.push_back(std::to_string(stored) + "-bit file with " + std::to_string(c.true_bits) +
                               "-bit content: " + counted(std::size_t(first.levels), "level"));
    if (c.looks == Looks::grey && whole && c.grey.levels > 16 && c.grey.levels < few_levels)
        out.warnings.push_back(
            "only " + std::to_string(c.grey.levels) + " levels in use, in [" + number(c.grey.min) + ", " +
            number(c.grey.max) +
            "]: slopes come in steps; export the height normalised, with 16 bits, or use --dequantise");
    if (c.looks == Looks::normal_map) {
        if (c.not_unit > 0.1)
            out.warnings.push_back(percent(c.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                                   number(c.normal_length) + "); normalise them before use");
        add_if(out.warnings, share_of(c.inward, c.info.width, c.info.height), "normal|into the surface",
               "blue below half");
    }
    if (c.looks == Looks::grey && c.colour_channels == 3 && c.tint > 0)
        out.notes.push_back("grey, but its channels differ by up to " + number(c.tint) +
                            " of 255 levels: the mean of the channels is taken");
    if (c.looks == Looks::grey && is_lossy(c))
        out.notes.push_back("lossy file: its blocks show in slopes; prefer the original");
    if (c.looks == Looks::grey && (c.tiling.x > tiles_up_to || c.tiling.y > tiles_up_to))
        out.notes.push_back(std::string("does not tile in ") +
                            (c.tiling.x > tiles_up_to ? (c.tiling.y > tiles_up_to ? "x and y" : "x") : "y") +
                            ": as a height use --wrap" +
                            (c.tiling.x > tiles_up_to ? (c.tiling.y > tiles_up_to ? "" : "-u") : "-v") + " clamp");
    if (c.info.alpha_channel >= 0 && std::size_t(c.info.alpha_channel) < c.channels.size()) {
        const ChannelCheck& alpha = c.channels[c.info.alpha_channel];
        if (alpha.min == alpha.max && alpha.min == 1) out.notes.push_back("alpha is 1 everywhere");
        else if (alpha.levels > 16 && c.channels.size() > 2)
            out.notes.push_back("alpha holds " + (alpha.levels > most_levels ? "many" : std::to_string(alpha.levels)) +
                                " levels: perhaps packed data, such as a height (--channel a)");
    }
    return out;
}

Findings judge(const PairReport& report) {
    Findings out;
    const PairCheck& c = report.check;
    if (c.flat) {
        out.warnings.push_back("one of them is flat: nothing to compare");
        return out;
    }
    const double corr = std::min(std::abs(c.corr_x), std::abs(c.corr_y));
    if (corr < pair_tells)
        out.warnings.push_back("they do not show the same relief (correlation " + number(corr) +
                               "): what follows is a guess");
    else if (corr < pair_agrees) out.warnings.push_back("they agree only roughly (correlation " + number(corr) + ")");
    if (c.inverted)
        out.warnings.push_back("inverted height: the normal map is that of the negative height; bake with --invert");
    if (c.directx)
        out.warnings.push_back(
            "DirectX green: y points down in the normal map; bake with --directx to match, or flip its green");
    if (c.not_unit > 0.1)
        out.warnings.push_back(percent(c.not_unit) + " of the normals are more than 2 % off unit length (mean " +
                               number(c.normal_length) + "): normalised before use");
    add_if(out.warnings, share_of(c.inward, report.normal_width, report.normal_height), "normal|into the surface",
           "blue at or below half, which has no slope");
    if (report.height_width != report.normal_width || report.height_height != report.normal_height)
        out.warnings.push_back("sizes differ: compared at " + std::to_string(c.width) + " x " +
                               std::to_string(c.height));
    const double gap = std::abs(std::abs(c.scale_x) - std::abs(c.scale_y));
    if (corr >= pair_agrees && gap > 0.15 * c.scale)
        out.notes.push_back("the slopes along x and y have different scales: the texels may not be square");
    return out;
}

namespace {

/// As read_mesh, and a look at what a glTF has beside its mesh.
Mesh read_parts(const std::string& path, const InspectOptions& options, std::optional<GltfParts>& parts) {
    if (!is_gltf(path)) return read_mesh(path, options.read);
    Gltf gltf = read_gltf(path, {.flip_v = !options.read.flip_v});
    parts.emplace();
    parts->nodes = gltf.nodes.size();
    parts->images = gltf.images.size();
    for (const GltfImage& image : gltf.images) parts->missing_images += image.bytes.empty() ? 1 : 0;
    for (const GltfMaterial& material : gltf.materials) parts->normal_textures += material.normal ? 1 : 0;
    parts->tangents = !gltf.mesh.tangents.empty();
    return flatten(std::move(gltf));
}

} // namespace

Findings judge(const DistanceReport& report) {
    Findings out;
    const MeshDistance& d = report.distance;
    if (report.over_limit())
        out.warnings.push_back("over the limit: up to " + number(d.upper) + " apart, " + number(report.limit) +
                               " allowed" + (d.lower > report.limit ? "" : " (perhaps within: see the lower bound)"));
    if (d.upper > 1.5 * d.lower && d.upper > 1e-6 * d.diagonal)
        out.notes.push_back("the bounds are far apart: the meshes are too unlike to settle it in the time allowed");
    return out;
}

MeshReport inspect_mesh(const std::string& path, const InspectOptions& options) {
    MeshReport report;
    report.file = path;
    const Mesh mesh = read_parts(path, options, report.gltf);
    const std::vector<Triangle> triangles = triangulate(mesh);
    report.check = check_mesh(mesh, triangles, options.mesh);
    report.uv = check_uvs(mesh, triangles, options.uv);
    report.audited = options.audit;
    if (options.audit) report.audit = audit(mesh, triangles);
    report.findings = judge(report);
    return report;
}

DistanceReport inspect_distance(const std::string& path, const std::string& other_path, const InspectOptions& options) {
    DistanceReport report;
    report.file = path;
    report.other = other_path;
    report.limit = options.limit;
    const Mesh mesh = read_mesh(path), other = read_mesh(other_path);
    report.distance = mesh_distance(mesh, triangulate(mesh), other, triangulate(other), options.distance);
    report.findings = judge(report);
    return report;
}

ImageReport inspect_image(const std::string& path, const InspectOptions&) {
    ImageReport report;
    report.file = path;
    ImageInfo info;
    const Image<float> image = read_image(path, &info);
    report.check = check_image(image, info);
    report.step = step_slope(report.check.grey_step, image.width());
    report.findings = judge(report);
    return report;
}

PairReport inspect_pair(const std::string& height_path, const std::string& normal_path, const InspectOptions& options) {
    PairReport report;
    report.height_file = height_path;
    report.normal_file = normal_path;
    const HeightTexture height = read_height(height_path, options.height_channel);
    const Image<float> normals = read_image(normal_path);
    if (normals.channels() < 3)
        throw Error(Refusal::unsuitable, normal_path + ": has " + std::to_string(normals.channels()) +
                                             " channels, a normal map has three; give the normal map second");
    if (!std::all_of(normals.data(), normals.data() + normals.size(), [](float v) { return v - v == 0; }))
        throw Error(Refusal::unsuitable, normal_path + ": holds NaN or Inf; export it again");
    report.height_width = height.values.width();
    report.height_height = height.values.height();
    report.normal_width = normals.width();
    report.normal_height = normals.height();
    report.check = check_pair(height.values, normals);
    report.findings = judge(report);
    return report;
}

} // namespace bake
