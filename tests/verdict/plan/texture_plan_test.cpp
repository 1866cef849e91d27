// What textures of little scenes are reduced to.
#include "bake/base/parallel.h"
#include "bake/picture/bc5.h"
#include "preview/little_scenes.h"
#include "verdict/plan/planned_texture.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Normals of height a sin(2 pi k u) over the square of edge 2.
Texture waves(int size, int k, float slope) {
    return texture(size, size, 3, [&](float u, float, float* t) {
        const Vec3f n = glm::normalize(Vec3f(-slope * std::cos(2 * pi_f * float(k) * u), 0, 1));
        for (int c = 0; c < 3; ++c) t[c] = n[c];
    });
}

/// A square that fills the picture, lit at an angle.
Scene square(Material material, int pixels = 48) {
    material.reflectance.diffuse = Vec3f(0.8f);
    Scene scene = one_mesh(plane_mesh(), std::move(material));
    scene.camera.position = Vec3f(0, 0, 2.5f);
    scene.settings.width = scene.settings.height = pixels;
    scene.lights = {directional({1, 0, 1})};
    build(scene);
    return scene;
}

Material with_normals(Texture map) {
    Material material;
    material.name = "relief";
    material.normal_map = std::move(map);
    return material;
}

PartOptions options(double budget) {
    PartOptions out;
    out.budget = budget;
    out.rule.most = 512;
    return out;
}

/// Normals as a texture file in BC5 has them, whose blocks are other ones when they are encoded again.
Texture noisy_blocks() {
    Image<float> noise(64, 64, 3);
    for (std::size_t i = 0; i < noise.size(); ++i) noise.data()[i] = 0.1f * float(std::sin(double(i * i)));
    bc5_round(noise);
    Image<float> again = copied(noise);
    bc5_round(again);
    REQUIRE(!std::equal(noise.data(), noise.data() + noise.size(), again.data()));
    return std::make_shared<const Image<float>>(std::move(noise));
}

