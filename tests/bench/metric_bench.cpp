// metric_bench [SIZE]: time and error of the metrics of bake compare on two pictures of SIZE x SIZE (512 unless given): waves of
// about 40 pixels, and the same with noise and a darker half. The error is the difference at each pixel from the formulas of the
// papers written down a second time, in double and with two-dimensional kernels (tests/verdict/metric), at every 17th pixel of
// every 17th row, in units of the metric. The limit is one pass that reads both pictures and writes one channel.
#include "bake/verdict/metric/hdr_flip.h"
#include "bake/verdict/metric/squared_error.h"
#include "bake/verdict/metric/ssim.h"
#include "bench.h"
#include "verdict/metric/pictures.h"
#include "verdict/metric/plain_flip.h"
#include "verdict/metric/plain_ssim.h"

using namespace bake;

namespace {

/// Differences between found(x, y) and right(x, y), `border` pixels from the sides of the picture.
template <class Found, class Right>
bench::Errors differences(int size, int border, const Found& found, const Right& right) {
    std::vector<float> errors;
    for (int y = border; y < size - border; y += 17)
        for (int x = border; x < size - border; x += 17)
            errors.push_back(float(std::abs(double(found(x, y)) - right(x, y))));
    return bench::errors_of(std::move(errors));
}

double plain_squared_error(const Image<float>& a, const Image<float>& b, int x, int y) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c)) - double(b.at(x, y, c)), 2) / 3;
    return sum;
}

/// Both pictures at each exposure as HDR-FLIP shows them.
struct Toned {
    std::vector<Image<float>> a, b;
    Toned(const Image<float>& reference, const Image<float>& test, const ExposureRange& range) {
        for (int i = 0; i < range.count; ++i)
            for (const bool first : {true, false}) {
                const Image<float>& p = first ? reference : test;
                (first ? a : b).push_back(test::picture(p.width(), p.height(), 3, [&](int x, int y, int c) {
                    return std::min(1.0, aces_curve(double(p.at(x, y, c)) * std::exp2(range.at(i))));
                }));
            }
    }
    double error(int x, int y) const {
        double largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, test::PlainFlip{a[i], b[i], flip_pixels_per_degree}.error(x, y));
        return largest;
    }
};

void rows(int size) {
    const Image<float> a = test::picture(
        size, size, 3, [](int x, int y, int c) { return 0.5 + 0.4 * std::sin(0.16 * x + c) * std::cos(0.13 * y); });
    const Image<float> b = test::picture(size, size, 3, [&](int x, int y, int c) {
        return double(a.at(x, y, c)) * (2 * x < size ? 1 : 0.8) + 0.1 * (test::noise(x, y, c) - 0.5);
    });
    const Image<float> grey_a = luma(a), grey_b = luma(b);
    const ExposureRange range = exposure_range(a);
    const Toned toned(a, b, range);
    Image<float> room(size, size, 1);
    const auto of = [](const Image<float>& errors) { return [&errors](int x, int y) { return errors.at(x, y); }; };
    const auto turns = bench::in_turn(
        3, {[&] {
            for_rows(size, 16, [&](std::int64_t begin, std::int64_t end) {
                for (auto y = int(begin); y < int(end); ++y)
                    for (int x = 0; x < size; ++x)
                        room.at(x, y) = a.at(x, y, 0) + a.at(x, y, 1) + a.at(x, y, 2) + b.at(x, y, 0) + b.at(x, y, 1) +
                                        b.at(x, y, 2);
            });
        }},
        {{[&] { return squared_errors(a, b); },
          [&](const SquaredErrors& found) {
              return differences(size, 0, of(found.picture),
                                 [&](int x, int y) { return plain_squared_error(a, b, x, y); });
          }},
         {[&] { return ssim(luma(a), luma(b)); },
          [&](const Ssim& found) {
              const int border = ssim_window / 2;
              return differences(
                  size, border, [&](int x, int y) { return found.errors.at(x - border, y - border); },
                  [&](int x, int y) { return 1 - test::plain_ssim(grey_a, grey_b, x - border, y - border); });
          }},
         {[&] { return flip(a, b); },
          [&](const Image<float>& found) {
              const test::PlainFlip plain{a, b, flip_pixels_per_degree};
              return differences(size, 0, of(found), [&](int x, int y) { return plain.error(x, y); });
          }},
         {[&] { return hdr_flip(a, b, range); },
          [&](const Image<float>& found) {
              return differences(size, 0, of(found), [&](int x, int y) { return toned.error(x, y); });
          }}});
    const char* const names[] = {"rmse and psnr", "ssim", "flip", "hdr-flip"};
    for (std::size_t i = 0; i < turns.works.size(); ++i)
        bench::print_row(turns.works[i],
                         {"metric", names[i], size, double(size) * size, turns.works[i].ratio_to(turns.limits[0]),
                          "read+write pass",
                          bench::text("%.0f ms in all; difference from the papers' formulas in double; in units "
                                      "of the metric; not degrees",
                                      1e3 * turns.works[i].median())});
}

} // namespace

int main(int argc, char** argv) {
    const int size = argc > 1 ? std::atoi(argv[1]) : 512;
    if (size < 64 || size > 4096) return std::fprintf(stderr, "usage: metric_bench [SIZE], 64 to 4096\n"), 2;
    rows(size);
}
