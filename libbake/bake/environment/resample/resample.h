// One environment as another: other projection, other size, turned.
//
//   one     a bilinear look at the source from each texel's centre
//   grid4   the mean of 4 x 4 such looks
//   exact   each source texel is shared out by the overlap of its solid angle with the result's texels, so that all of its
//           radiance times solid angle arrives. Inside a texel radiance follows its slope (central differences, limited
//           to stay between the neighbours and above 0), which keeps the texel's mean: second order where the sky is
//           smooth, no ringing where it is not. A result's texel is the mean over its solid angle.
//           Second-order conservative remapping: Jones, First- and Second-Order Conservative Remapping Schemes for Grids in
//           Spherical Coordinates, Monthly Weather Review 1999; overlaps as in overlap.h.
//
// Between two pictures neither of which is a cube, exact goes through a cube that is finer than both.
#pragma once
#include "bake/environment/resample/overlap.h"
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/layout.h"
#include <functional>
#include <glm/mat3x3.hpp>

namespace bake {

class Progress;

enum class Samples { automatic, one, grid4, exact };

struct ResampleOptions {
    /// automatic: one where every texel finds its own texel again, grid4 from a ball or probe and to a result more than
    /// twice as fine as the source, else exact.
    Samples samples = Samples::automatic;
    glm::dmat3 turn{1}; ///< a rotation, source to result, in cube space
};

/// What automatic stands for; `density`: texels per radian of the result (Environment::density). `same_lattice`: it is
/// laid out as the source and of its size. Throws Error{Refusal::usage} for exact from a ball or a probe, whose texels at
/// the rim have no shape.
Samples resolve(const Environment& source, double density, bool same_lattice, const ResampleOptions& options);

/// A cube, channels as in the source. In a cube with edge samples, texels that two or three faces share are equal.
Cube to_cube(const Environment& source, const FaceGrid& grid, const ResampleOptions& options = {},
             Progress* progress = nullptr);
/// The faces of it, each turned by an even number of quarter turns, in bands of rows from the top down, so that a large
/// cube need not be whole in memory: take(k, y, band) gets rows from y on of faces[k].
void each_band(const Environment& source, const FaceGrid& grid, const ResampleOptions& options,
               const std::array<TurnedFace, 6>& faces,
               const std::function<void(int k, int y, Image<float>& band)>& take, Progress* progress = nullptr);
/// A picture of the whole sky.
Image<float> to_picture(const Environment& source, Projection projection, int width, int height,
                        const ResampleOptions& options = {}, Progress* progress = nullptr);

/// Turns by yaw (ahead moves to the right), then pitch (ahead moves up), then roll (the picture ahead turns clockwise).
glm::dmat3 turn_of(double yaw_deg, double pitch_deg, double roll_deg) noexcept;
/// Whether a rotation carries axes to axes; it is then rounded to do so exactly.
bool snap_to_axes(glm::dmat3& turn) noexcept;

} // namespace bake
