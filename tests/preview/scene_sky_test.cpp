// Keys of a scene for light of the sky from filtered levels, and for translucency.
#include "bake/base/error.h"
#include "bake/preview/scene_io.h"
#include "cli/command.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

SceneEntries entries(const std::string& lines) {
    const Folder folder;
    write_file(folder / "s.toml", lines);
    return read_scene(folder / "s.toml");
}

std::string refusal(const std::string& lines) {
    try {
        entries(lines);
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::unreadable);
        return error.what();
    }
    return "";
}

const std::string sky = "[sky]\nimage = \"sky.exr\"\n", material = "[[material]]\nname = \"m\"\n";

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene_sky: levels of the sky and their light") {
        const SceneEntries s =
            entries("[render]\nsky-light = \"irradiance\"\n" + sky +
                    "irradiance = \"e_%s.exr\"\nspecular = \"g_%s.exr\"\nspecular-roughness = [0, 0.25, 1]\n");
        CHECK(s.settings.sky_light == SkyLighting::irradiance);
        CHECK(s.sky.irradiance.ends_with("e_%s.exr"));
        CHECK(s.sky.specular.ends_with("g_%s.exr"));
        CHECK(s.sky.alphas == std::vector<float>{0, 0.25f, 1});
    }

    TEST_CASE("scene_sky: what is missing or out of order in them is refused with its line") {
        const std::string file = "specular = \"g_%s.exr\"\n";
        CHECK(refusal(sky + file).find(":3: [sky] \"specular-roughness\" is missing") != std::string::npos);
        CHECK(refusal(sky + "specular-roughness = [0]\n").find("is missing; give its file") != std::string::npos);
        CHECK(refusal(sky + "specular = \"g.exr\"\nspecular-roughness = [0]\n").find("has no %s") != std::string::npos);
        for (const char* list : {"[]", "0.5", "[0, \"a\"]", "[0.5, 0.1]", "[0, 2]", "[-1, 0]", "[0.5, 0.5]"})
            CHECK(refusal(sky + file + "specular-roughness = " + list + "\n").find("rising numbers from 0 to 1") !=
                  std::string::npos);
    }

    TEST_CASE("scene_sky: smaller skies") {
        const SkyReduction both = entries(sky + "face-size = 64\nsh-bands = 3\n").sky.reduction;
        CHECK(both.face_size == 64);
        CHECK(both.sh_bands == 3);
        CHECK(entries(sky).sky.reduction.face_size == 0);
        CHECK(entries(sky).sky.reduction.sh_bands == 0);
        CHECK(refusal(sky + "face-size = 0\n").find(":3: [sky] \"face-size\" is 0, outside 1 to") != std::string::npos);
        CHECK(refusal(sky + "face-size = 6.5\n").find("is not a whole number") != std::string::npos);
        CHECK(refusal(sky + "sh-bands = 33\n").find(":3: [sky] \"sh-bands\" is 33, outside 1 to 32") !=
              std::string::npos);
    }

    TEST_CASE("scene_sky: translucency is off unless a mean free path is given") {
        const Reflectance off = entries(material).materials.at(0).reflectance;
        CHECK(off.subsurface == Vec3f(0));
        const Reflectance one = entries(material + "subsurface = 0.5\n").materials.at(0).reflectance;
        CHECK(one.subsurface == Vec3f(0.5f));
        CHECK(one.translucency == 1);
        const Reflectance three =
            entries(material + "subsurface = [1, 0.5, 0.25]\ntranslucency = 0.75\n").materials.at(0).reflectance;
        CHECK(three.subsurface == Vec3f(1, 0.5f, 0.25f));
        CHECK(three.translucency == 0.75f);
        CHECK(refusal(material + "translucency = 0.5\n")
                  .find(":3: [[material]] \"translucency\" has no \"subsurface\"") != std::string::npos);
        CHECK(refusal(material + "subsurface = -1\n").find(":3: ") != std::string::npos);
        CHECK(refusal(material + "subsurface = 1\ntranslucency = 2\n").find(":4: ") != std::string::npos);
    }

} // TEST_SUITE
