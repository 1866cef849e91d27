#include "bake/base/error.h"
#include "bake/verdict/inspect.h"
#include "folders.h"
#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unistd.h>

using namespace bake;

namespace {

namespace fs = std::filesystem;

struct Folder {
    fs::path path = fs::temp_directory_path() / ("bake_inspect_" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
        return (path / name).string();
    }
};

bool says(const std::vector<std::string>& lines, const std::string& words) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("inspect_mesh: a plain quad has no warning, and each fault has one") {
        const Folder folder;
        const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
        const MeshReport good = inspect_mesh(folder.write("good.obj", square + "f 1/1 2/2 3/3 4/4\n"));
        CHECK(good.findings.warnings.empty());
        CHECK(says(good.findings.notes, "no normals"));
        const MeshReport bad = inspect_mesh(
            folder.write("bad.obj", square + "f 1/1 2/2 3/3 4/4\nf 1/1 2/2 3/3 4/4\nf 1/1 2/1 3/1\nf 1/1 1/2 2/3\n"));
        CHECK(says(bad.findings.warnings, "duplicate"));
        CHECK(says(bad.findings.warnings, "overlapping uvs: 100 %"));
        CHECK(says(bad.findings.warnings, "without uv area"));
        CHECK(says(bad.findings.warnings, "used twice"));
        CHECK(says(bad.findings.warnings, "1 zero-area face:"));
        CHECK(says(inspect_mesh(folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).findings.warnings,
                   "no uvs"));
    }

