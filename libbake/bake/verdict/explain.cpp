#include "bake/verdict/explain.h"
#include "bake/base/printable.h"
#include "bake/relief/map/error_budget.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

std::vector<double> list(const Vec3d& v) { return {v.x, v.y, v.z}; }
std::vector<double> list(const Vec2d& v) { return {v.x, v.y}; }

/// The texel of the map that contains uv.
struct MapTexel {
    int x, y;
    Vec2d centre;
};

MapTexel find_texel(const ExplainInput& in) {
    const int width = in.options.width, height = in.options.height;
    const int x = std::clamp(int(in.uv.x * width), 0, width - 1),
              y = std::clamp(int((1 - in.uv.y) * height), 0, height - 1);
    return {x, y, {(x + 0.5) / width, 1 - (y + 0.5) / height}};
}

RouteStep image_step(const ExplainInput& in, const MapTexel& at) {
    const HeightTexture& h = *in.height;
    RouteStep step{"image_io: " + in.height_path, {}};
    step.entries.push_back({"size", {double(h.values.width()), double(h.values.height())}, ""});
    step.entries.push_back(
        {"stored as",
         {},
         std::string(name(h.info.type)) + ", " + std::to_string(h.info.channels.size()) + " channel(s)"});
    step.entries.push_back({"levels used", {double(h.levels)}, h.levels > 256 ? "or more" : ""});
    step.entries.push_back({"quantisation step", {h.step}, ""});
    step.entries.push_back({"map texel (x, y)", {double(at.x), double(at.y)}, "row 0 at the top"});
    step.entries.push_back({"its centre (u, v)", list(at.centre), "v up"});
    const int x = std::clamp(int(at.centre.x * h.values.width()), 0, h.values.width() - 1);
    const int y = std::clamp(int((1 - at.centre.y) * h.values.height()), 0, h.values.height() - 1);
    const HeightOptions& o = in.options.height_options;
    const char* rows[] = {"values above", "values here", "values below"};
    for (int j = -1; j <= 1; ++j) {
        RouteEntry entry{rows[j + 1], {}, ""};
        for (int i = -1; i <= 1; ++i)
            entry.values.push_back(h.values.at(wrap_index(x + i, h.values.width(), o.wrap_u),
                                               wrap_index(y + j, h.values.height(), o.wrap_v)));
        step.entries.push_back(entry);
    }
    return step;
}

RouteStep height_step(const ExplainInput& in, const HeightField& field, const Height<float>& h) {
    const HeightOptions& o = in.options.height_options;
    const Filter filter = resolve_filter(in.options.filter, *in.height);
    RouteStep step{"height: b = amplitude (value - midlevel)", {}};
    step.entries.push_back({"amplitude, midlevel", {o.amplitude, o.midlevel}, "object units, value"});
    step.entries.push_back({"filter", {}, std::string(name(filter))});
    step.entries.push_back(
        {"slopes taken at", {double(field.values().width()), double(field.values().height())}, "texels"});
    step.entries.push_back({"b", {double(h.b)}, "object units"});
    step.entries.push_back({"b_u, b_v", {double(h.b_u), double(h.b_v)}, "per unit of u and v"});
    return step;
}

RouteStep surface_step(const ExplainInput& in, const BakeTarget& target, const TexelHit& hit, const Jet<float>& jet) {
    const Triangle& triangle = target.surface.triangles[hit.triangle];
    RouteStep step{"mesh_surface: " + in.mesh_path, {}};
    step.entries.push_back({"face, triangle", {double(triangle.face), double(hit.triangle)}, "from 0"});
    step.entries.push_back({"barycentrics", {double(1 - hit.b1 - hit.b2), double(hit.b1), double(hit.b2)}, ""});
    step.entries.push_back({"p", list(target.surface.mesh->origin + Vec3d(jet.p)), ""});
    step.entries.push_back({"p_u", list(Vec3d(jet.p_u)), ""});
    step.entries.push_back({"p_v", list(Vec3d(jet.p_v)), ""});
    step.entries.push_back({"n", list(Vec3d(jet.n)), "outward, unit"});
    step.entries.push_back({"n_u", list(Vec3d(jet.n_u)), ""});
    step.entries.push_back({"n_v", list(Vec3d(jet.n_v)), ""});
    step.entries.push_back({"sigma", {double(jet.sigma)}, jet.sigma < 0 ? "mirrored chart" : "chart not mirrored"});
    return step;
}

