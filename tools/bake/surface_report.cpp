#include "surface_report.h"
#include "bake/base/text.h"

namespace bake {
namespace {

/// Degenerate points that the text and the JSON list, at most.
constexpr std::size_t points_printed = 6, points_in_json = 1000;

const char* describe(Degenerate what) {
    switch (what) {
    case Degenerate::pole: return "pole, with a limit normal";
    case Degenerate::without_normal: return "no normal";
    case Degenerate::no_chart: return "no area in uv";
    default: return "";
    }
}

struct NamedRange {
    const char *label, *key; ///< in the text, and in the JSON
    ValueRange range;
};

std::vector<NamedRange> ranges(const SurfaceSummary& s, bool has_uv) {
    std::vector<NamedRange> out = {{"x", "x", s.x}, {"y", "y", s.y}, {"z", "z", s.z}};
    if (has_uv) out.insert(out.end(), {{"|p_u|", "length_p_u", s.length_u}, {"|p_v|", "length_p_v", s.length_v}});
    out.insert(out.end(), {{"mean curvature", "mean_curvature", s.mean_curvature},
                           {"gauss curvature", "gauss_curvature", s.gauss_curvature}});
    return out;
}

} // namespace

std::string to_text(const std::string& what, const SurfaceMesh& mesh, const SurfaceSummary& s) {
    const bool has_uv = !mesh.mesh.corner_uv.empty();
    std::string text = what + format("\n%-16s %14s %14s %14s\n", "", "min", "max", "mean");
    for (const auto& [label, key, range] : ranges(s, has_uv))
        text += format("%-16s %14.7g %14.7g %14.7g\n", label, range.min, range.max, range.mean);
    text += format("area %.7g, %zu faces, %zu vertices\ndegenerate points: %zu\n", s.area, mesh.mesh.faces(),
                   mesh.mesh.positions.size(), s.degenerate.size());
    for (std::size_t i = 0; i < std::min(points_printed, s.degenerate.size()); ++i) {
        const DegeneratePoint& d = s.degenerate[i];
        const std::string uv = has_uv ? format(", uv (%.5g, %.5g)", double(d.uv.x), double(d.uv.y)) : "";
        const auto p = Vec3d(d.p) + 0.0; // no -0
        text += format("  (%.5g, %.5g, %.5g)%s, face %zu: %s\n", p.x, p.y, p.z, uv.c_str(), d.face, describe(d.what));
    }
    if (s.degenerate.size() > points_printed)
        text += format("  and %zu more; --json lists them\n", s.degenerate.size() - points_printed);
    return text;
}

nlohmann::json to_json(const SurfaceSummary& s, bool has_uv) {
    nlohmann::json object = {
        {"area", s.area}, {"degenerate_count", s.degenerate.size()}, {"degenerate", nlohmann::json::array()}};
    for (const auto& [label, key, r] : ranges(s, has_uv))
        object[key] = {{"min", r.min}, {"max", r.max}, {"mean", r.mean}};
    for (std::size_t i = 0; i < std::min(points_in_json, s.degenerate.size()); ++i) {
        const DegeneratePoint& d = s.degenerate[i];
        object["degenerate"].push_back({{"what", describe(d.what)},
                                        {"position", {d.p.x, d.p.y, d.p.z}},
                                        {"uv", {d.uv.x, d.uv.y}},
                                        {"face", d.face}});
    }
    return object;
}

nlohmann::json to_json(const SurfaceMapReport& r) {
    return {{"covered", r.covered},
            {"border", r.border},
            {"overlapped", r.overlapped},
            {"degenerate", r.degenerate},
            {"padded", r.padded},
            {"empty", r.empty},
            {"outside_faces", r.outside_faces},
            {"crossing_faces", r.crossing_faces},
            {"tiles", r.tiles},
            {"largest_uv_distance", r.residual}};
}

std::string to_text(const SurfaceMapReport& r, const SurfaceMapOptions& options) {
    const double share = 100.0 / (double(options.width) * options.height);
    return format(
        "maps %d x %d: charts cover %.1f %% and %.1f %% at their borders; %.1f %% padded, %.1f %% left at zero\n",
        options.width, options.height, share * double(r.covered), share * double(r.border), share * double(r.padded),
        share * double(r.empty));
}

void warn(const CommonArgs& common, const std::string& title, const SurfaceMapReport& r) {
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) note(common, format("%s: %lld %s", title.c_str(), static_cast<long long>(count), what));
    };
    if (!r.tiles.empty())
        note(common, title + ": its charts lie in " + r.tiles + " of the uvs' tiles and are in the maps modulo 1");
    say(r.overlapped, "texels lie in more than one face; the lowest face is in the maps");
    say(r.outside_faces, "faces lie outside the tile and are not in the maps");
    say(r.crossing_faces, "faces leave the tile; only their part inside is in the maps");
    say(r.degenerate, "texels lie on a pole or have no chart; what does not exist there is their neighbours'");
}

} // namespace bake
