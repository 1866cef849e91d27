#include "bake/light/ggx_albedo.h"
#include "bake/base/vec.h"
#include <array>

namespace bake {
namespace {

constexpr int rows = 16, loss_nodes = 20, schlick_nodes = 18; // of the table: along alpha, and along the angle
constexpr int eta_nodes = 10, azimuths = 10;                  // of the quadrature over visible normals
constexpr int mean_nodes = 120;                               // of the quadrature over mu

struct Pair {
    double loss = 0, schlick = 0;
};

/// Nodes in (0, 1) and weights of sum 1, by Newton's method on the Legendre polynomial.
template <int N> struct GaussLegendre {
    std::array<double, N> x{}, weight{};
    GaussLegendre() noexcept {
        for (int i = 0; i < N; ++i) {
            double t = std::cos(pi * (i + 0.75) / (N + 0.5)), slope = 1;
            for (int step = 0; step < 8; ++step) {
                double before = 1, p = t;
                for (int k = 2; k <= N; ++k) {
                    const double next = ((2 * k - 1) * t * p - (k - 1) * before) / k;
                    before = p, p = next;
                }
                slope = N * (t * p - before) / (t * t - 1);
                t -= p / slope;
            }
            x[std::size_t(i)] = (1 - t) / 2;
            weight[std::size_t(i)] = 1 / ((1 - t * t) * slope * slope);
        }
    }
};

/// E and E5 by quadrature over visible normals. After the surface is stretched to alpha = 1, the view direction is
/// s = (s_x, 0, s_z), and a visible normal h at the angle eta to s and the azimuth chi around s has the density
/// 2 cos(eta) / (pi (1 + s_z)) (Dupuy and Benyoub 2023: its mirror direction is uniform on a spherical cap). Along chi the
/// integral ends where h reflects below the surface, which is a quadratic equation in tan(eta). Nodes are dense there,
/// because G2 / G1 falls to 0 within an angle of about mu.
Pair integrate(double alpha, double mu) noexcept {
    static const GaussLegendre<eta_nodes> gauss;
    static const GaussLegendre<azimuths> around;
    const double a2 = alpha * alpha, sine = std::sqrt(std::max(0.0, 1 - mu * mu)),
                 length = std::hypot(alpha * sine, mu);
    const double s_x = alpha * sine / length, s_z = mu / length, root_v = std::sqrt(a2 + (1 - a2) * mu * mu);
    double sum = 0, sum_schlick = 0;
    for (int j = 0; j < 2 * azimuths; ++j) {
        const double r = around.x[std::size_t(j / 2)], turn = pi / 2 * r * r * r * (j % 2 ? 1 : -1);
        const double k = s_x * -std::sin(turn), d_chi = around.weight[std::size_t(j / 2)] * 1.5 * r * r;
        const double a = mu * (a2 + (1 - a2) * k * k), b = k * (mu * (1 - a2) * s_z - length),
                     c = mu * (a2 + (1 - a2) * s_z * s_z - 2);
        const double root = std::sqrt(b * b - a * c);
        const double tangent = b > 0 ? -c / (b + root) : (root - b) / a;
        const double versine = 1 - 1 / std::sqrt(1 + tangent * tangent); // 1 - cos(eta) at the end
        for (std::size_t i = 0; i < eta_nodes; ++i) {
            const double t = gauss.x[i], w = 1 - t * t * t; // nearly eta
            const double cos_eta = 1 - versine * w * w, sin_eta = w * std::sqrt(versine * (1 + cos_eta));
            // The normal on the surface itself is (alpha h_x, alpha h_y, h_z), not normalised.
            const double h_z = s_z * cos_eta + k * sin_eta, squared = a2 + (1 - a2) * h_z * h_z;
            const double v_h = length * cos_eta; // times the root of `squared`
            const double l_z = std::max(0.0, 2 * v_h * h_z / squared - mu);
            const double g2_by_g1 = l_z * (mu + root_v) / (l_z * root_v + mu * std::sqrt(a2 + (1 - a2) * l_z * l_z));
            const double share = gauss.weight[i] * 24 * t * t * w * versine * cos_eta / (1 + s_z) * d_chi * g2_by_g1;
            const double m = std::max(0.0, 1 - v_h / std::sqrt(squared));
            sum += share, sum_schlick += share * (m * m * m * m * m);
        }
    }
    return {1 - sum, sum_schlick};
}

/// Cubic interpolation between the four nodes around t, in units of nodes: Lagrange's weights.
template <int N> struct Cubic {
    int first;
    std::array<float, 4> weight;
    explicit Cubic(float t) noexcept {
        first = std::clamp(int(t) - 1, 0, N - 4);
        const float a = t - float(first), b = a - 1, c = a - 2, d = a - 3;
        weight = {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
    }
};

/// Along alpha: its fourth root, because the mean loss goes as alpha^2 log alpha.
float node_of_alpha(float alpha) noexcept {
    constexpr float least = 0.1f; // of least_ggx_alpha
    return (std::sqrt(std::sqrt(alpha)) - least) / (1 - least) * (rows - 1);
}
double alpha_of_node(int i) noexcept { return std::pow(0.1 + 0.9 * i / (rows - 1), 4); }

/// Along the angle, for the loss: dense where masking begins, at mu near alpha.
float node_of_loss(float alpha, float mu) noexcept {
    return std::sqrt(mu * (1 + alpha) / (mu + alpha)) * (loss_nodes - 1);
}
double mu_of_loss(double alpha, double y) noexcept { // y = node / (loss_nodes - 1)
    return y * y * alpha / (1 + alpha - y * y);
}

/// The same for E5.
float node_of_schlick(float alpha, float mu) noexcept {
    const float length = std::sqrt(mu * mu + alpha * alpha * (1 - mu * mu));
    return std::sqrt((mu * mu * (1 + alpha)) / (length + alpha)) * (schlick_nodes - 1);
}
double mu_of_schlick(double alpha, double y) noexcept { // y = node / (schlick_nodes - 1)
    const double length = alpha + y * y * (1 - alpha);
    // length^2 = mu^2 (1 - alpha^2) + alpha^2
    return std::sqrt(y * y * (length + alpha) / (1 + alpha));
}

template <int N, class Row> double interpolated(const Cubic<N>& cubic, const Row& row) noexcept {
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j) sum += double(cubic.weight[j]) * double(row[std::size_t(cubic.first) + j]);
    return sum;
}

struct Table {
    std::array<std::array<float, loss_nodes>, rows> loss{};
    /// (E5 / E)^(1/5), along the root of mu: nearly 1 - mu on smooth surfaces.
    std::array<std::array<float, schlick_nodes>, rows> schlick{};
    std::array<float, rows> mean_loss{}; ///< divided by alpha^2
    std::array<float, rows> mean_schlick{};

