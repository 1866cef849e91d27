// What is told of the outline before a comparison, beside what the comparison measures.
#include "bake/preview/outline_doubt.h"
#include "bake/verdict/compare/compared_scene.h"
#include "bake/verdict/compare/silhouette.h"
#include "folders.h"
#include "verdict/compare/relief_scene.h"
#include <cstdlib>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The number of pixels that loading tells; 0 without a note.
double told_px(const Scene& scene) {
    for (const std::string& note : scene.notes)
        if (const auto at = note.find("off by up to ");
            at != std::string::npos && note.find("pixels") != std::string::npos)
            return std::atof(note.c_str() + at + 13);
    return 0;
}

struct Outlines {
    double told = 0, measured = 0;
};

Outlines outlines(SceneEntries entries, int size, int levels) {
    entries.settings.width = entries.settings.height = size;
    const ComparedScene compared(entries, "");
    const MethodScene bump = compared.load({Shade::exact}), displaced = compared.load({Shade::displace, levels});
    const OutlineError error =
        outline_error(object_mask(bump.scene, bump.of_object, 2), object_mask(displaced.scene, displaced.of_object, 2));
    return {told_px(bump.scene), error.max};
}

void check_within_two(const Outlines& found) {
    CAPTURE(found.told);
    CAPTURE(found.measured);
    CHECK(found.told / found.measured < 2);
    CHECK(found.told / found.measured > 0.5);
}

SceneEntries smooth_scene(const std::string& shape, float amplitude) {
    SceneEntries entries = test::relief_scene(shape, amplitude);
    entries.meshes[0].columns = entries.meshes[0].rows = 24;
    return entries;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("outline: a sphere moved out or in by a constant height is off by that height in pixels") {
        for (const float midlevel : {0.0f, 1.0f}) {
            SceneEntries entries = smooth_scene("sphere", 0.1f);
            auto white = std::make_shared<LoadedPicture>(
                LoadedPicture{copied(entries.pictures["waves.exr"]->image), entries.pictures["waves.exr"]->info});
            std::fill(white->image.data(), white->image.data() + white->image.size(), 0.5f);
            entries.pictures["waves.exr"] = white;
            entries.materials[0].relief.midlevel = midlevel;
            entries.cameras[0].orthographic = true, entries.cameras[0].height = 4;
            const Outlines found = outlines(entries, 80, 0);
            CHECK(found.told == doctest::Approx(1).epsilon(0.06)); // .05 in a view of 4 over 80 pixels
            CHECK(std::abs(found.measured - 1) <= 0.75);           // by steps of half a pixel
        }
    }

    TEST_CASE("outline: on a sphere and a torus under waves what is told is within a factor of 2 of what is measured") {
        for (const char* shape : {"sphere", "torus"})
            for (const float amplitude : {0.06f, 0.2f}) {
                CAPTURE(std::string(shape));
                SceneEntries entries = smooth_scene(shape, amplitude);
                entries.cameras[0].position = Vec3f(0, 4, 2); // relief does not close the hole of the torus
                check_within_two(outlines(std::move(entries), 120, 2));
            }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("outline: nothing is told of low relief, of methods that displace, and of those that show no relief") {
        const ComparedScene low(smooth_scene("sphere", 0.002f), ""),
            high(smooth_scene("sphere", 0.5f), ""); // both of 24 x 24 pixels
        CHECK(told_px(low.load({Shade::exact}).scene) == 0);
        for (const Shade shade : {Shade::plain, Shade::roughness, Shade::displace})
            CHECK(told_px(high.load({shade, 0}).scene) == 0);
        for (const Shade shade : {Shade::constant_scale, Shade::blinn, Shade::exact, Shade::bump, Shade::normal})
            CHECK(told_px(high.load({shade}).scene) > 1);
    }

    TEST_CASE("outline: a plane that is seen from above has none, and an object behind another has none") {
        SceneEntries entries = smooth_scene("plane", 0.5f);
        entries.cameras[0].position = Vec3f(0, 5, 0), entries.cameras[0].orthographic = true;
        entries.cameras[0].height = 4;
        CHECK(told_px(load(entries)) == 0);
        SceneEntries hidden = smooth_scene("sphere", 0.5f);
        MeshEntry wall{.shape = "cube"};
        wall.placement.translate = Vec3f(0, 0.5f, 2), wall.placement.scale = Vec3f(2, 2, 0.1f);
        CHECK(told_px(load(hidden)) > 1);
        hidden.meshes.push_back(wall);
        CHECK(told_px(load(hidden)) == 0);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("outline: on real meshes what is told is within a factor of 2 of what is measured") {
        const auto data = test::shared_data();
        for (const char* file : {"meshes/spot/spot_triangulated.obj", "meshes/leeperrysmith/LeePerrySmith.obj"}) {
            const float part = 0.03f;
            CAPTURE(std::string(file));
            SceneEntries entries = test::relief_scene("", part);
            entries.meshes[0].file = (data / file).string(), entries.meshes[0].shape = "";
            entries.materials[0].relief.file = (data / "textures/heights/crater_dat.png").string();
            entries.materials[0].relief.relative = true;
            entries.materials[0].relief.midlevel = 0.0f; // a dent would remove thin parts altogether
            entries.cameras.clear();
            const Outlines found = outlines(entries, 160, 0);
            MESSAGE("told " << found.told << ", measured " << found.measured);
            check_within_two(found);
        }
    }
}
