#include "bake/environment/file/orientation.h"
#include "bake/environment/sky/layout.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace bake {
namespace {

constexpr float moved_cost = 0.5f, mirrored_cost = 1.5f;
/// Arrangements whose costs differ by less are equally good.
constexpr float same_cost = 1e-4f;

/// The side of a file, 4 file + side, that is `side` of face k of an arrangement.
int side_of_file(const Orientation& o, FaceSide side) noexcept {
    int own = (side.side + o.turns[side.face]) % 4;
    if (o.mirrored[side.face] && own % 2 == 1) own = 4 - own;
    return 4 * o.source[side.face] + own;
}

float value_at(const SideTable& table, const Orientation& o, const Seam& seam) noexcept {
    const bool same_direction = o.mirrored[seam.a.face] != o.mirrored[seam.b.face];
    return table[same_direction][side_of_file(o, seam.a)][side_of_file(o, seam.b)];
}

/// Score for keeping files as given, larger for more; px and nx decide between equals.
int kept(const Orientation& o) noexcept {
    int score = 0;
    for (int k = 0; k < 6; ++k) {
        const bool placed = o.source[k] == k, turned = o.turns[k] != 0 || o.mirrored[k];
        score += placed && !turned ? 20 : placed ? 6 : !turned ? 1 : 0;
        score += k < 2 && placed && !turned ? 3 : 0;
    }
    return score;
}

/// Depth-first search over the faces, which abandons a branch as soon as it costs more than the best arrangement.
class OrientationSearch {
public:
    explicit OrientationSearch(const SideSteps& sides) {
        for (int mirrored = 0; mirrored < 2; ++mirrored)
            for (int a = 0; a < 24; ++a)
                for (int b = 0; b < 24; ++b)
                    costs_[mirrored][a][b] = 2 * std::log(std::max(1.0f, sides.ratio[mirrored][a][b]));
        for (const Seam& seam : seams()) {
            ends_[std::max(seam.a.face, seam.b.face)].push_back(seam);
            limit_ += value_at(costs_, {}, seam);
        }
        visit_places(0, 0);
        now_ = {};
        visit_mirrored(0, 0);
    }
    Orientation best;

private:
    bool is_full(int face, float cost) {
        if (cost > limit_ + same_cost) return true;
        if (face < 6) return false;
        if (cost < limit_ - same_cost || kept(now_) > kept(best)) best = now_, limit_ = std::min(limit_, cost);
        return true;
    }
    /// All permutations and turns.
    void visit_places(int face, float cost) {
        if (is_full(face, cost)) return;
        for (int source = 0; source < 6; ++source) {
            if (used_[source]) continue;
            used_[source] = true;
            now_.source[face] = source;
            for (now_.turns[face] = 0; now_.turns[face] < 4; ++now_.turns[face])
                visit_places(face + 1, cost + cost_of(face));
            used_[source] = false;
        }
        now_.turns[face] = 0;
    }
    /// All turns and mirrorings of the faces in their places.
    void visit_mirrored(int face, float cost) {
        if (is_full(face, cost)) return;
        for (const bool mirrored : {false, true}) {
            now_.mirrored[face] = mirrored;
            for (now_.turns[face] = 0; now_.turns[face] < 4; ++now_.turns[face])
                visit_mirrored(face + 1, cost + cost_of(face));
        }
        now_.turns[face] = 0;
        now_.mirrored[face] = false;
    }
    /// Of placing a face, with the seams to the faces before it.
    float cost_of(int face) const noexcept {
        const bool mirrored = now_.mirrored[face];
        const bool moved = now_.source[face] != face || now_.turns[face] != 0 || mirrored;
        float sum = (moved ? moved_cost : 0) + (mirrored ? mirrored_cost : 0);
        for (const Seam& seam : ends_[face]) sum += value_at(costs_, now_, seam);
        return sum;
    }

