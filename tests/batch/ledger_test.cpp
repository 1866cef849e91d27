#include "bake/batch/ledger.h"
#include "cli/command.h"
#include <sys/stat.h>

using namespace bake;
using bake::test::Folder, bake::test::write_file;

namespace {

ReadFile read_now(const std::string& path) {
    struct stat file {};
    stat(path.c_str(), &file);
    return {path, stamp_of(file)};
}

/// A task that read `in` and wrote `out`, recorded by one ledger and asked of another one.
struct Recorded {
    Folder folder;
    std::string in = folder / "an input %.png", out = folder / "out.png", file = folder / "a.ledger";
    BatchTask task{.name = "a b", .words = {"normal-map", "--out=x"}, .inputs = {}, .outputs = {}, .needs = {}};

    Recorded() {
        write_file(in, "one");
        write_file(out, "two");
        Ledger ledger(file, "1 a");
        ledger.record(task, {read_now(in)}, {out}, 1.5);
        ledger.write();
    }
    std::string why(const std::string& program = "1 a") const { return Ledger(file, program).why(task); }
};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("Ledger: what was recorded is unchanged, and its seconds are known") {
        const Recorded recorded;
        CHECK(recorded.why() == "");
        CHECK(Ledger(recorded.file, "1 a").seconds(recorded.task) == doctest::Approx(1.5));
        CHECK(recorded.folder.names().size() == 3);
    }

    TEST_CASE("Ledger: each change is a reason") {
        Recorded recorded;
        CHECK(recorded.why("2 a") == "another version of bake");
        write_file(recorded.in, "One");
        CHECK(recorded.why() == "inputs changed: " + recorded.in);
        write_file(recorded.in, "one"); // as before, with another time
        CHECK(recorded.why() == "");
        write_file(recorded.out, "too");
        CHECK(recorded.why() == "output changed: " + recorded.out);
        std::filesystem::remove(recorded.out);
        CHECK(recorded.why() == "output missing: " + recorded.out);
        recorded.task.words.push_back("--amplitude=2");
        CHECK(recorded.why() == "options changed");
        recorded.task.name = "c";
        CHECK(recorded.why() == "new");
    }

    TEST_CASE("Ledger: a task that another version ran last is known as such, whatever ran since") {
        const Recorded recorded;
        BatchTask other = recorded.task;
        other.name = "other";
        {
            Ledger ledger(recorded.file, "2 b");
            ledger.record(other, {read_now(recorded.in)}, {recorded.out}, 1);
            ledger.write();
        }
        CHECK(recorded.why("2 b") == "another version of bake");
        CHECK(recorded.why("1 a") == "");
        CHECK(Ledger(recorded.file, "2 b").why(other) == "");
    }

    TEST_CASE("Ledger: an input that changed while the task ran is changed the next time") {
        const Recorded recorded;
        ReadFile old = read_now(recorded.in);
        --old.stamp.changed_ns;
        Ledger ledger(recorded.file, "1 a");
        ledger.record(recorded.task, {old}, {recorded.out}, 1);
        CHECK(ledger.why(recorded.task) == "inputs changed: " + recorded.in);
    }

    TEST_CASE("Ledger: a file that is no ledger, or a torn one, counts as absent") {
        const Recorded recorded;
        const std::string bytes = test::contents(recorded.file);
        write_file(recorded.file, bytes.substr(0, bytes.size() - 8));
        CHECK(recorded.why() == "new");
        write_file(recorded.file, "something else");
        CHECK(recorded.why() == "new");
    }
}
