#include "bake/environment/file/face_files.h"
#include "bake/base/error.h"
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

namespace bake {
namespace {

namespace fs = std::filesystem;
using Words = std::array<std::string, 6>;

const std::vector<Words>& all_words() {
    static const std::vector<Words> words = [] {
        const std::vector<Words> lower = {{"px", "nx", "py", "ny", "pz", "nz"},
                                          {"px", "mx", "py", "my", "pz", "mz"},
                                          {"posx", "negx", "posy", "negy", "posz", "negz"},
                                          {"right", "left", "up", "down", "front", "back"},
                                          {"right", "left", "top", "bottom", "front", "back"},
                                          {"rt", "lf", "up", "dn", "bk", "ft"},
                                          {"rt", "lf", "up", "dn", "fr", "bk"},
                                          {"+x", "-x", "+y", "-y", "+z", "-z"},
                                          {"xpos", "xneg", "ypos", "yneg", "zpos", "zneg"},
                                          {"0", "1", "2", "3", "4", "5"}};
        std::vector<Words> all = lower;
        for (const Words& set : lower) {
            Words upper = set, capital = set;
            for (int i = 0; i < 6; ++i) {
                for (char& c : upper[i]) c = char(std::toupper(static_cast<unsigned char>(c)));
                capital[i][0] = upper[i][0];
            }
            if (upper != set) all.push_back(upper);
            if (capital != set && capital != upper) all.push_back(capital);
        }
        return all;
    }();
    return words;
}

std::string joined(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// The file names without the beginning and the end that all of them share.
std::vector<std::string> distinct_parts(const std::vector<std::string>& paths) {
    std::vector<std::string> names;
    for (const std::string& path : paths) names.push_back(fs::path(path).filename().string());
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

/// The face that each word names, -1 for words that are not in the set.
std::vector<int> faces_of(const std::vector<std::string>& parts, const Words& words) {
    std::vector<int> faces;
    for (const std::string& part : parts) {
        const auto at = std::find(words.begin(), words.end(), part);
        faces.push_back(at == words.end() ? -1 : int(at - words.begin()));
    }
    return faces;
}

std::string with(const std::string& pattern, const std::string& word) {
    const std::size_t at = pattern.find("%s");
    if (at == std::string::npos || pattern.find("%s", at + 2) != std::string::npos)
        throw Error(Refusal::usage, pattern + ": stands for six faces only with exactly one %s, which becomes px, nx, "
                                              "py, ny, pz, nz; put one in, or list six files");
    return pattern.substr(0, at) + word + pattern.substr(at + 2);
}

} // namespace

FaceFiles name_faces(const std::vector<std::string>& paths) {
    if (paths.empty())
        throw Error(Refusal::usage, "no file: there is no input; give six faces, a pattern with %s, or one image");
    const std::vector<std::string> parts = distinct_parts(paths);
    for (const Words& words : all_words()) {
        const std::vector<int> faces = faces_of(parts, words);
        // A single file has no part that differs from the others.
        if (paths.size() < 2 || std::count(faces.begin(), faces.end(), -1) > 0) continue;
        FaceFiles found;
        found.naming = joined(words);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            std::string& file = found.files[faces[i]];
            if (!file.empty())
                throw Error(Refusal::usage, paths[i] + ": is a second " + words[faces[i]] + " beside " + file +
                                                "; give each face once");
            file = paths[i];
        }
        for (int face = 0; face < 6; ++face)
            if (found.files[face].empty())
                throw Error(Refusal::usage, paths[0] + ": and its like are " + std::to_string(paths.size()) +
                                                " faces of six; " + words[face] + " (" + cube_face_names[face] +
                                                ") is missing");
        return found;
    }
    if (paths.size() != 6)
        throw Error(Refusal::usage, paths[0] + ": is one of " + std::to_string(paths.size()) +
                                        " inputs; give six faces, a pattern with %s, or one image");
    FaceFiles found;
    std::copy(paths.begin(), paths.end(), found.files.begin());
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < i; ++j)
            if (found.files[i] == found.files[j])
                throw Error(Refusal::usage, paths[i] + ": is given twice; give each face once");
    return found;
}

FaceFiles find_faces(const std::string& pattern) {
    int most = 0;
    FaceFiles best;
    std::string missing = with(pattern, "px");
    for (const Words& words : all_words()) {
        FaceFiles found;
        found.naming = joined(words);
        int there = 0;
        std::string absent;
        for (int i = 0; i < 6; ++i) {
            found.files[i] = with(pattern, words[i]);
            std::error_code ignored;
            if (fs::exists(found.files[i], ignored)) ++there;
            else if (absent.empty()) absent = found.files[i];
        }
        if (there == 6) return found;
        if (there > most) most = there, missing = absent;
    }
    throw Error(Refusal::unreadable,
                missing + ": no such file" +
                    (most > 0 ? ", though " + std::to_string(most) + " of the six faces are there" : "") +
                    "; check the pattern " + pattern +
                    ", whose %s stands for px nx py ny pz nz, right left up down front back, ...");
}

std::array<std::string, 6> cube_files(const std::string& pattern) {
    std::array<std::string, 6> files;
    for (int i = 0; i < 6; ++i) files[i] = with(pattern, cube_face_names[i]);
    return files;
}

Cube read_faces(const std::array<std::string, 6>& files, const RadianceOptions& options, FacesReport* report) {
    Cube cube;
    ImageInfo first;
    for (int i = 0; i < 6; ++i) {
        const auto refuse = [&](const std::string& why) { throw Error(Refusal::unsuitable, files[i] + ": " + why); };
        ImageInfo info;
        Image<float>& face = cube.faces[i] =
            read_radiance(files[i], options, &info, report ? &report->mended[i] : nullptr);
        if (face.width() != face.height())
            refuse("is " + std::to_string(face.width()) + "x" + std::to_string(face.height()) +
                   "; a face of the sky must be square");
        if (i == 0) first = info;
        for (const std::string& line : info.notes)
            if (report) report->notes.push_back(files[i] + ": " + line);
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
    if (report) report->first = std::move(first);
    return cube;
}

Image<float> to_rgb(const Image<float>& image) {
    Image<float> rgb(image.width(), image.height(), 3);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = image.at(x, y, image.channels() < 3 ? 0 : c);
    return rgb;
}

Cube read_cube(const std::array<std::string, 6>& files, ColourSpace space, std::vector<std::string>* notes) {
    FacesReport report;
    Cube cube = read_faces(files, {.space = space, .allow_negative = true}, &report);
    if (notes) notes->insert(notes->end(), report.notes.begin(), report.notes.end());
    if (cube.channels() < 3)
        throw Error(Refusal::unsuitable, files[0] + ": has " + std::to_string(cube.channels()) +
                                             " channel(s); a face of the sky needs red, green and blue");
    if (cube.channels() > 3)
        for (Image<float>& face : cube.faces) face = to_rgb(face);
    return cube;
}

} // namespace bake
