// Resampling of an environment to another projection, another size or another rotation.
//
//   one     bilinear interpolation of the source at the centre of each texel
//   grid4   the mean of 4 x 4 interpolated samples per texel
//   exact   second-order conservative remapping: Jones, First- and Second-Order Conservative Remapping Schemes for Grids in
//           Spherical Coordinates, Monthly Weather Review 1999. The flux of each source texel is distributed by the overlap
//           of its solid angle with the texels of the result (overlap.h), so that no flux is lost. Radiance inside a source
//           texel is linear with the slopes of slope.h, which keep the mean: second order where the sky is smooth, without
//           ringing elsewhere. A texel of the result is the mean over its solid angle.
//
// Between two pictures of the whole sky, exact resamples through a cube that is finer than both.
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
    /// automatic: one if texels map to texels (also after a yaw by whole columns of a lat-long), grid4 from a projection with discs and to a result more than twice as fine as
    /// the source, otherwise exact.
    Samples samples = Samples::automatic;
    glm::dmat3 turn{1}; ///< a rotation, source to result, in cube space
};

/// Resolves automatic. `density`: texels per radian of the result (Environment::density). `same_lattice`: the result has the
/// layout and the size of the source. Throws Error{Refusal::usage} for exact from a projection with discs, because the
/// texels at a rim are cut by it.
Samples resolve(const Environment& source, double density, bool same_lattice, const ResampleOptions& options);

/// A cube with the channels of the source. In a cube with edge samples, texels that two or three faces share are equal.
Cube to_cube(const Environment& source, const FaceGrid& grid, const ResampleOptions& options = {},
             Progress* progress = nullptr);
/// The faces of to_cube, each turned by an even number of quarter turns, in bands of rows from the top down, so that a
/// large cube is never whole in memory: take(k, y, band) gets rows from y on of faces[k].
void each_band(const Environment& source, const FaceGrid& grid, const ResampleOptions& options,
               const std::array<TurnedFace, 6>& faces,
               const std::function<void(int k, int y, Image<float>& band)>& take, Progress* progress = nullptr);
/// A picture of the whole sky.
Image<float> to_picture(const Environment& source, Projection projection, int width, int height,
                        const ResampleOptions& options = {}, Progress* progress = nullptr);

/// Rotation by yaw (ahead moves to the right), then pitch (ahead moves up), then roll (the picture ahead turns clockwise).
glm::dmat3 turn_of(double yaw_deg, double pitch_deg, double roll_deg) noexcept;
/// Whether a rotation maps axes to axes; such a rotation is rounded to do so exactly.
bool snap_to_axes(glm::dmat3& turn) noexcept;

} // namespace bake
