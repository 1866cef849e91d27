#include "bake/environment/file/face_files.h"
#include "bake/base/error.h"
#include "bake/environment/file/face_names.h"
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace bake {
namespace {

namespace fs = std::filesystem;
/// The parts of the paths by which six files differ: file names without the ending and without the beginning and the end
/// that all of them share; names of folders if the files have the same name.
std::vector<std::string> distinct_parts(const std::vector<std::string>& paths) {
    std::vector<std::string> names, folders;
    for (const std::string& path : paths) {
        names.push_back(fs::path(path).stem().string());
        folders.push_back(fs::path(path).parent_path().filename().string());
    }
    if (std::count(names.begin(), names.end(), names[0]) == std::ptrdiff_t(names.size())) names = folders;
    const auto shared = [&](auto&& at) {
        std::size_t count = 0;
        for (;; ++count)
            for (const std::string& name : names)
                if (count >= name.size() || at(name, count) != at(names[0], count)) return count;
    };
    const std::size_t head = shared([](const std::string& name, std::size_t i) { return name[i]; });
    for (std::string& name : names) name.erase(0, head);
    const std::size_t tail = shared([](const std::string& name, std::size_t i) { return name[name.size() - 1 - i]; });
    for (std::string& name : names) name.erase(name.size() - tail);
    return names;
}

bool is_letter(char c) noexcept { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) noexcept { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// How a part is written: a run of small letters is a, of capitals A, of digits #, a sign +; others are as they are. The
/// six names of one sky have the same style.
std::string style_of(const std::string& part) {
    std::string style;
    for (const char c : part) {
        const char kind = is_letter(c)                                       ? (is_upper(c) ? 'A' : 'a')
                          : std::isdigit(static_cast<unsigned char>(c)) != 0 ? '#'
                          : c == '-'                                         ? '+'
                                                                             : c;
        if (style.empty() || style.back() != kind) style += kind;
    }
    return style;
}

/// A word in a style, if the style is one of those of a single word.
std::string in_style(std::string word, const std::string& style) {
    const std::size_t capitals = style == "A" ? word.size() : style == "Aa" ? 1 : 0;
    for (std::size_t i = 0; i < capitals; ++i) word[i] = char(std::toupper(static_cast<unsigned char>(word[i])));
    return style == "A" || style == "Aa" || style == "a" ? word : "";
}

/// One way to fill six faces.
struct Candidate {
    FaceWords kind = FaceWords::axes;
    std::string style;
    std::array<std::string, 6> files, parts;

    int count() const noexcept {
        return int(std::count_if(files.begin(), files.end(), [](const std::string& file) { return !file.empty(); }));
    }
    FaceFiles found() const {
        FaceFiles result{files, ""};
        for (const std::string& part : parts) result.naming += (result.naming.empty() ? "" : " ") + part;
        return result;
    }
    std::string missing() const {
        for (int face = 0; face < 6; ++face)
            if (files[face].empty()) return cube_face_names[face];
        return "";
    }
};

/// The faces as words of a kind name them; nothing if a path has no such word. `twice`: a path whose face another path has.
std::optional<Candidate> named_by(FaceWords kind, const std::vector<std::string>& paths,
                                  const std::vector<std::string>& parts, std::string& twice) {
    Candidate candidate{kind, "", {}, {}};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const int face = face_named(kind, parts[i]);
        if (face < 0) return std::nullopt;
        if (candidate.files[face].empty()) candidate.files[face] = paths[i], candidate.parts[face] = parts[i];
        else if (twice.empty())
            twice = paths[i] + ": is a second " + cube_face_names[face] + " beside " + candidate.files[face] +
                    "; give each face once";
    }
    return candidate;
}

std::string with(const std::string& pattern, const std::string& word) {
    const std::size_t at = pattern.find("%s");
    if (at == std::string::npos || pattern.find("%s", at + 2) != std::string::npos)
        throw Error(Refusal::usage, pattern + ": stands for six faces only with exactly one %s, which becomes px, nx, "
                                              "py, ny, pz, nz; put one in, or list six files");
    return pattern.substr(0, at) + word + pattern.substr(at + 2);
}

/// What stands in place of the %s in the names of existing files, and the files.
std::vector<std::pair<std::string, std::string>> matches_of(const std::string& pattern) {
    const std::string whole = with(pattern, "%s");
    const std::size_t at = whole.find("%s"), begin = whole.rfind('/', at) + 1,
                      end = std::min(whole.find('/', at), whole.size());
    const std::string folder = begin == 0 ? "." : whole.substr(0, begin), head = whole.substr(begin, at - begin),
                      tail = whole.substr(at + 2, end - at - 2);
    std::vector<std::pair<std::string, std::string>> matches;
    std::error_code closed, ignored;
    const fs::directory_iterator entries(folder, closed);
    if (closed == std::errc::permission_denied)
        throw Error(Refusal::unreadable,
                    folder + ": cannot be listed (" + closed.message() + "); check its permissions");
    for (const fs::directory_entry& entry : entries) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) continue;
        const std::string part = name.substr(head.size(), name.size() - head.size() - tail.size());
        const std::string file = with(pattern, part);
        if (fs::exists(file, ignored)) matches.emplace_back(part, file);
    }
    // The shortest names first, so that px stands before posx and results do not depend on the order of the folder.
    std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
        return a.first.size() != b.first.size() ? a.first.size() < b.first.size() : a.first < b.first;
    });
    return matches;
}

