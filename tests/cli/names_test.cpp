// Names of files, and names in files, that hold what a terminal would obey.
#include "cli/command.h"
#include <algorithm>
#include <nlohmann/json.hpp>

using namespace bake::test;

namespace {

const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();

/// An escape sequence, a newline that forges a line, a control character in two bytes, and a byte that is not UTF-8.
const std::string hostile = "a\x1b[2J\nbake: all is well\xc2\x9b"
                            "c\xff";
const std::string shown = "a\\x1b[2J\\nbake: all is well\\xc2\\x9bc\\xff";

bool is_clean(const std::string& text) {
    for (const char c : text)
        if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f) return false;
    return text.find("\xc2\x9b") == std::string::npos && text.find('\xff') == std::string::npos;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("names: every verb prints hostile names of its files escaped, and JSON stays JSON") {
        const Folder folder;
        const std::string png = hostile + ".png", obj = hostile + ".obj", toml = hostile + ".toml";
        fs::copy_file(dots, folder / png);
        fs::copy_file(torus, folder / obj);
        write_file(folder / toml, "mesh = [{file = \"" + torus + "\"}]\n");
        const std::string relief = hostile + "_relief.toml"; // whose object has such a name too
        write_file(folder / relief, "material = [{name = \"a\", height = \"" + dots +
                                        "\"}]\nmesh = [{name = " + "\"a\\u001b[2J\\nbake: all is well\", file = \"" +
                                        torus + "\", material = \"a\"}]\n");
        const std::string out_png = hostile + "_out.png", out_ply = hostile + "_out.ply";
        const std::string bakes = hostile + "_bakes.toml";
        write_file(folder / bakes, "manifest = 1\n[[bake]]\nname = \"a\\u001b[2J\\nbake: all is well\"\nverb = "
                                   "\"bump-table\"\nfiles = [\"" +
                                       dots + "\"]\noutputs = {out = \"a\\u001b.exr\"}\n");
        const std::vector<std::vector<std::string>> lines = {
            {"batch", bakes},
            {"check", png, obj},
            {"check", obj, "--against", obj},
            {"check", obj, "--height", png},
            {"compare", png, png},
            {"plan", relief, "--size", "8", "-o", hostile + "_out.toml"},
            {"normal-map", obj, "--height", png, "--amplitude", "200%", "--size", "32", "-o", out_png},
            {"bump-table", png, "-o", out_png},
            {"explain", obj, "--height", png, "--uv", "0.5,0.5"},
            {"displace", obj, "--height", png, "-o", out_ply},
            {"surface", obj, "-o", out_ply, "--maps", "normal", "--maps-out", hostile, "--size", "16"},
            {"cubemap", "labels", "--size", "8", "-o", out_png},
            {"render", toml, "-o", out_png, "--size", "8", "--spp", "1"}};
        for (const std::string& verb : verbs())
            CHECK_MESSAGE(std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line[0] == verb; }),
                          "add a command line of " << verb << " to this test");
        for (std::vector<std::string> line : lines) {
            CAPTURE(line[0]);
            const Run text = run_bake(folder, line);
            CHECK(text.code == 0);
            CHECK(is_clean(text.out));
            CHECK(is_clean(text.err));
            CHECK((text.out + text.err).find(shown) != std::string::npos);
            CHECK((text.out + text.err).find("\nbake: all is well") == std::string::npos);
            line.push_back("--json");
            const Run json = run_bake(folder, line);
            CHECK(json.code == 0);
            CHECK(is_clean(json.out));
            CHECK(nlohmann::json::parse(json.out).is_object());
        }
    }

    TEST_CASE("names: refusals are one line, whatever they name") {
        const Folder folder;
        write_file(folder / hostile, "");
        write_file(folder / (hostile + ".obj"), "v 0 0 0\nusemtl " + hostile.substr(0, 6) + "\nf 1 2 \x1b[2J\n");
        write_file(folder / (hostile + ".png"), "x");
        write_file(folder / "keys.toml", "\"k\\u001b\\nbake: fine\" = 1\n");
        write_file(folder / "files.toml", "mesh = [{file = \"m\\u001b\\nbake: fine.obj\"}]\n");
        write_file(folder / "name.gltf", "{\"asset\":{\"version\":\"2\\u001b\\nbake: fine\"}}");
        for (const std::vector<std::string>& line : {std::vector<std::string>{hostile},
                                                     {"check", hostile + ".obj"},
                                                     {"check", hostile + ".png"},
                                                     {"check", hostile + "/none.ply"},
                                                     {"check", dots, "--" + hostile},
                                                     {"check", dots, "--uv-set", hostile},
                                                     {"check", "name.gltf"},
                                                     {"surface", "--shape", hostile, "-o", "a.ply"},
                                                     {"bump-table", dots, "--filter", hostile, "-o", "a.exr"},
                                                     {"bump-table", dots, "-o", hostile + "/a.exr"},
                                                     {"bump-table", dots, "-o", hostile},
                                                     {"cubemap", hostile + "%s", "-o", "a.exr"},
                                                     {"render", "keys.toml", "-o", "a.png"},
                                                     {"render", "files.toml", "-o", "a.png"}}) {
            CAPTURE(line[0]);
            CAPTURE(line.size());
            const Run run = run_bake(folder, line);
            CAPTURE(run.err);
            CHECK((run.code >= 2 && run.code <= 5));
            CHECK(run.out == "");
            CHECK(lines(run.err) == 1);
            CHECK(is_clean(run.err));
            CHECK(run.err.find("\\") != std::string::npos);
        }
    }

} // TEST_SUITE
