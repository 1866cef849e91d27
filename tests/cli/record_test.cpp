// What the command's files say of how they were made, and who reads it.
#include "bake/base/provenance.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/bump_table.h"
#include "cli/command.h"
#include "folders.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

using Json = nlohmann::json;

void write_height(const std::string& file) {
    Image<float> height(16, 8, 1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) height.at(x, y) = float(0.5 + 0.25 * std::sin(x * 0.39) * std::cos(y * 0.78));
    write_image(file, height, {.depth = Depth::u16});
}

void write_quad(const std::string& file) {
    write_file(file, "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("record: every kind of file says verb, options, inputs and meaning, and check reads it back") {
        const Folder folder;
        write_height(folder / "h.png");
        write_quad(folder / "q.obj");
        const std::vector<std::vector<std::string>> runs = {
            {"normal-map", "h.png", "-o", "n.png", "--directx", "--amplitude", "0.125"},
            {"normal-map", "h.png", "-o", "n.exr"},
            {"normal-map", "h.png", "-o", "n.tif"},
            {"bump-table", "h.png", "-o", "b.png"},
            {"bump-table", "h.png", "-o", "b.exr", "--layout", "bumpslopes"},
            {"bump-table", "h.png", "-o", "c.tif", "--layout", "bumpslopes"},
            {"displace", "q.obj", "--height", "h.png", "-o", "d.ply"},
            {"surface", "q.obj", "-o", "s.glb"},
            {"displace", "q.obj", "--height", "h.png", "-o", "e.obj"},
            {"render", "q.obj", "-o", "r.png", "--size", "16", "--spp", "1"},
            {"cubemap", "labels", "--size", "16", "-o", "sky.exr"},
            {"normal-map", "q.obj", "--height", "h.png", "-o", "a.usda"},
            {"normal-map", "q.obj", "--height", "h.png", "-o", "a.mtlx"},
        };
        for (const auto& words : runs) {
            const std::string& file =
                words[std::size_t(std::find(words.begin(), words.end(), "-o") - words.begin()) + 1];
            CAPTURE(file);
            const Run run = run_bake(folder, words);
            REQUIRE_MESSAGE(run.code == 0, run.err);
            const Run check = run_bake(folder, {"check", "--json", file});
            REQUIRE_MESSAGE(check.code == 0, check.err);
            const Json record = Json::parse(check.out)["files"][0]["record"];
            REQUIRE(record.is_object());
            CHECK(record["software"] == "bake");
            CHECK(record["verb"] == words[0]);
            CHECK(record["values"].contains("content"));
            CHECK(!record["options"].contains("out"));
            if (words[1] != "labels") {
                REQUIRE(record["inputs"].size() >= 1);
                CHECK(record["inputs"][0]["name"] == (words[2] == "--height" ? "h.png" : words[1]));
                CHECK(record["inputs"][0]["xxh128"].get<std::string>().size() == 32);
            }
            const Run text = run_bake(folder, {"check", file});
            CHECK(text.out.find("made by") != text.out.npos);
        }
        const Json normal = Json::parse(read_image_info(folder / "n.png").record);
        CHECK(normal["values"]["green"] == "down");
        CHECK(normal["values"]["amplitude"] == 0.125);
        CHECK(normal["options"]["amplitude"] == "0.125");
        CHECK(normal["options"]["filter"] == "auto");
    }

    TEST_CASE("record: other folders and thread counts give the same bytes, other inputs do not") {
        const Folder folder;
        write_height(folder / "h.png");
        fs::create_directory(folder.path / "other");
        fs::copy_file(folder / "h.png", folder / "other/h.png");
        for (const char* ending : {"png", "exr", "tif"}) {
            const std::string name = std::string("n.") + ending;
            REQUIRE(run_bake(folder, {"normal-map", "h.png", "-o", name, "--threads", "1"}).code == 0);
            REQUIRE(run_bake(folder, {"normal-map", "other/h.png", "-o", "other/x." + std::string(ending), "--threads",
                                      "2", "--quiet"})
                        .code == 0);
            CHECK(contents(folder / name) == contents(folder / ("other/x." + std::string(ending))));
        }
        const std::string before = contents(folder / "n.png");
        fs::rename(folder / "h.png", folder / "g.png");
        REQUIRE(run_bake(folder, {"normal-map", "g.png", "-o", "n.png"}).code == 0);
        CHECK(contents(folder / "n.png") != before);
    }

    TEST_CASE("record: a bump table is rendered in the units that its file names") {
        const Folder folder;
        write_height(folder / "h.png");
        const auto render = [&](const std::vector<std::string>& units, const std::string& ending) {
            std::vector<std::string> words = {"bump-table", "h.png", "-o", "b." + ending, "--amplitude", "0.2"};
            if (ending != "png") words.insert(words.end(), {"--depth", "float"});
            words.insert(words.end(), units.begin(), units.end());
            REQUIRE(run_bake(folder, words).code == 0);
            const Run run = run_bake(folder, {"render", "b." + ending, "--as", "bump", "--on", "plane", "-o", "r.exr",
                                              "--size", "24", "--spp", "1", "--depth", "float"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            return read_image(folder / "r.exr");
        };
        const Image<float> plain = render({"--units", "uv"}, "exr");
        for (const std::vector<std::string>& units :
             std::vector<std::vector<std::string>>{{"--units", "texel"},
                                                   {"--units", "difference"},
                                                   {"--units", "world"},
                                                   {"--units", "world", "--extent", "3,0.5"}})
            for (const char* ending : {"exr", "tif", "png"}) {
                CAPTURE(units.back());
                CAPTURE(ending);
                const Image<float> other = render(units, ending);
                REQUIRE(other.size() == plain.size());
                const float bound = ending == std::string("png") ? 2e-3f : 2e-5f; // 16 bits, and floats
                float most = 0;
                for (std::size_t i = 0; i < plain.size(); ++i)
                    most = std::max(most, std::abs(other.data()[i] - plain.data()[i]));
                CHECK(most <= bound);
            }
    }

    TEST_CASE("record: a normal map that is read with the other green is told") {
        const Folder folder;
        write_height(folder / "h.png");
        write_quad(folder / "q.obj");
        REQUIRE(run_bake(folder, {"normal-map", "h.png", "-o", "n.png", "--directx"}).code == 0);
        const auto notes = [&](const std::string& directx) {
            write_file(folder / "s.toml", "[[material]]\nname = \"m\"\nnormal = \"n.png\"\ndirectx = " + directx +
                                              "\n[[mesh]]\nfile = \"q.obj\"\nmaterial = \"m\"\n");
            const Run run = run_bake(folder, {"render", "s.toml", "-o", "r.png", "--size", "8", "--spp", "1"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            return run.err;
        };
        CHECK(notes("false").find("its record says that green points down") != std::string::npos);
        CHECK(notes("true").find("record") == std::string::npos);
    }
}
