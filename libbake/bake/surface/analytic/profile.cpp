#include "bake/surface/analytic/profile.h"
#include "bake/base/error.h"
#include "bake/base/number_lines.h"
#include <algorithm>

namespace bake {
namespace {

/// Solves the diagonally dominant tridiagonal system low[i] y[i-1] + diagonal[i] y[i] + high[i] y[i+1] = x[i]; y replaces x.
void solve(const std::vector<double>& low, std::vector<double> diagonal, const std::vector<double>& high,
           std::vector<double>& x) {
    for (std::size_t i = 1; i < x.size(); ++i) {
        const double k = low[i] / diagonal[i - 1];
        diagonal[i] -= k * high[i - 1];
        x[i] -= k * x[i - 1];
    }
    x.back() /= diagonal.back();
    for (std::size_t i = x.size() - 1; i-- > 0;) x[i] = (x[i] - high[i] * x[i + 1]) / diagonal[i];
}

enum class End {
    natural, ///< second derivative 0
    level,   ///< first derivative 0
};

/// Second derivatives at the knots of the spline through `y`.
std::vector<double> second_derivatives(const std::vector<double>& t, const std::vector<double>& y, End first,
                                       End last) {
    const std::size_t n = t.size();
    std::vector<double> low(n), diagonal(n, 1.0), high(n), x(n);
    const auto step = [&](std::size_t i) { return t[i + 1] - t[i]; };
    const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / step(i); };
    for (std::size_t i = 1; i + 1 < n; ++i) {
        low[i] = step(i - 1), diagonal[i] = 2 * (step(i - 1) + step(i)), high[i] = step(i);
        x[i] = 6 * (slope(i) - slope(i - 1));
    }
    if (first == End::level) diagonal[0] = 2 * step(0), high[0] = step(0), x[0] = 6 * slope(0);
    if (last == End::level) diagonal[n - 1] = 2 * step(n - 2), low[n - 1] = step(n - 2), x[n - 1] = -6 * slope(n - 2);
    solve(low, diagonal, high, x);
    return x;
}

/// Second derivatives of a periodic spline, whose last value equals the first. The Sherman-Morrison formula corrects the
/// solution of a tridiagonal system.
std::vector<double> periodic_second_derivatives(const std::vector<double>& t, const std::vector<double>& y) {
    const std::size_t n = t.size() - 1; // distinct knots
    const auto step = [&](std::size_t i) { return t[i % n + 1] - t[i % n]; };
    const auto slope = [&](std::size_t i) { return (y[i % n + 1] - y[i % n]) / step(i); };
    std::vector<double> low(n), diagonal(n), high(n), x(n), z(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double before = step(i + n - 1), after = step(i);
        low[i] = before, high[i] = after, diagonal[i] = 2 * (before + after), x[i] = 6 * (slope(i) - slope(i + n - 1));
    }
    const double corner = low[0], gamma = -diagonal[0]; // low[0] and high[n-1] are the same step
    diagonal[0] -= gamma;
    diagonal[n - 1] -= corner * corner / gamma;
    z[0] = gamma, z[n - 1] = corner;
    solve(low, diagonal, high, x);
    solve(low, diagonal, high, z);
    const double k = (x[0] + corner * x[n - 1] / gamma) / (1 + z[0] + corner * z[n - 1] / gamma);
    for (std::size_t i = 0; i < n; ++i) x[i] -= k * z[i];
    x.push_back(x[0]);
    return x;
}

/// The points of a profile file, checked.
std::vector<Vec2d> read_points(const std::string& path, const std::vector<NumberLine>& lines) {
    const auto refuse = [&](const std::string& what) { throw Error{Refusal::unreadable, path + ": " + what}; };
    std::vector<Vec2d> points;
    for (const NumberLine& line : lines) {
        const std::string where = "line " + std::to_string(line.line);
        if (line.values.size() != 2) refuse(where + ": not two numbers; write 'radius height'");
        const Vec2d p{line.values[0], line.values[1]};
        if (p.x < 0) refuse(where + ": negative radius; the axis is at radius 0");
        if (!points.empty() && p == points.back()) refuse(where + ": repeats the previous point; remove one of them");
        points.push_back(p);
    }
    if (points.size() < 2) refuse("fewer than two points; write one line 'radius height' per point");
    if (points.size() == 3 && points.front() == points.back())
        refuse("the curve returns along itself; a loop needs at least three different points");
    return points;
}

/// Sets the knots and second derivatives of the spline through the points.
void add_spline(Profile& profile, bool pointed) {
    const auto& points = profile.points;
    auto& knots = profile.knots;
    knots = {0};
    for (std::size_t i = 1; i < points.size(); ++i)
        knots.push_back(knots.back() + glm::length(points[i] - points[i - 1]));
    const double length = knots.back();
    for (double& t : knots) t /= length;

    std::vector<double> radius, height;
    for (const Vec2d& p : points) {
        radius.push_back(p.x);
        height.push_back(p.y);
    }
    const auto end = [&](const Vec2d& p) { return p.x == 0 && !pointed ? End::level : End::natural; };
    const auto radius2 = profile.loop ? periodic_second_derivatives(knots, radius)
                                      : second_derivatives(knots, radius, End::natural, End::natural);
    const auto height2 = profile.loop ? periodic_second_derivatives(knots, height)
                                      : second_derivatives(knots, height, end(points.front()), end(points.back()));
    for (std::size_t i = 0; i < points.size(); ++i) profile.second.emplace_back(radius2[i], height2[i]);
}

/// Least radius between knots i and i + 1.
double least_radius(const Profile& profile, std::size_t i) noexcept {
    const double from = profile.knots[i], to = profile.knots[i + 1];
    double least = std::min(profile.points[i].x, profile.points[i + 1].x);
    // One cubic piece is sampled finely enough to find its minimum.
    for (int k = 1; k < 64; ++k) least = std::min(least, profile_at(profile, from + (to - from) * k / 64).p.x);
    return least;
}

} // namespace

