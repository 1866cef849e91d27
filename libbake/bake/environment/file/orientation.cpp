#include "bake/environment/file/orientation.h"
#include "bake/base/parallel.h"
#include "bake/environment/sky/layout.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

/// A side of a face: 0 top, 1 right, 2 bottom, 3 left; each runs clockwise around the face.
struct FaceSide {
    int face, side;
};
/// The 12 edges of the cube as pairs of sides, which run in opposite directions as seen from inside.
using Seams = std::array<std::pair<FaceSide, FaceSide>, 12>;

CubeTexel texel_on(int n, CubeFace face, int side, int i) noexcept {
    switch (side) {
    case 0: return {face, i, 0};
    case 1: return {face, n - 1, i};
    case 2: return {face, n - 1 - i, n - 1};
    default: return {face, 0, n - 1 - i};
    }
}

/// Found by texel_across for each side of a small cube.
const Seams& seams() {
    static const Seams found = [] {
        Seams all{};
        const int n = 3;
        int count = 0;
        for (int face = 0; face < 6; ++face)
            for (int side = 0; side < 4; ++side) {
                CubeTexel middle = texel_on(n, CubeFace(face), side, 1);
                (side % 2 ? middle.x : middle.y) += side == 1 || side == 2 ? 1 : -1;
                const CubeTexel there = texel_across(n, CubeFace(face), middle.x, middle.y);
                const int other = int(there.face);
                for (int k = 0; k < 4; ++k) {
                    const CubeTexel at = texel_on(n, there.face, k, 1);
                    if (at.x == there.x && at.y == there.y && face < other) all[count++] = {{face, side}, {other, k}};
                }
            }
        return all;
    }();
    return found;
}

/// Sums of steps and of squared steps.
struct StepSums {
    double plain = 0, square = 0;
    void add(const StepSums& other) noexcept {
        plain += other.plain;
        square += other.square;
    }
};

/// The step between two texels, of square roots: in linear radiance a few lamps would outweigh everything else.
StepSums step(const float* a, const float* b, int channels) noexcept {
    const auto seen = [](float value) { return std::sqrt(value > 0 ? value : 0.0f); };
    StepSums sum;
    for (int c = 0; c < channels; ++c) {
        const double d = std::abs(double(seen(a[c]) - seen(b[c])));
        sum.plain += d / channels;
        sum.square += d * d / channels;
    }
    return sum;
}

StepSums mean_inside(const Cube& cube, int channels) {
    const int n = cube.size();
    if (n < 2) return {};
    std::vector<StepSums> rows(std::size_t(6) * n);
    for_rows(6 * n, 64, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t r = begin; r < end; ++r) {
            const Image<float>& face = cube.faces[r / n];
            const int y = int(r % n);
            for (int x = 0; x < n; ++x) {
                if (x + 1 < n) rows[r].add(step(&face.at(x, y), &face.at(x + 1, y), channels));
                if (y + 1 < n) rows[r].add(step(&face.at(x, y), &face.at(x, y + 1), channels));
            }
        }
    });
    StepSums sum;
    for (const StepSums& row : rows) sum.add(row);
    const double count = 12.0 * n * (n - 1);
    return {sum.plain / count, sum.square / count};
}

StepSums mean_across(const Cube& cube, FaceSide a, FaceSide b, int channels) {
    const int n = cube.size();
    StepSums sum;
    for (int i = 0; i < n; ++i) {
        const CubeTexel p = texel_on(n, CubeFace(a.face), a.side, i),
                        q = texel_on(n, CubeFace(b.face), b.side, n - 1 - i);
        sum.add(step(&cube[p.face].at(p.x, p.y), &cube[q.face].at(q.x, q.y), channels));
    }
    return {sum.plain / n, sum.square / n};
}

/// steps[4 a + i][4 b + j]: mean squared step between side i of file a and side j of file b.
using Steps = std::array<std::array<double, 24>, 24>;

Steps all_squares(const Cube& cube, int channels) {
    Steps steps{};
    for_rows(24, 1, [&](std::int64_t begin, std::int64_t end) {
        for (int a = int(begin); a < int(end); ++a)
            for (int b = 0; b < 24; ++b)
                steps[a][b] = a / 4 == b / 4 ? 0 : mean_across(cube, {a / 4, a % 4}, {b / 4, b % 4}, channels).square;
    });
    return steps;
}

/// The side of a file that becomes `side` of a face after `turns` counter-clockwise quarter turns.
int side_of_file(int side, int turns) noexcept { return (side + turns) % 4; }

