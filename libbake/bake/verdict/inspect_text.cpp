#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/relief/height/sample_type.h"
#include "bake/verdict/inspect.h"
#include "bake/verdict/record_report.h"
#include "bake/verdict/report_text.h"

namespace bake {
namespace {

std::string plural(std::size_t count, const char* one, const char* many) {
    return format("%zu %s", count, count == 1 ? one : many);
}

std::string face_sizes(const MeshCheck& c) {
    std::string text;
    for (std::size_t n = 3; n < c.faces_of_size.size(); ++n) {
        if (c.faces_of_size[n] == 0) continue;
        const std::string kind = n == 3 ? "triangle" : n == 4 ? "quad" : format("%zu-gon", n);
        text += (text.empty() ? "" : ", ") + plural(c.faces_of_size[n], kind.c_str(), (kind + "s").c_str());
        if (n == largest_listed_face) text += " or larger";
    }
    return text;
}

// 1001-1003 1011
std::string tile_list(const std::vector<int>& tiles) {
    std::string text;
    for (std::size_t i = 0; i < tiles.size();) {
        std::size_t end = i + 1;
        while (end < tiles.size() && tiles[end] == tiles[end - 1] + 1) ++end;
        if (!text.empty()) text += " ";
        text += std::to_string(tiles[i]);
        if (end - i > 1) text += "-" + std::to_string(tiles[end - 1]);
        i = end;
    }
    return text.empty() ? "none" : text;
}

std::string range(const ChannelCheck& channel) {
    std::string text = format("%.5g to %.5g, mean %.5g, ", channel.min, channel.max, channel.mean);
    text += channel.levels > most_levels ? "over 65536 levels" : plural(std::size_t(channel.levels), "level", "levels");
    if (channel.nan + channel.inf > 0) text += format(", %zu NaN, %zu Inf", channel.nan, channel.inf);
    return text;
}

std::string uv_rows(const MeshReport& report) {
    const UvCheck& uv = report.uv;
    if (uv.triangles == 0) return row("uv", "none");
    std::string text =
        row("uv bounds", format("u %.4g to %.4g, v %.4g to %.4g; UDIM tiles ", uv.min.x, uv.max.x, uv.min.y, uv.max.y) +
                             tile_list(uv.udim_tiles));
    text += row("uv charts",
                format("of %zu triangles %zu mirrored, %zu without area; overlap %.1f %% of the covered area (%.4g)",
                       uv.triangles, uv.mirrored_triangles, uv.degenerate_triangles, 100 * uv.overlap, uv.covered));
    if (uv.density.median > 0) {
        text +=
            row("texel density", format("median %.4g uv per unit, p5 x%.3g, p95 x%.3g (sqrt(uv area / area), by area)",
                                        uv.density.median, uv.density.p5, uv.density.p95));
        text += row("uv stretch", format("p5 %.3g, median %.3g, p95 %.3g (longer over shorter axis)", uv.stretch.p5,
                                         uv.stretch.median, uv.stretch.p95));
    }
    return text;
}

std::string audit_row(const MeshAudit& a) {
    std::string text = plural(a.self_intersections, "self intersection", "self intersections") + ", ";
    text += !a.closed         ? format("not closed (%zu of %zu components are)", a.closed_components, a.components)
            : !a.outward      ? "closed, not outward"
            : a.bounds_volume ? "closed and outward: bounds a volume"
                              : "closed and outward";
    if (a.nested_components > 0) text += format(", %zu inside others", a.nested_components);
    if (a.closed_components > 0) text += format(", volume %.6g", a.volume);
    return row("audit", text);
}

std::string normal_row(const char* name, const NormalDeviation& there, const NormalDeviation& back) {
    return row(name, format("mean %.3g, p95 %.3g, max %.3g; back %.3g, %.3g, %.3g degrees", there.mean, there.p95,
                            there.max, back.mean, back.p95, back.max));
}

std::string depth_text(const ImageCheck& c) {
    if (is_cut(c.info)) return format("%d bits, of which %d are read", c.info.bits, c.true_bits);
    if (c.true_bits > 0) return plural(std::size_t(c.true_bits), "bit", "bits");
    return std::string("as stored, ") + name(c.info.type);
}

} // namespace

std::string bake_options(const PairReport& report) {
    if (!report.recipe) return "";
    const PairRecipe& recipe = *report.recipe;
    std::string text = format("`amplitude` %.4g", recipe.amplitude);
    if (recipe.extent_v > 0) text += format(" `extent` 1,%.4g", recipe.extent_v);
    if (recipe.invert) text += " `invert`";
    if (recipe.directx) text += " `directx`";
    if (!report.height_channel.empty()) text += " `channel` " + report.height_channel;
    return text;
}

std::string to_text(const MeshReport& report) {
    const MeshCheck& c = report.check;
    const Connectivity& t = c.welded;
    std::string text = printable(report.file) + "\n";
    text += row("mesh", format("%zu positions, %zu faces (%s), %zu corners, %zu triangles", c.positions, c.faces,
                               face_sizes(c).c_str(), c.corners, c.triangles));
    if (c.materials > 0 || c.groups > 0)
        text += row("parts", plural(c.groups, "group", "groups") + ", " + plural(c.materials, "material", "materials"));
    if (const auto& gltf = report.gltf)
        text += row("glTF", plural(gltf->nodes, "node", "nodes") + ", " +
                                plural(gltf->normal_textures, "normal texture", "normal textures") + ", " +
                                plural(gltf->images, "image", "images") +
                                (gltf->tangents ? ", tangents of its own" : ", no tangents"));
    const Vec3d min = report.origin + Vec3d(c.box.min), max = report.origin + Vec3d(c.box.max);
    const int digits = report.origin == Vec3d(0) ? 5 : 12; // of a mesh far from zero the first digits are all equal
    text +=
        row("bounds", format("(%.*g %.*g %.*g) to (%.*g %.*g %.*g), diagonal %.5g, area %.5g", digits, min.x, digits,
                             min.y, digits, min.z, digits, max.x, digits, max.y, digits, max.z, c.diagonal, c.area));
    text += row("topology", plural(t.components, "component", "components") +
                                format(" (%zu closed), ", t.closed_components) +
                                plural(t.boundary_edges, "boundary edge", "boundary edges") + " in " +
                                plural(t.boundary_loops, "loop", "loops") + ", " +
                                plural(t.nonmanifold_edges, "non-manifold edge", "non-manifold edges") + ", " +
                                plural(t.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices"));
    text += row("faces", format("%zu flipped, %zu duplicate, %zu zero-area (up to 1e-12 of diagonal^2, or collinear)",
                                t.flipped_faces, c.duplicate_faces, c.zero_area_faces));
    text += uv_rows(report);
    if (report.audit.available) text += audit_row(report.audit);
    text += record_rows(report.record);
    return text + endings(report.findings);
}

std::string to_text(const ImageReport& report) {
    const ImageCheck& c = report.check;
    std::string names;
    for (const ChannelCheck& channel : c.channels) names += (names.empty() ? "" : " ") + channel.name;
    std::string text = printable(report.file) + "\n";
    text += row("image", format("%d x %d, %s, %d-bit %s, channels ", c.info.width, c.info.height, c.info.format.c_str(),
                                c.info.bits, name(c.info.type)) +
                             names);
    for (const ChannelCheck& channel : c.channels) text += row("channel " + channel.name, range(channel));
    text += row("true depth", depth_text(c));
    const bool grey = c.kind.looks == Looks::grey || (c.kind.looks == Looks::constant && c.kind.tint <= grey_tint);
    std::string greyness = grey ? "yes" : "no";
    if (c.kind.tint > 0) greyness += format(", channels differ by up to %.4g of 255 levels", c.kind.tint);
    if (grey && c.colour_channels > 1) greyness += "; their mean " + range(c.grey);
    text += row("grey", greyness);
    const auto tiles = [](const BorderStep& step) {
        return format("%s (x%.3g)", step.tiles() ? "yes" : step.breaks() ? "no" : "perhaps", step.ratio());
    };
    text +=
        row("tiles", "x " + tiles(c.tiling.x) + ", y " + tiles(c.tiling.y) + ": border step over the mean step inside");
    text += row("looks like", name(c.kind.looks));
    if (c.kind.looks == Looks::grey && c.grey_step > 0) {
        text += row("one step",
                    format("%.4g of the height; slope %.4g per texel, at extent 1 and amplitude 1 %.4g = %.4g degrees",
                           c.grey_step, report.step.per_texel, report.step.slope, report.step.angle_deg));
        text += row("", format("slope = amplitude * step * width / (2 * extent); one degree at amplitude %.4g",
                               report.step.one_degree_amplitude));
    }
    const NormalStats& n = c.kind.normals;
    if (c.kind.looks == Looks::normal_map)
        text += row("normals", format("mean length %.4f, %.3g %% over 2 %% off, mean (%.3f %.3f %.3f)", n.length,
                                      100 * n.not_unit, n.mean.x, n.mean.y, n.mean.z));
    text += record_rows(c.info.record);
    return text + endings(report.findings);
}

std::string to_text(const PairReport& report) {
    const PairCheck& c = report.check;
    std::string text = printable(report.height_file + " + " + report.normal_file) + "\n";
    text += row("pair", format("height %d x %d, normals %d x %d, compared at %d x %d", report.height_width,
                               report.height_height, report.normal_width, report.normal_height, c.width, c.height));
    text += row("correlation",
                format("x %+.4f, y %+.4f (slopes of the normals, read as OpenGL, against those of the height)",
                       c.corr_x, c.corr_y));
    text += row("scale", format("%.4g (x %.4g, y %.4g): slope in the normal map per unit of height per texel", c.scale,
                                c.scale_x, c.scale_y));
    text += row("height", !c.height_decided ? "not decided" : c.inverted ? "inverted" : "white is high");
    text += row("green", !c.green_decided ? "not decided" : c.directx ? "DirectX, y down" : "OpenGL, y up");
    if (report.recipe) {
        text += row("amplitude", format("%.4g of the picture's width", report.recipe->amplitude));
        text += row("bake with", bake_options(report));
    }
    text += row("normals", format("mean length %.4f, %.3g %% over 2 %% off", c.normal_length, 100 * c.not_unit));
    return text + endings(report.findings);
}

std::string to_text(const DistanceReport& report) {
    const MeshDistance& d = report.distance;
    const OneWayDistance& worst = d.there.lower >= d.back.lower ? d.there : d.back;
    const double part = d.diagonal > 0 ? 1 / d.diagonal : 0;
    std::string text = printable(report.file + " against " + report.other) + "\n";
    text += row("hausdorff", format("%.6g to %.6g (%.3g to %.3g of the diagonal %.5g)", d.lower, d.upper,
                                    d.lower * part, d.upper * part, d.diagonal));
    const int digits = glm::length(worst.farthest) > 10 * d.diagonal ? 12 : 5; // far from zero the first are all equal
    text += row("farthest",
                format("(%.*g %.*g %.*g) from (%.*g %.*g %.*g) %s", digits, worst.farthest.x, digits, worst.farthest.y,
                       digits, worst.farthest.z, digits, worst.nearest.x, digits, worst.nearest.y, digits,
                       worst.nearest.z, &worst == &d.there ? "of the other" : "of the first"));
    text += row("there", format("mean %.6g, rms %.6g, max %.6g to %.6g", d.there.mean, d.there.rms, d.there.lower,
                                d.there.upper));
    text += row("back",
                format("mean %.6g, rms %.6g, max %.6g to %.6g", d.back.mean, d.back.rms, d.back.lower, d.back.upper));
    text += normal_row("facet normals", d.there.facet, d.back.facet);
    if (d.shading) text += normal_row("file's normals", d.there.shading, d.back.shading);
    return text + endings(report.findings);
}

} // namespace bake
