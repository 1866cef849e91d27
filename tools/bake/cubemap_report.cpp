#include "cubemap_report.h"
#include "bake/base/text.h"
#include <algorithm>

namespace bake {
namespace {

constexpr const char* axes[6] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

/// "3 of the 12 seams are open (+X/-Y most, 4.21 times the steps beside it)"
std::string open_text(const OrientationCheck& check) {
    const auto worst = std::max_element(check.given_seams.begin(), check.given_seams.end());
    const Seam& seam = seams()[worst - check.given_seams.begin()];
    return format("%d of the 12 seams are open (%s/%s most, %.2f times the steps beside it)", check.open_given(),
                  axes[seam.a.face], axes[seam.b.face], *worst);
}

/// Whether the arrangement only exchanges two opposite faces, which has the seams of six mirrored faces.
bool is_mirror_image(const Orientation& o) noexcept {
    int swapped = 0;
    for (int k = 0; k < 6; ++k) {
        if (o.turns[k] != 0 || o.mirrored[k] || (o.source[k] != k && o.source[k] != (k ^ 1))) return false;
        swapped += o.source[k] != k;
    }
    return swapped == 2;
}

std::string seams_note(const EnvironmentReport& report, bool fix) {
    const OrientationCheck& check = report.orientation;
    const int open = check.open_given();
    if (!check.wrong && check.visible())
        return open_text(check) + "; no arrangement of the faces was found that closes them";
    if (!check.wrong) return fix ? "no arrangement was found whose seams match better; the faces are as given" : "";
    std::string how = to_text(check.closes, report.files);
    if (is_mirror_image(check.closes)) how += " (seams cannot tell this from six faces that are all mirrored)";
    const char* effect = open > 0 && check.open_best() == 0 ? "they close" : "the seams match better";
    const std::string before = open == 0 ? format("seam ratio %.2f", check.given) : open_text(check);
    if (report.fixed) return before + "; " + effect + format(" (seam ratio %.2f), done: ", check.best) + how;
    return before + "; " + effect + format(" (seam ratio %.2f) with ", check.best) + how +
           "; --fix-orientation does so";
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

std::vector<std::string> input_notes(const CubemapArgs& args, const EnvironmentReport& report) {
    std::vector<std::string> notes = reading_notes(report);
    if (has_seams(report))
        if (const std::string seams = seams_note(report, args.reading.fix_orientation); !seams.empty())
            notes.push_back(seams);
    return notes;
}

std::vector<std::string> cubemap_notes(const CubemapArgs& args, const EnvironmentReport& report,
                                       const EnvironmentWritten& written) {
    std::vector<std::string> notes = input_notes(args, report);
    if (args.target.depth == Depth::automatic && written.target.depth == Depth::float32 &&
        resolve_depth(args.target.file, Depth::automatic) == Depth::half)
        notes.push_back("written as float: half floats hold no radiance above 65504");
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
                           {"mended", to_json(report.faults.bad)},
                           {"negative", report.faults.negative},
                           {"negative_share", report.faults.negative_share},
                           {"over_half", to_json(written.over)},
                           {"clipped", written.clipped}};
    add_orientation(report, json);
    return json;
}

void add_orientation(const EnvironmentReport& report, nlohmann::json& json) {
    if (!report.checked) return;
    const OrientationCheck& check = report.orientation;
    nlohmann::json faces = nlohmann::json::object();
    for (int k = 0; k < 6; ++k)
        faces[cube_face_names[k]] = {{"file", report.files[check.closes.source[k]]},
                                     {"mirrored", bool(check.closes.mirrored[k])},
                                     {"turned_deg", 90 * check.closes.turns[k]}};
    nlohmann::json ratios = nlohmann::json::object();
    for (int i = 0; i < 12; ++i) {
        const Seam& seam = seams()[i];
        ratios[std::string(cube_face_names[seam.a.face]) + "-" + cube_face_names[seam.b.face]] = check.given_seams[i];
    }
    json["naming"] = report.naming;
    json["orientation"] = {{"seam_ratio", check.given}, {"best_seam_ratio", check.best},
                           {"wrong", check.wrong},      {"open_seams", check.open_given()},
                           {"seams", ratios},           {"fixed", report.fixed},
                           {"unknown", check.unknown},  {"closes_with", faces}};
}

std::string seam_text(const EnvironmentReport& report) {
    if (!has_seams(report)) return "";
    return format(", seam ratio %.2f", report.fixed ? report.orientation.best : report.orientation.given);
}

} // namespace bake