double total(const Steps& steps, const Orientation& o) noexcept {
    double sum = 0;
    for (const auto& [a, b] : seams())
        sum += steps[4 * o.source[a.face] + side_of_file(a.side, o.turns[a.face])]
                    [4 * o.source[b.face] + side_of_file(b.side, o.turns[b.face])];
    return sum;
}

/// Score for keeping files as given, larger for more; px and nx decide between equals.
int kept(const Orientation& o) noexcept {
    int score = 0;
    for (int k = 0; k < 6; ++k) {
        const bool placed = o.source[k] == k;
        score += placed && o.turns[k] == 0 ? 20 : placed ? 6 : o.turns[k] == 0 ? 1 : 0;
        score += k < 2 && placed && o.turns[k] == 0 ? 3 : 0;
    }
    return score;
}

/// Depth-first search over the faces, which abandons a branch as soon as its seams cost more than the best arrangement: 2.9
/// million arrangements take a few milliseconds.
class OrientationSearch {
public:
    /// Arrangements whose costs differ by at most `same` are equally good.
    OrientationSearch(const Steps& steps, double same) : steps_(steps), same_(same), limit_(total(steps, {})) {
        for (const auto& [a, b] : seams()) at_[std::max(a.face, b.face)].push_back({a, b});
        visit(0, 0.0);
    }
    Orientation best;

private:
    void visit(int face, double cost) {
        if (cost > limit_ + same_) return;
        if (face == 6) {
            const bool equal = cost > limit_ - same_;
            if (equal && kept(now_) <= kept(best)) return;
            limit_ = std::min(limit_, cost);
            best = now_;
            return;
        }
        for (int source = 0; source < 6; ++source) {
            if (used_[source]) continue;
            used_[source] = true;
            now_.source[face] = source;
            for (now_.turns[face] = 0; now_.turns[face] < 4; ++now_.turns[face]) visit(face + 1, cost + joins(face));
            used_[source] = false;
        }
        now_.turns[face] = 0;
    }
    double joins(int face) const noexcept {
        double sum = 0;
        for (const auto& [a, b] : at_[face])
            sum += steps_[4 * now_.source[a.face] + side_of_file(a.side, now_.turns[a.face])]
                         [4 * now_.source[b.face] + side_of_file(b.side, now_.turns[b.face])];
        return sum;
    }

    const Steps& steps_;
    double same_, limit_;
    std::array<std::vector<std::pair<FaceSide, FaceSide>>, 6> at_; ///< seams that are complete once this face is placed
    std::array<bool, 6> used_{};
    Orientation now_;
};

int colours(const Cube& cube) noexcept { return std::min(3, cube.channels()); }

double mean_over_seams(const Cube& cube, const Orientation& o) {
    double sum = 0;
    for (const auto& [a, b] : seams())
        sum += mean_across(cube, {o.source[a.face], side_of_file(a.side, o.turns[a.face])},
                           {o.source[b.face], side_of_file(b.side, o.turns[b.face])}, colours(cube))
                   .plain;
    return sum / 12;
}

} // namespace

bool Orientation::as_given() const noexcept { return *this == Orientation{}; }

OrientationCheck check_orientation(const Cube& cube) {
    OrientationCheck check;
    const int channels = colours(cube);
    const StepSums inside = mean_inside(cube, channels);
    if (!(inside.plain > 0)) {
        check.unknown = true;
        return check;
    }
    // Squares distinguish arrangements better if little more than noise crosses the seams.
    const Steps squares = all_squares(cube, channels);
    const double mean_square = 12 * inside.square;
    check.closes = OrientationSearch(squares, 1e-6 * inside.square).best;
    const double given = total(squares, {}) / mean_square, best = total(squares, check.closes) / mean_square;
    check.wrong =
        given > 1.2 && !check.closes.as_given() && best <= 0.85 * given && (best <= 1.4 || best <= 0.25 * given);
    check.given = mean_over_seams(cube, {}) / inside.plain;
    check.best = check.closes.as_given() ? check.given : mean_over_seams(cube, check.closes) / inside.plain;
    return check;
}

Cube reorient(const Cube& cube, const Orientation& orientation) {
    Cube result;
    for (int k = 0; k < 6; ++k) result.faces[k] = turned(cube.faces[orientation.source[k]], orientation.turns[k]);
    return result;
}

std::string to_text(const Orientation& orientation, const std::array<std::string, 6>& files) {
    constexpr const char* axes[6] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
    std::string text;
    for (int k = 0; k < 6; ++k) {
        if (orientation.source[k] == k && orientation.turns[k] == 0) continue;
        text += (text.empty() ? "" : ", ") + std::string(axes[k]) + " = " + files[orientation.source[k]];
        if (orientation.turns[k]) text += " turned " + std::to_string(90 * orientation.turns[k]) + " deg";
    }
    return text;
}

} // namespace bake
