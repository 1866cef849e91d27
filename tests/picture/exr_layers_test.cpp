#include "bake/picture/exr_layers.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

using Names = std::vector<std::string>;

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("exr_layers: colours of the main layer, in any case of letters, and alpha") {
        const auto chosen = [](const Names& channels) { return choose_layer(channels).channels; };
        CHECK(chosen({"A", "B", "G", "R", "Z"}) == Names{"R", "G", "B", "A"});
        CHECK(chosen({"a", "b", "g", "r"}) == Names{"r", "g", "b", "a"});
        CHECK(chosen({"B", "G", "R", "diffuse.B", "diffuse.G", "diffuse.R"}) == Names{"R", "G", "B"});
        CHECK(chosen({"rgba.A", "rgba.B", "rgba.G", "rgba.R"}) == Names{"rgba.R", "rgba.G", "rgba.B", "rgba.A"});
        CHECK(chosen({"Combined.B", "Combined.G", "Combined.R", "Depth.Z"}) ==
              Names{"Combined.R", "Combined.G", "Combined.B"});
        CHECK(chosen({"ViewLayer.AO.B", "ViewLayer.AO.G", "ViewLayer.AO.R", "ViewLayer.Combined.B",
                      "ViewLayer.Combined.G", "ViewLayer.Combined.R"})[0] == "ViewLayer.Combined.R");
        CHECK(chosen({"Z", "layer.B", "layer.G", "layer.R"}) == Names{"layer.R", "layer.G", "layer.B"});
        CHECK(chosen({"Y", "Z"}) == Names{"Y"});
        CHECK(chosen({"height.Y"}) == Names{"height.Y"});
        CHECK(chosen({"blue", "green", "red"}) == Names{"red", "green", "blue"});
    }

    TEST_CASE("exr_layers: a channel whose name says nothing belongs to the picture beside it") {
        const auto chosen = [](const Names& channels) { return choose_layer(channels).channels; };
        CHECK(chosen({"B", "G", "R", "sign"}) == Names{"R", "G", "B", "sign"});
        CHECK(chosen({"X", "Y", "Z", "sign"}) == Names{"X", "Y", "Z", "sign"});
        CHECK(choose_layer({"B", "G", "R", "sign"}).colours == 3);
        CHECK(chosen({"B", "G", "R", "id", "sign"}) == Names{"R", "G", "B"}); // more than a picture has
        CHECK(chosen({"B", "G", "R", "other.sign"}) == Names{"R", "G", "B"});
    }

    TEST_CASE("exr_layers: names that say nothing of colours leave all channels") {
        CHECK(choose_layer({"Z"}).channels == Names{"Z"});
        CHECK(choose_layer({"Z"}).colours == 0);
        CHECK(choose_layer({"b_u", "b_v"}).channels == Names{"b_u", "b_v"});
        CHECK(choose_layer({"b", "b_u", "b_v"}).channels.size() == 3);
        CHECK(choose_layer({"X", "Y", "Z"}).channels == Names{"X", "Y", "Z"});
        CHECK(choose_layer({"G", "R"}).channels == Names{"R", "G"});
    }

    TEST_CASE("exr_layers: names lose their layer, and what is left out is named") {
        const LayerChoice choice = choose_layer({"rgba.B", "rgba.G", "rgba.R", "depth.Z"});
        CHECK(choice.names == Names{"R", "G", "B"});
        CHECK(choice.left_out == Names{"depth.Z"});
        CHECK(choice.colours == 3);
    }
}
