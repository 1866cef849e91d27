#include "displace_report.h"
#include "inputs/byte_option.h"

namespace bake {
namespace {

std::string place(const Vec3d& p) { return format("(%.6g, %.6g, %.6g)", p.x, p.y, p.z); }

const char* name(Seam seam) { return seam == Seam::average ? "average" : seam == Seam::owner ? "owner" : "blend"; }

nlohmann::json to_json(const Vec3d& p) { return {p.x, p.y, p.z}; }

std::string to_text(const MeshAudit& audit) {
    const std::string cuts =
        audit.self_intersections > 0
            ? format("%zu pairs of triangles cut each other, the first at ", audit.self_intersections) +
                  place(audit.first_place)
            : "no triangles cut each other";
    const std::string inside = !audit.closed ? "not closed"
                                             : (audit.outward ? "closed, outward" : "closed, inside out") +
                                                   format(", volume %.6g", audit.volume);
    return "audit: " + cuts + "; " + inside + "\n";
}

nlohmann::json to_json(const MeshAudit& audit) {
    nlohmann::json object = {{"available", audit.available}};
    if (!audit.available) return object;
    object.update({{"self_intersections", audit.self_intersections},
                   {"closed", audit.closed},
                   {"outward", audit.outward},
                   {"bounds_volume", audit.bounds_volume},
                   {"volume", audit.volume}});
    if (audit.self_intersections > 0) object["first_place"] = to_json(audit.first_place);
    return object;
}

} // namespace

std::string to_text(const DisplaceArgs& args, const DisplaceOutcome& o) {
    const DisplaceReport& r = o.report;
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::string text =
        format("%s: %llu points, %llu faces (%llu triangles) over %zu patches of %s, %s\n", printable(args.out).c_str(),
               count(r.count.points), count(r.count.faces), count(r.triangles), o.patches, o.base.c_str(),
               describe_bytes(double(o.file_bytes)).c_str()) +
        format("%s: amplitude %g, midlevel %g; b from %.6g to %.6g\n", o.described.c_str(), o.amplitude, o.midlevel,
               r.height_min, r.height_max);
    if (r.seam_points > 0)
        text += format("uv seams: %llu points, largest mismatch %.6g at %s; %s\n", count(r.seam_points),
                       r.seam_mismatch, place(r.seam_worst).c_str(), name(args.seam));
    text += format("fold margin (%s, to stay above 0): %.4g at %s, uv (%.6g, %.6g); %llu points folded\n",
                   args.vector ? "stretch" : "1 + b a", r.fold_margin, place(r.fold_worst).c_str(), r.fold_worst_uv.x,
                   r.fold_worst_uv.y, count(r.folded));
    if (args.measure || args.max_error)
        text += format("distance from the displaced surface: max %.4g, rms %.4g (%.4g %% of the diagonal)\n",
                       r.error_max, r.error_rms, 100 * r.error_max / o.size);
    if (r.uniform_triangles > 0)
        text +=
            format("%llu triangles where a uniform rate of the same error needs %llu (%.2f times as many)\n",
                   count(r.triangles), count(r.uniform_triangles), double(r.uniform_triangles) / double(r.triangles));
    return o.audit && o.audit->available ? text + to_text(*o.audit) : text;
}

void warn(const DisplaceArgs& args, const CommonArgs& common, const DisplaceOutcome& o) {
    const DisplaceReport& r = o.report;
    const std::string& base = args.surface.name();
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    note_all(common, base, o.mesh_notes);
    note(common, o.amplitude_note);
    if (r.faces_without_uv > 0)
        note(common, format("%s: %llu of %zu faces have no uvs and stay where they are", base.c_str(),
                            count(r.faces_without_uv), o.base_faces));
    const double most = std::max(std::abs(r.height_min), std::abs(r.height_max));
    if (most > 0.25 * o.size)
        note(common, format("%s: displaced by up to %.4g, %.0f %% of its diagonal: more than relief can be on it; give "
                            "--amplitude in object units or as a per cent",
                            base.c_str(), most, 100 * most / o.size));
    if (args.seam != Seam::blend && r.seam_mismatch > 3 * o.edge)
        note(common, format("%s: the height differs by up to %.4g across a uv seam, %.1f edges of the result: a step "
                            "shows there; --seam blend spreads it",
                            base.c_str(), r.seam_mismatch, r.seam_mismatch / o.edge));
    if (o.facets.part() > smallest_seen_part && !args.max_error)
        note(common,
             format("%s: the faces miss %.0f %% of the relief: they are off by %.3g (rms; at most %.3g), because "
                    "their edges span %.3g texels; %s, or put the rest into a map by bake normal-map --residual-of",
                    base.c_str(), 100 * std::min(1.0, o.facets.part()), o.facets.rms, o.facets.max,
                    o.facets.edge_texels, args.levels ? "raise --levels" : "cut them by --levels"));
    if (o.max_error > 0 && r.error_max > o.max_error)
        note(common, format("%s: the result is up to %.4g away from the displaced surface, more than --max-error %.4g: "
                            "no edge is cut into more than %d "
                            "segments; a finer mesh, a smoother height or a larger --max-error",
                            base.c_str(), r.error_max, o.max_error, 4 * Rates{}.most));
    if (r.folded > 0 && args.vector)
        note(common, format("%s: %llu points face against the surface they were moved from: the vectors fold it, or it "
                            "hangs over (smallest stretch %.3g); a smaller --amplitude, and --audit tells whether it "
                            "cuts itself",
                            base.c_str(), count(r.folded), r.fold_margin));
    else if (r.folded > 0)
        note(common, format("%s: %llu points are turned inside out, the displacement being beyond the radius of "
                            "curvature; a smaller --amplitude, "
                            "or a --midlevel that moves it the other way",
                            base.c_str(), count(r.folded)));
    if (r.no_normal > 0)
        note(common,
             format("%s: %llu points have no normal and stay where they are", base.c_str(), count(r.no_normal)));
    if (r.no_tangents > 0)
        note(common, format("%s: %llu points have no tangents (poles); their normals are those of the faces there",
                            base.c_str(), count(r.no_tangents)));
    if (o.audit && !o.audit->available) note(common, "no audit: this build has no CGAL");
}

nlohmann::json to_json(const DisplaceArgs& args, const DisplaceOutcome& o) {
    const DisplaceReport& r = o.report;
    nlohmann::json object = {{"out", args.out},
                             {"base", args.surface.name()},
                             {"kind", o.base},
                             {"patches", o.patches},
                             {"diagonal", o.size},
                             {"points", r.count.points},
                             {"faces", r.count.faces},
                             {"triangles", r.triangles},
                             {"mean_edge", o.edge},
                             {"bytes_needed", r.count.bytes},
                             {"file_bytes", o.file_bytes},
                             {"amplitude", o.amplitude},
                             {"midlevel", o.midlevel},
                             {"height", {{"file", args.height.path}, {"min", r.height_min}, {"max", r.height_max}}},
                             {"seam",
                              {{"policy", name(args.seam)},
                               {"points", r.seam_points},
                               {"mismatch", r.seam_mismatch},
                               {"worst", to_json(r.seam_worst)}}},
                             {"fold",
                              {{"points", r.folded},
                               {"margin", r.fold_margin},
                               {"worst", to_json(r.fold_worst)},
                               {"worst_uv", {r.fold_worst_uv.x, r.fold_worst_uv.y}}}},
                             {"faces_without_uv", r.faces_without_uv},
                             {"no_normal", r.no_normal},
                             {"no_tangents", r.no_tangents}};
    if (!args.vector)
        object["faces_miss"] = {{"part", o.facets.part()},
                                {"rms", o.facets.rms},
                                {"max", o.facets.max},
                                {"edge_texels", o.facets.edge_texels}};
    if (args.measure || args.max_error) object["measured_error"] = {{"max", r.error_max}, {"rms", r.error_rms}};
    if (r.uniform_triangles > 0) object["uniform_triangles"] = r.uniform_triangles;
    if (!o.notes.empty()) object["notes"] = o.notes;
    if (o.audit) object["audit"] = to_json(*o.audit);
    return object;
}

} // namespace bake