ProfilePoint profile_at(const Profile& profile, double t) noexcept {
    if (profile.loop) t -= std::floor(t);
    const auto& knots = profile.knots;
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
    const auto i = std::size_t(above - knots.begin()) - 1;
    const double h = knots[i + 1] - knots[i], b = (t - knots[i]) / h, a = 1 - b;
    const Vec2d p0 = profile.points[i], p1 = profile.points[i + 1], m0 = profile.second[i], m1 = profile.second[i + 1];
    const double ca = (a * a * a - a) * h * h / 6, cb = (b * b * b - b) * h * h / 6;
    const double da = (1 - 3 * a * a) * h / 6, db = (3 * b * b - 1) * h / 6;
    return {a * p0 + b * p1 + ca * m0 + cb * m1, (p1 - p0) / h + da * m0 + db * m1, a * m0 + b * m1};
}

Profile read_profile(const std::string& path, bool pointed) {
    const std::vector<NumberLine> lines = read_number_lines(path);
    const auto refuse = [&](const std::string& what) { throw Error{Refusal::unreadable, path + ": " + what}; };
    Profile profile;
    auto& points = profile.points;
    points = read_points(path, lines);
    const std::size_t n = points.size();
    profile.loop = points.front() == points.back();

    double area = 0;
    for (std::size_t i = 0; i + 1 < n; ++i) area += (points[i].x + points[i + 1].x) * (points[i + 1].y - points[i].y);
    const bool reversed = area < 0;
    if (reversed) std::reverse(points.begin(), points.end());
    add_spline(profile, pointed);

    for (std::size_t i = 0; i + 1 < n; ++i)
        if (least_radius(profile, i) < -1e-12) {
            const std::size_t a = reversed ? n - 2 - i : i;
            refuse("the curve crosses the axis between lines " + std::to_string(lines[a].line) + " and " +
                   std::to_string(lines[a + 1].line) + "; add points there");
        }
    return profile;
}

} // namespace bake
