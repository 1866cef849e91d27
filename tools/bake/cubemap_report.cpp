#include "cubemap_report.h"
#include "bake/base/text.h"

namespace bake {
namespace {

std::string seams_note(const EnvironmentReport& report, bool fix) {
    const OrientationCheck& check = report.orientation;
    if (!check.wrong && fix) return "the faces are right as given; there is nothing to fix";
    if (!check.wrong)
        return check.given > 1.5
                   ? format("seams are visible (%.2f times the steps inside the faces), and no turn or swap of "
                            "faces closes them",
                            check.given)
                   : "";
    const std::string how = to_text(check.closes, report.files);
    if (report.fixed) return format("seams closed (%.2f to %.2f): ", check.given, check.best) + how;
    return format("seams are open (%.2f times the steps inside the faces); they close (%.2f) with ", check.given,
                  check.best) +
           how + "; --fix-orientation does so";
}

nlohmann::json to_json(const BadTexels& bad) {
    nlohmann::json json = {{"texels", bad.texels},
                           {"nan", bad.nan},
                           {"infinite", bad.infinite},
                           {"negative", bad.negative},
                           {"over", bad.over}};
    if (bad.x >= 0) json["first"] = {bad.x, bad.y};
    return json;
}

bool has_seams(const EnvironmentReport& report) { return report.checked && !report.orientation.unknown; }

} // namespace

std::vector<std::string> cubemap_notes(const CubemapArgs& args, const EnvironmentReport& report,
                                       const EnvironmentWritten& written) {
    std::vector<std::string> notes = report.notes;
    if (report.format == SkyFormat::faces && report.naming.empty())
        notes.push_back("the names do not say which file is which face; taken in the order px nx py ny pz nz");
    if (report.mended.texels > 0)
        notes.push_back(std::to_string(report.mended.texels) + " texels mended: " + to_text(report.mended));
    if (has_seams(report))
        if (const std::string seams = seams_note(report, args.reading.fix_orientation); !seams.empty())
            notes.push_back(seams);
    if (written.over.over > 0)
        notes.push_back(std::to_string(written.over.over) +
                        " texels above 65504, the largest of half floats, were mended");
    if (written.clipped > 0)
        notes.push_back(std::to_string(written.clipped) +
                        " values above 1 were clipped; write .exr or .tif to keep them");
    return notes;
}

nlohmann::json cubemap_json(const CubemapArgs& args, const EnvironmentReport& report, const EnvironmentWritten& written,
                            int channels) {
    constexpr const char* sample_names[] = {"auto", "1", "4x4", "exact"};
    nlohmann::json json = {{"out", written.files},
                           {"from", name(report.format)},
                           {"to", name(written.target.to)},
                           {"width", written.width},
                           {"height", written.height},
                           {"levels", written.levels},
                           {"channels", channels},
                           {"samples", sample_names[int(args.resampling.samples)]},
                           {"mended", to_json(report.mended)},
                           {"over_half", to_json(written.over)},
                           {"clipped", written.clipped}};
    if (!report.checked) return json;
    const OrientationCheck& check = report.orientation;
    nlohmann::json faces = nlohmann::json::object();
    for (int k = 0; k < 6; ++k)
        faces[cube_face_names[k]] = {{"file", report.files[check.closes.source[k]]},
                                     {"turned_deg", 90 * check.closes.turns[k]}};
    json["naming"] = report.naming;
    json["orientation"] = {{"seam_ratio", check.given}, {"best_seam_ratio", check.best}, {"wrong", check.wrong},
                           {"fixed", report.fixed},     {"unknown", check.unknown},      {"closes_with", faces}};
    return json;
}

std::string seam_text(const EnvironmentReport& report) {
    if (!has_seams(report)) return "";
    return format(", seam ratio %.2f", report.fixed ? report.orientation.best : report.orientation.given);
}

} // namespace bake
