#include "bake/base/shared_loads.h"
#include "cli/command.h"

using namespace bake;
using bake::test::Folder, bake::test::write_file;

namespace {

/// Files of texts, and how often each was read.
struct Texts {
    Folder folder;
    std::string a = folder / "a", b = folder / "b", other = folder / "other";
    int reads = 0;

    Texts() {
        for (const std::string& path : {a, b, other}) write_file(path, path);
    }
    std::string load(const std::string& path, const std::string& how = "text", std::size_t bytes = 10) {
        return shared_load<std::string>(
            path, how,
            [&] {
                ++reads;
                return how + test::contents(path);
            },
            [](const std::string& text) { return text; }, [&](const std::string&) { return bytes; });
    }
};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("shared_load: reads a file once, as long as it is the same") {
        Texts texts;
        texts.load(texts.a);
        texts.load(texts.a);
        CHECK(texts.reads == 2); // nothing is kept
        const SharedLoads loads({texts.a, texts.b}, 100);
        for (int i = 0; i < 3; ++i) CHECK(texts.load(texts.a) == "text" + texts.a);
        CHECK(texts.reads == 3);
        CHECK(texts.load(texts.a, "upside down") == "upside down" + texts.a);
        CHECK(texts.load(texts.a) == "text" + texts.a);
        CHECK(texts.reads == 4);
        write_file(texts.a, "changed");
        CHECK(texts.load(texts.a) == "textchanged");
        texts.load(texts.other);
        texts.load(texts.other);
        CHECK(texts.reads == 7); // it is not one of the files
    }

    TEST_CASE("shared_load: a job reads the file in any case") {
        Texts texts;
        const SharedLoads loads({texts.a}, 100);
        texts.load(texts.a);
        const InputRecord inputs;
        texts.load(texts.a);
        CHECK(texts.reads == 1);
        REQUIRE(files_read().size() == 1);
        CHECK(files_read()[0].path == texts.a);
    }

    TEST_CASE("SharedLoads: keeps what was used last, within its bytes, and nothing in a pause") {
        Texts texts;
        SharedLoads loads({texts.a, texts.b}, 25);
        texts.load(texts.a);
        texts.load(texts.b);
        texts.load(texts.a);
        texts.load(texts.a, "again"); // puts out b
        CHECK(texts.reads == 3);
        texts.load(texts.a);
        CHECK(texts.reads == 3);
        texts.load(texts.b);
        CHECK(texts.reads == 4);
        texts.load(texts.a, "large", 26);
        texts.load(texts.a, "large", 26);
        CHECK(texts.reads == 6);
        {
            const SharedLoads::Pause pause(loads);
            texts.load(texts.b);
            texts.load(texts.b);
            CHECK(texts.reads == 8);
        }
        texts.load(texts.b);
        texts.load(texts.b);
        CHECK(texts.reads == 9);
    }
}
