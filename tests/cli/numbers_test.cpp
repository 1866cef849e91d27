// Numbers of the command line are finite and decimal, whichever option they belong to.
#include "cli/command.h"
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

using namespace bake::test;

namespace {

const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string(),
                  scene = (own_meshes() / "scene.toml").string(),
                  relief_scene = (own_meshes() / "torus_methods.toml").string();

struct Option {
    std::string flag, type; ///< as --help shows them; no type: a flag
};

/// The options that a verb's help lists.
std::vector<Option> options_of(const std::string& verb) {
    const Folder folder;
    std::istringstream help(run_bake(folder, {verb, "--help"}).out);
    std::vector<Option> options;
    for (std::string line; std::getline(help, line);) {
        if (!line.starts_with("  -")) continue;
        const std::size_t end = line.find(' ', 2);
        Option option{line.substr(2, end - 2), ""};
        option.flag = option.flag.substr(option.flag.find("--"));
        // One space parts the type from the names, and at least two the description from both.
        if (end != std::string::npos && end + 1 < line.size() && line[end + 1] != ' ') {
            option.type = line.substr(end + 1, line.find(' ', end + 1) - end - 1);
            option.type = option.type.substr(0, option.type.find('='));
        }
        options.push_back(option);
    }
    return options;
}

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// What stands in the place of a number of this type of option; empty for an option without a number.
std::vector<std::string> not_numbers(const std::string& type) {
    std::vector<std::string> values = {"nan", "inf", "-inf", "1e999", "0x10", "1,5", ""};
    const auto fill = [&](const std::string& before, const std::string& behind) {
        for (std::string& value : values) value = before + value + behind;
        values.insert(values.end(), {"nan", ""});
    };
    if (is_one_of(
            type,
            {"",         "TEXT",         "Excludes:",  "Needs:",       "MESH",      "PREFIX",        "NAMES",
             "HEIGHT",   "CAMERA",       "NAME",       "KEY",          "NAME[:KEY", "DISPLACED.glb", "HOST[:PORT]",
             "OUT.html", "PLANNED.toml", "BAKES.toml", "NAME,...|all", "HIGH.ply",  "LIST",          "NORMAL",
             "OUT.glb",  "OUT.png",      "OUT.ply",    "NORMAL.png"}))
        return {};
    if (is_one_of(type, {"W,H", "U,V", "X,Y"})) fill("1,", "");
    else if (type == "X,Y,Z") fill("1,2,", "");
    else if (type == "X,Y,W,H") fill("0,0,4,", "");
    else if (type == "A,B,...") {
        fill("0.5,", "");
        std::erase(values, "0.5,1,5"); // three numbers
    } else if (type == "METRIC") fill("flip=", "");
    else if (type == "sh:N|direct") fill("sh:", "");
    else if (type == "strict|normal|loose|rmse") {
        fill("rmse=", "");
        std::erase(values, "rmse=inf"); // a budget without bound
    } else if (type == "triangles") fill("bytes=", "");
    else if (is_one_of(type, {"N|WxH", "NxM|N"})) values.insert(values.end(), {"1xnan", "1x"});
    else if (type == "N|U,V") {
        fill("1,", "");
        std::erase(values, "1,1,5"); // three numbers
    } else if (type == "LENGTH|N%") values.insert(values.end(), {"nan%", "%"});
    else if (type.find('|') != std::string::npos) return {}; // one of a few names
    else
        CHECK_MESSAGE(is_one_of(type, {"N", "P", "NUMBER", "SIZE"}),
                      "unknown type " << type << ": add it to this test");
    return values;
}

/// A command line of the verb that lacks nothing.
std::vector<std::string> complete(const std::string& verb, const std::string& flag) {
    const std::map<std::string, std::vector<std::string>> lines = {
        {"batch", {(own_meshes() / "bakes.toml").string()}},
        {"check", {torus, "--against", torus}},
        {"compare", {dots, dots}},
        {"plan", {(own_meshes() / "studs.toml").string()}},
        {"bump-table", {dots, "-o", "a.exr"}},
        {"normal-map", {torus, "--height", dots, "-o", "a.png"}},
        {"explain", {torus, "--height", dots}},
        {"displace", {torus, "--height", dots, "-o", "a.ply"}},
        {"surface", {torus, "-o", "a.ply"}},
        {"render", {scene, "-o", "a.png"}},
        {"cubemap", flag == "--at" ? std::vector<std::string>{"--capture", scene, "-o", "a.exr"}
                                   : std::vector<std::string>{"labels", "-o", "a.exr"}}};
    REQUIRE_MESSAGE(lines.contains(verb), "add a command line of " << verb << " to this test");
    std::vector<std::string> line = lines.at(verb);
    line.insert(line.begin(), verb);
    // Options of `compare` for a scene.
    if (verb == "compare" && is_one_of(flag, {"--spp", "--size", "--repeats", "--object", "--methods", "--reference",
                                              "--camera", "--csv", "--no-causes", "--report"}))
        line = {verb, relief_scene};
    if (flag == "--roughness" && verb == "cubemap") line.insert(line.end(), {"--specular", "ggx"});
    return line;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("numbers: every option of every verb refuses what is no finite decimal number, by its name") {
        const Folder folder;
        int with_numbers = 0;
        std::set<std::string> known; // options that several verbs have get all values once, and then one
        for (const std::string& verb : verbs())
            for (const Option& option : options_of(verb)) {
                CAPTURE(option.flag);
                std::vector<std::string> values = not_numbers(option.type);
                with_numbers += !values.empty();
                if (!known.insert(option.flag + option.type).second && !values.empty()) values.resize(1);
                for (const std::string& value : values) {
                    std::vector<std::string> line = complete(verb, option.flag);
                    line.push_back(option.flag + "=" + value);
                    check_refused(folder, line, 2, option.flag);
                }
            }
        CHECK(with_numbers >= 48);
    }

    TEST_CASE("numbers: those within a camera, a shape and a material too") {
        const Folder folder;
        for (const char* bad : {"nan", "inf", "1e999", "0x10", ""})
            for (const char* key :
                 {"position=0,0,", "position=0,1,5:target=", "position=0,1,5:fov-deg=", "position=0,1,5:height="})
                check_refused(folder,
                              {"displace", torus, "--height", dots, "-o", "a.ply", "--edge-px", "1", "--camera",
                               std::string(key) + bad},
                              2, "--camera");
        for (const char* bad : {"nan", "inf", "-inf", "1e999", "0x10", ""})
            check_refused(folder, {"surface", "--shape", std::string("torus:R=") + bad, "-o", "a.ply"}, 2, "R ");
        for (const char* bad :
             {"nan", "inf", "-inf", "1e999", "0x10", "", "-1", "1:2", "1:2:nan", "#12345", "#1234567"})
            for (const char* key : {"diffuse=", "shininess=1,reflect="})
                check_refused(folder, {"render", torus, "-o", "a.png", "--material", std::string(key) + bad}, 2,
                              "--material");
    }

    TEST_CASE("numbers: a pair out of range is said to be that") {
        const Folder folder;
        for (const char* pair : {"1,99999999999999999999", "0,1", "-1,2"})
            check_refused(folder, {"normal-map", dots, "--extent", pair, "-o", "n.png"}, 2, ": is out of range;");
        check_refused(folder, {"normal-map", dots, "--extent", "1;2", "-o", "n.png"}, 2, ": is not a pair;");
    }

    TEST_CASE("numbers: an empty argument is a usage error everywhere, wherever it stands") {
        const Folder folder;
        for (const std::string& verb : verbs()) {
            check_refused(folder, {verb, ""}, 2, "argument 2: is empty", {.seconds = 5});
            std::vector<std::string> line = complete(verb, "");
            line.push_back("");
            check_refused(folder, line, 2, ": is empty");
            // One way to be empty after the other, as all options go through the same few lines.
            int turn = 0;
            for (const Option& option : options_of(verb)) {
                if (option.type.empty() || turn > 9) continue;
                const std::vector<std::string> ways[] = {
                    {option.flag, ""}, {option.flag + "="}, {option.flag + "=", dots}};
                line = complete(verb, option.flag);
                line.insert(line.end(), ways[turn % 3].begin(), ways[turn % 3].end());
                check_refused(folder, line, 2, option.flag + ": is empty");
                ++turn;
            }
        }
        check_refused(folder, {"check", torus, "--against", ""}, 2, "--against: is empty");
        check_refused(folder, {"help", ""}, 2, "is empty");
    }

} // TEST_SUITE
