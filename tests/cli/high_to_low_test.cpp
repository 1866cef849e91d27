// bake normal-map --high from outside: what each failure of a bake from high-poly meshes does, and what is printed.
#include "bake/mesh/gltf/io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "memory_limits.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

using namespace bake;
using namespace bake::test;

namespace {

const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";
/// The unit square under the whole unit square of uv.
const std::string low = points + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

/// A square from -1 to 3, at this height, with these faces of its corners 1 to 4.
std::string square(double z, const std::string& faces = "f 1 2 3 4\n") {
    const std::string end = " " + std::to_string(z) + "\n";
    return "v -1 -1" + end + "v 3 -1" + end + "v 3 3" + end + "v -1 3" + end + faces;
}

/// low.obj, and high.obj a hundredth above it.
struct Meshes : Folder {
    Meshes() {
        write_file(*this / "low.obj", low);
        write_file(*this / "high.obj", square(0.01));
    }
};

using Strings = std::vector<std::string>;

Strings command(const Strings& more, const std::string& mesh = "low.obj", const std::string& high = "high.obj",
                const char* size = "16") {
    Strings all = {"normal-map", mesh, "--high", high, "-o", "n.png", "--size", size};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// Done, with no word on stderr.
Run good(const Folder& folder, const Strings& arguments) {
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(run.err == "");
    return run;
}

/// Done, with one line on stderr that holds `note`; what is printed as JSON.
nlohmann::json noted(const Folder& folder, Strings arguments, const std::string& note) {
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(lines(run.err) == 1);
    CHECK(run.err.starts_with("bake: "));
    CHECK(run.err.find(note) != std::string::npos);
    arguments.emplace_back("--json");
    return nlohmann::json::parse(run_bake(folder, arguments).out);
}

/// Largest difference of a map from the flat one.
double off_flat(const std::string& file) {
    const Image<float> map = read_image(file);
    REQUIRE(map.channels() == 3);
    double worst = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
        worst = std::max(worst, std::abs(double(map.data()[i]) - (i % 3 == 2 ? 1 : 0.5)));
    return std::isfinite(worst) ? worst : 1e9;
}
constexpr double step = 1.0 / 65535;

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("high to low: uvs that a map cannot hold are refused") {
        const Meshes folder;
        write_file(folder / "none.obj", points + "f 1 2 3 4\n");
        check_refused(folder, command({}, "none.obj"), 4, "none.obj: has no uvs; unwrap the mesh first");
        write_file(folder / "tiles.obj", points + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\n"
                                                  "f 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n");
        check_refused(folder, command({}, "tiles.obj"), 4, "tiles of the uvs (1001, 1002) and overlap modulo 1");
        // With several rays to a texel as well, and a tile brings it about.
        check_refused(folder, command({"--rays", "2"}, "tiles.obj"), 4, "and overlap modulo 1");
        const auto said = noted(folder, command({"--tile", "1002", "--rays", "2"}, "tiles.obj"), "1 faces lie outside");
        CHECK(said["texels"]["hit"] == 256);
        write_file(folder / "point.obj", points + "vt .5 .5\nf 1/1 2/1 3/1 4/1\n");
        check_refused(folder, command({}, "point.obj"), 4, "point.obj: no face has area in its uvs");
    }

    TEST_CASE("high to low: overlapping uvs are baked of the first face and counted, mirrored ones right way round") {
        const Meshes folder;
        // The second square is the first one mirrored, on the same texels.
        write_file(folder / "overlap.obj", points + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                                    "f 1/1 2/2 3/3 4/4\nf 2/2 5/1 6/4 3/3\n");
        auto said = noted(folder, command({}, "overlap.obj"), "256 texels lie in more than one face; the lowest face");
        CHECK(said["texels"]["overlapped"] == 256);
        CHECK(said["texels"]["hit"] == 256);
        CHECK(off_flat(folder / "n.png") <= step);
        // Detail that rises along x and y leans to -x and -y: on a chart that is mirrored in u to +u and still to -v.
        write_file(folder / "slope.obj", "v -1 -1 -.03\nv 3 -1 .05\nv 3 3 .09\nv -1 3 .01\nf 1 2 3 4\n");
        write_file(folder / "mirrored.obj", points + "vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\nf 1/1 2/2 3/3 4/4\n");
        const double half = 0.5 / std::hypot(0.02, 0.01, 1);
        for (const bool mirrored : {false, true}) {
            good(folder, command({"--quiet"}, mirrored ? "mirrored.obj" : "low.obj", "slope.obj"));
            const Image<float> map = read_image(folder / "n.png");
            CHECK(std::abs(double(map.at(5, 5, 0)) - 0.5 - (mirrored ? 0.02 : -0.02) * half) < 1e-4);
            CHECK(std::abs(double(map.at(5, 5, 1)) - 0.5 + 0.01 * half) < 1e-4);
        }
    }

    TEST_CASE("high to low: uvs of exactly 1, and triangles without area in uv, in LOW and in HIGH") {
        const Meshes folder;
        CHECK(good(folder, command({})).out.find("charts cover 100.0 %") != std::string::npos);
        write_file(folder / "line.obj", points + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                                 "f 1/1 2/2 3/3 4/4\nf 2/2 5/2 6/2 3/2\n");
        auto said = noted(folder, command({}, "line.obj"), "2 triangles have no area in uv and were not baked");
        CHECK(said["texels"]["hit"] == 256);
        CHECK(off_flat(folder / "n.png") <= step);
        // Two corners that are one, and three, beside the square.
        write_file(folder / "thin_low.obj", low + "f 1/1 1/1 2/2\n");
        write_file(folder / "thin.obj", square(0.01, "f 1 1 2\nf 3 3 3\nf 1 2 3 4\n"));
        said = noted(folder, command({}, "thin_low.obj", "thin.obj"), "1 triangles have no area in uv");
        CHECK(said["texels"]["hit"] == 256);
        CHECK(off_flat(folder / "n.png") <= step);
    }

    TEST_CASE("high to low: values that are not finite are the reader's to refuse, with file and line") {
        const Meshes folder;
        write_file(folder / "nan.obj", "v 0 0 0\nv 1 0 nan\nv 1 1 0\nf 1 2 3\n");
        write_file(folder / "inf_n.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 inf\nf 1//1 2//1 3//1\n");
        check_refused(folder, command({}, "low.obj", "nan.obj"), 3, "nan.obj:2: 'nan' is not a finite");
        check_refused(folder, command({}, "low.obj", "inf_n.obj"), 3, "inf_n.obj:4: 'inf' is not a finite");
        check_refused(folder, command({}, "nan.obj"), 3, "nan.obj:2:");
        check_refused(folder, command({"--cage", "nan.obj"}), 3, "nan.obj:2:");
    }

    TEST_CASE("high to low: HIGH elsewhere in space is noted, and an error with --strict") {
        const Meshes folder;
        write_file(folder / "away.obj", square(100));
        const auto said =
            noted(folder, command({}, "low.obj", "away.obj"), "away.obj: no ray finds it; is it elsewhere");
        CHECK(said["texels"]["missed"] == 256);
        CHECK(said["texels"]["behind"] == 0);
        CHECK(said["witnesses"].size() == 8);
        CHECK(said["witnesses"][0]["nearest"]["mesh"] == "away.obj");
        CHECK(off_flat(folder / "n.png") <= step);
        const Run strict = run_bake(folder, command({"--strict", "--quiet"}, "low.obj", "away.obj"));
        CHECK(strict.code == 1);
        CHECK(lines(strict.err) == 1);
        CHECK(strict.err.find("low.obj: 256 texels find no detail") != std::string::npos);
        CHECK(good(folder, command({"--strict", "--quiet"})).code == 0);
    }

    TEST_CASE("high to low: HIGH inside out is told from HIGH that is not there") {
        const Meshes folder;
        write_file(folder / "back.obj", square(0.01, "f 4 3 2 1\n"));
        auto said = noted(folder, command({}, "low.obj", "back.obj"), "back.obj: rays meet the back of its triangles");
        CHECK(said["texels"]["behind"] == 256);
        CHECK(said["witnesses"][0]["state"] == "behind");
        // Of a mesh of which the half x < 1/2 alone is turned over.
        write_file(folder / "half.obj", "v -1 -1 .01\nv .5 -1 .01\nv .5 3 .01\nv -1 3 .01\nv 3 -1 .01\nv 3 3 .01\n"
                                        "f 4 3 2 1\nf 2 5 6 3\n");
        const Run run = run_bake(folder, command({}, "low.obj", "half.obj"));
        CHECK(run.code == 0);
        CHECK(lines(run.err) == 2);
        CHECK(run.err.find("low.obj: 128 texels find no detail") != std::string::npos);
        CHECK(run.err.find("128 of these find the back of triangles") != std::string::npos);
    }

    TEST_CASE("high to low: files without faces or that are missing are refused by name") {
        const Meshes folder;
        write_file(folder / "empty.obj", "");
        write_file(folder / "points.obj", "v 0 0 0\nv 1 0 0\n");
        check_refused(folder, command({}, "low.obj", "empty.obj"), 4, "empty.obj: has no faces");
        check_refused(folder, command({}, "low.obj", "points.obj"), 4, "points.obj: has no faces (2 points)");
        check_refused(folder, command({}, "points.obj"), 4, "points.obj: has no faces");
        check_refused(folder, command({"empty.obj"}), 2, "empty.obj"); // a word without an option's name
        check_refused(folder, command({}, "low.obj", "none.obj"), 3, "none.obj: no such file");
        check_refused(folder, command({}, "none.obj"), 3, "none.obj: no such file");
        check_refused(folder, command({"--cage", "none.obj"}), 3, "none.obj: no such file");
        check_refused(folder, {"normal-map", "low.obj", "--high", "high.obj", "none.obj", "-o", "n.png"}, 3,
                      "none.obj: no such file");
    }

    TEST_CASE(
        "high to low: a mesh on itself is flat within the encoding, shells closer than the envelope go by the first") {
        const Meshes folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        const Run level = good(folder, command({}, "low.obj", "low.obj"));
        CHECK(level.out.find("detail lies 0 to 0 above the surface") != std::string::npos);
        good(folder, {"normal-map", torus, "--high", torus, "-o", "n.png", "--size", "96x48"});
        CHECK(off_flat(folder / "n.png") <= step);
        // The outer shell leans to -x, the inner one is level; both are within reach.
        write_file(folder / "shells.obj",
                   "v -1 -1 .01\nv 3 -1 .03\nv 3 3 .03\nv -1 3 .01\nv -1 -1 0\nv 3 -1 0\nv 3 3 0\nv -1 3 0\n"
                   "f 5 6 7 8\nf 1 2 3 4\n");
        const nlohmann::json said =
            nlohmann::json::parse(good(folder, command({"--json"}, "low.obj", "shells.obj")).out);
        CHECK(said["heights"][0].get<double>() > 0.014);
        const double lean = -0.005 / std::hypot(0.005, 1);
        CHECK(std::abs(double(read_image(folder / "n.png").at(7, 7, 0)) - 0.5 - 0.5 * lean) < 1e-4);
    }

    TEST_CASE("high to low: quads that are not planar, one texel, one triangle") {
        const Meshes folder;
        write_file(folder / "bent.obj", "v 0 0 0\nv 1 0 .1\nv 1 1 0\nv 0 1 .1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                        "f 1/1 2/2 3/3 4/4\n");
        good(folder, command({}, "bent.obj", "bent.obj"));
        CHECK(off_flat(folder / "n.png") <= step);
        const nlohmann::json one =
            nlohmann::json::parse(good(folder, command({"--json"}, "low.obj", "high.obj", "1")).out);
        CHECK(one["texels"]["hit"] == 1);
        CHECK(off_flat(folder / "n.png") <= step);
        write_file(folder / "triangle.obj", points + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
        good(folder, command({"--rays", "3"}, "triangle.obj", "triangle.obj"));
        CHECK(off_flat(folder / "n.png") <= step);
    }

    TEST_CASE("high to low: a cage has the faces of LOW, or is refused") {
        const Meshes folder;
        write_file(folder / "other.obj", points + "f 1 2 3 4\nf 2 5 6 3\n");
        check_refused(folder, command({"--cage", "other.obj"}), 4, "other.obj: has other faces than the low-poly mesh");
        write_file(folder / "cage.obj", square(0.05));
        const nlohmann::json said = nlohmann::json::parse(good(folder, command({"--cage", "cage.obj", "--json"})).out);
        // The farthest corner of the cage.
        CHECK(said["reach"]["front"].get<double>() == doctest::Approx(std::hypot(2, 2, 0.05)).epsilon(1e-4));
        CHECK(said["texels"]["hit"] == 256);
    }

    TEST_CASE("high to low: options that contradict or lack each other are usage errors") {
        const Meshes folder;
        const std::string dots = (own_meshes() / "dots.png").string();
        check_refused(folder, command({"--height", dots}), 2, "--high, --height: the detail comes from one of them");
        check_refused(folder, {"normal-map", "--high", "high.obj", "-o", "n.png"}, 2,
                      "--high: needs the low-poly mesh");
        for (const Strings& more : {Strings{"--cage", "low.obj"},
                                    {"--cage-out", "c.ply"},
                                    {"--extrude", "1"},
                                    {"--max-distance", "1"},
                                    {"--rays", "2"},
                                    {"--high-normals", "facet"},
                                    {"--max-error-deg", "1"},
                                    {"--high-smooth", "1%"},
                                    {"--cast", "face"},
                                    {"--maps", "height"},
                                    {"--maps-out", "m"},
                                    {"--sky-rays", "4"},
                                    {"--sky-distance", "1"},
                                    {"--debug-rays", "d.glb"},
                                    {"--report-map", "r.png"},
                                    {"--strict"}}) {
            Strings all = {"normal-map", "low.obj", "--height", dots, "-o", "n.png"};
            all.insert(all.end(), more.begin(), more.end());
            check_refused(folder, all, 2, more[0] + " requires --high");
        }
        check_refused(folder, command({"--maps", "height"}), 2, "--maps, --maps-out: belong together");
        check_refused(folder, command({"--maps-out", "m"}), 2, "--maps, --maps-out: belong together");
        check_refused(folder, command({"--maps", "hight", "--maps-out", "m"}), 2, "'hight' is no map; choose from");
        check_refused(folder, command({"--cage", "low.obj", "--extrude", "1"}), 2, "--cage: brings its own distances");
        for (const Strings& more : {Strings{"--cage", "low.obj"}, {"--extrude", "1"}})
            check_refused(folder, command({"--cage-out", "c.ply", more[0], more[1]}), 2,
                          "--cage-out: writes the automatic envelope");
        check_refused(folder, command({"--cage-out", "c.glb"}), 2, "--cage-out: name a file that ends in .ply or .obj");
        check_refused(folder, command({"--cage-out", "c_<UDIM>.ply"}), 2, "--cage-out c_<UDIM>.ply: <UDIM> stands");
        check_refused(folder, command({"--cage-out", "low.obj"}), 2, "would replace a file");
        check_refused(folder, command({"--max-distance", "1"}), 2, "--max-distance: counts from where rays start");
        check_refused(folder, command({"--high-smooth", "1", "--high-normals", "facet"}), 2,
                      "--high-smooth, --high-normals facet: facets have one normal each");
        check_refused(folder, command({"--high-smooth", "0"}), 2, "--high-smooth");
        for (const char* option : {"--extent=1,1", "--amplitude=1", "--method=blinn", "--wrap=clamp", "--invert"})
            check_refused(folder, command({option}), 2, "leave it out with --high");
        check_refused(folder, command({}, "low.obj", dots), 3, "dots.png: is a picture, where a mesh is expected");
        check_refused(folder, command({"--debug-rays", "low.obj"}), 2, "would replace a file");
        check_refused(folder,
                      {"normal-map", "low.obj", "--high", "high.obj", "-o", "m_height.exr", "--maps", "height",
                       "--maps-out", "m"},
                      2, "is the name of two outputs");
    }

    TEST_CASE("high to low: an output that cannot be written leaves nothing, not the other outputs either") {
        const Meshes folder;
        check_refused(folder, {"normal-map", "low.obj", "--high", "high.obj", "-o", "none/n.png"}, 5,
                      "none/n.png: cannot be written");
        check_refused(folder, command({"--maps", "height,id", "--maps-out", "none/m"}), 5, "none/m_height.exr: cannot");
        check_refused(folder, command({"--cage-out", "none/c.ply"}), 5, "none/c.ply: cannot be written");
        check_refused(folder,
                      {"normal-map", "low.obj", "--high", "high.obj", "-o", "none/n.png", "--cage-out", "c.ply"}, 5,
                      "none/n.png: cannot be written");
        check_refused(folder, command({"--debug-rays", "none/d.glb"}), 5, "none/d.glb: cannot be written");
        // What was there stays as it was.
        good(folder, command({"--quiet"}));
        const std::string before = contents(folder / "n.png");
        write_file(folder / "back.obj", square(0.01, "f 4 3 2 1\n"));
        check_refused(folder, command({"--maps", "height", "--maps-out", "none/m"}, "low.obj", "back.obj"), 5,
                      "none/m");
        CHECK((contents(folder / "n.png") == before));
    }

    TEST_CASE("high to low: the result as JSON, and the maps beside it") {
        const Meshes folder;
        const Run run = good(folder, command({"--json", "--maps",
                                              "height,position,ambient-occlusion,bent-normal,thickness,"
                                              "mean-curvature,gauss-curvature,id",
                                              "--maps-out", "m", "--debug-rays", "d.glb", "--sky-rays", "4"}));
        const nlohmann::json said = nlohmann::json::parse(run.out);
        for (const char* key : {"out", "width", "height", "space", "green", "high", "reach", "hard_edges", "rays",
                                "ray_lengths", "heights", "parallax_texels", "seams", "witnesses", "texels"})
            CHECK_MESSAGE(said.contains(key), std::string(key));
        // What is drawn of the rays can be told apart.
        const std::vector<GltfMaterial> drawn = read_gltf(folder / "d.glb").materials;
        REQUIRE(drawn.size() == 3);
        for (int k = 0; k < 3; ++k)
            CHECK(glm::length(drawn[k].base_color_factor - drawn[(k + 1) % 3].base_color_factor) > 0.5f);
        CHECK(said["high"]["meshes"] == nlohmann::json({"high.obj"}));
        CHECK(said["high"]["triangles"] == 2);
        CHECK(said["rays"] == 256);
        CHECK(said["heights"][1].get<double>() == doctest::Approx(0.01).epsilon(1e-4));
        CHECK(said["texels"]["hit"] == 256);
        CHECK(said["witnesses"].size() == 4); // one of each four rows
        CHECK(said["witnesses"][0]["state"] == "hit");
        CHECK(said["witnesses"][0]["height"].get<double>() == doctest::Approx(0.01).epsilon(1e-4));
        CHECK((folder.names() == std::set<std::string>{"low.obj", "high.obj", "n.png", "d.glb", "m_height.exr",
                                                       "m_position.exr", "m_ambient-occlusion.exr", "m_bent-normal.exr",
                                                       "m_thickness.exr", "m_mean-curvature.exr",
                                                       "m_gauss-curvature.exr", "m_id.exr"}));
        CHECK(read_image(folder / "m_height.exr").at(3, 3) == doctest::Approx(0.01).epsilon(1e-4));
        CHECK(read_image(folder / "m_position.exr").channels() == 3);
        CHECK(read_image(folder / "m_ambient-occlusion.exr").at(3, 3) == 1);
        CHECK(run_bake(folder, {"check", "d.glb"}).code == 0);
    }

    TEST_CASE("high to low: --extrude and --max-distance are object units or per cent, and end the search") {
        const Meshes folder;
        const auto missed = [&](const Strings& more) {
            Strings all = command(more);
            all.insert(all.end(), {"--quiet", "--json"});
            const nlohmann::json said = nlohmann::json::parse(run_bake(folder, all).out);
            return said["texels"]["missed"].get<int>();
        };
        CHECK(missed({"--extrude", "0.02"}) == 0);
        CHECK(missed({"--extrude", "0.005"}) == 256);
        // The diagonal of all six points is sqrt 5.
        CHECK(missed({"--extrude", "0.5%"}) == 0);
        CHECK(missed({"--extrude", "0.4%"}) == 256);
        CHECK(missed({"--extrude", "0.5", "--max-distance", "0.48"}) == 256);
        CHECK(missed({"--extrude", "0.5", "--max-distance", "0.5"}) == 0);
    }

    TEST_CASE("high to low: 1, 2 and 7 threads write the same bytes") {
        const Meshes folder;
        const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();
        REQUIRE(
            run_bake(folder, {"displace", torus, "--height", dots, "--levels", "1", "--quiet", "-o", "d.ply"}).code ==
            0);
        std::vector<std::string> first;
        for (const char* threads : {"1", "2", "7"}) {
            REQUIRE(run_bake(folder, {"normal-map", torus,
                                      "--high",     "d.ply",
                                      "-o",         "n.png",
                                      "--size",     "128x64",
                                      "--threads",  threads,
                                      "--rays",     "2",
                                      "--maps",     "height,ambient-occlusion",
                                      "--maps-out", "m",
                                      "--sky-rays", "8",
                                      "--quiet",    "--debug-rays",
                                      "r.ply"})
                        .code == 0);
            std::vector<std::string> bytes;
            for (const char* name : {"n.png", "m_height.exr", "m_ambient-occlusion.exr", "r.ply"})
                bytes.push_back(contents(folder / name));
            if (first.empty()) first = bytes;
            CHECK((bytes == first));
        }
    }

    TEST_CASE("high to low: a map that memory cannot hold is refused in one line") {
        if (!keeps_memory_limits()) return;
        const Meshes folder;
        for (const long long mib : {600, 1500, 3000}) {
            CAPTURE(mib);
            const RunLimits limits{.resources = {{RLIMIT_AS, mib << 20}}};
            check_refused(folder, command({"--quiet"}, "low.obj", "high.obj", "16384"), 4, "ulimit -v", limits);
            check_refused(folder,
                          command({"--quiet", "--maps", "position,id", "--maps-out", "m", "--rays", "2"}, "low.obj",
                                  "high.obj", "16384"),
                          4, "ulimit -v", limits);
        }
        CHECK(run_bake(folder, command({}), {.resources = {{RLIMIT_AS, 1500LL << 20}}}).code == 0);
    }

} // TEST_SUITE
