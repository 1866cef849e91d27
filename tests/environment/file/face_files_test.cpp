#include "bake/base/error.h"
#include "bake/environment/file/face_files.h"
#include "cli/command.h"
#include <cmath>

using namespace bake;
using test::Folder;
namespace fs = std::filesystem;

namespace {

Image<float> flat_image(int width, int height, int channels, float value) {
    Image<float> image(width, height, channels);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = value;
    return image;
}

/// Runs `work`, which must refuse with `why` and name `file`.
template <class Work> void check_refused(Refusal why, const std::string& file, Work&& work) {
    try {
        work();
        FAIL("not refused");
    } catch (const Error& error) {
        CHECK(error.refusal == why);
        CHECK_MESSAGE(std::string(error.what()).rfind(file, 0) == 0, error.what());
        CHECK_MESSAGE(std::string(error.what()).find(';') != std::string::npos, error.what());
    }
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("face_files: names that say nothing are taken in the order given") {
        const std::vector<std::string> files = {"a.png", "b.png", "c.png", "d.png", "e.png", "f.png"};
        const FaceFiles found = name_faces(files);
        CHECK(found.naming == "");
        CHECK(std::vector<std::string>(found.files.begin(), found.files.end()) == files);
    }

    TEST_CASE("face_files: a missing face, a second one, a wrong number are refused by name") {
        check_refused(Refusal::usage, "sky_px.png", [] {
            name_faces({"sky_px.png", "sky_nx.png", "sky_py.png", "sky_ny.png", "sky_nz.png"});
        });
        check_refused(Refusal::usage, "b/sky_nx.png", [] {
            name_faces({"sky_px.png", "sky_nx.png", "sky_py.png", "sky_ny.png", "sky_nz.png", "b/sky_nx.png"});
        });
        check_refused(Refusal::usage, "a.png", [] { name_faces({"a.png", "b.png"}); });
        check_refused(Refusal::usage, "a.png", [] {
            name_faces({"a.png", "b.png", "c.png", "d.png", "e.png", "a.png"});
        });
        check_refused(Refusal::usage, "no file", [] { name_faces({}); });
        try {
            name_faces({"sky_px.png", "sky_nx.png", "sky_py.png", "sky_ny.png", "sky_nz.png"});
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find("the face pz is missing") != std::string::npos);
        }
        const std::vector<std::string> same = {"a.png", "b.png", "c.png", "d.png", "e.png", "a.png"};
        check_refused(Refusal::usage, "a.png", [&] { faces_in_order(same); });
    }

    TEST_CASE("face_files: a pattern finds whichever set of words is there, and names the face that is not") {
        const Folder folder;
        for (const char* word : {"rt", "lf", "up", "dn", "bk", "ft"})
            test::write_file(folder / (std::string("sky_") + word + ".jpg"), "x");
        const FaceFiles found = find_faces(folder / "sky_%s.jpg");
        CHECK(found.files[4] == folder / "sky_bk.jpg");
        fs::remove(folder / "sky_dn.jpg");
        check_refused(Refusal::unreadable, folder / "sky_dn.jpg", [&] { find_faces(folder / "sky_%s.jpg"); });
        check_refused(Refusal::unreadable, folder / "other_px.jpg", [&] { find_faces(folder / "other_%s.jpg"); });
        for (const char* word : {"Pos_X", "Neg_X", "Pos_Y"})
            test::write_file(folder / (std::string("s_") + word + ".png"), "x");
        check_refused(Refusal::unreadable, folder / "s_%s.png", [&] { find_faces(folder / "s_%s.png"); });
    }

    TEST_CASE("face_files: a pattern stands for six names") {
        const auto files = cube_files("sky/a_%s.jpg");
        CHECK(files[0] == "sky/a_px.jpg");
        CHECK(files[5] == "sky/a_nz.jpg");
        for (const char* bad : {"sky.jpg", "%s/%s.jpg"}) check_refused(Refusal::usage, bad, [&] { cube_files(bad); });
    }

    TEST_CASE("face_files: 8-bit faces are decoded from sRGB, float faces are not, and either can be told") {
        const Folder folder;
        for (const char* name : cube_face_names) {
            write_image(folder / (std::string(name) + ".png"), flat_image(2, 2, 3, 0.5f), {.depth = Depth::u8});
            write_image(folder / (std::string(name) + ".exr"), flat_image(2, 2, 4, 0.5f), {.depth = Depth::float32});
        }
        const double decoded = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
        CHECK(read_faces(cube_files(folder / "%s.png")).faces[3].at(1, 1, 2) == doctest::Approx(decoded).epsilon(1e-5));
        const Cube as_data = read_faces(cube_files(folder / "%s.png"), ColourSpace::linear);
        CHECK(as_data.faces[0].at(0, 0) == doctest::Approx(128 / 255.0));
        const Cube floats = read_faces(cube_files(folder / "%s.exr"));
        CHECK(floats.faces[5].at(0, 1, 1) == doctest::Approx(0.5));
        CHECK(floats.faces[5].channels() == 4);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("face_files: a faulty face is refused by its name") {
        const Folder folder;
        const auto files = cube_files(folder / "%s.exr");
        const auto write = [&](int i, const Image<float>& image) {
            write_image(files[i], image, {.depth = Depth::float32});
        };
        for (int i = 0; i < 6; ++i) write(i, flat_image(4, 4, 3, 0.5f));
        CHECK(read_faces(files).size() == 4);

        write(2, flat_image(4, 5, 3, 0.5f));
        check_refused(Refusal::unsuitable, files[2], [&] { read_faces(files); });
        write(2, flat_image(8, 8, 3, 0.5f));
        check_refused(Refusal::unsuitable, files[2], [&] { read_faces(files); });
        write(2, flat_image(4, 4, 1, 0.5f));
        check_refused(Refusal::unsuitable, files[2], [&] { read_faces(files); });
        write_image(files[2], flat_image(4, 4, 3, 0.5f), {.depth = Depth::half});
        check_refused(Refusal::unsuitable, files[2], [&] { read_faces(files); });
        fs::remove(files[2]);
        check_refused(Refusal::unreadable, files[2], [&] { read_faces(files); });
    }

} // TEST_SUITE
