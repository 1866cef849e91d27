// The angles between the normals of two pictures, as a report. Conventions are told apart first.
#pragma once
#include "bake/relief/height/normal_values.h"
#include "bake/verdict/compare/figures.h"
#include "bake/verdict/inspect.h"
#include <optional>

namespace bake {

enum class NormalSpace {
    tangent, ///< channels and encoding as guess_normal_values() finds them; green as check_normals() finds it
    object, ///< three channels; n = rgb if a value is below 0 or floats are so nearer to unit length, else n = 2 rgb - 1;
            ///< green is not examined
};

struct NormalsCompareOptions {
    NormalSpace space = NormalSpace::tangent;
    std::vector<Limit> limits; ///< angle, angle-p95, angle-p99, angle-max, degrees
};

struct NormalsReport {
    std::string file, other;
    int width = 0, height = 0;
    NormalSpace space = NormalSpace::tangent;
    NormalValues values, other_values;
    PairCheck check;           ///< of tangent space
    bool green_turned = false; ///< the green of the second points the other way, and was turned before comparing
    std::size_t left_out = 0;  ///< pixels where one of the two has no direction
    ErrorSummary angles;       ///< degrees
    Findings findings;
    bool over_limit = false;
    Image<float> errors; ///< degrees, one channel; 0 where left out
};

/// Degrees between two vectors of any length above 0, accurate for small angles too.
double angle_deg(const Vec3d& a, const Vec3d& b) noexcept;

/// Throws the errors of read_image(), Error{Refusal::unsuitable} naming the file for other sizes, too few channels, NaN or
/// Inf and pictures without any common direction, and Error{Refusal::usage} for an unknown limit.
NormalsReport compare_normals(const std::string& file, const std::string& other,
                              const NormalsCompareOptions& options = {});

std::vector<Figure> figures(const NormalsReport& report);
std::string to_text(const NormalsReport& report);
std::string to_json(const NormalsReport& report);

} // namespace bake
