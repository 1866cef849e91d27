#include "bake/surface/analytic/parametric.h"
#include "bake/base/edit_distance.h"
#include "bake/base/error.h"
#include "bake/base/parse_double.h"
#include "bake/base/text.h"
#include "bake/surface/analytic/parametric_shapes.h"
#include "bake/surface/point/curvature.h"
#include <algorithm>

namespace bake {
namespace {

/// For example "torus:R=1,r=0.4".
std::string spelled(const ShapeKind& kind) {
    std::string out = kind.name;
    char mark = ':';
    const auto add = [&](const std::string& text) {
        out += mark + text;
        mark = ',';
    };
    if (kind.file_key) add(kind.file_key + std::string("=FILE"));
    for (const ShapeKey& key : kind.keys) add(key.name + format("=%g", key.value));
    return out;
}

const ShapeKind& kind_named(std::string_view name, const std::string& head) {
    const auto kinds = shape_kinds();
    const auto by_name = [&](const ShapeKind& kind) { return kind.name == name; };
    if (const auto found = std::find_if(kinds.begin(), kinds.end(), by_name); found != kinds.end()) return *found;
    const auto nearest = std::min_element(kinds.begin(), kinds.end(), [&](const ShapeKind& a, const ShapeKind& b) {
        return edit_distance(a.name, name) < edit_distance(b.name, name);
    });
    std::string all;
    for (const ShapeKind& kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kind.name);
    const std::string near =
        edit_distance(nearest->name, name) <= 3 ? "did you mean " + std::string(nearest->name) + "? " : "";
    throw Error{Refusal::usage, head + "no such shape; " + near + "the shapes are " + all};
}

/// Replaces defaults in `values` by those in "key=value,..." and returns the file name among them. Refusals start with
/// `head`.
std::string read_values(const ShapeKind& kind, const std::string& head, std::string_view text,
                        std::vector<double>& values) {
    const auto refuse = [&](const std::string& what) { throw Error{Refusal::usage, head + what}; };
    std::string file;
    std::vector<std::string_view> given;
    while (!text.empty()) {
        const std::string_view entry = text.substr(0, text.find(','));
        text = entry.size() == text.size() ? "" : text.substr(entry.size() + 1);
        const std::size_t equals = entry.find('=');
        const std::string_view value = equals == std::string_view::npos ? "" : entry.substr(equals + 1);
        const std::string name(entry.substr(0, equals));
        const auto key =
            std::find_if(kind.keys.begin(), kind.keys.end(), [&](const ShapeKey& k) { return k.name == name; });
        const bool is_file = kind.file_key && name == kind.file_key;
        if (key == kind.keys.end() && !is_file)
            refuse(shown(name) + " is not a key of " + kind.name + "; write " + spelled(kind));
        if (std::find(given.begin(), given.end(), name) != given.end()) refuse(name + " is given twice; remove one");
        given.push_back(entry.substr(0, equals));
        if (is_file) {
            file = value;
            continue;
        }
        const auto number = parse_finite(value);
        if (!number) refuse(name + " needs a number, not " + shown(value) + "; write " + spelled(kind));
        if (!(*number >= key->least && *number <= key->most))
            refuse(name + format(" must be between %g and %g; its default is %g", key->least, key->most, key->value));
        values[std::size_t(key - kind.keys.begin())] = *number;
    }
    return file;
}

/// Derivatives of N = p_u x p_v along u and v.
struct NormalDerivatives {
    Vec3d along_u, along_v;
};
NormalDerivatives normal_derivatives(const Jet2<double>& s) noexcept {
    return {glm::cross(s.p_uu, s.p_v) + glm::cross(s.p_u, s.p_uv),
            glm::cross(s.p_uv, s.p_v) + glm::cross(s.p_u, s.p_vv)};
}

/// Direction from t to the inside of the unit interval: +1 at t = 0, -1 at t = 1, else 0. 0 if the interval is closed.
double inward(double t, Closure closure) noexcept {
    if (closure != Closure::open) return 0;
    return t == 0 ? 1 : t == 1 ? -1 : 0;
}

/// True if v is zero up to rounding.
bool vanishes(const Vec3d& v, double scale) noexcept { return !(glm::length(v) > 1e-12 * scale); }

bool same_direction(const Vec3d& a, const Vec3d& b) noexcept { return glm::length(a - b) < 1e-9; }

/// Samples along a collapsed edge. Odd, so that one is on the symmetry axis of a shape.
constexpr int samples = 7;

} // namespace

ParametricSurface::ParametricSurface(std::string_view text) {
    const std::string head = "shape " + shown(text) + ": ";
    const std::size_t colon = text.find(':');
    const ShapeKind& kind = kind_named(text.substr(0, colon), head);
    auto shape = std::make_shared<AnalyticShape>();
    shape->name = kind.name;
    shape->kind = &kind;
    for (const ShapeKey& key : kind.keys) shape->values.push_back(key.value);
    std::string file;
    if (colon != std::string_view::npos) file = read_values(kind, head, text.substr(colon + 1), shape->values);
    if (const char* fault = kind.fault ? kind.fault(shape->values.data()) : nullptr)
        throw Error{Refusal::usage, head + fault + "; the default is " + spelled(kind)};
    if (kind.file_key && file.empty()) throw Error{Refusal::usage, head + "it needs a file; write " + spelled(kind)};

    shape->closure_u = kind.domain.closure_u;
    shape->closure_v = kind.domain.closure_v;
    shape->closed = kind.domain.closed;
    if (shape->name == "revolution") {
        shape->profile = read_profile(file, shape->values[0] != 0);
        if (shape->profile.loop) shape->closure_v = Closure::periodic;
        shape->closed =
            shape->profile.loop || (shape->profile.points.front().x == 0 && shape->profile.points.back().x == 0);
    }
    if (shape->name == "bezier") {
        shape->patches = read_bezier(file);
        if (shape->values[0] != 0) // mirrored in u, which reverses N
            for (BezierPatch& patch : shape->patches)
                for (auto row = patch.points.begin(); row != patch.points.end(); row += 4) std::reverse(row, row + 4);
        shape->borders = bezier_borders(shape->patches);
        shape->closed = shape->borders.closed;
    }
    shape_ = std::move(shape);
}

const std::string& ParametricSurface::name() const noexcept { return shape_->name; }
int ParametricSurface::patches() const noexcept { return std::max(1, int(shape_->patches.size())); }
Closure ParametricSurface::closure_u() const noexcept { return shape_->closure_u; }
Closure ParametricSurface::closure_v() const noexcept { return shape_->closure_v; }
bool ParametricSurface::closed() const noexcept { return shape_->closed; }
std::pair<int, int> ParametricSurface::default_resolution() const noexcept {
    return {shape_->kind->cells.columns, shape_->kind->cells.rows};
}

std::string ParametricSurface::help() const {
    std::string out = shape_->name + ", " + shape_->kind->what;
    for (std::size_t i = 0; i < shape_->values.size(); ++i) {
        const ShapeKey& key = shape_->kind->keys[i];
        out += format("%s %s=%g (%s)", i == 0 ? ":" : ",", key.name, shape_->values[i], key.what);
    }
    return out;
}

Jet2<double> ParametricSurface::derivatives(double u, double v, int patch) const noexcept {
    return shape_->kind->derivatives(*shape_, u, v, patch);
}

Vec3d ParametricSurface::side_normal(double u, double v, int patch) const noexcept {
    const Jet2<double> s = derivatives(u, v, patch);
    if (const Vec3d n = jet_of(s).n; n != Vec3d(0)) return n;
    const NormalDerivatives g = normal_derivatives(s);
    const double into_u = inward(u, closure_u()), into_v = inward(v, closure_v());
    return unit_or_zero(into_u * g.along_u + into_v * g.along_v);
}

Vec3d ParametricSurface::limit_normal(double u, double v, int patch) const noexcept {
    const Jet2<double> s = derivatives(u, v, patch);
    const double into_u = inward(u, closure_u()), into_v = inward(v, closure_v());
    const NormalDerivatives g = normal_derivatives(s);
    const double second = glm::length(s.p_uu) + glm::length(s.p_uv) + glm::length(s.p_vv),
                 scale = (glm::length(s.p_u) + glm::length(s.p_v)) * second;
    const bool grows_u = !vanishes(g.along_u, scale), grows_v = !vanishes(g.along_v, scale);
    // At an inner point N would change its sign: a fold. If both derivatives vanish the direction is unknown.
    if ((grows_u && into_u == 0) || (grows_v && into_v == 0) || !(grows_u || grows_v)) return Vec3d(0);
    const Vec3d along_u = grows_u ? unit_or_zero(into_u * g.along_u) : Vec3d(0),
                along_v = grows_v ? unit_or_zero(into_v * g.along_v) : Vec3d(0);
    if (grows_u && grows_v && !same_direction(along_u, along_v)) return Vec3d(0);
    const Vec3d n = grows_v ? along_v : along_u;

    // If a whole edge collapses to the point, the limits along all parameter lines to it must agree.
    const auto agree = [&](bool u_varies) {
        for (int k = 1; k <= samples; ++k) {
            const double t = k / (samples + 1.0), at_u = u_varies ? t : u, at_v = u_varies ? v : t;
            const Jet2<double> other = derivatives(at_u, at_v, patch);
            if (jet_of(other).sigma != 0 || other.p != s.p) return true; // the edge does not collapse
            if (!same_direction(side_normal(at_u, at_v, patch), n)) return false;
        }
        return true;
    };
    return (into_v == 0 || agree(true)) && (into_u == 0 || agree(false)) ? n : Vec3d(0);
}

Jet<double> ParametricSurface::jet(double u, double v, int patch) const noexcept {
    Jet<double> jet = jet_of(derivatives(u, v, patch));
    if (jet.sigma == 0) jet.n = limit_normal(u, v, patch);
    return jet;
}

Pole ParametricSurface::pole(double u, double v, int patch) const noexcept {
    if (jet_of(derivatives(u, v, patch)).sigma != 0) return Pole::none;
    return limit_normal(u, v, patch) == Vec3d(0) ? Pole::without_normal : Pole::with_normal;
}

std::string parametric_shapes() {
    std::string out;
    for (const ShapeKind& kind : shape_kinds()) out += format("%-46s %s\n", spelled(kind).c_str(), kind.what);
    return out;
}

} // namespace bake
