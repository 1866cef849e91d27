// Analytic surfaces p(u,v) with exact derivatives. The UV chart is the unit square.
//
// u and v are in [0, 1], and p_u is per unit of u; y is up. N = p_u x p_v points outward on closed shapes.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/analytic/closure.h"
#include "bake/surface/point/jet.h"
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace bake {

/// none: p_u x p_v is not 0. Otherwise the normal has or does not have a limit at the point.
enum class Pole { none, with_normal, without_normal };

struct AnalyticShape; // parametric_shapes.h

/// An analytic surface: immutable and cheap to copy.
class ParametricSurface {
public:
    /// From text such as "torus:R=2,r=0.7": a name of parametric_shapes() and values of its keys; other keys have their
    /// defaults. `revolution:profile=FILE` reads a profile (profile.h), `bezier:file=FILE` a patch file (bezier.h).
    /// Throws Error{Refusal::usage} for an unknown name or key or a value out of range, Error{Refusal::unreadable} for
    /// a faulty file.
    explicit ParametricSurface(std::string_view shape);

    const std::string& name() const noexcept;
    int patches() const noexcept; ///< 1, or the number of Bezier patches in the file
    Closure closure_u() const noexcept;
    Closure closure_v() const noexcept;
    bool closed() const noexcept;                            ///< without boundary and two-sided
    std::pair<int, int> default_resolution() const noexcept; ///< cells along u and v
    std::string help() const;                                ///< description with keys and values

    /// Point and derivatives, exact up to rounding. u and v are finite; periodic parameters wrap. patch < patches().
    Jet2<double> derivatives(double u, double v, int patch = 0) const noexcept;

    /// Point, first derivatives, and the outward unit normal with its derivatives. At a pole n is the limit normal or, if
    /// there is none, zero; sigma, n_u and n_v are zero.
    Jet<double> jet(double u, double v, int patch = 0) const noexcept;
    Pole pole(double u, double v, int patch = 0) const noexcept;
    /// The outward unit normal. At a pole it is the limit along the parameter line that ends there (along the meridian at
    /// the apex of a cone), or zero if that limit does not exist.
    Vec3d side_normal(double u, double v, int patch = 0) const noexcept;

    const AnalyticShape& shape() const noexcept { return *shape_; }

private:
    Vec3d limit_normal(double u, double v, int patch) const noexcept;
    std::shared_ptr<const AnalyticShape> shape_;
};

/// One line per shape with its name, keys and defaults, for help texts.
std::string parametric_shapes();

/// columns x rows quads over every patch, patch by patch and row by row: face (patch rows + j) columns + i has the
/// corners (i,j) (i+1,j) (i+1,j+1) (i,j+1). uv = parameters, exact normals, positions shared at closures and poles. Quads
/// at a pole keep four corners, two of which share their position, so that each keeps its own uv
/// (see without_repeats()). Bezier patches share the positions of common borders when these are bit-equal.
/// Throws Error{Refusal::usage} for fewer than one column or row, or 3 of them along a periodic direction.
Mesh tessellate(const ParametricSurface& surface, int columns, int rows);

/// The mesh with corners that repeat their predecessor's position taken out, and faces left with fewer than three.
Mesh without_repeats(const Mesh& mesh);

} // namespace bake
