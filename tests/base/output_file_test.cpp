#include "bake/base/error.h"
#include "bake/base/input_record.h"
#include "bake/base/output_file.h"
#include "cli/command.h"
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace bake;
using namespace bake::test;

namespace {

void fill(const OutputFile& file, const std::string& text) {
    const int to = file.open_descriptor();
    CHECK(write(to, text.data(), text.size()) == ssize_t(text.size()));
    CHECK(close(to) == 0);
}

void write_output(const std::string& path, const std::string& text) {
    OutputFile file(path);
    fill(file, text);
    file.commit();
}

/// The error of `work`, which must refuse with `why`.
template <class Work> std::string refusal(Refusal why, Work&& work) {
    try {
        work();
    } catch (const Error& error) {
        CHECK(error.refusal == why);
        return error.what();
    }
    FAIL_CHECK("was accepted");
    return "";
}

unsigned mode_of(const std::string& path) {
    struct stat file {};
    REQUIRE(stat(path.c_str(), &file) == 0);
    return file.st_mode & 07777;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("output_file: the target appears with commit(), whole, under the rights of a new file") {
        const Folder folder;
        const mode_t mask = umask(022);
        {
            OutputFile file(folder / "a.txt");
            fill(file, "new");
            CHECK(folder.names().size() == 1);
            CHECK_FALSE(fs::exists(folder / "a.txt"));
            file.commit();
        }
        umask(mask);
        CHECK(contents(folder / "a.txt") == "new");
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
        CHECK(mode_of(folder / "a.txt") == 0644);
    }

    TEST_CASE("output_file: without commit() the old file stays and the temporary goes") {
        const Folder folder;
        write_file(folder / "a.txt", "old");
        {
            const OutputFile file(folder / "a.txt");
            fill(file, "half of the n");
            CHECK(folder.names().size() == 2);
        }
        CHECK(contents(folder / "a.txt") == "old");
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
    }

    TEST_CASE("output_file: an empty file is unwritable, and the old one stays") {
        const Folder folder;
        write_file(folder / "a.txt", "old");
        refusal(Refusal::unwritable, [&] { OutputFile(folder / "a.txt").commit(); });
        CHECK(contents(folder / "a.txt") == "old");
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
    }

    TEST_CASE("output_file: folders, missing folders, no name, pipes and devices are unwritable, before any work") {
        const Folder folder;
        fs::create_directory(folder.path / "taken");
        REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
        fs::create_symlink("loop", folder.path / "loop");
        const auto before = folder.names();
        for (const std::string& path : {folder / "taken", folder / "taken/", folder / "nowhere/a.txt", std::string(""),
                                        std::string("/"), folder / "pipe", std::string("/dev/full"), folder / "loop"}) {
            CAPTURE(path);
            refusal(Refusal::unwritable, [&] { const OutputFile file(path); });
        }
        CHECK(folder.names() == before);
    }

    TEST_CASE("output_file: what is written to the null device is discarded") {
        const Folder folder;
        fs::create_symlink("/dev/null", folder.path / "nothing.txt");
        write_output(folder / "nothing.txt", "text");
        write_output("/dev/null", "text");
        CHECK(fs::is_character_file("/dev/null"));
        CHECK(folder.names() == std::set<std::string>{"nothing.txt"});
    }

    TEST_CASE("output_file: a target that became a folder meanwhile is unwritable, and nothing is left") {
        const Folder folder;
        {
            OutputFile file(folder / "a");
            fill(file, "new");
            fs::create_directory(folder.path / "a");
            refusal(Refusal::unwritable, [&] { file.commit(); });
        }
        CHECK(folder.names() == std::set<std::string>{"a"});
    }

    TEST_CASE("output_file: a symbolic link stays and its target is replaced, with the target's mode") {
        const Folder folder;
        fs::create_directory(folder.path / "store");
        write_file(folder / "store/real.txt", "old");
        REQUIRE(chmod((folder / "store/real.txt").c_str(), 0640) == 0);
        fs::create_symlink("store/real.txt", folder.path / "inner.txt");
        fs::create_symlink("inner.txt", folder.path / "link.txt");
        fs::create_symlink("store/made.txt", folder.path / "dangling.txt");
        write_output(folder / "link.txt", "new");
        write_output(folder / "dangling.txt", "made");
        CHECK(fs::read_symlink(folder / "link.txt") == "inner.txt");
        CHECK(fs::is_symlink(folder / "dangling.txt"));
        CHECK(contents(folder / "store/real.txt") == "new");
        CHECK(contents(folder / "store/made.txt") == "made");
        CHECK(mode_of(folder / "store/real.txt") == 0640);
    }

    TEST_CASE("output_file: the owner is kept" * doctest::skip(geteuid() != 0)) {
        const Folder folder;
        write_file(folder / "a.txt", "old");
        REQUIRE(chown((folder / "a.txt").c_str(), 65534, 65534) == 0);
        REQUIRE(chmod((folder / "a.txt").c_str(), 0604) == 0);
        write_output(folder / "a.txt", "new");
        struct stat file {};
        REQUIRE(stat((folder / "a.txt").c_str(), &file) == 0);
        CHECK(file.st_uid == 65534);
        CHECK(file.st_gid == 65534);
        CHECK((file.st_mode & 07777) == 0604);
    }

    TEST_CASE("output_file: what a killed run left is swept, what a live one locks is not, nor what is not ours") {
        const Folder folder;
        const std::string left = ".bake-0123456789abcdef.tmp", live = ".bake-fedcba9876543210.tmp";
        for (const std::string& name :
             {left, live, std::string(".bake-0123.tmp"), std::string(".bake-0123456789ABCDEF.tmp")})
            write_file(folder / name, "text");
        fs::create_symlink("a.txt", folder.path / ".bake-00000000000000aa.tmp");
        const int lock = open((folder / live).c_str(), O_RDWR | O_CLOEXEC);
        REQUIRE(flock(lock, LOCK_EX | LOCK_NB) == 0);
        auto expected = folder.names();
        expected.erase(left);
        expected.insert("a.txt");
        const OutputFile running(folder / "b.txt");
        write_output(folder / "a.txt", "new");
        CHECK(folder.names().size() == expected.size() + 1);
        for (const std::string& name : expected) CHECK(fs::exists(fs::symlink_status(folder / name)));
        CHECK_FALSE(fs::exists(folder / left));
        close(lock);
    }

    TEST_CASE("output_file: the longest name that a folder can hold") {
        const Folder folder;
        const std::string name = std::string(251, 'n') + ".txt";
        write_output(folder / name, "new");
        CHECK(contents(folder / name) == "new");
    }

    TEST_CASE("output_file: a file that was read is not replaced, under whatever name") {
        const Folder folder;
        write_file(folder / "in.txt", "old");
        fs::create_hard_link(folder / "in.txt", folder / "hard.txt");
        fs::create_symlink("in.txt", folder.path / "soft.txt");
        const auto read = [&] {
            struct stat file {};
            REQUIRE(stat((folder / "in.txt").c_str(), &file) == 0);
            remember_input("in.txt", file);
        };
        {
            const InputRecord inputs;
            read();
            for (const char* name : {"in.txt", "hard.txt", "soft.txt"})
                CHECK(refusal(Refusal::usage, [&] { const OutputFile file(folder / name); }).find("would replace") !=
                      std::string::npos);
        }
        {
            const InputRecord inputs;
            OutputFile reserved(folder / "in.txt"); // before it is read
            fill(reserved, "new");
            read();
            refusal(Refusal::usage, [&] { reserved.commit(); });
        }
        CHECK(contents(folder / "in.txt") == "old");
        read();
        write_output(folder / "in.txt", "new"); // without a record
        CHECK(contents(folder / "in.txt") == "new");
        CHECK(folder.names().size() == 3);
    }

    TEST_CASE("output_set: files appear together; those of a set that is not committed do not") {
        const Folder folder;
        write_file(folder / "b.txt", "old");
        {
            OutputSet set;
            write_output(folder / "a.txt", "new");
            {
                OutputSet inner;
                write_output(folder / "b.txt", "new");
                inner.commit();
            }
            CHECK(contents(folder / "b.txt") == "old");
            CHECK_FALSE(fs::exists(folder / "a.txt"));
            set.commit();
            CHECK(contents(folder / "a.txt") == "new");
            CHECK(contents(folder / "b.txt") == "new");
        }
        {
            const OutputSet dropped;
            write_output(folder / "a.txt", "newer");
        }
        CHECK(contents(folder / "a.txt") == "new");
        CHECK(folder.names() == std::set<std::string>{"a.txt", "b.txt"});
    }

    TEST_CASE("output_set: one name for two outputs is refused, before anything is replaced") {
        const Folder folder;
        fs::create_symlink("a.txt", folder.path / "link.txt");
        write_file(folder / "a.txt", "old");
        OutputSet set;
        write_output(folder / "b.txt", "new");
        write_output(folder / "a.txt", "one");
        write_output(folder / "link.txt", "two");
        CHECK(refusal(Refusal::usage, [&] { set.commit(); }).find("two outputs") != std::string::npos);
        CHECK(contents(folder / "a.txt") == "old");
        CHECK(folder.names() == std::set<std::string>{"a.txt", "link.txt"});
    }

    TEST_CASE("output_set: when a rename fails, the message says which files are new and which are old") {
        const Folder folder;
        fs::create_directory(folder.path / "sub");
        OutputSet set;
        write_output(folder / "a.txt", "new");
        write_output(folder / "sub/b.txt", "new");
        write_output(folder / "c.txt", "new");
        fs::remove_all(folder.path / "sub");
        const std::string message = refusal(Refusal::unwritable, [&] { set.commit(); });
        CHECK(message.find("new are " + folder / "a.txt" + ";") != std::string::npos);
        CHECK(message.find("not written are " + folder / "sub/b.txt" + ", " + folder / "c.txt") != std::string::npos);
        CHECK(folder.names() == std::set<std::string>{"a.txt"});
    }

} // TEST_SUITE
