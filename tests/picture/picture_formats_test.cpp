// The library of foreign formats, as a program that links libbake sees it.
#include "cli/command.h"
#include <sys/wait.h>

using namespace bake::test;

namespace {

struct Answer {
    int code;
    std::string out, err;
};

Answer read_picture(const Folder& folder, const std::string& file) {
    const std::string program = (fs::path(std::getenv("BAKE")).parent_path() / "linked/read_picture").string();
    const int status =
        std::system((program + " '" + file + "' >'" + folder / "out" + "' 2>'" + folder / "err" + "'").c_str());
    return {WEXITSTATUS(status), contents(folder / "out"), contents(folder / "err")};
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("picture_formats: a program linked to libbake reads foreign formats, and is told why it cannot") {
        const Folder folder;
        write_file(folder / "a.pgm", std::string("P5 2 1 255\n\x00\xff", 13));
        Answer answer = read_picture(folder, folder / "a.pgm");
        CHECK(answer.err == "");
        CHECK(answer.code == 0);
        CHECK(answer.out == "2 1 1 0.500\n");

        write_file(folder / "bad.jpg", "\xff\xd8\xff\xe0 not a picture");
        answer = read_picture(folder, folder / "bad.jpg");
        CHECK(answer.code == 3);
        CHECK(lines(answer.err) == 1);
        CHECK(answer.err.starts_with(folder / "bad.jpg: "));
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("picture_formats: a program linked to libbake reads a JPEG") {
        const fs::path jpeg = shared_data() / "textures/pairs/cube2_castell_wall_gk_v01/castell_wall_gk_v01_hm.jpg";
        const Folder folder;
        const Answer answer = read_picture(folder, jpeg.string());
        CHECK(answer.err == "");
        CHECK(answer.code == 0);
    }
}
