// What cmake --install puts under a prefix.
#include "cli/command.h"

using namespace bake::test;

TEST_SUITE("cli") {

    TEST_CASE("install: the installed command runs and reads a JPEG, whose decoder is a library of its own") {
        const Folder folder;
        const std::string build = fs::path(std::getenv("BAKE")).parent_path().string();
        const std::string install =
            "cmake --install '" + build + "' --prefix '" + folder / "x" + "' >'" + folder / "log" + "' 2>&1";
        REQUIRE_MESSAGE(std::system(install.c_str()) == 0, contents(folder / "log"));
        const std::string picture = (source_folder() / "tests/data/dots.jpg").string();
        const std::string check =
            "'" + folder / "x/bin/bake" + "' check '" + picture + "' >'" + folder / "out" + "' 2>&1";
        CHECK(std::system(check.c_str()) == 0);
        CHECK_MESSAGE(contents(folder / "out").find("16 x 16") != std::string::npos, contents(folder / "out"));
    }

} // TEST_SUITE