/// The method of the bake, which uses blinn instead of exact where the surface folds.
NormalMethod baked_method(const ExplainInput& in, const Jet<float>& jet, const Height<float>& h) {
    return in.options.method == NormalMethod::exact && folds(jet, h.b) ? NormalMethod::blinn : in.options.method;
}

RouteStep normal_step(NormalMethod baked, const BakeTarget& target, const Jet<double>& jet, const Height<double>& h) {
    const ConstantScale<double> scale{target.scale.u, target.scale.v};
    RouteStep step{"displaced_normal: N' by each method, unit", {}};
    const Vec3d exact = unit_or_zero(displaced_normal(jet, h, NormalMethod::exact));
    step.entries.push_back({"tilt from n", {glm::degrees(angle_between(exact, jet.n))}, "degrees, exact"});
    for (const NormalMethod method : all_normal_methods) {
        const Vec3d n = unit_or_zero(displaced_normal(jet, h, method, scale));
        char words[64];
        std::snprintf(words, sizeof words, "%.4f deg from exact%s", glm::degrees(angle_between(n, exact)),
                      method == baked ? ", baked" : "");
        step.entries.push_back({std::string(name(method)), list(n), words});
    }
    return step;
}

/// The frame of a shader at the texel: interpolated T and N.
struct Frame {
    Vec3f tangent, n;
    float sign;
};

Frame frame_at(const BakeTarget& target, const TexelHit& hit) {
    const auto [c0, c1, c2] = target.surface.triangles[hit.triangle].corner;
    const float b0 = 1 - hit.b1 - hit.b2;
    const auto mix = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c) { return b0 * a + hit.b1 * b + hit.b2 * c; };
    const std::vector<Vec4f>& t = target.tangents;
    return {mix(Vec3f(t[c0]), Vec3f(t[c1]), Vec3f(t[c2])),
            mix(target.surface.n[c0], target.surface.n[c1], target.surface.n[c2]), t[c0].w};
}

RouteStep tangent_step(const Frame& frame, const Vec3f& t) {
    RouteStep step{"tangent_space: MikkTSpace, N' = t.x T + t.y B + t.z N", {}};
    step.entries.push_back({"T", list(Vec3d(frame.tangent)), "interpolated"});
    step.entries.push_back({"B", list(Vec3d(frame.sign * glm::cross(frame.n, frame.tangent))), "sign (N x T)"});
    step.entries.push_back({"N", list(Vec3d(frame.n)), "interpolated"});
    step.entries.push_back({"sign", {double(frame.sign)}, ""});
    step.entries.push_back({"t", list(Vec3d(t)), "unit"});
    return step;
}

RouteStep encode_step(const Vec3f& t, bool directx) {
    RouteStep step{"normal_map: rgb = (t + 1) / 2", {}};
    const Vec3f rgb = encode_normal(t, directx);
    step.entries.push_back({"rgb", list(Vec3d(rgb)), directx ? "green down (DirectX)" : "green up (OpenGL)"});
    for (const int bits : {8, 16}) {
        const auto largest = float((1 << bits) - 1);
        const Vec3f levels = glm::vec3(std::floor(rgb.x * largest + 0.5f), std::floor(rgb.y * largest + 0.5f),
                                       std::floor(rgb.z * largest + 0.5f));
        char words[64];
        std::snprintf(words, sizeof words, "decodes %.4f deg off",
                      glm::degrees(angle_between(Vec3d(t), Vec3d(decode_normal(levels / largest, directx)))));
        step.entries.push_back({std::to_string(bits) + " bit", list(Vec3d(levels)), words});
    }
    return step;
}

