#include "high_report.h"
#include "raster_notes.h"
#include <algorithm>

namespace bake {
namespace {

double share(std::int64_t part, std::int64_t whole) { return whole > 0 ? 100 * double(part) / double(whole) : 0; }

const char* source_of_reach(const HighArgs& args) {
    return !args.cage.empty() ? "cage" : args.extrude ? "extruded" : "automatic reach";
}

const char* name(TexelState state) {
    switch (state) {
    case TexelState::hit: return "hit";
    case TexelState::behind: return "behind";
    case TexelState::missed: return "missed";
    case TexelState::unmatched:
    case TexelState::outside: break;
    }
    return "outside";
}

std::string to_text(const Witness& w) {
    const Vec3f at = w.cast.start + w.cast.reach.front * w.cast.inward;
    std::string text = format("  texel (%d, %d), face %u, uv (%.5g, %.5g), at (%.4g, %.4g, %.4g): ", w.x, w.y, w.face,
                              w.uv.x, w.uv.y, double(at.x), double(at.y), double(at.z));
    return text + format("%s; the nearest corner of %s is (%.4g, %.4g, %.4g), %.4g away",
                         w.state == TexelState::behind ? "only the back of triangles" : "nothing",
                         printable(w.mesh).c_str(), double(w.nearest.x), double(w.nearest.y), double(w.nearest.z),
                         w.distance);
}

/// Of all sources together.
struct Totals {
    std::size_t triangles = 0, hard_edges = 0;
    float front = 0, back = 0;
    explicit Totals(const TransferSources& sources) {
        for (const TransferSource& source : sources.sources) {
            triangles += source.high->triangle_count();
            hard_edges = std::max(hard_edges, source.casting->hard_edges()); // each knows the whole low-poly mesh
            front = std::max(front, source.casting->most_front()), back = std::max(back, source.casting->most_back());
        }
    }
};

nlohmann::json vector(const Vec3f& v) { return {v.x, v.y, v.z}; }

nlohmann::json to_json(const Witness& w) {
    nlohmann::json out = {{"texel", {w.x, w.y}},
                          {"face", w.face},
                          {"uv", {w.uv.x, w.uv.y}},
                          {"state", name(w.state)},
                          {"ray",
                           {{"start", vector(w.cast.start)},
                            {"direction", vector(w.cast.inward)},
                            {"length", w.cast.reach.front + w.cast.reach.back}}}};
    if (w.state == TexelState::hit) out["height"] = w.height;
    else out["nearest"] = {{"mesh", w.mesh}, {"position", vector(w.nearest)}, {"distance", w.distance}};
    return out;
}

} // namespace

std::string to_text(const HighReport& report) {
    const TransferOptions& options = report.options;
    const TransferReport& r = report.result;
    const Totals totals(report.sources);
    const std::int64_t texels = std::int64_t(options.width) * options.height;
    std::string text =
        format("%s: %d x %d, %s space, green %s\n%zu triangles, %lld rays; %s: at most %.3g outward and %.3g inward",
               printable(report.args.out).c_str(), options.width, options.height,
               options.space == Space::tangent ? "tangent" : "object",
               options.directx ? "down (DirectX)" : "up (OpenGL)", totals.triangles, static_cast<long long>(r.rays),
               source_of_reach(report.args.high), double(totals.front), double(totals.back));
    if (options.max_error_deg > 0 && r.hit > 0)
        text += format("\n%.3g rays for each texel of the charts, for means to %.3g deg",
                       double(r.rays) / double(r.hit + r.missed), options.max_error_deg);
    if (!report.args.high.cage_out.empty())
        text += "\nenvelope written as a cage to " + printable(report.args.high.cage_out);
    if (report.smooth > 0) text += format("\nnormals of the high-poly mesh smoothed over %.4g", report.smooth);
    text += format("\ncharts cover %.1f %% of the map; %.2f %% of their texels find no detail; %.1f %% padded, %.1f %% "
                   "left flat",
                   share(r.hit + r.missed + r.unmatched, texels), share(r.missed, r.hit + r.missed + r.unmatched),
                   share(r.padded, texels), share(r.empty, texels));
    if (r.hit > 0)
        text += format("\ndetail lies %.3g to %.3g above the surface; leaning rays move it by %.2g texels in the mean, "
                       "%.2g at most",
                       r.nearest + 0.0, r.farthest + 0.0, r.parallax_mean, r.parallax_max); // + 0: no "-0"
    if (report.density.max > 0)
        text += format("\n%.4g texels per unit in the median, 90 %% of the surface %.4g to %.4g", report.density.median,
                       report.density.p05, report.density.p95);
    if (report.centre.max > 0)
        text +=
            format("\none ray per texel is %.3g deg from the mean over the texel in the median, 95 %% below %.3g, at "
                   "most %.3g; --rays 2 takes the mean",
                   report.centre.median, report.centre.p95, report.centre.max);
    if (report.seams.samples > 0)
        text += format("\nthe two sides of %lld seams differ by %.3g deg in the mean, 95 %% below %.3g, at most %.3g",
                       static_cast<long long>(report.seams.seams), report.seams.mean, report.seams.percentile_95,
                       report.seams.max);
    for (const Witness& w : report.witnesses)
        if (w.state != TexelState::hit) text += "\n" + to_text(w);
    return text + "\n";
}

nlohmann::json to_json(const HighReport& report) {
    const TransferOptions& options = report.options;
    const TransferReport& r = report.result;
    const Totals totals(report.sources);
    nlohmann::json witnesses = nlohmann::json::array();
    for (const Witness& w : report.witnesses) witnesses.push_back(to_json(w));
    return {{"out", report.args.out},
            {"width", options.width},
            {"height", options.height},
            {"space", options.space == Space::tangent ? "tangent" : "object"},
            {"green", options.directx ? "down" : "up"},
            {"high",
             {{"meshes", report.args.high.paths},
              {"triangles", totals.triangles},
              {"smooth", report.smooth},
              {"cage_out", report.args.high.cage_out}}},
            {"reach", {{"front", totals.front}, {"back", totals.back}}},
            {"hard_edges", totals.hard_edges},
            {"rays", r.rays},
            {"max_error_deg", options.max_error_deg > 0 ? nlohmann::json(options.max_error_deg) : nlohmann::json()},
            {"ray_lengths", r.lengths},
            {"heights", {r.nearest, r.farthest}},
            {"parallax_texels", {{"mean", r.parallax_mean}, {"max", r.parallax_max}}},
            {"texels_per_unit",
             {{"p05", report.density.p05}, {"median", report.density.median}, {"p95", report.density.p95}}},
            {"centre_error_deg",
             {{"median", report.centre.median}, {"p95", report.centre.p95}, {"max", report.centre.max}}},
            {"seams", to_json(report.seams)},
            {"witnesses", witnesses},
            {"texels",
             {{"hit", r.hit},
              {"missed", r.missed},
              {"behind", r.behind},
              {"unmatched", r.unmatched},
              {"wider", r.wider},
              {"outward", r.outward},
              {"degenerate", r.degenerate},
              {"border", r.border},
              {"overlapped", report.target.raster.overlapped},
              {"padded", r.padded},
              {"empty", r.empty}}}};
}

std::vector<std::string> notes_of(const HighReport& report) {
    std::vector<std::string> out;
    const TransferOptions& options = report.options;
    const TransferReport& r = report.result;
    const std::string& low = report.args.mesh;
    const std::string& high = report.args.high.paths[0];
    const auto say = [&](std::int64_t count, const std::string& what) {
        if (count > 0) out.push_back(format("%s: %lld %s", low.c_str(), static_cast<long long>(count), what.c_str()));
    };
    const bool cage = !report.args.high.cage.empty();
    const std::string farther = cage ? "a cage that lies farther out" : "a larger --extrude";
    if (r.hit == 0 && r.behind > 0)
        out.push_back(high + ": rays meet the back of its triangles alone; turn its faces over, or give " + farther);
    else if (r.hit == 0 && r.missed > 0)
        out.push_back(
            high + ": no ray finds it; " +
            (cage ? "is the cage outside of it?" : "is it elsewhere in space, or in another unit than " + low + "?"));
    else
        say(r.missed, "texels find no detail, and are filled like the padding of charts; give " + farther +
                          ", or close the high-poly mesh there");
    if (r.hit > 0) say(r.behind, "of these find the back of triangles; turn those faces over");
    say(r.unmatched, "texels belong to parts without a high-poly part of their name, and are flat");
    if (report.match) {
        for (const std::string& name : report.match->low_alone)
            out.push_back(low + ": part " + name + " has no high-poly part of its name");
        for (const std::string& name : report.match->high_alone)
            out.push_back("high-poly part " + name + " belongs to no part of " + low + " and is left out");
    }
    say(r.outward, "texels have a normal that points into the mesh, which few viewers show as it is");
    say(r.degenerate, "rays have no tangent space where they start (charts without area)");
    for (std::string& line : notes_of(report.target, low, options.tile, report.all_tiles))
        out.push_back(std::move(line));
    return out;
}

} // namespace bake