    Table() noexcept {
        for (std::size_t i = 0; i < rows; ++i) {
            const double alpha = alpha_of_node(int(i));
            for (std::size_t j = 0; j < loss_nodes; ++j)
                loss[i][j] = float(std::sqrt(std::max(
                    0.0, integrate(alpha, mu_of_loss(alpha, std::max(1e-3, double(j) / (loss_nodes - 1)))).loss)));
            for (std::size_t j = 0; j < schlick_nodes; ++j) {
                const Pair value =
                    integrate(alpha, mu_of_schlick(alpha, std::max(1e-3, double(j) / (schlick_nodes - 1))));
                schlick[i][j] = float(std::pow(value.schlick / (1 - value.loss), 0.2));
            }
        }
        for (std::size_t i = 0; i < rows; ++i) set_mean(i);
    }

    /// Of the values as they are looked up, so that both agree. Simpson's rule.
    void set_mean(std::size_t i) noexcept {
        const double alpha = alpha_of_node(int(i));
        double sum = 0, sum_schlick = 0;
        for (int k = 0; k <= mean_nodes; ++k) {
            const double simpson = (k == 0 || k == mean_nodes ? 1 : k % 2 ? 4 : 2) / (3.0 * mean_nodes);
            const double x = double(k) / mean_nodes, mu = x * x * x * x, measure = simpson * 8 * x * x * x * mu;
            const double root = interpolated(Cubic<loss_nodes>(node_of_loss(float(alpha), float(mu))), loss[i]);
            const double r = interpolated(Cubic<schlick_nodes>(node_of_schlick(float(alpha), float(mu))), schlick[i]);
            sum += measure * root * root;
            sum_schlick += measure * (1 - root * root) * r * r * r * r * r;
        }
        mean_loss[i] = float(sum / (alpha * alpha)), mean_schlick[i] = float(sum_schlick);
    }
};

const Table& table() noexcept {
    static const Table computed; // once, by the first thread that comes; others wait
    return computed;
}

} // namespace

GgxAlbedo integrated_ggx_albedo(double alpha, double mu) noexcept {
    const Pair found = integrate(alpha, mu);
    return {float(std::max(0.0, found.loss)), float(found.schlick)};
}

GgxRow ggx_row(float alpha) noexcept {
    alpha = std::clamp(alpha, least_ggx_alpha, 1.f);
    const Cubic<rows> x(node_of_alpha(alpha));
    return {alpha, x.first, x.weight};
}

GgxAlbedo ggx_albedo(const GgxRow& row, float mu) noexcept {
    const Table& t = table();
    mu = std::clamp(mu, 0.f, 1.f);
    const Cubic<loss_nodes> y(node_of_loss(row.alpha, mu));
    const Cubic<schlick_nodes> z(node_of_schlick(row.alpha, mu));
    float loss = 0, root = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t at = std::size_t(row.first) + i;
        const float* const losses = &t.loss[at][std::size_t(y.first)];
        const float* const roots = &t.schlick[at][std::size_t(z.first)];
        float row_loss = 0, row_root = 0;
        for (std::size_t j = 0; j < 4; ++j) row_loss += y.weight[j] * losses[j], row_root += z.weight[j] * roots[j];
        loss += row.weight[i] * row_loss, root += row.weight[i] * row_root;
    }
    loss = std::min(loss * loss, 1.f), root = std::clamp(root, 0.f, 1.f);
    return {loss, (1 - loss) * root * root * root * root * root};
}

GgxAlbedo ggx_mean_albedo(const GgxRow& row) noexcept {
    const Table& t = table();
    GgxAlbedo out;
    for (std::size_t i = 0; i < 4; ++i) {
        out.loss += row.weight[i] * t.mean_loss[std::size_t(row.first) + i];
        out.schlick += row.weight[i] * t.mean_schlick[std::size_t(row.first) + i];
    }
    return {row.alpha * row.alpha * out.loss, out.schlick};
}

Vec3f sample_ggx_loss(float alpha, const Vec2f& u) noexcept {
    const float a2 = alpha * alpha, mu2 = std::min(a2 * std::expm1(u.x * std::log1p(1 / a2)), 1.f);
    const float sine = std::sqrt(1 - mu2), turn = 2 * float(pi) * u.y;
    return {sine * std::cos(turn), sine * std::sin(turn), std::sqrt(mu2)};
}

float ggx_loss_density(float alpha, float mu) noexcept {
    const float a2 = alpha * alpha;
    return mu / (float(pi) * (mu * mu + a2) * std::log1p(1 / a2));
}

} // namespace bake
