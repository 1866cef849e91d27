#include "bake/verdict/asset_report.h"
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/mesh/asset/asset.h"
#include "bake/verdict/record_report.h"
#include "bake/verdict/report_text.h"
#include <filesystem>

namespace bake {
namespace {

const char* format_of(const std::string& path) { return asset_text(path) == AssetText::usda ? "USD" : "MaterialX"; }

} // namespace

AssetReport inspect_asset(const std::string& path) {
    TextAssetContent content = read_text_asset(path);
    AssetReport report{path, content.materials, std::move(content.pictures), std::move(content.record), {}};
    // Other programs have further ways to name files: places for tiles, prefixes, references.
    if (report.record.empty()) return report;
    for (const std::string& picture : report.pictures)
        if (std::error_code none; !std::filesystem::exists(std::filesystem::path(path).parent_path() / picture, none))
            report.findings.warnings.push_back("the picture " + printable(picture) +
                                               " is missing; copy it into the folder of the file");
    return report;
}

std::string to_text(const AssetReport& report) {
    std::string names;
    for (const std::string& name : report.pictures) names += (names.empty() ? "" : ", ") + printable(name);
    std::string text = printable(report.file) + "\n";
    text += row(format_of(report.file), format("%zu material%s; the mesh is not inspected", report.materials,
                                               report.materials == 1 ? "" : "s"));
    if (!names.empty()) text += row("pictures", names);
    return text + record_rows(report.record) + endings(report.findings);
}

std::string to_json(const AssetReport& report) {
    nlohmann::ordered_json json = {{"file", report.file},
                                   {"kind", "asset"},
                                   {"format", format_of(report.file)},
                                   {"materials", report.materials},
                                   {"pictures", report.pictures}};
    if (!report.record.empty()) json["record"] = record_object(report.record);
    json["notes"] = report.findings.notes, json["warnings"] = report.findings.warnings;
    // Names of files may be no UTF-8.
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace bake