/// Files of a pattern, grouped by the kind and the style of their names; small letters before capitals.
std::vector<Candidate> candidates_of(const std::string& pattern) {
    std::map<std::pair<FaceWords, std::string>, Candidate, std::greater<>> groups;
    for (const auto& [part, file] : matches_of(pattern))
        for (int kind = 0; kind < int(FaceWords::count); ++kind) {
            const int face = face_named(FaceWords(kind), part);
            if (face < 0) continue;
            Candidate& group = groups[{FaceWords(kind), style_of(part)}];
            group.kind = FaceWords(kind);
            group.style = style_of(part);
            if (group.files[face].empty()) group.files[face] = file, group.parts[face] = part;
        }
    std::vector<Candidate> candidates;
    for (auto& [key, group] : groups) candidates.push_back(std::move(group));
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.kind < b.kind; });
    return candidates;
}

} // namespace

FaceFiles name_faces(const std::vector<std::string>& paths) {
    if (paths.empty())
        throw Error(Refusal::usage, "no file: there is no input; give six faces, a pattern with %s, or one image");
    const std::vector<std::string> parts = distinct_parts(paths);
    std::string fault;
    for (int kind = 0; kind < int(FaceWords::count) && paths.size() > 1; ++kind) {
        std::string twice;
        const auto candidate = named_by(FaceWords(kind), paths, parts, twice);
        if (!candidate) continue;
        if (candidate->count() == 6 && twice.empty()) return candidate->found();
        if (!fault.empty()) continue;
        fault = !twice.empty() ? twice
                               : paths[0] + ": and the others are " + std::to_string(paths.size()) +
                                     " faces of six; the face " + candidate->missing() + " is missing; add it";
    }
    if (!fault.empty()) throw Error(Refusal::usage, fault);
    if (paths.size() != 6)
        throw Error(Refusal::usage, paths[0] + ": is one of " + std::to_string(paths.size()) +
                                        " inputs; give six faces, a pattern with %s, or one image");
    return faces_in_order(paths);
}

FaceFiles faces_in_order(const std::vector<std::string>& paths) {
    FaceFiles found;
    std::copy(paths.begin(), paths.end(), found.files.begin());
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < i; ++j)
            if (found.files[i] == found.files[j])
                throw Error(Refusal::usage, paths[i] + ": is given twice; give each face once");
    return found;
}

FaceFiles find_faces(const std::string& pattern) {
    const std::vector<Candidate> candidates = candidates_of(pattern);
    if (candidates.empty())
        throw Error(Refusal::unreadable, with(pattern, "px") + ": no such file; check the pattern " + pattern +
                                             ", whose %s stands for px nx py ny pz nz, right left up down front back, "
                                             "...");
    const auto best = std::max_element(candidates.begin(), candidates.end(),
                                       [](const auto& a, const auto& b) { return a.count() < b.count(); });
    if (best->count() == 6) return best->found();
    const std::string face = best->missing();
    const auto k = std::find(cube_face_names.begin(), cube_face_names.end(), face) - cube_face_names.begin();
    const std::string word = in_style(word_of(best->kind, int(k)), best->style);
    throw Error(
        Refusal::unreadable,
        (word.empty() ? pattern + ": has no file for the face " + face : with(pattern, word) + ": no such file") +
            ", though " + std::to_string(best->count()) + " of the six faces are there; add it");
}

std::array<std::string, 6> cube_files(const std::string& pattern) {
    std::array<std::string, 6> files;
    for (int i = 0; i < 6; ++i) files[i] = with(pattern, cube_face_names[i]);
    return files;
}

Cube read_faces(const std::array<std::string, 6>& files, ColourSpace space, ImageInfo* first_out) {
    Cube cube;
    ImageInfo first;
    for (int i = 0; i < 6; ++i) {
        const auto refuse = [&](const std::string& why) { throw Error(Refusal::unsuitable, files[i] + ": " + why); };
        ImageInfo info;
        Image<float>& face = cube.faces[i] = read_radiance(files[i], space, &info);
        if (face.width() != face.height())
            refuse("is " + std::to_string(face.width()) + "x" + std::to_string(face.height()) +
                   "; a face of the sky must be square");
        const std::vector<std::string> told = std::exchange(info.notes, {});
        if (i == 0) first = info;
        for (const std::string& line : told) first.notes.push_back(files[i] + ": " + line);
        if (face.width() != cube.size())
            refuse("is " + std::to_string(face.width()) + " texels wide, but " + files[0] + " is " +
                   std::to_string(cube.size()) + "; the six faces must be of one size");
        if (face.channels() != cube.channels())
            refuse("has " + std::to_string(face.channels()) + " channel(s), but " + files[0] + " has " +
                   std::to_string(cube.channels()) + "; the six faces must be alike");
        if (info.type != first.type)
            refuse(std::string("holds ") + name(info.type) + " samples, but " + files[0] + " holds " +
                   name(first.type) + "; the six faces must be alike");
    }
    if (first_out) *first_out = std::move(first);
    return cube;
}

Image<float> to_rgb(const Image<float>& image) {
    Image<float> rgb(image.width(), image.height(), 3);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = image.at(x, y, image.channels() < 3 ? 0 : c);
    return rgb;
}

} // namespace bake
