// Table of the shapes of ParametricSurface: names, keys and point functions.
#pragma once
#include "bake/surface/analytic/bezier.h"
#include "bake/surface/analytic/closure.h"
#include "bake/surface/analytic/profile.h"
#include <span>

namespace bake {

struct ShapeKey {
    const char* name;
    double value;       ///< default
    double least, most; ///< inclusive
    const char* what;
};

/// Closures of the unit square of parameters.
struct ShapeDomain {
    Closure closure_u, closure_v;
    bool closed = false; ///< the surface has an inside
};

struct ShapeCells {
    int columns, rows;
};

struct AnalyticShape;

/// One kind of shape. Functions take the values in the order of the keys.
struct ShapeKind {
    const char* name;
    const char* what;
    std::vector<ShapeKey> keys;
    ShapeDomain domain;
    ShapeCells cells; ///< default resolution
    Jet2<double> (*derivatives)(const AnalyticShape& shape, double u, double v, int patch);
    /// If not null: returns the constraint between keys that the values violate, or null.
    const char* (*fault)(const double* value);
    const char* file_key; ///< if not null: the key whose value is a file
};
std::span<const ShapeKind> shape_kinds();

struct AnalyticShape {
    std::string name;
    const ShapeKind* kind = nullptr;
    std::vector<double> values;
    Profile profile;                  ///< revolution
    std::vector<BezierPatch> patches; ///< bezier
    BezierBorders borders;            ///< bezier
    Closure closure_u = Closure::open, closure_v = Closure::open;
    bool closed = false;
};

} // namespace bake
