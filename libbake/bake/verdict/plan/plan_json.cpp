// The plan as JSON.
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/plan/rung_words.h"
#include "bake/verdict/plan/texture_form.h"
#include <cmath>
#include <nlohmann/json.hpp>

namespace bake {

const char* name(Known known) noexcept {
    switch (known) {
    case Known::bound: return "bound";
    case Known::probe: return "probe";
    case Known::not_settled: return "not-settled";
    case Known::not_tried: return "not-tried";
    case Known::skipped: return "skipped";
    }
    return "";
}

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isinf(value) ? Json("inf") : std::isnan(value) ? Json() : Json(value); }

Json json_of(const SquareEstimate& e) {
    return {{"rmse", number(e.rmse())},
            {"low", number(e.low())},
            {"high", number(e.high())},
            {"mean_square", number(e.square)},
            {"mean_square_error", number(e.error)},
            {"pixels", e.pixels},
            {"all_pixels", e.all}};
}

Json json_of(const RungCost& cost) {
    return {{"triangles", cost.triangles},
            {"object_bytes", cost.object_bytes},
            {"texture_bytes", cost.texture_bytes},
            {"ms", number(cost.ms)}};
}

Json json_of(const Rung& rung) {
    Json json = {{"model", name(rung.method)}, {"known", name(rung.known)}, {"cost", json_of(rung.cost)}};
    if (rung.known == Known::bound) json["bound"] = number(rung.bound);
    if (has_error(rung)) json["error"] = json_of(rung.error);
    if (!rung.camera.empty()) json["camera"] = rung.camera;
    if (rung.flip >= 0) json["flip"] = number(rung.flip);
    if (!rung.note.empty()) json["note"] = rung.note;
    return json;
}

Json json_of(const ReliefFacts& facts) {
    return {{"height_px", number(facts.height_px)},
            {"contour_px", number(facts.contour_px)},
            {"most_slope", number(facts.most_slope)},
            {"most_bend", number(facts.most_bend)},
            {"sun_above_horizon_deg", number(facts.sun_above_horizon_deg)},
            {"texel_px", number(facts.texel_px)},
            {"in_view", facts.in_view}};
}

Json json_of(const ObjectPlan& object) {
    const Rung* chosen = chosen_rung(object);
    const RungCost& cost = chosen ? chosen->cost : object.reference_cost;
    Json json = {{"object", object.object},
                 {"material", object.material},
                 {"meshes", object.meshes},
                 {"model", name(chosen ? chosen->method : object.reference)},
                 {"settled", !chosen || chosen->known != Known::not_settled},
                 {"budget", number(object.budget)},
                 {"why", object.why},
                 {"chosen", chosen ? Json(object.chosen) : Json()}};
    Json& rungs = json["rungs"] = Json::array();
    for (const Rung& rung : object.rungs) rungs.push_back(json_of(rung));
    json["reference"] = {{"model", name(object.reference)},
                         {"cost", json_of(object.reference_cost)},
                         {"rmse", number(object.reference_error)}};
    json["saved"] = {{"triangles", object.reference_cost.triangles - cost.triangles},
                     {"object_bytes", object.reference_cost.object_bytes - cost.object_bytes},
                     {"ms", number(object.reference_cost.ms - cost.ms)}};
    if (!object.high.empty()) json["high"] = object.high;
    if (object.rgb8_bytes > 0) {
        json["rgb8_bytes"] = object.rgb8_bytes;
        json["saved"]["bytes_against_rgb8"] = object.rgb8_bytes - cost.texture_bytes;
    }
    Json& facts = json["facts"] = Json::array(); // of a height
    if (!object.high.empty()) return json;
    for (const ReliefFacts& one : object.facts) facts.push_back(json_of(one));
    return json;
}

Json json_of(const TexturePlan& t) {
    return {{"file", t.file},
            {"kind", t.kind},
            {"width", t.width},
            {"height", t.height},
            {"channels", t.channels},
            {"bits", t.bits},
            {"half", t.half},
            {"bc5", t.bits == bc5_bits},
            {"bytes", t.bytes},
            {"source",
             {{"width", t.source_width},
              {"height", t.source_height},
              {"channels", t.source_channels},
              {"bits", t.source_bits},
              {"bytes", t.source_bytes}}},
            {"error", json_of(t.error)},
            {"rgb8_rmse", t.rgb8_rmse < 0 ? Json() : number(t.rgb8_rmse)},
            {"why", t.why}};
}

Json json_of(const SkyPlan& sky) {
    return {{"model", sky.model},
            {"face", sky.face},
            {"levels", sky.levels},
            {"bytes", sky.bytes},
            {"source", {{"face", sky.source_face}, {"bytes", sky.source_bytes}}},
            {"error", json_of(sky.error)},
            {"why", sky.why}};
}

Json json_of(const LightPlan& light) {
    return {{"light", light.light},
            {"keep", light.keep},
            {"shadows", light.shadows},
            {"error", json_of(light.error)},
            {"why", light.why}};
}

Json json_of(const Verification& v) {
    Json json = {{"camera", v.camera}, {"object", v.object.empty() ? Json() : Json(v.object)}};
    if (v.predicted.pixels > 0) json["predicted"] = json_of(v.predicted);
    json["measured"] = json_of(v.measured);
    json["flip"] = number(v.flip);
    json["within"] = v.within;
    return json;
}

template <class List> Json list_of(const List& list) {
    Json json = Json::array();
    for (const auto& one : list) json.push_back(json_of(one));
    return json;
}

} // namespace

std::string to_json(const ScenePlan& plan, const std::string& scene) {
    Json json = {{"verb", "plan"},
                 {"scene", scene},
                 {"budget",
                  {{"name", plan.budget.name},
                   {"metric", plan_words::unit(plan.budget.metric)},
                   {"value", number(plan.budget.value)}}},
                 {"cameras", plan.cameras},
                 {"exposure", plan.exposure},
                 {"objects", list_of(plan.objects)},
                 {"textures", list_of(plan.textures)},
                 {"sky", plan.sky ? json_of(*plan.sky) : Json()},
                 {"lights", list_of(plan.lights)},
                 {"verified", list_of(plan.verified)},
                 {"interrupted", plan.interrupted},
                 {"over_budget", plan.over_budget},
                 {"notes", plan.notes}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace bake
