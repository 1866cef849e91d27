#include "bake/base/content_hash.h"
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/input_record.h"
#include "bake/base/provenance.h"
#include "bake/picture/picture_file.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("recorded_inputs: the hash of what was read, whatever becomes of the file later") {
        const Folder folder;
        const std::string path = folder / "a.txt";
        write_file(path, "first");
        const InputRecord record;
        SUBCASE("a file in memory") { read_file(path); }
        SUBCASE("a picture file") { const PictureFile file(path); }
        CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
        write_file(folder / "b.txt", "other");
        std::filesystem::rename(folder / "b.txt", path);
        CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
        std::filesystem::remove(path); // as temporary files are
        CHECK(recorded_inputs().empty());
    }

    TEST_CASE("recorded_inputs: no hash of a file that was changed while it was read, and no record") {
        const Folder folder;
        const std::string path = folder / "a.txt";
        write_file(path, "first");
        const InputRecord record;
        {
            const PictureFile file(path);
            CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
            write_file(path, "longer than the first");
            CHECK(recorded_inputs().at(0).hash == "");
        }
        CHECK(recorded_inputs().at(0).hash == "");
        const RunRecord run({"normal-map", {}});
        try {
            record_text({});
            FAIL("has a record");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unreadable);
            CHECK(std::string(error.what()) == path + ": was changed while it was read; run the command again");
        }
    }

    TEST_CASE("recorded_inputs: no hash of a file that was changed between two times that it was read") {
        const Folder folder;
        const std::string path = folder / "a.txt";
        write_file(path, "first");
        const InputRecord record;
        read_file(path);
        write_file(path, "longer than the first");
        CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
        read_file(path);
        CHECK(recorded_inputs().at(0).hash == "");
    }

} // TEST_SUITE
