#include "bake/verdict/inspect.h"
#include "bake/verdict/record_report.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

// File names may contain invalid UTF-8, which is replaced, so that the output is valid JSON.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void add(Json& json, const Findings& findings) {
    json["notes"] = findings.notes;
    json["warnings"] = findings.warnings;
}

Json topology(const Connectivity& t) {
    return {{"edges", t.edges},
            {"boundary_edges", t.boundary_edges},
            {"boundary_loops", t.boundary_loops},
            {"nonmanifold_edges", t.nonmanifold_edges},
            {"nonmanifold_vertices", t.nonmanifold_vertices},
            {"components", t.components},
            {"closed_components", t.closed_components},
            {"inside_out_components", t.inside_out_components},
            {"flipped_faces", t.flipped_faces},
            {"unorientable_edges", t.unorientable_edges}};
}

Json spread(const Spread& s) { return {{"p5", s.p5}, {"median", s.median}, {"p95", s.p95}}; }

Json uvs(const UvCheck& uv) {
    return {{"triangles", uv.triangles},
            {"mirrored_triangles", uv.mirrored_triangles},
            {"degenerate_triangles", uv.degenerate_triangles},
            {"covered", uv.covered},
            {"overlap", uv.overlap},
            {"min", {uv.min.x, uv.min.y}},
            {"max", {uv.max.x, uv.max.y}},
            {"udim_tiles", uv.udim_tiles},
            {"outside_faces", uv.outside_faces},
            {"crossing_faces", uv.crossing_faces},
            {"density", spread(uv.density)},
            {"stretch", spread(uv.stretch)}};
}

Json channel(const ChannelCheck& c) {
    return {{"name", c.name},
            {"min", c.min},
            {"max", c.max},
            {"mean", c.mean},
            {"nan", c.nan},
            {"inf", c.inf},
            {"levels", c.levels > most_levels ? Json(nullptr) : Json(c.levels)},
            {"least_step", c.least_step}};
}

Json place(const Vec3d& p) { return {p.x, p.y, p.z}; }

Json audit(const MeshAudit& a) {
    Json json = {{"self_intersections", a.self_intersections}};
    if (a.self_intersections > 0)
        json["first_intersection"] = {{"faces", {a.first_faces[0], a.first_faces[1]}}, {"place", place(a.first_place)}};
    json.update({{"closed", a.closed},
                 {"outward", a.outward},
                 {"bounds_volume", a.bounds_volume},
                 {"volume", a.volume},
                 {"components", a.components},
                 {"closed_components", a.closed_components},
                 {"inverted_components", a.inverted_components},
                 {"nested_components", a.nested_components}});
    return json;
}

Json one_way(const OneWayDistance& d, bool shading) {
    const auto angles = [](const NormalDeviation& n) { return Json{{"mean", n.mean}, {"p95", n.p95}, {"max", n.max}}; };
    Json json = {{"lower", d.lower},
                 {"upper", d.upper},
                 {"mean", d.mean},
                 {"rms", d.rms},
                 {"farthest", place(d.farthest)},
                 {"nearest", place(d.nearest)},
                 {"facet_normals_deg", angles(d.facet)}};
    if (shading) json["file_normals_deg"] = angles(d.shading);
    return json;
}

} // namespace

std::string to_json(const MeshReport& report) {
    const MeshCheck& c = report.check;
    Json json = {{"file", report.file}, {"kind", "mesh"},       {"positions", c.positions},
                 {"faces", c.faces},    {"corners", c.corners}, {"triangles", c.triangles}};
    Json sizes = Json::object();
    for (std::size_t n = 3; n < c.faces_of_size.size(); ++n)
        if (c.faces_of_size[n] > 0)
            sizes[std::to_string(n) + (n == largest_listed_face ? "+" : "")] = c.faces_of_size[n];
    json["faces_of_size"] = sizes;
    json["materials"] = c.materials;
    json["groups"] = c.groups;
    if (const auto& gltf = report.gltf)
        json["gltf"] = {{"nodes", gltf->nodes},
                        {"normal_textures", gltf->normal_textures},
                        {"images", gltf->images},
                        {"missing_images", gltf->missing_images},
                        {"tangents", gltf->tangents}};
    const Vec3d min = report.origin + Vec3d(c.box.min), max = report.origin + Vec3d(c.box.max);
    json["min"] = {min.x, min.y, min.z};
    json["max"] = {max.x, max.y, max.z};
    json["diagonal"] = c.diagonal;
    json["area"] = c.area;
    json["topology"] = topology(c.welded);
    json["topology_as_indexed"] = topology(c.topology);
    json["coincident_positions"] = c.coincident_positions;
    json["unused_positions"] = c.unused_positions;
    json["repeated_corners"] = c.repeated_corners;
    json["duplicate_faces"] = c.duplicate_faces;
    json["zero_area_faces"] = c.zero_area_faces;
    json["faces_without_uv"] = c.faces_without_uv;
    json["faces_without_normal"] = c.faces_without_normal;
    json["bad_normals"] = c.bad_normals;
    json["opposed_normals"] = c.opposed_normals;
    json["uv"] = report.uv.triangles > 0 ? uvs(report.uv) : Json(nullptr);
    if (report.audit.available) json["audit"] = audit(report.audit);
    if (!report.record.empty()) json["record"] = record_object(report.record);
    add(json, report.findings);
    return dump(json);
}

