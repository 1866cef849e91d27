#include "bake/base/content_hash.h"
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/input_record.h"
#include "bake/base/provenance.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("recorded_inputs: the hash of what was read, and none of a file that another one replaced meanwhile") {
        const Folder folder;
        const std::string path = folder / "a.txt";
        write_file(path, "first");
        const InputRecord record;
        read_file(path);
        write_file(folder / "b.txt", "other");
        const auto replace = [&] { std::filesystem::rename(folder / "b.txt", path); };
        SUBCASE("replaced after the hash is known") {
            CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
            replace();
            CHECK(recorded_inputs().at(0).hash == content_hash("first", 5));
        }
        SUBCASE("replaced before") {
            replace();
            CHECK(recorded_inputs().at(0).hash == "");
            const RunRecord run({"normal-map", {}});
            try {
                record_text({});
                FAIL("has a record");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unreadable);
                CHECK(std::string(error.what()) == path + ": was changed while it was used; run the command again");
            }
        }
        SUBCASE("written to before") {
            write_file(path, "longer than the first");
            CHECK(recorded_inputs().at(0).hash == "");
        }
        SUBCASE("removed before: as temporary files are") {
            std::filesystem::remove(path);
            CHECK(recorded_inputs().empty());
        }
    }

} // TEST_SUITE
