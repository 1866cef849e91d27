#include "bake/verdict/compare/comparison_pictures.h"
#include "bake/verdict/compare/scene_comparison.h"
#include "verdict/compare/relief_scene.h"
#include <cmath>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace bake;
using test::relief_scene;

TEST_SUITE("oracle") {
    TEST_CASE(
        "scene_comparison: over 100 seeds one standard error covers the true squared error 60 to 75 % of the time") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.15f);
        entries.settings.filter = TextureFilter::off; // a filter depends on the number of samples
        const ComparedScene compared(entries, "");
        const MethodScene bump = compared.load({Shade::exact}), displaced = compared.load({Shade::displace, 3});
        const std::vector<std::uint8_t> pixels = pixels_of_either(object_mask(bump.scene, bump.of_object, 4),
                                                                  object_mask(displaced.scene, displaced.of_object, 4));
        const auto square = [&](int spp, std::uint32_t seed) {
            RenderSettings settings = compared.settings();
            settings.spp = spp, settings.seed = seed;
            return square_error(render_halves(displaced.scene, settings), render_halves(bump.scene, settings), -2,
                                pixels);
        };
        const Estimate truth = square(1024, 12345);
        REQUIRE(truth.error < 0.01 * truth.value);
        int covered = 0;
        double bias = 0;
        for (std::uint32_t seed = 1; seed <= 100; ++seed) {
            const Estimate one = square(8, seed);
            covered += std::abs(one.value - truth.value) <= one.error;
            bias += (one.value - truth.value) / (100 * truth.value);
        }
        CHECK(covered >= 60);
        CHECK(covered <= 75);
        CHECK(std::abs(bias) < 0.005);
    }
}

TEST_SUITE("unit") {
    TEST_CASE(
        "scene_comparison: rows in the order asked for, the reference itself exactly 0, worse than plain is told") {
        SceneCompareOptions options;
        options.methods = {{Shade::blinn}, {Shade::displace, 2}, {Shade::plain}};
        options.reference = ShadeMethod{Shade::displace, 2};
        std::vector<std::string> told;
        options.told = [&](const std::string& line) { told.push_back(line); };
        const SceneComparison comparison = compare_scene(relief_scene("sphere:R=1", 0.1f), "ball", options);
        REQUIRE(comparison.rows.size() == 3);
        CHECK(comparison.rows[0].method == "blinn");
        CHECK(comparison.rows[1].method == "displace:4");
        CHECK(comparison.rows[2].method == "plain");
        CHECK(comparison.reference.method == "displace:4");
        CHECK(comparison.reference.why == "as asked for");
        const PictureErrors& same = comparison.rows[1].errors;
        CHECK(same.object.square.value == 0);
        CHECK(same.object.flip.value == 0);
        CHECK(same.angles.max == 0);
        CHECK((same.outline.known && same.outline.max == 0));
        CHECK(std::isinf(same.frame.psnr.value));
        CHECK(comparison.rows[0].errors.object.rmse.value > 0);
        CHECK(comparison.rows[0].errors.object.rmse.value < comparison.rows[2].errors.object.rmse.value);
        CHECK(comparison.rows[1].on_time_front);
        CHECK(told.size() == 4);
        const auto json = nlohmann::json::parse(
            to_json(comparison, "s.toml", [](const std::string& method) { return "c " + method; }));
        CHECK(json["command"] == "c ");
        CHECK(json["methods"][2]["command"] == "c plain");
        CHECK(json["methods"][0]["object"]["rmse"]["value"] == comparison.rows[0].errors.object.rmse.value);
        // Deep dents that are displaced out of sight are worse as bumps than as nothing.
        for (const std::string& note : comparison.notes) CHECK(note.find("worse than no relief") == std::string::npos);
    }

    TEST_CASE("comparison_pictures: a picture and an error per method, and a sheet and charts that name them all") {
        SceneCompareOptions options;
        options.methods = {{Shade::plain}, {Shade::bump_roughness}, {Shade::displace, 1}};
        options.reference = ShadeMethod{Shade::displace, 2};
        const SceneComparison comparison = compare_scene(relief_scene("torus:R=1,r=0.4", 0.1f), "", options);
        const std::vector<NamedPicture> pictures = method_pictures(comparison);
        std::vector<std::string> names;
        for (const NamedPicture& picture : pictures) {
            names.push_back(picture.name);
            CHECK((picture.picture.width() == 24 && picture.picture.height() == 24 && picture.picture.channels() == 3));
            for (std::size_t i = 0; i < picture.picture.size(); ++i)
                REQUIRE((picture.picture.data()[i] >= 0 && picture.picture.data()[i] <= 1));
        }
        CHECK(names == std::vector<std::string>{"reference.png", "plain.png", "plain_error.png", "bump_roughness.png",
                                                "bump_roughness_error.png", "displace_2.png", "displace_2_error.png"});
        CHECK(comparison_sheet(comparison).width() > 4 * 24);
        for (const std::string& svg : {time_chart(comparison), bytes_chart(comparison)})
            for (const char* label : {">plain<", ">bump+roughness<", ">displace:2<"})
                CHECK_MESSAGE(svg.find(label) != std::string::npos, std::string(label));
    }
}