std::string to_json(const ImageReport& report) {
    const ImageCheck& c = report.check;
    Json json = {{"file", report.file},   {"kind", "image"},          {"format", c.info.format},
                 {"width", c.info.width}, {"height", c.info.height},  {"type", name(c.info.type)},
                 {"bits", c.info.bits},   {"true_bits", c.true_bits}, {"srgb_tagged", c.info.srgb_tagged}};
    json["channels"] = Json::array();
    for (const ChannelCheck& own : c.channels) {
        Json one = channel(own);
        one["true_bits"] = own.true_bits;
        json["channels"].push_back(one);
    }
    json["grey"] = channel(c.grey);
    json["looks_like"] = name(c.kind.looks);
    json["tint"] = {{"max", c.kind.tint}, {"mean", c.kind.mean_tint}};
    json["tiling"] = {{"x", c.tiling.x.ratio()},
                      {"y", c.tiling.y.ratio()},
                      {"tiles_x", !c.tiling.x.breaks()},
                      {"tiles_y", !c.tiling.y.breaks()}};
    if (c.kind.looks == Looks::grey)
        json["step"] = {{"height", c.grey_step},
                        {"slope_per_texel", report.step.per_texel},
                        {"slope", report.step.slope},
                        {"angle_deg", report.step.angle_deg},
                        {"one_degree_amplitude", report.step.one_degree_amplitude}};
    if (c.kind.looks == Looks::normal_map)
        json["normals"] = {{"mean_length", c.kind.normals.length},
                           {"not_unit", c.kind.normals.not_unit},
                           {"inward", c.kind.normals.inward},
                           {"mean", {c.kind.normals.mean.x, c.kind.normals.mean.y, c.kind.normals.mean.z}}};
    if (!c.info.record.empty()) json["record"] = record_object(c.info.record);
    add(json, report.findings);
    return dump(json);
}

std::string to_json(const PairReport& report) {
    const PairCheck& c = report.check;
    Json json = {{"file", report.height_file},
                 {"normals", report.normal_file},
                 {"kind", "pair"},
                 {"height_size", {report.height_width, report.height_height}},
                 {"normals_size", {report.normal_width, report.normal_height}},
                 {"compared_size", {c.width, c.height}},
                 {"correlation", {{"x", c.corr_x}, {"y", c.corr_y}, {"both", c.corr}}},
                 {"scale", c.scale},
                 {"scale_x", c.scale_x},
                 {"scale_y", c.scale_y},
                 {"inverted", c.height_decided ? Json(c.inverted) : Json(nullptr)},
                 {"green", c.green_decided ? Json(c.directx ? "directx" : "opengl") : Json(nullptr)},
                 {"normal_length", c.normal_length},
                 {"not_unit", c.not_unit},
                 {"inward", c.inward}};
    if (report.recipe) {
        json["amplitude"] = report.recipe->amplitude;
        json["bake_options"] = bake_options(report);
    }
    add(json, report.findings);
    return dump(json);
}

std::string to_json(const DistanceReport& report) {
    const MeshDistance& d = report.distance;
    Json json = {{"file", report.file},
                 {"against", report.other},
                 {"kind", "distance"},
                 {"hausdorff", {{"lower", d.lower}, {"upper", d.upper}}},
                 {"mean", std::max(d.there.mean, d.back.mean)},
                 {"rms", std::max(d.there.rms, d.back.rms)},
                 {"diagonal", d.diagonal},
                 {"there", one_way(d.there, d.shading)},
                 {"back", one_way(d.back, d.shading)}};
    if (report.limit > 0) json["limit"] = report.limit;
    add(json, report.findings);
    return dump(json);
}

} // namespace bake
