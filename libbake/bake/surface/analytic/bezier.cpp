#include "bake/surface/analytic/bezier.h"
#include "bake/base/error.h"
#include "bake/base/number_lines.h"
#include <algorithm>
#include <map>

namespace bake {
namespace {

constexpr double most_patches = 1e6;

struct Reader {
    const std::string& path;
    std::vector<NumberLine> lines;
    std::size_t next = 0;

    [[noreturn]] void refuse(const std::string& what) const {
        const std::string where = lines.empty()         ? ": the file holds no numbers; "
                                  : next < lines.size() ? ": line " + std::to_string(lines[next].line) + ": "
                                                        : ": the file ends too soon; ";
        throw Error{Refusal::unreadable, path + where + what};
    }
    const std::vector<double>& take(std::size_t count, const char* what) {
        if (next >= lines.size() || lines[next].values.size() != count) refuse(what);
        return lines[next++].values;
    }
    std::size_t count(const char* what) {
        const double value = take(1, what)[0];
        --next;
        if (!(value >= 1 && value <= most_patches && value == std::floor(value))) refuse(what);
        ++next;
        return std::size_t(value);
    }
    Vec3d point() {
        const auto& v = take(3, "not a point; write 'x y z'");
        return {v[0], v[1], v[2]};
    }
};

/// Bernstein polynomials of degree 3; exact at t = 0 and 1.
std::array<double, 4> basis(double t) noexcept {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// Value and first two derivatives of a cubic curve. They are sums of differences of control points, so that coincident
/// points give derivatives of exactly 0.
struct Curve {
    Vec3d p, d, dd;
};
Curve curve_at(const std::array<Vec3d, 4>& c, double t) noexcept {
    const double s = 1 - t;
    const Vec3d a = c[1] - c[0], b = c[2] - c[1], e = c[3] - c[2];
    return {bezier_curve(c, t), 3.0 * (s * s * a + 2 * s * t * b + t * t * e), 6.0 * (s * (b - a) + t * (e - b))};
}

/// The control points of a border as a map key.
using Key = std::array<double, 12>;
Key key_of(const std::array<Vec3d, 4>& c, bool reversed) {
    Key key;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            key[std::size_t(3 * i + k)] = c[std::size_t(reversed ? 3 - i : i)][k] + 0.0; // turns -0 into 0
    return key;
}

/// 16 points per patch, with the line "3 3" before them if `with_degrees`.
std::vector<BezierPatch> read_points(Reader& in, std::size_t patches, bool with_degrees) {
    std::vector<BezierPatch> out;
    for (std::size_t i = 0; i < patches; ++i) {
        if (with_degrees && in.take(2, "no degrees; write '3 3' before every patch") != std::vector<double>{3, 3}) {
            --in.next;
            in.refuse("not a bicubic patch; its degrees must be '3 3'");
        }
        BezierPatch& patch = out.emplace_back();
        for (Vec3d& p : patch.points) p = in.point();
    }
    return out;
}

/// 16 indices per patch, then the points.
std::vector<BezierPatch> read_indexed(Reader& in, std::size_t patches) {
    const std::size_t first = in.next;
    bool from_zero = false;
    for (std::size_t i = 0; i < patches; ++i) {
        const auto& indices = in.take(16, "not a patch; write 16 indices on one line");
        from_zero = from_zero || std::find(indices.begin(), indices.end(), 0.0) != indices.end();
    }
    const std::size_t count = in.count("not a number of points; write it alone on its line");
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(in.point());
    const std::size_t end = in.next;
    std::vector<BezierPatch> out;
    for (in.next = first; in.next < first + patches; ++in.next) {
        BezierPatch& patch = out.emplace_back();
        for (std::size_t i = 0; i < 16; ++i) {
            const double index = in.lines[in.next].values[i] - (from_zero ? 0 : 1);
            if (!(index >= 0 && index < double(count) && index == std::floor(index)))
                in.refuse("an index is not the number of a point; there are " + std::to_string(count) + " points");
            patch.points[i] = points[std::size_t(index)];
        }
    }
    in.next = end;
    return out;
}

} // namespace

std::vector<BezierPatch> read_bezier(const std::string& path) {
    Reader in{path, read_number_lines(path)};
    const std::size_t patches = in.count("not a number of patches; write it alone on its line");
    if (in.next == in.lines.size()) in.refuse("there are no patches; write them after their number");
    const std::size_t numbers = in.lines[in.next].values.size();
    if (numbers != 2 && numbers != 3 && numbers != 16)
        in.refuse("not a patch; write a point 'x y z', the degrees '3 3' or 16 indices");
    std::vector<BezierPatch> out = numbers == 16 ? read_indexed(in, patches) : read_points(in, patches, numbers == 2);
    if (in.next < in.lines.size())
        in.refuse("there are more lines than the given number of patches; correct the number");
    return out;
}

Vec3d bezier_curve(std::span<const Vec3d, 4> c, double t) noexcept {
    const auto b = basis(t);
    return b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
}

Jet2<double> bezier_derivatives(const BezierPatch& patch, double u, double v) noexcept {
    std::array<Curve, 4> rows;
    for (std::size_t j = 0; j < 4; ++j) {
        const Vec3d* const p = &patch.points[4 * j];
        rows[j] = curve_at({p[0], p[1], p[2], p[3]}, u);
    }
    const Curve p = curve_at({rows[0].p, rows[1].p, rows[2].p, rows[3].p}, v),
                d = curve_at({rows[0].d, rows[1].d, rows[2].d, rows[3].d}, v),
                dd = curve_at({rows[0].dd, rows[1].dd, rows[2].dd, rows[3].dd}, v);
    return {p.p, d.p, p.d, dd.p, d.d, p.dd};
}

std::array<Vec3d, 4> bezier_border(const BezierPatch& patch, int side) noexcept {
    const auto& p = patch.points;
    switch (side) {
    case 0: return {p[0], p[1], p[2], p[3]};
    case 1: return {p[3], p[7], p[11], p[15]};
    case 2: return {p[12], p[13], p[14], p[15]};
    default: return {p[0], p[4], p[8], p[12]};
    }
}

BezierBorders bezier_borders(const std::vector<BezierPatch>& patches) {
    BezierBorders out;
    std::map<Key, std::uint32_t> borders;
    std::map<std::array<double, 3>, std::uint32_t> corners;
    std::vector<int> sides;
    for (const BezierPatch& patch : patches) {
        auto& corner = out.corner.emplace_back();
        auto& border = out.border.emplace_back();
        auto& reversed = out.reversed.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3d p = patch.points[std::array{0u, 3u, 15u, 12u}[k]] + 0.0;
            corner[k] = corners.try_emplace({p.x, p.y, p.z}, std::uint32_t(corners.size())).first->second;
            const auto curve = bezier_border(patch, int(k));
            const Key forward = key_of(curve, false), backward = key_of(curve, true);
            reversed[k] = backward < forward;
            const auto [found, fresh] = borders.try_emplace(std::min(forward, backward), std::uint32_t(borders.size()));
            border[k] = found->second;
            if (fresh) {
                auto& canonical = out.curve.emplace_back(curve);
                if (reversed[k]) std::reverse(canonical.begin(), canonical.end());
                out.point.push_back(
                    std::all_of(curve.begin(), curve.end(), [&](const Vec3d& q) { return q == curve[0]; }));
                sides.push_back(0);
            }
            ++sides[border[k]];
        }
    }
    out.corners = std::uint32_t(corners.size());
    out.closed = true;
    for (std::size_t b = 0; b < sides.size(); ++b) out.closed = out.closed && (out.point[b] || sides[b] == 2);
    return out;
}

} // namespace bake
