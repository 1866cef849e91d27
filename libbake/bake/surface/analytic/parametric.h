// Analytic surfaces p(u,v), with exact derivatives, over the unit square of the UV chart.
//
// u and v both run from 0 to 1 (p_u is per unit of u); y is up. All charts of closed shapes have N = p_u x p_v outward.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/analytic/closure.h"
#include "bake/surface/point/jet.h"
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace bake {

/// A point where p_u x p_v = 0: does the normal have a limit there?
enum class Pole { none, with_normal, without_normal };

struct AnalyticShape; // parametric_shapes.h

/// One analytic surface, by name and values: cheap to copy, immutable.
class ParametricSurface {
public:
    /// "torus:R=2,r=0.7": a name of parametric_shapes() and values for its keys; what is left out has its default.
    /// `revolution:profile=FILE` reads a curve of "radius height" lines, `bezier:file=FILE` a patch file.
    /// Throws Error{Refusal::usage} for an unknown name or key and values out of range, Error{Refusal::unreadable} for
    /// the files.
    explicit ParametricSurface(std::string_view shape);

    const std::string& name() const noexcept;
    int patches() const noexcept; ///< 1, or the Bezier patches of the file
    Closure closure_u() const noexcept;
    Closure closure_v() const noexcept;
    bool closed() const noexcept; ///< has no boundary and an inside
    bool orientable() const noexcept;
    std::pair<int, int> default_resolution() const noexcept; ///< cells along u and v that show the shape
    std::string help() const;                                ///< its keys and their values

    /// Point and derivatives, exact up to rounding; any finite u, v; periodic ones wrap. `patch` below patches().
    Jet2<double> derivatives(double u, double v, int patch = 0) const noexcept;

    /// The same with the outward unit normal and its derivatives. At a pole n is the limit normal where there is one
    /// (else zero), and sigma, n_u, n_v are 0.
    Jet<double> jet(double u, double v, int patch = 0) const noexcept;
    Pole pole(double u, double v, int patch = 0) const noexcept;
    /// The outward unit normal where there is one; at a pole what it tends to along the parameter that runs into it
    /// (one per meridian of a cone's apex); zero where that vanishes too.
    Vec3d side_normal(double u, double v, int patch = 0) const noexcept;

    const AnalyticShape& shape() const noexcept { return *shape_; }

private:
    Vec3d limit_normal(double u, double v, int patch) const noexcept;
    std::shared_ptr<const AnalyticShape> shape_;
};

/// Names of all shapes, with their keys and defaults: one line each, for --help.
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