    TEST_CASE("inspect_image: 8-bit content, NaN and few levels are warnings; text and JSON agree") {
        const Folder folder;
        Image<float> ramp(256, 16, 1);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 256; ++x) ramp.at(x, y) = float(x) / 255;
        WriteOptions deep;
        deep.depth = Depth::u16;
        write_image((folder.path / "ramp.png").string(), ramp, deep);
        const ImageReport report = inspect_image((folder.path / "ramp.png").string());
        CHECK(says(report.findings.warnings, "16-bit file with 8-bit content"));
        CHECK(says(report.findings.notes, "does not tile in x:"));
        CHECK(to_text(report).find("true depth     8 bits") != std::string::npos);
        const auto json = nlohmann::json::parse(to_json(report));
        CHECK(json["bits"] == 16);
        CHECK(json["true_bits"] == 8);
        CHECK(json["kind"] == "image");
        CHECK(json["channels"].size() == 1);
        CHECK(json["warnings"].size() == report.findings.warnings.size());
        CHECK(json["step"]["height"].get<double>() == doctest::Approx(1 / 255.0));

        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 256; ++x) ramp.at(x, y) = float(x / 8) / 255;
        WriteOptions shallow;
        shallow.depth = Depth::u8;
        write_image((folder.path / "few.png").string(), ramp, shallow);
        CHECK(says(inspect_image((folder.path / "few.png").string()).findings.warnings, "only 32 levels in use"));

        ImageReport broken = report;
        broken.check.channels[0].nan = 3;
        CHECK(says(judge(broken).warnings, "3 NaNs: in channel Y"));
    }

    TEST_CASE("judge: samples that the reader cut are no 8-bit content") {
        ImageReport report;
        report.check.info.type = SampleType::u8;
        report.check.info.bits = 16;
        report.check.true_bits = 8;
        report.check.channels.push_back({.name = "Y", .max = 1, .levels = 161});
        CHECK(says(judge(report).warnings, "have 16 bits"));
        CHECK_FALSE(says(judge(report).warnings, "content"));
        CHECK(to_text(report).find("true depth     16 bits, of which 8 are read") != std::string::npos);
    }

    TEST_CASE("judge: v is doubted if nearly all triangles are mirrored, not if half of them are") {
        MeshReport report;
        report.check.faces = report.uv.triangles = report.check.triangles = 1000;
        for (const std::size_t mirrored : {504, 900, 950}) {
            report.uv.mirrored_triangles = mirrored;
            CHECK(says(judge(report).notes, "flip_v") == (mirrored == 950));
        }
    }

    TEST_CASE("inspect_image: normal maps that are not plain say so") {
        const Folder folder;
        const auto look = [&](const char* name, Depth depth, const auto& store) {
            Image<float> image(64, 64, 3);
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const double s = std::sin(0.4 * x), t = std::cos(0.3 * y), z = 1 / std::sqrt(s * s + t * t + 1);
                    const double n[3] = {s * z, t * z, z};
                    for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(store(n[c], c));
                }
            const std::string file = (folder.path / name).string();
            write_image(file, image, {.depth = depth});
            return inspect_image(file);
        };
        const ImageReport srgb =
            look("srgb.png", Depth::u8, [](double n, int) { return linear_to_srgb(float(0.5 + 0.5 * n)); });
        CHECK(srgb.check.kind.looks == Looks::normal_map);
        CHECK(says(srgb.findings.warnings, "sRGB-encoded"));
        const ImageReport two = look("two.png", Depth::u8, [](double n, int c) { return c == 2 ? 0 : 0.5 + 0.5 * n; });
        CHECK(two.check.kind.looks == Looks::normal_map);
        CHECK(two.findings.warnings.empty());
        CHECK(says(two.findings.notes, "z is rebuilt"));
        const ImageReport negative = look("signed.exr", Depth::half, [](double n, int) { return n; });
        CHECK(negative.check.kind.looks == Looks::normal_map);
        CHECK(negative.findings.warnings.empty());
        CHECK(says(negative.findings.notes, "signed"));
        const ImageReport plain = look("plain.png", Depth::u8, [](double n, int) { return 0.5 + 0.5 * n; });
        CHECK(plain.findings.warnings.empty());
        CHECK(plain.findings.notes.empty());
    }

    TEST_CASE("inspect_pair: signed normals and two channels have the scale of plain ones") {
        const Folder folder;
        Image<float> height(64, 64, 1), plain(64, 64, 3), with_sign(64, 64, 3), two(64, 64, 3);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const double u = 2 * pi * 3 * x / 64, v = 2 * pi * 2 * y / 64;
                height.at(x, y) = float(0.5 + 0.2 * std::sin(u) + 0.2 * std::sin(v));
                const double s = -10 * 0.2 * 2 * pi * 3 / 64 * std::cos(u),
                             t = 10 * 0.2 * 2 * pi * 2 / 64 * std::cos(v);
                const double z = 1 / std::sqrt(s * s + t * t + 1), n[3] = {s * z, t * z, z};
                for (int c = 0; c < 3; ++c) {
                    with_sign.at(x, y, c) = float(n[c]);
                    plain.at(x, y, c) = float(0.5 + 0.5 * n[c]);
                    two.at(x, y, c) = c < 2 ? plain.at(x, y, c) : 0;
                }
            }
        const auto pair = [&](const char* name, const Image<float>& normals) {
            const std::string heights = (folder.path / "h.exr").string(), file = (folder.path / name).string();
            write_image(heights, height);
            write_image(file, normals);
            return inspect_pair(heights, file);
        };
        const double scale = pair("plain.exr", plain).check.scale;
        CHECK(scale == doctest::Approx(10).epsilon(0.03));
        const PairReport negative = pair("signed.exr", with_sign);
        CHECK(negative.check.scale == doctest::Approx(scale).epsilon(0.001));
        CHECK(says(negative.findings.notes, "signed"));
        const PairReport rebuilt = pair("two.png", two);
        CHECK(rebuilt.check.scale == doctest::Approx(scale).epsilon(0.001));
        CHECK(says(rebuilt.findings.notes, "z is rebuilt"));
        CHECK(rebuilt.findings.warnings.empty());
        CHECK(bake_options(rebuilt).starts_with("`amplitude` 0.15"));
    }

    TEST_CASE("inspect: JSON is valid for names that are not UTF-8") {
        MeshReport report;
        report.file = "b\xff"
                      "d.obj";
        CHECK(nlohmann::json::parse(to_json(report))["kind"] == "mesh");
    }

    TEST_CASE("judge: warnings name the conventions of a pair") {
        PairReport report;
        report.check.corr_x = -0.97;
        report.check.corr_y = 0.99;
        report.check.corr = 0.98;
        report.check.height_decided = report.check.green_decided = true;
        report.check.inverted = report.check.directx = true;
        report.check.not_unit = 0.4;
        const Findings f = judge(report);
        CHECK(says(f.warnings, "inverted height"));
        CHECK(says(f.warnings, "DirectX green"));
        CHECK(says(f.warnings, "unit length"));
        report = {};
        report.check.corr_x = report.check.corr_y = report.check.corr = 0.1;
        CHECK(says(judge(report).warnings, "do not show the same relief"));
    }

    TEST_CASE("inspect_pair: a grey image as the normal map is refused") {
        const Folder folder;
        Image<float> grey(4, 4, 1);
        std::fill_n(grey.data(), 16, 0.5f);
        const std::string file = (folder.path / "grey.png").string();
        write_image(file, grey);
        CHECK_THROWS_AS(inspect_pair(file, file), Error);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("inspect_pair: every real pair, at least as well as its manifest says") {
        const fs::path pairs = test::shared_data() / "textures/pairs";
        struct Known {
            const char *height, *normals;
            double corr_x, corr_y; ///< at least; the manifest's digits, less half of the last
            double scale;          ///< 0: not stated
            bool inverted, directx;
        };
        const Known known[] = {
            {"ambientcg_Rock020/Rock020_1K_Displacement.jpg", "ambientcg_Rock020/Rock020_1K_Normal.jpg", 0.9985, 0.9985,
             63, false, true},
            {"ambientcg_Tiles036/Tiles036_1K_Displacement.jpg", "ambientcg_Tiles036/Tiles036_1K_Normal.jpg", 0.9945,
             0.9945, 3.5, false, true},
            {"ambientcg_Metal007/Metal007_1K_Displacement.jpg", "ambientcg_Metal007/Metal007_1K_Normal.jpg", 0.685,
             0.815, 1.4, false, true},
            {"cube2_metal_tech_01/metal_tech_01_hm.png", "cube2_metal_tech_01/metal_tech_01_nm.png", 0.9995, 0.9995,
             68.4, false, true},
            {"cube2_diamond_plate_big_gk/diamond_plate_big_gk_hm.png",
             "cube2_diamond_plate_big_gk/diamond_plate_big_gk_nm.png", 0.9975, 0.9975, 0, false, true},
            {"cube2_wall_plate_12_gk/wall_plate_12_gk_hm.png", "cube2_wall_plate_12_gk/wall_plate_12_gk_nm.png", 0.97,
             0.9955, 0, true, true},
            {"cube2_castell_wall_gk_v01/castell_wall_gk_v01_hm.jpg",
             "cube2_castell_wall_gk_v01/castell_wall_gk_v01_nm.jpg", 0.865, 0.895, 0, false, true},
            {"cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_hm.png",
             "cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_nm.png", 0.97, 0.945, 0, false, true},
            {"cube2_rock_formation_gk_v01/rock_formation_gk_v01_hm.png",
             "cube2_rock_formation_gk_v01/rock_formation_gk_v01_nm.png", 0.9, 0.9, 0, false, true},
            {"bevy_parallax_cube/cube_depth.png", "bevy_parallax_cube/cube_normal.png", 0.7, 0.7, 0, true, false},
        };
        for (const Known& k : known) {
            CAPTURE(k.height);
            const PairCheck c = inspect_pair((pairs / k.height).string(), (pairs / k.normals).string()).check;
            CHECK(std::abs(c.corr_x) >= k.corr_x);
            CHECK(std::abs(c.corr_y) >= k.corr_y);
            if (k.scale > 0) CHECK(c.scale == doctest::Approx(k.scale).epsilon(0.04));
            CHECK(c.inverted == k.inverted);
            CHECK(c.directx == k.directx);
        }
        InspectOptions alpha;
        alpha.height_channel = Grey::a;
        const fs::path packed = test::shared_data() / "textures/packed";
        const PairCheck rock =
            inspect_pair((packed / "rock023_alb_ht.png").string(), (packed / "rock023_nrm_rgh.png").string(), alpha)
                .check;
        CHECK(rock.corr_x > 0.95);
        CHECK(rock.corr_y > 0.95);
        CHECK_FALSE(rock.directx);
        CHECK(rock.not_unit > 0.1);
    }

    TEST_CASE("inspect_image: what is known of real heights") {
        const fs::path textures = test::shared_data() / "textures";
        const auto look = [&](const char* name) { return inspect_image((textures / name).string()); };
        const ImageReport plate = look("pairs/cube2_diamond_plate_big_gk/diamond_plate_big_gk_hm.png");
        CHECK(plate.check.kind.looks == Looks::grey);
        CHECK(plate.check.grey.min == doctest::Approx(0.889).epsilon(0.001));
        CHECK(plate.check.grey.max == doctest::Approx(0.978).epsilon(0.001));
        CHECK(says(plate.findings.warnings, "levels in use"));
        const ImageReport tech = look("pairs/cube2_metal_tech_01/metal_tech_01_hm.png");
        CHECK(tech.check.kind.looks == Looks::grey);
        CHECK(tech.check.kind.tint == doctest::Approx(1));
        CHECK(look("heights/crater_dat.png").check.true_bits == 16);
        CHECK(look("heights/terrain3d_mountain1.exr").check.channels[0].max == doctest::Approx(1.0049).epsilon(1e-4));
        CHECK(look("heights/terrain3d_stones.exr").check.info.type == SampleType::half);
        for (const char* name : {"normals/mesh_wire_norm.png", "packed/rock023_nrm_rgh.png",
                                 "pairs/ambientcg_Rock020/Rock020_1K_Normal.jpg",
                                 "pairs/cube2_castell_wall_gk_v01/castell_wall_gk_v01_nm.jpg",
                                 "pairs/cube2_wall_plate_12_gk/wall_plate_12_gk_nm.png"})
            CHECK_MESSAGE(look(name).check.kind.looks == Looks::normal_map, name);
        for (const char* name : {"pairs/ambientcg_Rock020/Rock020_1K_Color.jpg",
                                 "pairs/cube2_rock_formation_gk_v01/rock_formation_gk_v01_cc.jpg",
                                 "packed/rock023_alb_ht.png", "pairs/bevy_parallax_cube/cube_color.png"})
            CHECK_MESSAGE(look(name).check.kind.looks == Looks::colour, name);
    }
}
