#include "bake/base/error.h"
#include "bake/picture/webp.h"
#include "bake/verdict/report/report_page.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace {

std::vector<ReportPicture> noise_pictures(int count, int size) {
    std::vector<ReportPicture> all;
    for (int i = 0; i < count; ++i) {
        ReportPicture one{std::to_string(i), noisy(size, size, unsigned(i)), {}};
        if (i > 0) one.errors = picture(size, size, 1, [&](int x, int y, int) { return noise(x, y, 9, unsigned(i)); });
        all.push_back(std::move(one));
    }
    return all;
}

double bytes(const StoredPictures& stored) {
    double sum = 0;
    for (const StoredPicture& p : stored.pictures)
        sum += double(p.shown.size() + p.highlights.size() + p.errors.size());
    return sum;
}

double level(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("webp: a lossless file gives the same levels; a lossy one is smaller and near") {
        Image<unsigned char> rgb(37, 21, 3);
        for (std::size_t i = 0; i < rgb.size(); ++i)
            rgb.data()[i] = static_cast<unsigned char>(255 * noise(int(i), 0, 0));
        const std::string exact = encode_webp(rgb, 101), lossy = encode_webp(rgb, 80);
        CHECK(lossy.size() < exact.size());
        const Image<unsigned char> back = decode_webp(exact);
        REQUIRE(back.size() == rgb.size());
        CHECK(std::equal(rgb.data(), rgb.data() + rgb.size(), back.data()));
        CHECK(encode_webp(rgb, 80) == lossy);
        CHECK(decode_webp("RIFFno").empty());
        CHECK_THROWS_AS(encode_webp(Image<unsigned char>(), 80), Error);
        CHECK_THROWS_AS(encode_webp(Image<unsigned char>(16384, 1, 3), 80), Error);
    }

    TEST_CASE("stored pictures: with room, shown values are exact to half a level and highlights to half a step") {
        const float values[] = {0, 0.001f, 0.2f, 0.5f, 0.9f, 3, 100, -1, std::numeric_limits<float>::quiet_NaN()};
        std::vector<ReportPicture> all(1);
        all[0].picture = picture(9, 1, 3, [&](int x, int, int c) { return c == 0 ? values[x] : 0.f; });
        const StoredPictures stored = store_pictures(all, 0.5f, 1e6);
        CHECK(stored.quality == 101);
        CHECK(stored.rms_levels == 0);
        const Image<unsigned char> shown = decode_webp(stored.pictures[0].shown);
        const Image<unsigned char> bright = decode_webp(stored.pictures[0].highlights);
        REQUIRE(shown.width() == 9);
        REQUIRE(bright.width() == 9);
        for (int x = 0; x < 9; ++x) {
            const double v = values[x] > 0 ? values[x] * std::sqrt(2.0) : 0;
            CHECK(std::abs(shown.at(x, 0) - level(std::min(v, 1.0))) <= 0.5001);
            if (v <= 1) CHECK(bright.at(x, 0) == 0);
            else
                CHECK(std::abs(bright.at(x, 0) / 255.0 * highlight_stops - std::log2(v)) <=
                      0.5001 / 255 * highlight_stops);
            CHECK(bright.at(x, 0, 1) == 0);
        }
        CHECK(stored.pictures[0].errors.empty());
    }

    TEST_CASE("stored pictures: without room, all have one lower quality, errors are halved, and the loss is told") {
        const std::vector<ReportPicture> all = noise_pictures(3, 65);
        const StoredPictures wide = store_pictures(all, 0, 1e6), tight = store_pictures(all, 0, 9000);
        CHECK(bytes(tight) <= 9000);
        CHECK(tight.quality < wide.quality);
        CHECK(!wide.halved_errors);
        CHECK(tight.halved_errors);
        CHECK(decode_webp(wide.pictures[1].errors).width() == 65);
        CHECK(decode_webp(tight.pictures[1].errors).width() == 33);
        const auto mean = [](const Image<unsigned char>& levels) {
            double sum = 0;
            for (std::size_t i = 0; i < levels.size(); ++i) sum += double(levels.data()[i]);
            return sum / double(levels.size());
        };
        CHECK(mean(decode_webp(tight.pictures[1].errors)) ==
              doctest::Approx(mean(decode_webp(wide.pictures[1].errors))).epsilon(0.05));
        double squares = 0, n = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Image<unsigned char> back = decode_webp(tight.pictures[i].shown);
            for (std::size_t k = 0; k < back.size(); ++k, ++n)
                squares += std::pow(back.data()[k] - std::round(level(all[i].picture.data()[k])), 2);
        }
        CHECK(tight.rms_levels == doctest::Approx(std::sqrt(squares / n)).epsilon(1e-3));
        CHECK(tight.p99_levels > tight.rms_levels);
    }

    TEST_CASE("stored pictures: errors take 15 % of the bytes and no more") {
        const std::vector<ReportPicture> all = noise_pictures(3, 65);
        for (double budget = 4000; budget <= 14000; budget += 1000) {
            const StoredPictures stored = store_pictures(all, 0, budget);
            double errors = 0;
            for (const StoredPicture& p : stored.pictures) errors += double(p.errors.size());
            CHECK(errors <= 0.15 * budget);
        }
        CHECK(
            !store_pictures(noise_pictures(2, 33), 0, 5000).pictures[1].errors.empty()); // one method and its reference
    }

    TEST_CASE("stored pictures: 11 pictures of 1024 x 1024 leave 60 KB for the page below 3 MB") {
        CHECK(report_budget(11 * 1024.0 * 1024) * 4 / 3 + 60e3 < 3e6);
        CHECK(report_budget(100) == report_budget(11 * 1024.0 * 1024));
        CHECK(report_budget(44 * 1024.0 * 1024) == doctest::Approx(4 * report_budget(100)));
    }
}
