// The shapes behind ParametricSurface: a table of names, keys and point functions.
#pragma once
#include "bake/surface/analytic/bezier.h"
#include "bake/surface/analytic/closure.h"
#include "bake/surface/analytic/profile.h"
#include <span>

namespace bake {

struct ShapeKey {
    const char* name;
    double value;       ///< unless given
    double least, most; ///< inclusive
    const char* what;
};

struct AnalyticShape;

/// One kind of shape. Values come in the order of the keys.
struct ShapeKind {
    const char* name;
    const char* what;
    std::vector<ShapeKey> keys;
    const char* file_key; ///< null, or the key that names its file
    Closure closure_u, closure_v;
    bool closed, orientable;
    int columns, rows;
    const char* (*fault)(const double* value); ///< what values do not go together, or null; itself null: any do
    Jet2<double> (*derivatives)(const AnalyticShape& shape, double u, double v, int patch);
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
