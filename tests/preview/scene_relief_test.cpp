#include "bake/base/error.h"
#include "bake/preview/scene_io.h"
#include "bake/preview/scene_relief.h"
#include "cli/command.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// The relief of a [[material]] with these lines.
ReliefEntry relief(const std::string& lines) {
    const Folder folder;
    write_file(folder / "s.toml", "[[material]]\nname = \"m\"\n" + lines);
    return read_scene(folder / "s.toml").materials.at(0).relief;
}

std::string refusal(const std::string& lines) {
    try {
        relief(lines);
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::unreadable);
        return error.what();
    }
    return "";
}

ImageInfo file_of(SampleType type) {
    ImageInfo info;
    info.type = type;
    return info;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene_relief: every key of a height is read") {
        const ReliefEntry full = relief("height = {file = \"h.png\", amplitude = 0.25, midlevel = 0.75, "
                                        "filter = \"order6\", wrap = \"mirror\"}\nshade = \"displace:8\"\n");
        CHECK(full.file.ends_with("h.png"));
        CHECK(full.amplitude.value() == 0.25f);
        CHECK_FALSE(full.relative);
        CHECK(full.midlevel.value() == 0.75f);
        CHECK(full.filter == Filter::order6);
        CHECK(full.wrap == Wrap::mirror);
        CHECK(full.shade->shade == Shade::displace);
        CHECK(full.shade->levels == 3);
        CHECK(relief("height = \"h.png\"\n").file.ends_with("h.png"));
    }

    TEST_CASE("scene_relief: amplitudes in per cent, and the defaults of the commands") {
        const ReliefEntry part = relief("height = {file = \"h.png\", amplitude = \"2%\"}\n");
        CHECK(relief_options(part, file_of(SampleType::u8), 50).height.amplitude == doctest::Approx(1));
        const ReliefEntry plain = relief("height = \"h.png\"\n");
        const ReliefOptions integers = relief_options(plain, file_of(SampleType::u16), 50);
        CHECK(integers.height.amplitude == doctest::Approx(0.5)); // 1 %
        CHECK(integers.height.midlevel == 0.5);
        CHECK(integers.method.shade == Shade::exact);
        const ReliefOptions floats = relief_options(plain, file_of(SampleType::float32), 50);
        CHECK(floats.height.amplitude == 1);
        CHECK(floats.height.midlevel == 0);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("scene_relief: what cannot be meant is refused with its key") {
        CHECK(refusal("height = 3\n").find("\"height\"") != std::string::npos);
        CHECK(refusal("height = {amplitude = 1}\n").find("\"file\"") != std::string::npos);
        for (const char* bad : {"\"2\"", "\"x%\"", "\"nan%\"", "\"1e9%\"", "true"})
            CHECK(refusal(std::string("height = {file = \"h.png\", amplitude = ") + bad + "}\n").find("amplitude") !=
                  std::string::npos);
        CHECK(refusal("height = \"h.png\"\nshade = \"displace\"\n").find("displace:16") != std::string::npos);
        CHECK(refusal("height = \"h.png\"\nnormal = \"n.png\"\n").find("keep one") != std::string::npos);
    }

} // TEST_SUITE
