#include "bake/verdict/plan/relief_waves.h"
#include "bake/base/parallel.h"
#include <bit>
#include <cmath>
#include <complex>

namespace bake {
namespace {

using Complex = std::complex<double>;

/// exp(-2 pi i k / n) for the first half of the k.
std::vector<Complex> unit_roots(std::size_t n) {
    std::vector<Complex> roots(n / 2);
    for (std::size_t k = 0; k < n / 2; ++k) roots[k] = std::polar(1.0, -2 * pi * double(k) / double(n));
    return roots;
}

/// In place, for a power of two: Cooley and Tukey, An Algorithm for the Machine Calculation of Complex Fourier Series, 1965.
void fourier_transform(std::vector<Complex>& a, const std::vector<Complex>& roots) {
    const std::size_t n = a.size();
    for (std::size_t i = 1, j = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(a[i], a[j]);
    }
    for (std::size_t half = 1; half < n; half *= 2)
        for (std::size_t begin = 0; begin < n; begin += 2 * half)
            for (std::size_t k = 0; k < half; ++k) {
                const Complex x = a[begin + k], t = roots[k * (n / (2 * half))], y = a[begin + k + half];
                const Complex z(t.real() * y.real() - t.imag() * y.imag(), t.real() * y.imag() + t.imag() * y.real());
                a[begin + k] = x + z, a[begin + k + half] = x - z;
            }
}

/// The values along one axis: `lines` lines of `n` values each.
struct Axis {
    const Image<float>& values;
    bool along_u;
    int n() const noexcept { return along_u ? values.width() : values.height(); }
    int lines() const noexcept { return along_u ? values.height() : values.width(); }
    double at(int line, int i) const noexcept {
        const double value = along_u ? values.at(i, line) : values.at(line, i);
        return std::isfinite(value) ? value : 0;
    }
};

/// Segments of a line: a whole period, or what is multiplied by the window of Hann.
struct Segments {
    int length = 1, count = 1;
    std::vector<double> window;
    double squares = 0; ///< of the window, summed
    std::vector<Complex> roots;

    Segments(int n, bool repeats) : length(int(std::bit_floor(unsigned(n)))), count(length == n ? 1 : 2) {
        for (int i = 0; i < length; ++i) {
            const double sine = std::sin(pi * (i + 0.5) / length);
            window.push_back(repeats && length == n ? 1 : sine * sine);
            squares += window.back() * window.back();
        }
        roots = unit_roots(std::size_t(length));
    }
};

/// Adds the power at the frequencies 0 to length / 2, so that white noise of variance 1 adds 1 at each.
void add_power(const Axis& axis, int line, int first, const Segments& segments, std::vector<Complex>& scratch,
               std::vector<double>& power) {
    double mean = 0;
    for (int i = 0; i < segments.length; ++i) mean += axis.at(line, first + i) / segments.length;
    for (int i = 0; i < segments.length; ++i)
        scratch[std::size_t(i)] = segments.window[std::size_t(i)] * (axis.at(line, first + i) - mean);
    fourier_transform(scratch, segments.roots);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(scratch[k]) / segments.squares;
}

/// Welch, The Use of Fast Fourier Transform for the Estimation of Power Spectra, 1967: the mean over segments of all lines.
std::vector<double> mean_power(const Axis& axis, bool repeats) {
    constexpr int most_lines = 128;
    const Segments segments(axis.n(), repeats);
    const int length = segments.length, lines = std::min(axis.lines(), most_lines);
    constexpr std::int64_t block = 8;
    std::vector<std::vector<double>> of_block(std::size_t((lines + block - 1) / block));
    for_rows(std::int64_t(of_block.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Complex> scratch(std::size_t(length), Complex(0));
        for (auto b = begin; b < end; ++b) {
            std::vector<double>& power = of_block[std::size_t(b)];
            power.assign(std::size_t(length / 2 + 1), 0);
            for (auto i = b * block; i < std::min<std::int64_t>(lines, (b + 1) * block); ++i) {
                const int line = int((2 * i + 1) * axis.lines() / (2 * lines));
                for (int s = 0; s < segments.count; ++s)
                    add_power(axis, line, s * (axis.n() - length), segments, scratch, power);
            }
        }
    });
    std::vector<double> power(std::size_t(length / 2 + 1), 0);
    for (const std::vector<double>& part : of_block)
        for (std::size_t k = 0; k < power.size(); ++k) power[k] += part[k] / (double(lines) * segments.count);
    return power;
}

double shortest_wave(const Axis& axis, bool repeats, double step, double share) {
    const int n = axis.n();
    if (n < 2) return n;
    const std::vector<double> power = mean_power(axis, repeats);
    const double noise = step * step / 12, length = 2.0 * double(power.size() - 1);
    std::vector<double> slopes(power.size());
    double sum = 0;
    for (std::size_t k = 1; k < power.size(); ++k) {
        const double w = 2 * pi * double(k) / length;
        // Below 0 too, so that what is random in the noise cancels in the sum.
        slopes[k] = w * w * (power[k] - noise) * (k + 1 == power.size() ? 0.5 : 1);
        sum += slopes[k];
    }
    if (!(sum > 0)) return n;
    double below = 0;
    for (std::size_t k = 1; k < power.size(); ++k)
        if ((below += slopes[k]) >= share * sum) return length / double(k);
    return 2;
}

} // namespace

ReliefWaves relief_waves(const HeightTexture& height, Wrap wrap_u, Wrap wrap_v, double share) {
    if (height.values.empty()) return {};
    return {shortest_wave({height.values, true}, wrap_u == Wrap::repeat, height.step, share),
            shortest_wave({height.values, false}, wrap_v == Wrap::repeat, height.step, share)};
}

} // namespace bake