    SideTable costs_;
    float limit_ = 0;
    std::array<std::vector<Seam>, 6> ends_; ///< seams that are complete once this face is placed
    std::array<bool, 6> used_{};
    Orientation now_;
};

std::array<double, 12> values_of(const SideTable& table, const Orientation& o) noexcept {
    std::array<double, 12> values;
    for (int i = 0; i < 12; ++i) values[i] = double(value_at(table, o, seams()[i]));
    return values;
}

double mean_of(const std::array<double, 12>& values) noexcept {
    return std::accumulate(values.begin(), values.end(), 0.0) / 12;
}

int count_open(const std::array<double, 12>& ratios) noexcept {
    return int(std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio > open_seam; }));
}

/// Whether the seams of the faces that `closes` moves show that it is right: each of them closes, or becomes four times
/// better, and the mean logarithm of their ratios falls by more than chance explains, which is more for shorter sides.
bool is_shown(const OrientationCheck& check, int size) noexcept {
    const Orientation& o = check.closes;
    const auto moved = [&](int k) { return o.source[k] != k || o.turns[k] != 0 || o.mirrored[k]; };
    double gain = 0;
    int count = 0;
    for (int i = 0; i < 12; ++i) {
        const Seam& seam = seams()[i];
        if (!moved(seam.a.face) && !moved(seam.b.face)) continue;
        const double before = check.given_seams[i], after = check.best_seams[i];
        if (after > open_seam && after > before / 4) return false;
        gain += std::log(std::max(before, 1.0) / std::max(after, 1.0));
        ++count;
    }
    return count > 0 && gain / count > 0.1 + 0.9 / std::sqrt(double(size));
}

Image<float> mirrored(const Image<float>& face) {
    Image<float> result(face.width(), face.height(), face.channels());
    for (int y = 0; y < face.height(); ++y)
        for (int x = 0; x < face.width(); ++x)
            std::copy_n(&face.at(face.width() - 1 - x, y), face.channels(), &result.at(x, y));
    return result;
}

} // namespace

bool Orientation::as_given() const noexcept { return *this == Orientation{}; }

int OrientationCheck::open_given() const noexcept { return count_open(given_seams); }
int OrientationCheck::open_best() const noexcept { return count_open(best_seams); }

bool OrientationCheck::visible() const noexcept {
    int open[6] = {};
    for (int i = 0; i < 12; ++i)
        if (given_seams[i] > open_seam) ++open[seams()[i].a.face], ++open[seams()[i].b.face];
    return *std::max_element(open, open + 6) >= 3;
}

OrientationCheck check_orientation(const Cube& cube) {
    OrientationCheck check;
    const SideSteps sides = compare_sides(cube);
    check.unknown = sides.unknown;
    if (check.unknown) return check;
    check.closes = OrientationSearch(sides).best;
    check.given_seams = values_of(sides.ratio, {});
    check.best_seams = values_of(sides.ratio, check.closes);
    check.given = mean_of(values_of(sides.mean, {}));
    check.best = mean_of(values_of(sides.mean, check.closes));
    check.wrong = !check.closes.as_given() && is_shown(check, cube.size());
    return check;
}

Cube reorient(const Cube& cube, const Orientation& o) {
    Cube result;
    for (int k = 0; k < 6; ++k) {
        const Image<float>& face = cube.faces[o.source[k]];
        result.faces[k] = o.mirrored[k] ? turned(mirrored(face), o.turns[k]) : turned(face, o.turns[k]);
    }
    return result;
}

std::string to_text(const Orientation& o, const std::array<std::string, 6>& files) {
    constexpr const char* axes[6] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
    std::string text;
    for (int k = 0; k < 6; ++k) {
        if (o.source[k] == k && o.turns[k] == 0 && !o.mirrored[k]) continue;
        text += (text.empty() ? "" : ", ") + std::string(axes[k]) + " = " + files[o.source[k]];
        if (o.mirrored[k]) text += " mirrored left to right";
        if (o.turns[k])
            text += std::string(o.mirrored[k] ? " and" : "") + " turned " + std::to_string(90 * o.turns[k]) + " deg";
    }
    return text;
}

} // namespace bake
