#include "bake/relief/displace/error.h"
#include "bake/base/progress.h"

namespace bake {

namespace {

constexpr std::size_t batch = 4096;

}

std::span<const Vec3d> DisplacedPatch::points(std::uint32_t patch, std::span<const Vec2d> st) {
    throw_if_interrupted();
    if (base_.size() < st.size()) base_.resize(st.size()), values_.resize(st.size()), points_.resize(st.size());
    surface_->base().evaluate(patch, st, {base_.data(), st.size()});
    surface_->values(patch, st, {base_.data(), st.size()}, {values_.data(), st.size()});
    for (std::size_t i = 0; i < st.size(); ++i) {
        if (blend_->touches(patch)) blend_->add(patch, st[i], base_[i], values_[i]);
        points_[i] = base_[i].jet.p + surface_->displacement(base_[i], values_[i]);
    }
    return {points_.data(), st.size()};
}

void DisplacedPatch::points(std::uint32_t patch, std::span<const Vec2d> st, std::vector<Vec3d>& out) {
    out.resize(st.size());
    for (std::size_t done = 0; done < st.size(); done += batch) {
        const auto some = points(patch, st.subspan(done, std::min(batch, st.size() - done)));
        std::copy(some.begin(), some.end(), out.begin() + std::int64_t(done));
    }
}

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) noexcept {
    const Vec3d ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double x = length2 > 0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - a - x * ab);
}

double distance_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) noexcept {
    const Vec3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return glm::length(ap);
    const Vec3d bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return glm::length(bp);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return glm::length(ap - d1 / (d1 - d3) * ab);
    const Vec3d cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return glm::length(cp);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return glm::length(ap - d2 / (d2 - d6) * ac);
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && d4 - d3 + d5 - d6 > 0)
        return glm::length(bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
    const double all = va + vb + vc; // of the squared area; below this it is rounding error
    if (!(all > 1e-14 * glm::dot(ab, ab) * glm::dot(ac, ac)))
        return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
    return glm::length(ap - vb / all * ab - vc / all * ac);
}

namespace {

/// Compares faces with the surface, in batches.
class Comparison {
public:
    Comparison(DisplacedPatch& patch, std::uint32_t number, std::span<const Vec2d> places,
               std::span<const Vec3d> points, std::span<const Vec2d> texels, std::uint32_t first_inside, double enough)
        : patch_(patch), number_(number), places_(places), points_(points), texels_(texels),
          first_inside_(first_inside), enough_(enough) {}

    void add(std::span<const std::uint32_t> corner) {
        if (error_.max() > enough_) return;
        const auto sides = int(corner.size());
        double longest = 0;
        for (int k = 0; k < sides; ++k)
            longest = std::max(longest, glm::length(texels_[corner[(k + 1) % sides]] - texels_[corner[k]]));
        Face face{{corner[0], corner[1], corner[2], corner[sides - 1]},
                  int(std::clamp(std::ceil(longest), 2.0, 64.0)),
                  sides};
        const auto place = [&](int k) { return places_[corner[k]]; };
        for (int j = 0; j <= face.cuts; ++j)
            for (int i = 0; i <= (sides == 4 ? face.cuts : face.cuts - j); ++i) {
                if (is_corner(face, i, j)) continue;
                const double x = double(i) / face.cuts, y = double(j) / face.cuts;
                st_.push_back(sides == 4 ? (1 - y) * ((1 - x) * place(0) + x * place(1)) +
                                               y * ((1 - x) * place(3) + x * place(2))
                                         : (1 - x - y) * place(0) + x * place(1) + y * place(2));
            }
        faces_.push_back(face);
        if (st_.size() >= batch) compare();
    }
    const CellError& finish() {
        compare();
        return error_;
    }

private:
    struct Face {
        std::uint32_t corner[4];
        int cuts, sides;
    };

    static bool is_corner(const Face& f, int i, int j) noexcept {
        return (i == 0 || i == f.cuts) && (j == 0 || j == f.cuts);
    }

    void compare() {
        if (faces_.empty()) return;
        const std::span<const Vec3d> at = patch_.points(number_, st_);
        std::size_t next = 0;
        for (const Face& f : faces_) {
            const Vec3d &a = points_[f.corner[0]], &b = points_[f.corner[1]], &c = points_[f.corner[2]];
            const Vec3d& d = points_[f.corner[3]];
            bool inside = true;
            for (int k = 0; k < f.sides; ++k) inside &= f.corner[k] >= first_inside_;
            double& worst = inside ? error_.inside : error_.border;
            for (int j = 0; j <= f.cuts; ++j)
                for (int i = 0; i <= (f.sides == 4 ? f.cuts : f.cuts - j); ++i) {
                    if (is_corner(f, i, j)) continue;
                    const Vec3d& p = at[next++];
                    double distance = 0;
                    if (f.sides == 3) distance = distance_to_triangle(p, a, b, c);
                    else {
                        distance = i >= j ? distance_to_triangle(p, a, b, c) : distance_to_triangle(p, a, c, d);
                        distance = std::max(distance, i + j <= f.cuts ? distance_to_triangle(p, a, b, d)
                                                                      : distance_to_triangle(p, b, c, d));
                    }
                    worst = std::max(worst, distance);
                    error_.square_sum += distance * distance;
                    ++error_.samples;
                }
        }
        faces_.clear();
        st_.clear();
    }

    DisplacedPatch& patch_;
    std::uint32_t number_;
    std::span<const Vec2d> places_;
    std::span<const Vec3d> points_;
    std::span<const Vec2d> texels_;
    std::uint32_t first_inside_;
    double enough_;
    std::vector<Face> faces_;
    std::vector<Vec2d> st_;
    CellError error_;
};

} // namespace

CellError cell_error(DisplacedPatch& patch, const PatchCells& cells, std::uint32_t cell, const PatchRates& r,
                     double enough) {
    std::vector<Vec2d> places;
    places.reserve(std::size_t(inner_points(r)) + r.side[0] + r.side[1] + r.side[2] + (r.sides == 4 ? r.side[3] : 0));
    CellRing border;
    const std::uint32_t inside =
        border.number(cells, cell, r, [&](const Vec2d& place, const Vec2d&) { places.push_back(place); });
    const std::uint32_t number = cells.patch(cell);
    std::vector<Vec3d> points(places.size());
    std::vector<Vec2d> texels(places.size());
    for (std::size_t done = 0; done < places.size(); done += batch) {
        const auto some = std::span(places).subspan(done, std::min(batch, places.size() - done));
        const auto at = patch.points(number, some);
        std::copy(at.begin(), at.end(), points.begin() + std::int64_t(done));
        for (std::size_t i = 0; i < some.size(); ++i) texels[done + i] = patch.base()[i].uv * patch.surface().texels();
    }
    Comparison comparison(patch, number, places, points, texels, inside, enough);
    FaceVisitor visitor([&](std::span<const std::uint32_t> face) { comparison.add(face); });
    emit_faces(r, border.ring, inside, visitor);
    return comparison.finish();
}

} // namespace bake
