#include "bake/environment/file/face_files.h"
#include "bake/environment/file/face_names.h"
#include "cli/command.h"
#include <algorithm>
#include <cctype>

using namespace bake;
using test::Folder;

namespace {

using Six = std::array<std::string, 6>;

/// px nx py ny pz nz, as programs and collections of skies name them.
const std::vector<Six>& spellings() {
    static const std::vector<Six> all = {
        {"px", "nx", "py", "ny", "pz", "nz"},
        {"px", "mx", "py", "my", "pz", "mz"},
        {"posx", "negx", "posy", "negy", "posz", "negz"},
        {"pos-x", "neg-x", "pos-y", "neg-y", "pos-z", "neg-z"},
        {"pos_x", "neg_x", "pos_y", "neg_y", "pos_z", "neg_z"},
        {"positive_x", "negative_x", "positive_y", "negative_y", "positive_z", "negative_z"},
        {"plusX", "minusX", "plusY", "minusY", "plusZ", "minusZ"},
        {"PosX", "NegX", "PosY", "NegY", "PosZ", "NegZ"},
        {"+x", "-x", "+y", "-y", "+z", "-z"},
        {"X+", "X-", "Y+", "Y-", "Z+", "Z-"},
        {"xp", "xn", "yp", "yn", "zp", "zn"},
        {"xpos", "xneg", "ypos", "yneg", "zpos", "zneg"},
        {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"},
        {"Left+X", "Right-X", "Up+Y", "Down-Y", "Front+Z", "Back-Z"},
        {"right", "left", "top", "bottom", "front", "back"},
        {"right", "left", "up", "down", "front", "back"},
        {"right1", "left2", "top3", "bottom4", "front5", "back6"},
        {"1_right", "2_left", "3_up", "4_down", "5_front", "6_back"},
        {"right", "left", "up", "down", "forward", "backward"},
        {"rt", "lf", "up", "dn", "bk", "ft"},
        {"rt", "lf", "up", "dn", "fr", "bk"},
        {"r", "l", "u", "d", "f", "b"},
        {"east", "west", "up", "down", "north", "south"},
        {"0", "1", "2", "3", "4", "5"},
        {"1", "2", "3", "4", "5", "6"},
        {"00", "01", "02", "03", "04", "05"},
        {"c00", "c01", "c02", "c03", "c04", "c05"},
        {"face0", "face1", "face2", "face3", "face4", "face5"},
    };
    return all;
}

Six in_capitals(Six words) {
    for (std::string& word : words)
        for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
    return words;
}

Six placed(const std::string& frame, const Six& words) {
    Six files;
    for (int i = 0; i < 6; ++i) {
        files[i] = frame;
        files[i].replace(files[i].find("%s"), 2, words[i]);
    }
    return files;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("face_names: lists in any order are told apart by every spelling, in small letters and capitals") {
        for (const Six& spelling : spellings())
            for (const Six& words : {spelling, in_capitals(spelling)})
                for (const char* frame : {"sky/%s.png", "a/mountain_%s.hdr", "sky-%s.exr", "%s_1024.png", "%s/f.png"}) {
                    const Six files = placed(frame, words);
                    CAPTURE(files[0]);
                    std::vector<std::string> mixed(files.begin(), files.end());
                    std::rotate(mixed.begin(), mixed.begin() + 4, mixed.end());
                    std::swap(mixed[0], mixed[2]);
                    const FaceFiles found = name_faces(mixed);
                    CHECK(found.files == files);
                    CHECK(!found.naming.empty());
                }
    }

    TEST_CASE("face_names: a pattern finds every spelling, in file names and in names of folders") {
        for (const Six& spelling : spellings())
            for (const Six& words : {spelling, in_capitals(spelling)}) {
                const Folder folder;
                const Six files = placed(folder / "sky_%s.png", words);
                for (const std::string& file : files) test::write_file(file, "x");
                test::write_file(folder / "sky_old.png", "x");
                CAPTURE(files[0]);
                CHECK(find_faces(folder / "sky_%s.png").files == files);
            }
        const Folder folder;
        const Six files = placed(folder / "%s/sky.png", {"Right", "Left", "Top", "Bottom", "Front", "Back"});
        for (const std::string& file : files) {
            std::filesystem::create_directory(std::filesystem::path(file).parent_path());
            test::write_file(file, "x");
        }
        CHECK(find_faces(folder / "%s/sky.png").files == files);
    }

    TEST_CASE("face_names: of two complete skies, the shorter names and the small letters are taken") {
        const Folder folder;
        const Six px = placed(folder / "s_%s.png", {"px", "nx", "py", "ny", "pz", "nz"});
        for (const Six& words : {spellings()[0], spellings()[2], in_capitals(spellings()[0]), spellings()[14]})
            for (const std::string& file : placed(folder / "s_%s.png", words)) test::write_file(file, "x");
        CHECK(find_faces(folder / "s_%s.png").files == px);
    }

    TEST_CASE("face_names: words that are part of other words name no face") {
        for (const char* part : {"night", "upper2lower", "box", "max", "frontier", "7", "x", "p", "old", ""})
            for (int kind = 0; kind < int(FaceWords::count); ++kind)
                if (std::string(part) != "7" || kind < int(FaceWords::from_zero))
                    CHECK_MESSAGE(face_named(FaceWords(kind), part) == -1, part);
        CHECK(face_named(FaceWords::from_zero, "6") == -1);
        CHECK(face_named(FaceWords::from_one, "0") == -1);
    }

} // TEST_SUITE
