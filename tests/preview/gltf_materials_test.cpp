#include "bake/preview/gltf_objects.h"
#include "preview/gltf_square.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

double linear(double encoded) { return std::pow((encoded + 0.055) / 1.055, 2.4); }

/// A level of 8 bits, all above the linear part of sRGB.
float level(int x, int y, int c) { return float(40 + 45 * x + 10 * y + 20 * c) / 255; }

Bsdf bsdf_of(const Scene& scene, float x, float y) {
    return bsdf_at(*scene.instances[0].material, *scene.instances[0].shape, point_of_square(x, y));
}

Vec3f normal_of(const Scene& scene, float x, float y) {
    return shading_normal(*scene.instances[0].material, *scene.instances[0].shape, point_of_square(x, y));
}

double apart(const Vec3f& a, const Vec3f& b) { return double(glm::length(a - b)); }

std::string texture_on(const std::string& key, const std::string& more = "") {
    return "\"" + key + R"(":{"index":0)" + more + "}";
}

std::string moved_by(const std::string& transform) {
    return R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}";
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("glTF base colour: factor times sRGB texture times vertex colour") {
        const Folder folder;
        write_texels(folder, 4, 3, level);
        const Scene scene =
            square_scene(folder, square_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.8,1,1],)" +
                                                 texture_on("baseColorTexture") + "}}",
                                             R"("TEXCOORD_0":1,"COLOR_0":3)", texel_texture()));
        const Vec3f factor(0.5f, 0.8f * 0.5f, 0.25f);
        for (const int x : {0, 1, 2, 3})
            for (const int y : {0, 1, 2, 3}) { // rows from the top
                const Vec3f seen = at_point(scene, (x + 0.5) / 4, 1 - (y + 0.5) / 4);
                for (int c = 0; c < 3; ++c)
                    CHECK(seen[c] == doctest::Approx(factor[c] * linear(double(level(x, y, c)))).epsilon(1e-5));
            }
    }

    TEST_CASE("glTF metallic-roughness: green is roughness, blue metal, not decoded from sRGB") {
        const Folder folder;
        write_texels(folder, 2, 3, [](int, int, int c) { return c == 0 ? 1.f : c == 1 ? 0.4f : 0.6f; });
        const Scene scene = square_scene(
            folder, square_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.5,0.2,1],"metallicFactor":0.5,)"
                                R"("roughnessFactor":0.75,)" +
                                    texture_on("metallicRoughnessTexture") + "}}",
                                R"("TEXCOORD_0":1)", texel_texture()));
        const Bsdf bsdf = bsdf_of(scene, 0.3f, 0.6f);
        const Bsdf expected = metallic_roughness({0.9f, 0.5f, 0.2f}, 0.5f * 0.6f, 0.75f * 0.4f);
        REQUIRE(bsdf.count == 2);
        CHECK(bsdf.lobes[0].roughness == doctest::Approx(expected.lobes[0].roughness));
        for (const std::size_t lobe : {0, 1}) CHECK(apart(bsdf.lobes[lobe].weight, expected.lobes[lobe].weight) < 1e-6);
    }

    TEST_CASE("glTF emission: factor times texture times strength, and without a material extension once") {
        const Folder folder;
        write_texels(folder, 4, 3, level);
        const std::string emissive = R"("emissiveFactor":[0.5,1,0.25],)" + texture_on("emissiveTexture");
        const Scene once =
            square_scene(folder, square_gltf("{" + emissive + "}", R"("TEXCOORD_0":1)", texel_texture()));
        const Scene strong = square_scene(
            folder,
            square_gltf("{" + emissive + R"(,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}}})",
                        R"("TEXCOORD_0":1)", texel_texture()));
        const Vec3f a = bsdf_of(once, 0.375f, 0.625f).emission, b = bsdf_of(strong, 0.375f, 0.625f).emission;
        CHECK(a.y == doctest::Approx(linear(double(level(1, 1, 1)))).epsilon(1e-5));
        CHECK(a.z == doctest::Approx(0.25 * linear(double(level(1, 1, 2)))).epsilon(1e-5));
        CHECK(apart(b, 8.f * a) < 1e-5);
    }

    TEST_CASE("glTF unlit: the base colour is seen in any light") {
        const Folder folder;
        const std::string material = R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,1]},)"
                                     R"("emissiveFactor":[1,1,1],"extensions":{"KHR_materials_unlit":{}}})";
        SceneEntries entries = square_entries(folder, square_gltf(material));
        for (const float light : {0.f, 5.f}) {
            entries.ambient = Vec3f(light);
            entries.lights = {directional({0, 0, 1})};
            const Vec3f seen = at_point(load(entries), 0.4, 0.7);
            CHECK(apart(seen, {0.2f, 0.4f, 0.6f}) < 1e-6);
        }
    }

    TEST_CASE("glTF normal map: x and y are scaled, along the uvs of its own set") {
        const Folder folder;
        const float x = 200.f / 255, y = 100.f / 255, z = 230.f / 255;
        write_texels(folder, 2, 3, [&](int, int, int c) { return c == 0 ? x : c == 1 ? y : z; });
        const auto normal = [&](const std::string& more) {
            return normal_of(square_scene(folder, square_gltf("{" + texture_on("normalTexture", more) + "}",
                                                              R"("TEXCOORD_0":1,"TEXCOORD_1":2)", texel_texture())),
                             0.6f, 0.2f);
        };
        const Vec3f t(2 * x - 1, 2 * y - 1, 2 * z - 1);
        CHECK(apart(normal(""), glm::normalize(t)) < 1e-5);
        CHECK(apart(normal(R"(,"scale":0.5)"), glm::normalize(t * Vec3f(0.5f, 0.5f, 1))) < 1e-5);
        CHECK(apart(normal(R"(,"scale":0)"), {0, 0, 1}) < 1e-5);
        // On set 1, u grows along +y and v along -x.
        CHECK(apart(normal(R"(,"texCoord":1)"), glm::normalize(Vec3f(-t.y, t.x, t.z))) < 1e-5);
        // A transform that turns the picture turns the tangents.
        const Vec3f turned = normal(moved_by(R"("rotation":1.5707963267948966)"));
        CHECK(turned.z == doctest::Approx(glm::normalize(t).z));
        CHECK(apart(turned, glm::normalize(t)) > 0.3);
    }

    TEST_CASE("glTF textures: KHR_texture_transform and texCoord, each texture its own") {
        const Folder folder;
        write_texels(folder, 4, 3, level);
        // Emission on set 1, whose (u, v) = (y, 1 - x); the base colour is scaled, turned and moved.
        const Scene scene = square_scene(
            folder, square_gltf(R"({"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{)" +
                                    texture_on("baseColorTexture",
                                               moved_by(R"("scale":[0.5,0.25],"rotation":0.3,"offset":[0.1,0.2])")) +
                                    "}," + texture_on("emissiveTexture", R"(,"texCoord":1)") + "}",
                                R"("TEXCOORD_0":1,"TEXCOORD_1":2)", texel_texture()));
        const Texture texels = read_albedo(folder / "t.png", ColourSpace::srgb);
        for (const auto& [x, y] : {std::pair(0.2f, 0.7f), std::pair(0.8f, 0.4f), std::pair(0.5f, 0.1f)}) {
            const Bsdf bsdf = bsdf_of(scene, x, y);
            CHECK(apart(bsdf.emission, lookup3(*texels, {y, 1 - x})) < 1e-5);
            // In the file's v, which points down: offset * rotation * scale, as the extension writes it.
            const double u = 0.5 * double(x), v = 0.25 * (1 - double(y)), c = std::cos(0.3), s = std::sin(0.3);
            const Vec2f moved(float(c * u + s * v + 0.1), float(1 - (-s * u + c * v + 0.2)));
            CHECK(apart(bsdf.ambient, lookup3(*texels, moved)) < 1e-5);
        }
    }

    TEST_CASE("glTF samplers: clamp, mirror and nearest, beyond the unit square") {
        const Folder folder;
        write_texels(folder, 4, 3, level);
        const Texture texels = read_albedo(folder / "t.png", ColourSpace::srgb);
        const auto seen = [&](const std::string& sampler, float x) {
            // The uvs reach from -1 to 2.
            const Scene scene = square_scene(
                folder,
                square_gltf(R"({"pbrMetallicRoughness":{)" +
                                texture_on("baseColorTexture", moved_by(R"("scale":[3,1],"offset":[-1,0])")) + "}}",
                            R"("TEXCOORD_0":1)", texel_texture(sampler)));
            return bsdf_of(scene, (x + 1) / 3, 0.625f).ambient;
        };
        const auto texel = [&](float u) { return lookup3(*texels, {u, 0.625f}); };
        for (const float x : {0.375f, 0.5f, 0.8f}) {
            CHECK(apart(seen("", x - 1), texel(x)) < 1e-4);
            CHECK(apart(seen(R"("wrapS":33648)", x + 1), texel(1 - x)) < 1e-4);
            CHECK(apart(seen(R"("wrapS":33648)", -x), texel(x)) < 1e-4);
            CHECK(apart(seen(R"("wrapS":33071)", x), texel(x)) < 1e-4);
            CHECK(apart(seen(R"("wrapS":33071)", x + 1), texel(0.875f)) < 1e-4);
            CHECK(apart(seen(R"("wrapS":33071)", x - 1), texel(0.125f)) < 1e-4);
        }
        CHECK(apart(seen(R"("magFilter":9728)", 0.49f), texel(0.375f)) < 1e-5);
        CHECK(apart(seen(R"("magFilter":9728)", 0.51f), texel(0.625f)) < 1e-5);
    }

    TEST_CASE(
        "glTF occlusion: ambient light and the sky's diffuse light, by its strength; not lights, not highlights") {
        const Folder folder;
        write_texels(folder, 2, 3, [](int, int, int c) { return c == 0 ? 0.4f : 1.f; });
        const auto of = [&](const std::string& more, bool sky) {
            const std::string material =
                R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.6})" + more + "}";
            SceneEntries entries = square_entries(folder, square_gltf(material, R"("TEXCOORD_0":1)", texel_texture()));
            entries.lights = {directional({0, 0, 1})};
            Scene scene = load(entries);
            if (sky) {
                scene.sky.cube = constant_cube({0.5f, 0.6f, 0.7f});
                scene.lights.clear();
                build(scene);
            }
            const Ray ray = primary_ray(camera_frame(scene.camera), 30, 30, 64, 64);
            return trace_one(scene, ray, 1, Sampler(3, 5, 0)).radiance;
        };
        const std::string full = "," + texture_on("occlusionTexture");
        const std::string half = "," + texture_on("occlusionTexture", R"(,"strength":0.5)");
        for (const bool sky : {false, true}) {
            const Radiance plain = of("", sky), dark = of(full, sky), less = of(half, sky);
            CHECK(apart(dark.emitted, 0.4f * plain.emitted) < 1e-6);
            CHECK(apart(less.emitted, 0.7f * plain.emitted) < 1e-6);
            CHECK(apart(dark.diffuse, (sky ? 0.4f : 1.f) * plain.diffuse) < 1e-6);
            CHECK(apart(dark.specular, plain.specular) < 1e-6);
            CHECK(plain.diffuse.x > 0.1f);
            CHECK(plain.specular.x > 0);
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("glTF materials: what cannot be shown is told, and every pixel is finite") {
        struct Fault {
            std::string material, rest, named;
        };
        const std::string textured = R"({"pbrMetallicRoughness":{)" + texture_on("baseColorTexture") + "}}";
        const std::string image = R"(,"textures":[{"source":0}],"images":[)";
        const std::vector<Fault> faults = {
            {R"({"name":"m","pbrMetallicRoughness":{"metallicFactor":-3}})", "", "metallicFactor is -3; 0 is taken"},
            {R"({"pbrMetallicRoughness":{"roughnessFactor":1e300}})", "", "roughnessFactor is inf; 1 is taken"},
            {R"({"pbrMetallicRoughness":{"baseColorFactor":[9,1,1,1]}})", "", "baseColorFactor is 9; 1 is taken"},
            {R"({"emissiveFactor":[0,1e39,0]})", "", "emissiveFactor is inf"},
            {R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e39}}})",
             "", "without KHR_materials_emissive_strength"},
            {R"({"extensions":{"KHR_materials_clearcoat":{},"KHR_materials_sheen":{}}})", "",
             "shown without KHR_materials_clearcoat, KHR_materials_sheen"},
            {textured, image + R"({"uri":"none.png"}])", "image 0 'none.png' is missing"},
            {textured, image + R"({"uri":"data:image/png;base64,iVBORw0KGgo="}])", "image 0 cannot be used"},
            {textured, R"(,"textures":[{"extensions":{"KHR_texture_basisu":{"source":0}}}])",
             "in a format that is not read"},
            {R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})", "", "is blended"},
            {R"({"alphaMode":"MASK","alphaCutoff":-2})", "", "alphaCutoff is -2"},
        };
        for (const Fault& fault : faults) {
            CAPTURE(fault.named);
            const Folder folder;
            const Scene scene = square_scene(folder, square_gltf(fault.material, R"("TEXCOORD_0":1)", fault.rest));
            std::string all;
            for (const std::string& note : scene.notes) all += note + "\n";
            CHECK_MESSAGE(all.find(fault.named) != std::string::npos, all);
            CHECK(scene.notes.size() == 1);
            CHECK(all.find("bake_image_") == std::string::npos);
            const Vec3f seen = at_point(scene, 0.3, 0.6);
            CHECK(std::isfinite(seen.x + seen.y + seen.z));
        }
    }

    TEST_CASE("glTF materials: textures on faces without uvs, and on a set that is missing, are told") {
        const Folder folder;
        write_texels(folder, 2, 3, level);
        const auto notes = [&](const std::string& more, const std::string& attributes) {
            const Scene scene = square_scene(folder, square_gltf(R"({"name":"m","pbrMetallicRoughness":{)" +
                                                                     texture_on("baseColorTexture", more) + "}}",
                                                                 attributes, texel_texture()));
            std::string all;
            for (const std::string& note : scene.notes) all += note + "\n";
            return all;
        };
        CHECK(notes("", R"("COLOR_0":3)").find("material 'm': has textures, but its faces have no uvs") !=
              std::string::npos);
        CHECK(notes(R"(,"texCoord":3)", R"("TEXCOORD_0":1)").find("TEXCOORD_3, which is missing") != std::string::npos);
        CHECK(notes("", R"("TEXCOORD_0":1)").empty());
    }

    TEST_CASE("glTF materials: indices out of range, and transforms beyond all floats, are refused in one line") {
        const Folder folder;
        write_texels(folder, 2, 3, level);
        const std::string far = moved_by(R"("scale":[1e300,1e300])");
        for (const std::string& material :
             {R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":7}}})" + std::string(),
              R"({"pbrMetallicRoughness":{)" + texture_on("baseColorTexture", far) + "}}"}) {
            CAPTURE(material);
            try {
                square_scene(folder, square_gltf(material, R"("TEXCOORD_0":1)", texel_texture()));
                FAIL("not refused");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unreadable);
                CHECK(std::string(error.what()).rfind(folder / "s.gltf: ", 0) == 0);
            }
        }
    }

} // TEST_SUITE