RouteStep shade_step(const Frame& frame, const Vec3f& t, bool directx) {
    RouteStep step{"bsdf: diffuse light from T + B + N", {}};
    const Vec3f bitangent = frame.sign * glm::cross(frame.n, frame.tangent);
    const Vec3f light = unit_or_zero(frame.tangent + bitangent + frame.n);
    const Vec3f rgb = encode_normal(t, directx);
    const Vec3f back = decode_normal(
        Vec3f(std::floor(rgb.x * 255 + 0.5f), std::floor(rgb.y * 255 + 0.5f), std::floor(rgb.z * 255 + 0.5f)) / 255.0f,
        directx);
    const Vec3f shaded = unit_or_zero(back.x * frame.tangent + back.y * bitangent + back.z * frame.n);
    step.entries.push_back({"N decoded from 8 bit", list(Vec3d(shaded)), ""});
    step.entries.push_back({"n . l, plain", {double(std::max(0.0f, glm::dot(unit_or_zero(frame.n), light)))}, ""});
    step.entries.push_back({"N . l, normal-mapped", {double(std::max(0.0f, glm::dot(shaded, light)))}, ""});
    return step;
}

} // namespace

std::vector<RouteStep> explain(const ExplainInput& in) {
    const MapTexel at = find_texel(in);
    const BakeTarget target =
        make_bake_target(*in.mesh, in.mesh_path, in.options.width, in.options.height, in.options.tile);
    const HeightField field(*in.height, in.options.height_options, in.options.filter, in.options.width,
                            in.options.height);
    std::vector<Height<float>> heights(in.options.width);
    SlopeFilter<float>::Scratch scratch;
    field.row(at.y, heights.data(), scratch);
    const Height<float>& h = heights[at.x];

    std::vector<RouteStep> route = {image_step(in, at), height_step(in, field, h)};
    const TexelHit& hit = target.raster.hits.at(at.x, at.y);
    if (hit.triangle == no_index) {
        route.push_back(
            {"uv_raster: " + in.mesh_path, {{"no face covers this texel", {}, "it is filled by padding, or flat"}}});
        return route;
    }
    const Jet<float> jet = jet_at(target.surface, hit.triangle, hit.b1, hit.b2);
    route.push_back(surface_step(in, target, hit, jet));
    const NormalMethod baked = baked_method(in, jet, h);
    route.push_back(
        normal_step(baked, target, jet_at<double>(target.surface, hit.triangle, hit.b1, hit.b2), {h.b, h.b_u, h.b_v}));
    if (baked != in.options.method)
        route.back().entries.push_back({"folded here", {}, "blinn is used instead of exact"});
    const Vec3f normal = unit_or_zero(displaced_normal(jet, h, baked, target.scale));
    const Frame frame = frame_at(target, hit);
    const Vec3f t =
        in.options.space == Space::object ? normal : to_tangent_space(normal, frame.tangent, frame.n, frame.sign);
    if (t == Vec3f(0)) {
        route.push_back({"normal_map", {{"no normal", {}, "the chart has no area here; the texel is flat"}}});
        return route;
    }
    if (in.options.space == Space::tangent) route.push_back(tangent_step(frame, t));
    route.push_back(encode_step(t, in.options.directx));
    if (in.options.space == Space::tangent) route.push_back(shade_step(frame, t, in.options.directx));
    return route;
}

std::string to_text(const std::vector<RouteStep>& route) {
    std::string text;
    char buffer[64];
    for (const RouteStep& step : route) {
        text += printable(step.title) + "\n";
        for (const RouteEntry& entry : step.entries) {
            std::snprintf(buffer, sizeof buffer, "  %-22s", entry.name.c_str());
            text += buffer;
            for (const double value : entry.values) {
                std::snprintf(buffer, sizeof buffer, " %12.6g", value == 0 ? 0.0 : value); // prints -0 as 0
                text += buffer;
            }
            if (!entry.words.empty()) text += "  " + printable(entry.words);
            text += "\n";
        }
    }
    return text;
}

std::string to_json(const std::vector<RouteStep>& route) {
    nlohmann::json steps = nlohmann::json::array();
    for (const RouteStep& step : route) {
        nlohmann::json entries = nlohmann::json::array();
        for (const RouteEntry& entry : step.entries)
            entries.push_back({{"name", entry.name}, {"values", entry.values}, {"words", entry.words}});
        steps.push_back({{"step", step.title}, {"entries", entries}});
    }
    // Names of files may not be UTF-8.
    return nlohmann::json{{"route", steps}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace bake