/// A square as load() gives it, with the last material: the first one is that of meshes without one, then come those of
/// the entries, and copies of these.
Scene read_square(std::vector<Material> materials, int pixels = 16) {
    Scene scene;
    scene.shapes.push_back(make_shape(plane_mesh()));
    scene.materials.push_back(std::make_unique<Material>());
    for (Material& material : materials) scene.materials.push_back(std::make_unique<Material>(std::move(material)));
    add_instance(scene, *scene.shapes[0], *scene.materials.back());
    scene.settings.width = scene.settings.height = pixels;
    scene.lights = {directional({1, 0, 1})};
    build(scene);
    return scene;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("texture plan: a flat map becomes one texel") {
        const Scene scene = square(with_normals(waves(64, 1, 0)));
        const auto plans = plan_textures(scene, nullptr, options(0.005));
        REQUIRE(plans.size() == 1);
        CHECK(plans[0].kind == "normal");
        CHECK(plans[0].file == "relief");
        CHECK(plans[0].width == 1);
        CHECK(plans[0].channels == 2);
        CHECK(plans[0].bytes == 2);
        CHECK(plans[0].source_bytes == 3 * (64 * 64 + 32 * 32 + 16 * 16 + 64 + 16 + 4 + 1));
        // 128 / 255 is not the middle: the normal tilts by half a level each way, at 45 degrees to the light.
        const double step = 1.0 / 255, expected = 0.8 * (step * std::sqrt(0.5));
        CHECK(plans[0].error.rmse() == doctest::Approx(expected).epsilon(0.05));
    }

    TEST_CASE("texture plan: smooth waves need fewer texels than short ones") {
        const Scene smooth = square(with_normals(waves(64, 1, 0.3f))), fine = square(with_normals(waves(64, 24, 0.3f)));
        const auto few = plan_textures(smooth, nullptr, options(0.01)),
                   many = plan_textures(fine, nullptr, options(0.01));
        CHECK(few[0].width <= 32);
        CHECK(few[0].error.rmse() <= 0.011);
        CHECK(many[0].width == 64);
    }

    TEST_CASE("texture plan: without a budget a baked map gets its finest form, a file stays as it is") {
        const Scene scene = square(with_normals(waves(16, 3, 0.3f)), 16);
        const auto plan = plan_textures(scene, nullptr, options(0))[0];
        CHECK(plan.width == 16);
        CHECK(plan.channels == 3);
        CHECK(plan.bits == 16);
        SceneEntries entries; // whose first material is the scene's second one
        entries.materials.emplace_back().normal_map = "waves.exr";
        Scene read;
        read.shapes.push_back(make_shape(plane_mesh()));
        read.materials.push_back(std::make_unique<Material>());
        read.materials.push_back(std::make_unique<Material>(with_normals(waves(16, 3, 0.3f))));
        add_instance(read, *read.shapes[0], *read.materials[1]);
        read.settings.width = read.settings.height = 16;
        read.lights = {directional({1, 0, 1})};
        build(read);
        const auto kept = plan_textures(read, &entries, options(0))[0];
        CHECK(kept.file == "waves.exr");
        CHECK(kept.bits == 32);
        CHECK(kept.bytes == kept.source_bytes);
        CHECK(kept.error.rmse() == 0);
    }

    TEST_CASE("texture plan: a file of 8 bits is not made larger, and stays as it is where nothing smaller will do") {
        SceneEntries entries;
        entries.materials.emplace_back().albedo = "dots.png";
        Scene scene;
        scene.shapes.push_back(make_shape(plane_mesh()));
        scene.materials.push_back(std::make_unique<Material>());
        Material material;
        auto dots = std::make_shared<Image<float>>(8, 8, 3);
        for (std::size_t i = 0; i < dots->size(); ++i) dots->data()[i] = i % 5 == 0 ? 1.0f : 0.0f;
        material.albedo = dots;
        scene.materials.push_back(std::make_unique<Material>(material));
        add_instance(scene, *scene.shapes[0], *scene.materials[1]);
        scene.settings.width = scene.settings.height = 16;
        scene.lights = {directional({0, 0, 1})};
        build(scene);
        const auto plan = plan_textures(scene, &entries, options(0))[0];
        CHECK(plan.file == "dots.png");
        CHECK(plan.bits == 8);
        CHECK(plan.bytes == plan.source_bytes);
        CHECK(plan.why.starts_with("the file stays as it is"));
    }

    TEST_CASE("texture plan: the same texels give an error of 0, and other ones do not") {
        const Scene scene = square(with_normals(waves(32, 4, 0.3f)));
        Scene twin = twin_of(scene);
        WorstProbe probe(scene, frame_and_materials(scene), options(0.01));
        CHECK(probe.measure(twin, 256).error.square == 0);
        const int all[] = {0};
        set_texture(twin, all, TextureUse::normal, copied(*scene.materials[0]->normal_map));
        const SquareEstimate same = probe.measure(twin, 256).error;
        CHECK(same.square == 0);
        CHECK(same.error == 0);
        set_texture(twin, all, TextureUse::normal, copied(*waves(32, 4, 0.4f)));
        CHECK(probe.measure(twin, 256).error.rmse() > 0.01);
    }

    TEST_CASE(
        "texture plan: materials that share a picture have one plan, and textures of a material share the budget") {
        Scene scene;
        scene.shapes.push_back(make_shape(plane_mesh()));
        Material material = with_normals(waves(16, 1, 0.2f));
        material.albedo = texture(16, 16, 3, [](float u, float v, float* t) { t[0] = u, t[1] = v, t[2] = 0.5f; });
        scene.materials.push_back(std::make_unique<Material>(material));
        material.normal_map = {};
        scene.materials.push_back(std::make_unique<Material>(material));
        add_instance(scene, *scene.shapes[0], *scene.materials[0]);
        add_instance(scene, *scene.shapes[0], *scene.materials[1], {.translate = {2, 0, 0}});
        const auto textures = scene_textures(scene);
        REQUIRE(textures.size() == 2);
        CHECK(textures[0].use == TextureUse::normal);
        CHECK(textures[0].materials == std::vector{0});
        CHECK(textures[1].materials == std::vector{0, 1});
        scene.settings.width = scene.settings.height = 32;
        scene.lights = {directional({1, 0, 1})};
        build(scene);
        const auto plans = plan_textures(scene, nullptr, options(0.02));
        CHECK(plans[1].error.rmse() <= 1.1 * 0.02);
        CHECK(plans[0].error.rmse() <= 1.1 * 0.02 * std::sqrt(0.5));
        CHECK(plans[0].why.find(" of 0.014") != std::string::npos);
        CHECK(plans[1].why.find(" of 0.02") != std::string::npos);
    }

    TEST_CASE("texture plan: what no camera sees gets the smallest form") {
        Scene scene = square(with_normals(waves(16, 3, 0.3f)), 16);
        scene.camera.target = Vec3f(0, 0, 100);
        const auto plan = plan_textures(scene, nullptr, options(0))[0];
        CHECK(plan.bytes == 2);
        CHECK(plan.why == "no camera sees it");
    }

    TEST_CASE("texture plan: a planned texture is what was judged") {
        const Scene scene = square(with_normals(waves(64, 1, 0.3f)));
        const auto plan = plan_textures(scene, nullptr, options(0.01))[0];
        const SceneTexture source = scene_textures(scene)[0];
        const Image<float> texels = planned_texture(source, plan);
        CHECK(texels.width() == plan.width);
        Scene twin = twin_of(scene);
        set_texture(twin, source.materials, source.use, copied(texels));
        WorstProbe probe(scene, {objects_with(scene, std::vector<const Material*>{scene.materials[0].get()})},
                         options(0.01));
        CHECK(probe.measure(twin, int(plan.error.pixels)).error.square == doctest::Approx(plan.error.square));
    }

    TEST_CASE("texture plan: a normal map that may err like RGB8 is the smallest that does, whatever the budget") {
        const Scene scene = square(with_normals(waves(64, 2, 0.2f)));
        PartOptions like = options(0);
        like.like_rgb8 = true;
        const auto plan = plan_textures(scene, nullptr, like)[0];
        CHECK(form_of(plan).in_bc5());
        CHECK(plan.width == 64);
        CHECK(plan.error.rmse() <= plan.rgb8_rmse);
        // With other random numbers, over all pixels.
        const SceneTexture source = scene_textures(scene)[0];
        Scene twin = twin_of(scene);
        PartOptions other = like;
        other.seed = 9;
        WorstProbe probe(scene, {objects_with(scene, std::vector<const Material*>{scene.materials[0].get()})}, other);
        const auto error = [&](const TextureForm& form) {
            set_texture(twin, source.materials, source.use,
                        stored(halvings_of(*source.picture)[std::size_t(form.halvings)], source.use, form));
            return probe.measure(twin, 1 << 20).error.rmse();
        };
        CHECK(error({0, 64, 64, 3, 8}) == doctest::Approx(plan.rgb8_rmse).epsilon(0.1));
        CHECK(error(form_of(plan)) <= error({0, 64, 64, 3, 8}));
        CHECK(error({1, 32, 32, 3, 16}) > error({0, 64, 64, 3, 8}));
        CHECK(plan.why.find("RGB of 8 bits in full size by ") != std::string::npos);
        CHECK(plan_textures(scene, nullptr, options(0.01))[0].rgb8_rmse < 0);
    }

    TEST_CASE("texture plan: a file of 8 bits that may err like RGB8 stays, because that errs by nothing") {
        SceneEntries entries;
        entries.materials.emplace_back().normal_map = "waves.png";
        const Image<float> read = stored(*waves(16, 3, 0.3f), TextureUse::normal, {0, 16, 16, 3, 8});
        const Scene scene = read_square({with_normals(std::make_shared<const Image<float>>(copied(read)))});
        PartOptions like = options(1);
        like.like_rgb8 = true;
        const auto plan = plan_textures(scene, &entries, like)[0];
        CHECK(plan.bytes == plan.source_bytes);
        CHECK(plan.error.rmse() == 0);
        CHECK(plan.rgb8_rmse == 0);
        CHECK(plan.why.starts_with("nothing smaller errs as little"));
    }

    TEST_CASE(
        "texture plan: a texture file of normals is known to be in BC5, although its blocks are not found again") {
        SceneTexture texture{.name = "n.ktx2", .use = TextureUse::normal, .picture = noisy_blocks()};
        CHECK(source_form(texture) == TextureForm{0, 64, 64, 2, bc5_bits});
        texture.name = "n.exr";
        CHECK(source_form(texture).bits == 32);
        texture.name = "n.ktx2";
        texture.picture =
            std::make_shared<const Image<float>>(stored(*waves(16, 3, 0.3f), TextureUse::normal, {0, 16, 16, 3, 8}));
        CHECK(source_form(texture).bits == 8);
    }

    TEST_CASE("texture plan: a file is known to be in BC5 only if it can be, whatever its texels are") {
        Image<float> tilted(8, 8, 3);
        for (std::size_t i = 0; i < tilted.size(); ++i) tilted.data()[i] = i % 3 == 0 ? 0.6f : i % 3 == 1 ? 0 : 0.8f;
        bc5_round(tilted);
        SceneTexture texture{.use = TextureUse::normal};
        texture.picture = std::make_shared<const Image<float>>(std::move(tilted));
        for (const auto& [name, blocks] :
             {std::pair("n.dds", true), {"n.ktx2", true}, {"n.png", false}, {"n.exr", false}}) {
            texture.name = name;
            CHECK_MESSAGE(source_form(texture).in_bc5() == blocks, name);
        }
    }

    TEST_CASE("texture plan: blocks of a file that nothing smaller replaces stay as they are, for later textures too") {
        SceneEntries entries;
        entries.materials.emplace_back().normal_map = "n.ktx2";
        Material material = with_normals(noisy_blocks());
        material.albedo = texture(1, 1, 3, [](float, float, float* t) { t[0] = t[1] = t[2] = 1; }); // made, not read
        const Scene scene = read_square({material});
        PartOptions like = options(1);
        like.like_rgb8 = true;
        const auto plans = plan_textures(scene, &entries, like);
        REQUIRE(plans.size() == 2);
        CHECK(plans[0].bytes == plans[0].source_bytes);
        CHECK(plans[0].rgb8_rmse > 0);
        CHECK(plans[0].why.starts_with("nothing smaller errs as little"));
        CHECK(plans[0].error.square == 0);
        CHECK(plans[1].kind == "albedo");
        CHECK(plans[1].error.square == 0);
    }

    TEST_CASE("texture plan: a baked map that the scene shows in BC5 errs by nothing as it is") {
        SceneEntries entries;
        entries.materials.emplace_back().normal_bc5 = true;
        entries.meshes.emplace_back().material = 0;
        const Scene scene = read_square({Material(), with_normals(noisy_blocks())});
        const auto plan = plan_textures(scene, &entries, options(0))[0];
        CHECK(plan.meshes == std::vector{0});
        CHECK(form_of(plan).in_bc5());
        CHECK(plan.bytes == plan.source_bytes);
        CHECK(plan.error.square == 0);
    }

    TEST_CASE("texture plan: the same for any number of threads") {
        const Scene scene = square(with_normals(waves(32, 2, 0.3f)), 24);
        const auto plans = plan_textures(scene, nullptr, options(0.01));
        const ThreadLimit one(1);
        const auto again = plan_textures(scene, nullptr, options(0.01));
        CHECK(plans[0].error.square == again[0].error.square);
        CHECK(plans[0].why == again[0].why);
        CHECK(form_of(plans[0]) == form_of(again[0]));
    }
}
