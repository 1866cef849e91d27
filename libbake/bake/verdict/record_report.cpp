#include "bake/verdict/record_report.h"
#include "bake/base/printable.h"
#include "bake/verdict/report_text.h"

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

std::string plain(const Json& value) { return printable(value.is_string() ? value.get<std::string>() : value.dump()); }

std::string text_at(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? "" : plain(*found);
}

/// "name value, name value"
std::string listed(const Json& object, const char* key) {
    std::string text;
    const auto found = object.find(key);
    if (found == object.end() || !found->is_object()) return text;
    for (const auto& [name, value] : found->items())
        text += (text.empty() ? "" : ", ") + printable(name) + ' ' + plain(value);
    return text;
}

} // namespace

Json record_object(const std::string& record) { return record.empty() ? Json() : Json::parse(record); }

std::string record_rows(const std::string& record) {
    const Json object = record_object(record);
    if (object.is_null()) return {};
    std::string text =
        row("made by", text_at(object, "software") + ' ' + text_at(object, "version") + ' ' + text_at(object, "verb"));
    if (const auto inputs = object.find("inputs"); inputs != object.end() && inputs->is_array())
        for (const Json& input : *inputs)
            if (input.is_object())
                text += row("from", text_at(input, "name") +
                                        (input.contains("xxh128") ? ", xxh128 " + text_at(input, "xxh128") : ""));
    if (const std::string options = listed(object, "options"); !options.empty()) text += row("options", options);
    if (const std::string values = listed(object, "values"); !values.empty()) text += row("values", values);
    return text;
}

} // namespace bake
