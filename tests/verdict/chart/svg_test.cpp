#include "bake/verdict/chart/svg.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("svg: text is escaped; control characters and bytes that are not UTF-8 become printable") {
        CHECK(xml_text("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
        CHECK(xml_text("1\xC2\xB0 \xE2\x89\xA4 2") == "1\xC2\xB0 \xE2\x89\xA4 2");
        CHECK(xml_text("a\nb\x01") == "a\\nb\\x01");
        CHECK(xml_text("\xFF") == "\\xff");
        CHECK(xml_text("a\xEF\xBF\xBE\xEF\xBF\xBF") == "a??");
    }

    TEST_CASE("svg: lengths have two decimals at most") {
        CHECK(px(0) == "0");
        CHECK(px(-0.001) == "0");
        CHECK(px(-2) == "-2");
        CHECK(px(100) == "100");
        CHECK(px(12.5) == "12.5");
        CHECK(px(1.0 / 3) == "0.33");
    }

    TEST_CASE("svg: a text that is too wide ends in an ellipsis and fits") {
        const std::string text = "displacement with 64 x 64 \xC3\xA9\xE6\xBC\xA2 and more";
        CHECK(fitted(text, 12, text_width(text, 12)) == text);
        for (double width = 12; width < text_width(text, 12); width += 3) {
            const std::string cut = fitted(text, 12, width);
            CHECK(text_width(cut, 12) <= width);
            CHECK(cut.size() >= 3);
            CHECK(cut.substr(cut.size() - 3) == "\xE2\x80\xA6");
            CHECK(text.compare(0, cut.size() - 3, cut.substr(0, cut.size() - 3)) == 0);
            CHECK(xml_text(cut) == cut); // no character is cut in two
        }
    }

    // Advances of DejaVu Sans, over 2048: the widest font that browsers take for sans-serif.
    TEST_CASE("svg: no letter is wider than is assumed") {
        const struct {
            const char* letters;
            double advance;
        } known[] = {{"0123456789", 1303}, {"abdpq", 1300}, {"e", 1260},  {"o", 1253}, {"m", 1995}, {"w", 1675},
                     {"W", 2025},          {"M", 1767},     {"OQ", 1612}, {"%", 1946}, {"@", 2048}, {"+=<>~^#", 1716},
                     {"il", 569},          {"I", 604},      {"HN", 1540}, {" ", 651},  {".,", 651}, {"-", 739},
                     {"r", 842},           {"t", 803},      {"_", 1024}};
        for (const auto& k : known)
            for (const char* c = k.letters; *c; ++c) CHECK(text_width(std::string(1, *c), 2048) >= k.advance);
    }
}
