#include "bake/base/error.h"
#include "bake/batch/emit.h"
#include "bake/batch/pattern.h"
#include "bake/batch/task.h"
#include "cli/command.h"

using namespace bake;
using bake::test::Folder, bake::test::write_file;

namespace {

/// The tasks of a manifest that stands in `folder`, which is the working directory meanwhile.
std::vector<BatchTask> tasks_in(const Folder& folder, const std::string& bakes) {
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path);
    struct Back {
        std::filesystem::path to;
        ~Back() { std::filesystem::current_path(to); }
    } const back{before};
    return batch_tasks(parse_manifest("manifest = 1\n" + bakes, "a.toml"), "a.toml");
}

std::string refusal_in(const Folder& folder, const std::string& bakes) {
    try {
        tasks_in(folder, bakes);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

constexpr const char* by_pattern = "[[bake]]\nname = \"n_{stem}\"\nverb = \"normal-map\"\nfiles = [\"*.png\"]\n"
                                   "options = {note = \"of {stem}\"}\noutputs = {out = \"out/{stem}_n.png\"}\n";

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("matches: * and ? stand for all but /, and a dot at the beginning for itself alone") {
        CHECK(matches("a/*.png", "a/b.png"));
        CHECK(matches("a/?.p*g", "a/b.png"));
        CHECK(matches("*", ""));
        CHECK(!matches("a/*.png", "a/b/c.png"));
        CHECK(!matches("?.png", ".png"));
        CHECK(!matches("*.png", ".b.png"));
        CHECK(matches(".*", ".b"));
        CHECK(!matches("a*b", "ac"));
        CHECK(stem_of("a/b.c.png") == "b.c");
    }

    TEST_CASE("batch_tasks: a pattern is a task for each file, and {stem} its name") {
        const Folder folder;
        for (const char* name : {"b.png", "a.png", "c.jpg"}) write_file(folder / name, "x");
        const auto tasks = tasks_in(folder, by_pattern);
        REQUIRE(tasks.size() == 2);
        CHECK(tasks[0].name == "n_a");
        CHECK(tasks[0].words == std::vector<std::string>{"normal-map", "a.png", "--note=of a", "--out=out/a_n.png"});
        CHECK(tasks[1].inputs == std::vector<std::string>{"b.png"});
        CHECK(tasks[1].outputs == std::vector<std::string>{"out/b_n.png"});
    }

    TEST_CASE("batch_tasks: a file may have a dash before its name, and braces in it") {
        const Folder folder;
        for (const char* name : {"-a.png", "100% {x}.png"}) write_file(folder / name, "x");
        const auto tasks = tasks_in(folder, by_pattern);
        REQUIRE(tasks.size() == 2);
        CHECK(tasks[0].words[1] == "./-a.png");
        CHECK(tasks[0].inputs[0] == "-a.png");
        CHECK(tasks[1].outputs[0] == "out/100% {x}_n.png");
        CHECK(refusal_in(folder, "[[bake]]\nname = \"a\"\nverb = \"check\"\noutputs = {out = \"{x}.png\"}\n") != "");
    }

    TEST_CASE("batch_tasks: outputs of bakes before are files of a pattern, and needed") {
        const Folder folder;
        write_file(folder / "a.png", "x");
        const auto tasks =
            tasks_in(folder, std::string(by_pattern) + "[[bake]]\nname = \"check\"\nverb = \"check\"\nfiles = "
                                                       "[\"out/*_n.png\"]\noutputs = {out = \"{stem}.txt\"}\n");
        REQUIRE(tasks.size() == 2);
        CHECK(tasks[1].name == "check:a_n");
        CHECK(tasks[1].inputs == std::vector<std::string>{"out/a_n.png"});
        CHECK(tasks[1].needs == std::vector<std::uint32_t>{0});
    }

    TEST_CASE("batch_tasks: a tile is a task") {
        const Folder folder;
        const auto tasks = tasks_in(folder, "[[bake]]\nname = \"n\"\nverb = \"normal-map\"\nfiles = [\"a.obj\"]\n"
                                            "tiles = [1001, 1012]\noutputs = {out = \"n.<UDIM>.png\"}\n");
        REQUIRE(tasks.size() == 2);
        CHECK(tasks[1].name == "n:1012");
        CHECK(tasks[1].words == std::vector<std::string>{"normal-map", "a.obj", "--tile=1012", "--out=n.1012.png"});
    }

    TEST_CASE("batch_tasks: tasks stand behind those that write their inputs, whatever the order of the file") {
        const Folder folder;
        const auto bake = [](const std::string& name, const std::string& in, const std::string& out) {
            return "[[bake]]\nname = \"" + name + "\"\nverb = \"check\"\nfiles = [\"" + in +
                   "\"]\noutputs = {out = \"" + out + "\"}\n";
        };
        const auto tasks =
            tasks_in(folder, bake("late", "b", "c") + bake("early", "a", "./b") + bake("other", "a", "d"));
        REQUIRE(tasks.size() == 3);
        CHECK(tasks[0].name == "early");
        CHECK(tasks[1].name == "late");
        CHECK(tasks[1].needs == std::vector<std::uint32_t>{0});
        CHECK(refusal_in(folder, bake("one", "b", "a") + bake("two", "a", "b")).find("needs another one of them") !=
              std::string::npos);
        CHECK(refusal_in(folder, bake("one", "a", "x/../b") + bake("two", "a", "b"))
                  .find("is an output of \"one\" and") != std::string::npos);
    }

    TEST_CASE("batch_tasks: refuses what has no meaning") {
        const Folder folder;
        CHECK(refusal_in(folder, by_pattern).find("there is no file \"*.png\"") != std::string::npos);
        CHECK(refusal_in(folder, "[[bake]]\nname = \"a\"\nverb = \"check\"\noutputs = {out = \"{stem}.png\"}\n")
                  .find("{stem} needs an input") != std::string::npos);
        CHECK(refusal_in(folder, "[[bake]]\nnaem = \"a\"\n").find("did you mean \"name\"?") != std::string::npos);
    }

    TEST_CASE("with_needs: the tasks of a pattern, and what they need") {
        const Folder folder;
        const std::string rest = "\nverb = \"check\"\n";
        const auto tasks =
            tasks_in(folder, "[[bake]]\nname = \"x\"" + rest + "outputs = {out = \"x\"}\n[[bake]]\nname = \"a\"" +
                                 rest + "outputs = {out = \"a\"}\n[[bake]]\nname = \"b\"" + rest +
                                 "files = [\"a\"]\noutputs = {out = \"b\"}\n");
        const auto part = with_needs(tasks, "b*", "a.toml");
        REQUIRE(part.size() == 2);
        CHECK(part[0].name == "a");
        CHECK(part[1].needs == std::vector<std::uint32_t>{0});
        CHECK_THROWS_AS(with_needs(tasks, "c", "a.toml"), Error);
    }

    TEST_CASE("shell_word: what a shell would take apart is in quotes") {
        CHECK(shell_word("--out=a/b_1.png") == "--out=a/b_1.png");
        CHECK(shell_word("a b") == "'a b'");
        CHECK(shell_word("it's") == "'it'\\''s'");
    }
}
