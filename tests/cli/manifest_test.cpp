// The bakes that a manifest lists, run by the command: their files show what the tracer shows without them.
#include "bake/base/text.h"
#include "bake/picture/image_io.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/planned_scene.h"
#include "bake/verdict/plan/texture_form.h"
#include "cli/command.h"
#include "verdict/plan/hand_made_plan.h"
#include <cmath>

using namespace bake;
using namespace bake::test;

namespace {

const std::string around = R"([render]
size = [64, 48]
spp = 4
exposure = 0
[camera]
position = [0, 3, 4]
target = [0, 0, 0]
[[light]]
type = "directional"
from = [-1, 1, 1]
)";

/// RMSE of two pictures of floats.
double distance(const Image<float>& a, const Image<float>& b) {
    REQUIRE(a.size() == b.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a.data()[i]) - double(b.data()[i]), 2);
    return std::sqrt(sum / double(a.size()));
}

Image<float> rendered(const Folder& folder, const std::string& scene) {
    const Run run = run_bake(folder, {"render", scene, "-o", scene + ".exr", "--quiet"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return read_image(folder / (scene + ".exr"));
}

/// Renders the object by this model, runs the bakes that it needs, and renders it from their files instead. `mesh`: the line
/// that names it, `map`: what is decided on its map. Returns the RMSE between the two pictures.
double difference(const std::string& model, const std::string& mesh, const std::optional<TexturePlan>& map = {}) {
    const Folder folder;
    fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
    fs::copy_file(own_meshes() / "torus.obj", folder / "torus.obj");
    const std::string relief = "height = {file = \"dots.png\", amplitude = \"2%\"}\n",
                      object = "[[mesh]]\nmaterial = \"studs\"\nname = \"ring\"\n",
                      material = "[[material]]\nname = \"studs\"\n";
    const std::string scene = around + material + relief + object + mesh + "\n";
    write_file(folder / "s.toml", scene);
    const SceneEntries entries = read_scene(folder / "s.toml");
    ScenePlan plan;
    plan.objects = {shown_by("ring", model, {0})};
    if (map) plan.textures = {*map};
    write_file(folder / "planned.toml", planned_scene(scene, entries, plan, folder / "planned.toml"));
    write_file(folder / "bakes.toml", to_toml(plan_manifest(entries, plan, folder / "bakes.toml")));

    std::string shown = mesh, maps;
    if (map && map->width < map->source_width && map->bits != bc5_bits)
        maps = "relief-size = " + std::to_string(map->width) + "\n";
    for (const Bake& bake : parse_manifest(contents(folder / "bakes.toml"), "bakes.toml").bakes) {
        const Run run = run_bake(folder, command_of(bake));
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const std::string file = bake.outputs.front().second;
        REQUIRE(fs::exists(folder / file));
        const std::string line = bake.use + " = \"" + file + "\"";
        if (bake.use == "file") shown = line;
        else if (!bake.use.empty()) maps += line + "\n";
        else shown = "file = \"" + file + "\""; // the shape, with the uvs of the map
    }
    write_file(folder / "baked.toml", around + material + maps + object + shown + "\n");
    return distance(rendered(folder, "planned.toml"), rendered(folder, "baked.toml"));
}

/// The same of a mirror under a sky that is planned with smaller faces. `sky`: the line that names it.
double sky_difference(const std::string& sky, const std::string& more, int source_face) {
    const Folder folder;
    for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
        const std::string name = std::string("sky_") + face + ".png";
        fs::copy_file(own_meshes() / name, folder / name);
    }
    const std::string keys = more + "yaw-deg = 30\nscale = 2\n",
                      ball = "[[material]]\nname = \"steel\"\nreflect = 0.5\n[[mesh]]\nshape = \"sphere:R=1\"\n"
                             "material = \"steel\"\n";
    const std::string scene = around + "[sky]\n" + sky + keys + ball;
    write_file(folder / "s.toml", scene);
    const SceneEntries entries = read_scene(folder / "s.toml");
    ScenePlan plan;
    plan.sky = SkyPlan{.model = "faces", .face = 32, .source_face = source_face};
    write_file(folder / "planned.toml", planned_scene(scene, entries, plan, folder / "planned.toml"));
    const Manifest manifest = plan_manifest(entries, plan, folder / "bakes.toml");
    REQUIRE(manifest.bakes.size() == 1);
    const Bake& bake = manifest.bakes[0];
    CHECK(bake.use == "faces");
    const Run run = run_bake(folder, command_of(bake));
    REQUIRE_MESSAGE(run.code == 0, run.err);
    const std::string files = "faces = \"" + bake.outputs.front().second + "\"\n";
    write_file(folder / "baked.toml", around + "[sky]\n" + files + "yaw-deg = 30\nscale = 2\n" + ball);
    return distance(rendered(folder, "planned.toml"), rendered(folder, "baked.toml"));
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("manifest: maps of the bits that were decided show the same, up to these bits") {
        TexturePlan map{.kind = "normal", .width = 64, .height = 64, .channels = 3, .bits = 8};
        map.source_width = map.source_height = 256, map.meshes = {0};
        const std::string file = "file = \"torus.obj\"";
        CHECK(difference("normal", file, map) < 3e-3);
        map.channels = 2, map.bits = bc5_bits;
        CHECK(difference("normal", file, map) < 2e-4); // the file has the planned texels
        map.width = map.height = 256;
        CHECK(difference("normal", file, map) < 2e-4);
        map.kind = "bump", map.bits = 16, map.channels = 2, map.width = map.height = 64;
        CHECK(difference("bump", file, map) < 2e-4);
    }

    TEST_CASE("manifest: the files of a smaller sky show what the planned scene does") {
        CHECK(sky_difference("faces = \"sky_%s.png\"\n", "", 192) < 5e-4);
        const std::string list = "faces = [\"sky_px.png\", \"sky_nx.png\", \"sky_py.png\", \"sky_ny.png\", "
                                 "\"sky_pz.png\", \"sky_nz.png\"]\n";
        CHECK(sky_difference(list, "colour-space = \"linear\"\nbad = \"clamp\"\n", 192) < 5e-4);
    }

    TEST_CASE("manifest: its bakes make files with which the picture is the same, up to the rounding of the files") {
        const std::string file = "file = \"torus.obj\"", shape = "shape = \"torus:R=1,r=0.4\"";
        CHECK(difference("bump", file) < 2e-4);
        CHECK(difference("normal", shape) < 2e-4);
        CHECK(difference("displace:4", file) < 2e-4);
        CHECK(difference("displace:4", shape + "\nsegments = [24, 12]") < 2e-4);
        CHECK(difference("displace+normal:4", file) < 2e-4);
    }
}
