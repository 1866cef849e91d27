#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "cli/command.h"
#include <sys/stat.h>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("output_file: the target appears with commit(), whole, under the rights of a new file") {
        const Folder folder;
        const mode_t mask = umask(022);
        {
            OutputFile file(folder / "a.txt");
            CHECK(fs::path(file.temporary()).parent_path() == folder.path);
            CHECK(fs::path(file.temporary()).extension() == ".txt");
            write_file(file.temporary(), "new");
            CHECK_FALSE(fs::exists(folder / "a.txt"));
            file.commit();
        }
        umask(mask);
        CHECK(contents(folder / "a.txt") == "new");
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
        CHECK((fs::status(folder / "a.txt").permissions() & fs::perms::all) == fs::perms(0644));
    }

    TEST_CASE("output_file: without commit() the old file stays and the temporary goes") {
        const Folder folder;
        write_file(folder / "a.txt", "old");
        {
            const OutputFile file(folder / "a.txt");
            write_file(file.temporary(), "half of the n");
            CHECK(folder.names().size() == 2);
        }
        CHECK(contents(folder / "a.txt") == "old");
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
    }

    TEST_CASE("output_file: folders, missing folders and no name at all are unwritable, before any work") {
        const Folder folder;
        fs::create_directory(folder.path / "taken");
        for (const std::string& path :
             {folder / "taken", folder / "taken/", folder / "nowhere/a.txt", std::string(""), std::string("/")}) {
            CAPTURE(path);
            try {
                const OutputFile file(path);
                FAIL_CHECK("was accepted");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unwritable);
            }
        }
        CHECK(folder.names() == std::set<std::string>{"taken"});
    }

    TEST_CASE("output_file: a target that became a folder meanwhile is unwritable, and nothing is left") {
        const Folder folder;
        {
            OutputFile file(folder / "a");
            fs::create_directory(folder.path / "a");
            CHECK_THROWS_AS(file.commit(), const Error&);
        }
        CHECK(folder.names() == std::set<std::string>{"a"});
    }

    TEST_CASE("write_text: replaces a file, empty text too") {
        const Folder folder;
        write_text(folder / "a.txt", "one\n");
        write_text(folder / "a.txt", std::string("two\0three", 9));
        CHECK(contents(folder / "a.txt").size() == 9);
        write_text(folder / "a.txt", "");
        CHECK(contents(folder / "a.txt") == "");
        CHECK_THROWS_AS(write_text("/dev/full/a", "text"), const Error&);
    }

} // TEST_SUITE
