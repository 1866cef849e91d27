#include "bake/base/provenance.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE(
        "record_text: nothing without a run; with one a line of ASCII that is a record, and the run before it after") {
        const Facts facts = {{"green", std::string("up")}, {"extent", std::vector<double>{2, 0.5}}, {"amplitude", 0.1}};
        CHECK(record_text(facts).empty());
        const RunRecord run({"normal-map",
                             {{"input", std::string("br\xc3\xbc"
                                                    "cke\n.png")}}});
        const std::string text = record_text(facts);
        for (const char c : text) REQUIRE((c >= 0x20 && c < 0x7f));
        CHECK(valid_record(text) == text);
        CHECK(text.find("\"verb\":\"normal-map\"") != text.npos);
        CHECK(text.find("br\\u00fccke\\n.png") != text.npos);
        {
            const RunRecord inner({"surface", {}});
            CHECK(record_text({}).find("surface") != text.npos);
        }
        CHECK(record_text(facts) == text);
    }

    TEST_CASE("record_word, record_numbers: what the values of a record say, of the kind that is asked for") {
        const RunRecord run({"normal-map", {}});
        const std::string text =
            record_text({{"green", std::string("up")}, {"extent", std::vector<double>{2, 0.5}}, {"amplitude", 0.1}});
        CHECK(record_word(text, "green") == "up");
        CHECK(record_word(text, "extent").empty());
        CHECK(record_word(text, "absent").empty());
        CHECK(record_numbers(text, "extent") == std::vector<double>{2, 0.5});
        CHECK(record_numbers(text, "amplitude") == std::vector<double>{0.1});
        CHECK(record_numbers(text, "green").empty());
        CHECK(record_word("", "green").empty());
        CHECK(record_numbers(R"({"software":"x","values":{"a":[1,"b"]}})", "a").empty());
        CHECK(record_word(R"({"software":"x","values":3})", "a").empty());
    }

    TEST_CASE("record_in: a comment that holds a record, and no other text, however deep") {
        const RunRecord run({"displace", {}});
        CHECK(record_in(record_comment({})) == record_text({}));
        for (const char* other : {"", "bake", "bake 0.1.0", "bake {", "bake {}", "bake {\"software\":1}", "Blender 3.4",
                                  "baked {\"software\":\"bake\"}"})
            CHECK(record_in(other).empty());
        const std::string deep =
            "{\"software\":\"bake\",\"a\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
        CHECK(valid_record(deep).empty());
        CHECK(!valid_record(R"({"software":"bake","a":[[[1]]]})").empty());
    }
}
