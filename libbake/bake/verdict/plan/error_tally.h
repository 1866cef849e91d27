// The mean squared error of a candidate over the area of an object, from pixels that are drawn at random.
//
// Of each pixel two independent halves of samples are rendered with the candidate and with the reference. Common random
// numbers do not remove the bias of a squared noisy difference, but the product of the differences of the two halves has
// none:
//   m = d_a . d_b / 3,   a = share of the samples that see the object in either picture
//   R = sum m / sum a,   q = m - R a,   se^2 = (sum q^2 + max |m|^2) / (sum a)^2
// The largest |m| counts twice, because one per cent of the pixels can carry half of the squared error, and few pixels may
// have missed them.
//
// That is the error of pixels drawn from a picture without end. Of a share f of all pixels of the object, drawn without
// replacement, it counts by 1 - f (Cochran, Sampling Techniques, 1977, section 2.6), and what is left is the noise within the
// visited pixels:
//   se^2 = ((1 - f) (sum q^2 + max |m|^2) + f (sum v + max v)) / (sum a)^2,   v = (|d_a|^2 - |d_b|^2)^2 / 36
// v is an estimate of the variance of m: of independent d_a and d_b with the same normal distribution, (d_a + d_b) /
// sqrt(2) and (d_a - d_b) / sqrt(2) are independent as well, and v is the square of 1/3 of their product. It is too small where a few samples see all of
// the difference: if one sample of each half does, d_a = d_b and v = 0.
#pragma once
#include <cmath>
#include <cstdint>

namespace bake {

struct PixelSquare {
    double m = 0, a = 0;
    double v = 0;
};

struct SquareEstimate {
    double square = 0;       ///< R; noise may make it negative
    double error = 0;        ///< one standard error of R
    std::int64_t pixels = 0; ///< with a > 0
    bool all = false;        ///< every pixel of the object was visited

    double rmse() const noexcept { return std::sqrt(std::fmax(0.0, square)); }
    double low() const noexcept { return std::sqrt(std::fmax(0.0, square - 2 * error)); }
    double high() const noexcept { return std::sqrt(std::fmax(0.0, square + 2 * error)); }
};

class ErrorTally {
public:
    void add(const PixelSquare& pixel) noexcept;
    /// `visited`: share of the object's pixels, f.
    SquareEstimate estimate(double visited = 0) const noexcept;

private:
    double m_ = 0, a_ = 0, mm_ = 0, ma_ = 0, aa_ = 0, v_ = 0, largest_ = 0, largest_v_ = 0;
    std::int64_t pixels_ = 0;
};

enum class Settled { within, over, open };

/// Looks are taken at `first` object pixels, then at `growth` times as many each, up to `most`.
struct StoppingRule {
    int first = 32;
    double growth = 1.5;
    int most = 2048;
    int rounds = 8;       ///< that all pixels may be visited in, with new samples each time
    int pass_from = 256;  ///< object pixels from which a candidate can pass, unless all are visited
    double fail_at = 0.9; ///< over when R - 2 se >= (fail_at B)^2
    double pass_at = 1.1; ///< within when R + 2 se <= (pass_at B)^2
    /// The looks end where a perfect reference would settle the judgement, and it is the error of the reference that leaves it
    /// open.
    bool until_reference = false;
};

/// `reference_error`: RMSE of the reference itself against a finer one, e. By the triangle inequality the RMSE against the
/// finer one is between low() - e and high() + e: a candidate is over if the former reaches fail_at B, and within if the
/// latter is at most pass_at B. Every candidate is within an infinite budget; within a budget of 0 is only the estimate 0
/// with error 0, as of equal pictures, and a reference without error.
Settled judge(const SquareEstimate& estimate, double budget, double reference_error = 0,
              const StoppingRule& rule = {}) noexcept;
/// At the end of the looks, what is still open may be taken if R + se + e^2 <= (pass_at B)^2: the errors of the candidate and
/// of the reference have nothing to do with each other, so that their squares add up.
bool acceptable(const SquareEstimate& estimate, double budget, double reference_error = 0,
                const StoppingRule& rule = {}) noexcept;

} // namespace bake
