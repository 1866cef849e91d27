// Manual pages and completions, which are made from the options.
#include "cli/command.h"
#include <regex>
#include <sstream>

using namespace bake::test;

namespace {

std::string out(const std::vector<std::string>& arguments) {
    const Folder folder;
    const Run run = run_bake(folder, arguments);
    CHECK(run.code == 0);
    CHECK(run.err == "");
    return run.out;
}

/// The long options of a verb, as its help lists them.
std::set<std::string> long_options(const std::string& verb) {
    std::set<std::string> names;
    std::istringstream in(out({verb, "--help"}));
    const std::regex option("^  (-., ?)?(--[a-z][a-z0-9-]*).*");
    std::smatch found;
    for (std::string line; std::getline(in, line) && line != "Examples:";)
        if (std::regex_match(line, found, option)) names.insert(found[2]);
    return names;
}

bool has_program(const std::string& name) { return std::system(("command -v " + name + " >/dev/null").c_str()) == 0; }

/// What a shell prints that runs the script.
std::string shell(const std::string& program, const std::string& script) {
    const Folder folder;
    write_file(folder / "script", script);
    CHECK(std::system((program + " '" + folder / "script" + "' >'" + folder / "out" + "' 2>&1").c_str()) == 0);
    return contents(folder / "out");
}

/// The words that bash offers for the last of `words`.
std::string bash_offers(const std::string& words, int count) {
    return shell("bash", out({"completion", "bash"}) + "\nCOMP_WORDS=(" + words +
                             ")\nCOMP_CWORD=" + std::to_string(count - 1) + "\n_bake\necho \"${COMPREPLY[*]}\"\n");
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("pages: the manual page of each verb has all its options, and that of bake all verbs") {
        const std::string general = out({"help", "--man"});
        CHECK(general.starts_with(".TH BAKE 1 "));
        for (const std::string& verb : verbs()) {
            CAPTURE(verb);
            const std::string page = out({"help", "--man", verb});
            std::string name = "bake-" + verb;
            for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) name.insert(at, "\\");
            CHECK(general.find("\\fB" + name + "\\fR(1)") != std::string::npos);
            CHECK(page.find(".SH NAME\n" + name + " \\- ") != std::string::npos);
            CHECK(page.find(".SH EXAMPLES") != std::string::npos);
            const std::set<std::string> options = long_options(verb);
            CHECK(options.size() >= 5);
            for (std::string option : options) {
                for (std::size_t at = 0; (at = option.find('-', at)) != std::string::npos; at += 2)
                    option.insert(at, "\\");
                CHECK_MESSAGE(page.find("\\fB" + option + "\\fR") != std::string::npos, option);
            }
        }
    }

    TEST_CASE("pages: man formats every page without a warning" * doctest::skip(!has_program("man"))) {
        std::vector<std::vector<std::string>> pages = {{"help", "--man"}};
        for (const std::string& verb : verbs()) pages.push_back({"help", "--man", verb});
        for (const std::vector<std::string>& page : pages) {
            CAPTURE(page.back());
            const Folder folder;
            write_file(folder / "page.1", out(page));
            const std::string command = "MANWIDTH=80 man --warnings -E UTF-8 -l '" + folder / "page.1" + "' >'" +
                                        folder / "text" + "' 2>'" + folder / "warnings" + "'";
            CHECK(std::system(command.c_str()) == 0);
            CHECK(contents(folder / "warnings") == "");
            CHECK(contents(folder / "text").find("EXIT STATUS") != std::string::npos);
        }
    }

    TEST_CASE("pages: bash completes verbs, options and words, and leaves files to itself") {
        CHECK(bash_offers("bake norm", 2) == "normal-map\n");
        CHECK(bash_offers("bake help bump", 3) == "bump-table\n");
        CHECK(bash_offers("bake normal-map a.png --dire", 4) == "--directx\n");
        CHECK(bash_offers("bake normal-map --method ex", 4) == "exact\n");
        CHECK(bash_offers("bake normal-map --method = ex", 5) == "exact\n");
        CHECK(bash_offers("bake normal-map --height m", 4) == "\n");
        const std::string script = out({"completion", "bash"});
        for (const std::string& verb : verbs())
            for (const std::string& option : long_options(verb))
                CHECK_MESSAGE(script.find(option) != std::string::npos, option);
    }

    TEST_CASE("pages: zsh completes options" * doctest::skip(!has_program("zsh"))) {
        // Without the completion system: what _arguments is given is looked at.
        const std::string offers =
            shell("zsh -f", "_arguments() { print -rl -- \"$@\" }\n_describe() { print -rl -- $verbs }\ncompdef() { }\n"
                            "words=(bake normal-map --met) CURRENT=3\n" +
                                out({"completion", "zsh"}));
        CHECK(offers.find("(--method)--method[Terms") != std::string::npos);
        CHECK(offers.find(":(exact blinn surface-gradient constant-scale)") != std::string::npos);
    }

    TEST_CASE("pages: fish completes options and words" * doctest::skip(!has_program("fish"))) {
        const std::string script = out({"completion", "fish"});
        CHECK(shell("fish --no-config", script + "\ncomplete -C 'bake norm'\n").starts_with("normal-map\t"));
        CHECK(
            shell("fish --no-config", script + "\ncomplete -C 'bake normal-map --dire'\n").starts_with("--directx\t"));
        CHECK(shell("fish --no-config", script + "\ncomplete -C 'bake normal-map --method ex'\n").starts_with("exact"));
    }

    TEST_CASE("pages: another shell is a usage error") {
        check_refused(Folder(), {"completion", "ksh"}, 2, "bash, zsh and fish");
    }

} // TEST_SUITE
