#include "bake/base/error.h"
#include "bake/environment/file/radiance.h"
#include "cli/command.h"
#include <limits>

using namespace bake;

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

/// 4 x 3 texels of .5, three channels, with a NaN, an Inf, a negative value and 1e6.
Image<float> faulty_sky() {
    Image<float> image(4, 3, 3);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = 0.5f;
    image.at(2, 0, 1) = nan;
    image.at(0, 1, 0) = inf;
    image.at(3, 1, 2) = -2;
    image.at(1, 2, 0) = 1e6f;
    return image;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("radiance: every kind of fault is counted, and the first is placed") {
        const BadTexels bad = find_bad(faulty_sky(), 65504);
        CHECK(bad.nan == 1);
        CHECK(bad.infinite == 1);
        CHECK(bad.negative == 1);
        CHECK(bad.over == 1);
        CHECK(bad.texels == 4);
        CHECK(bad.x == 2);
        CHECK(bad.y == 0);
        CHECK(find_bad(faulty_sky()).over == 0);
        CHECK(to_text(bad, 65504) == "1 NaN, 1 infinite, 1 negative, 1 above 65504; first at column 2, row 0 (nan)");
    }

    TEST_CASE("radiance: a texel with several faults is one texel") {
        Image<float> image = faulty_sky();
        image.at(2, 0, 0) = -1;
        CHECK(find_bad(image, 65504).texels == 4);
        CHECK(find_bad(image, 65504).negative == 2);
    }

    TEST_CASE("radiance: zero blackens faulty texels, clamp mends values, and both leave the rest alone") {
        Image<float> zero = faulty_sky(), clamped = faulty_sky();
        CHECK(mend(zero, BadPolicy::zero, "sky.exr", 65504).texels == 4);
        CHECK(zero.at(2, 0, 0) == 0);
        CHECK(zero.at(1, 2, 2) == 0);
        CHECK(zero.at(1, 1, 0) == 0.5f);
        CHECK(mend(clamped, BadPolicy::clamp, "sky.exr", 65504).texels == 4);
        CHECK(clamped.at(2, 0, 0) == 0.5f);
        CHECK(clamped.at(2, 0, 1) == 0);
        CHECK(clamped.at(0, 1, 0) == 65504);
        CHECK(clamped.at(3, 1, 2) == 0);
        CHECK(clamped.at(1, 2, 0) == 65504);
        CHECK(find_bad(zero, 65504).texels == 0);
        CHECK(find_bad(clamped, 65504).texels == 0);
    }

    TEST_CASE("radiance: refusal names the file, the counts and the place") {
        Image<float> image = faulty_sky();
        try {
            mend(image, BadPolicy::refuse, "sky.exr");
            FAIL("not refused");
        } catch (const Error& error) {
            const std::string why = error.what();
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(why.starts_with("sky.exr: "));
            CHECK(why.find("1 NaN") != std::string::npos);
            CHECK(why.find("column 2, row 0") != std::string::npos);
        }
    }

    TEST_CASE("radiance: alpha is no light") {
        Image<float> image(2, 1, 4);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = 1;
        image.at(0, 0, 3) = -1;
        CHECK(find_bad(image, 65504, 3).texels == 0);
        CHECK(find_bad(image, 65504).texels == 1);
        for (const BadPolicy policy : {BadPolicy::zero, BadPolicy::clamp}) {
            image.at(1, 0, 3) = inf; // no file may hold that
            CHECK(mend(image, policy, "sky.exr", 65504, 3).infinite == 1);
            CHECK(image.at(1, 0, 3) == 1);
            CHECK(image.at(0, 0, 3) == -1);
        }
    }

    TEST_CASE("radiance: a file is read with all its values, which mend_sky judges") {
        const test::Folder folder;
        const std::string file = folder / "sky.exr";
        write_image(file, faulty_sky(), {.depth = Depth::float32});
        const Image<float> read = read_radiance(file);
        CHECK(read.at(3, 1, 2) == -2);
        CHECK(read.at(0, 1, 0) == inf);
    }

} // TEST_SUITE
