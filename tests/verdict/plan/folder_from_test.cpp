// Folders as seen from others.
#include "bake/verdict/plan/folder_from.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {
    TEST_CASE("folder_from: one folder, below, above and beside") {
        CHECK(folder_from("a.toml", "b.toml") == ".");
        CHECK(folder_from("x/a.toml", "x/../x/b.toml") == ".");
        const auto same = [](const fs::path& folder, const char* expected) {
            CHECK((folder / "f").lexically_normal() == fs::path(expected) / "f");
        };
        same(folder_from("x/y/a.toml", "b.toml"), "x/y");
        same(folder_from("a.toml", "x/y/b.toml"), "../..");
        same(folder_from("x/a.toml", "y/b.toml"), "../x");
    }

    TEST_CASE("folder_from: links are followed on the way down, and never on the way up") {
        const Folder folder;
        fs::create_directories(folder / "real/deep");
        fs::create_directory_symlink(folder / "real/deep", folder / "link");
        write_file(folder / "a.png", "a");
        write_file(folder / "real/deep/b.png", "b");
        CHECK(folder_from(folder / "link/a.toml", folder / "b.toml").lexically_normal() == fs::path("link/"));
        CHECK(folder_from(folder / "link/a.toml", folder / "real/deep/b.toml") == ".");
        const fs::path up = folder_from(folder / "a.toml", folder / "link/b.toml");
        CHECK(contents((fs::path(folder / "link") / up / "a.png").string()) == "a");
    }
}
