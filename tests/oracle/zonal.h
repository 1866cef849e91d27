// A sun as a von Mises-Fisher lobe, and what any kernel about the direction itself makes of it: closed forms on the
// sphere that share no code with libbake.
//
//   sun:      L(d) = amplitude exp(kappa (d . s - 1))
//   kernel:   out(n) = integral of L(l) K(n . l) dl, K a function of the cosine
//   Funk-Hecke: out = sum over l of (2 l + 1) / (4 pi) L_l K_l P_l(n . s)
//             K_l = 2 pi integral of K(c) P_l(c) dc      L_l = flux A_l(kappa), A_l = I_{l+1/2}(kappa) / I_{1/2}(kappa)
#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace oracle {

/// Nodes and weights of Gauss and Legendre on [-1, 1].
struct Gauss {
    std::vector<double> x, w;
};
inline Gauss gauss_legendre(int n) {
    Gauss g{std::vector<double>(n), std::vector<double>(n)};
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 100; ++step) {
            double p0 = 1, p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1, p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1);
            const double move = p1 / slope;
            x -= move;
            if (std::abs(move) < 1e-15) break;
        }
        g.x[i] = x, g.w[i] = 2 / ((1 - x * x) * slope * slope);
    }
    return g;
}

/// Integral of f over [a, b], 48 points in each of `parts` parts that shrink by halves towards b.
template <class F> double integral_towards(double a, double b, int parts, F&& f) {
    static const Gauss g = gauss_legendre(48);
    double sum = 0, left = a;
    for (int part = 0; part < parts; ++part) {
        const double right = part + 1 == parts ? b : (left + b) / 2;
        for (std::size_t i = 0; i < g.x.size(); ++i)
            sum += g.w[i] * (right - left) / 2 * f(left + (g.x[i] + 1) / 2 * (right - left));
        left = right;
    }
    return sum;
}

struct Sun {
    double amplitude = 1000, kappa = 5000;
    double radiance(double c) const { return amplitude * std::exp(kappa * (c - 1)); }
    double flux() const { return amplitude * 2 * std::numbers::pi * -std::expm1(-2 * kappa) / kappa; }
    /// A_l for l below count: Bessel functions by Miller's downward recurrence.
    std::vector<double> band_factors(int count) const {
        // b_{l-1} = b_{l+1} + (2 l + 1) / kappa b_l for b_l = I_{l+1/2}, as ratios b_{l+1} / b_l from far above: a wrong
        // start is forgotten as exp(-l^2 / kappa).
        const int start = count + 100 + int(10 * std::sqrt(kappa));
        std::vector<double> ratio(start + 1, 0.0), A(count, 1.0);
        for (int l = start - 1; l >= 0; --l) ratio[l] = 1 / ((2 * l + 3) / kappa + ratio[l + 1]);
        for (int l = 1; l < count; ++l) A[l] = A[l - 1] * ratio[l - 1];
        return A;
    }
};

/// out(n) of a sun under a kernel that is 0 for c < 0: a series in P_l(n . s), complete to 1e-12.
class ConvolvedSun {
public:
    ConvolvedSun(const Sun& sun, const std::function<double(double)>& kernel) {
        // A_l falls as exp(-l^2 / (2 kappa)).
        const int count = int(std::sqrt(2 * sun.kappa * 30)) + 40;
        const std::vector<double> A = sun.band_factors(count);
        std::vector<double> K(count, 0.0);
        static const Gauss g = gauss_legendre(48);
        double left = 0; // parts that halve towards c = 1, where kernels are sharp and P_l turns fastest
        constexpr int parts = 36;
        for (int part = 0; part < parts; ++part) {
            const double right = part + 1 == parts ? 1 : (left + 1) / 2;
            // Enough points for P_l, which has l zeros in angle.
            const int slices = 1 + int(count * (std::acos(left) - std::acos(right)) / 30);
            for (int slice = 0; slice < slices; ++slice) {
                const double a = left + (right - left) * slice / slices,
                             b = left + (right - left) * (slice + 1) / slices;
                for (std::size_t i = 0; i < g.x.size(); ++i) {
                    const double c = a + (g.x[i] + 1) / 2 * (b - a), weight = g.w[i] * (b - a) / 2 * kernel(c);
                    double p0 = 1, p1 = c;
                    K[0] += weight, K[1] += weight * c;
                    for (int l = 2; l < count; ++l) {
                        const double p2 = ((2 * l - 1) * c * p1 - (l - 1) * p0) / l;
                        p0 = p1, p1 = p2, K[l] += weight * p2;
                    }
                }
            }
            left = right;
        }
        norm = 2 * std::numbers::pi * K[0];
        for (int l = 0; l < count; ++l) terms_.push_back((2 * l + 1) / 2.0 * sun.flux() * A[l] * K[l]);
    }
    /// At the cosine c between n and the sun.
    double operator()(double c) const {
        double sum = terms_[0] + terms_[1] * c, p0 = 1, p1 = c;
        for (std::size_t l = 2; l < terms_.size(); ++l) {
            const double p2 = ((2 * double(l) - 1) * c * p1 - (double(l) - 1) * p0) / double(l);
            p0 = p1, p1 = p2, sum += terms_[l] * p2;
        }
        return sum;
    }
    double norm = 0; ///< integral of the kernel

private:
    std::vector<double> terms_;
};

/// The kernels, as the papers have them (unnormalised).
inline double clamped_cosine(double c) { return c > 0 ? c : 0; }
/// GGX at N = V = R: D(h) (n . l), h halfway between n and l.
inline double ggx_kernel(double c, double alpha) {
    if (c <= 0) return 0;
    const double cos2_h = (1 + c) / 2, a2 = alpha * alpha, d = cos2_h * (a2 - 1) + 1;
    return a2 / (std::numbers::pi * d * d) * c;
}
inline double phong_kernel(double c, double exponent) { return c > 0 ? std::pow(c, exponent) : 0; }

} // namespace oracle
