#include "bake/relief/height/height.h"
#include "bake/relief/height/sample_type.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

ImageInfo info_of(SampleType type, int bits) {
    ImageInfo info;
    info.type = type;
    info.bits = bits;
    return info;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("default_midlevel: values of floats and of signed integers have a zero of their own") {
        CHECK(default_midlevel(info_of(SampleType::u8, 8)) == 0.5);
        CHECK(default_midlevel(info_of(SampleType::u16, 16)) == 0.5);
        CHECK(default_midlevel(info_of(SampleType::half, 16)) == 0);
        CHECK(default_midlevel(info_of(SampleType::float32, 32)) == 0);
        CHECK(default_midlevel(info_of(SampleType::other, 64)) == 0); // double
        CHECK(default_midlevel(info_of(SampleType::i16, 16)) == 0);
    }

    TEST_CASE("invert: about the midlevel, so that what lies on the surface stays there") {
        const auto inverted = [](SampleType type, std::optional<double> midlevel) {
            HeightTexture height;
            height.info = info_of(type, 16);
            height.values = Image<float>(1, 1, 1);
            height.values.at(0, 0) = 0.25f;
            invert(height, midlevel);
            return height.values.at(0, 0);
        };
        CHECK(inverted(SampleType::u16, {}) == 0.75f);
        CHECK(inverted(SampleType::half, {}) == -0.25f);
        CHECK(inverted(SampleType::half, 0.5) == 0.75f);
    }

    TEST_CASE("is_cut: only where the reader gives fewer bits than the file has") {
        CHECK(is_cut(info_of(SampleType::u8, 16)));
        CHECK_FALSE(is_cut(info_of(SampleType::u8, 8)));
        CHECK_FALSE(is_cut(info_of(SampleType::u8, 4)));
        CHECK_FALSE(is_cut(info_of(SampleType::u16, 12)));
        CHECK_FALSE(is_cut(info_of(SampleType::float32, 32)));
    }
}
