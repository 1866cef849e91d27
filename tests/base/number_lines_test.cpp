#include "bake/base/error.h"
#include "bake/base/number_lines.h"
#include "mesh/file/mesh_files.h"

using namespace bake;
using bake_tests::TemporaryFolder;

TEST_SUITE("unit") {
    TEST_CASE("number_lines: blanks and commas separate, # starts a comment, lines without numbers are no lines") {
        const TemporaryFolder folder;
        const auto lines = read_number_lines(folder.write("a", "# head\n1,2 , -3e2\t+4\r\n\n  \n.5# five\n6"));
        REQUIRE(lines.size() == 3);
        CHECK(lines[0].line == 2);
        CHECK(lines[0].values == std::vector<double>{1, 2, -300, 4});
        CHECK(lines[1].line == 5);
        CHECK(lines[1].values == std::vector<double>{0.5});
        CHECK(lines[2].line == 6);
        CHECK(lines[2].values == std::vector<double>{6});
        CHECK(read_number_lines(folder.write("b", "")).empty());
    }

    TEST_CASE("number_lines: words, infinities and numbers beyond doubles are refused with their line") {
        const TemporaryFolder folder;
        for (const char* word : {"x", "1x", "inf", "nan", "1e999", "0x10", "1;2", "+-1"}) {
            CAPTURE(std::string(word));
            try {
                read_number_lines(folder.write("a", std::string("1 2\n3 ") + word + " 4\n"));
                FAIL("taken");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unreadable);
                CHECK(std::string(error.what()).find("a: line 2: '" + std::string(word) + "' is not a number") !=
                      std::string::npos);
            }
        }
    }
}
