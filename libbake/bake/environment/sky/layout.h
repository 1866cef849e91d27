// Six faces in one picture, and faces turned.
//
//   hcross: 4 x 3 cells     py           vcross: 3 x 4 cells     py         strip: the six faces, one below the other
//                        nx pz px nz                          nx pz px      hstrip: the same, side by side
//                           ny                                   ny
//                                                                nz turned by 180 deg, so that it joins ny
//
// A strip is in OpenGL's order px nx py ny pz nz (Direct3D's and RenderMan's too), or in OpenEXR's: +X -X +Y -Y +Z -Z of
// its own axes, which are the world's, so x changes sign: nx px py ny pz nz, py and ny turned by 180 deg.
#pragma once
#include "bake/environment/sky/cube.h"
#include <optional>
#include <string>

namespace bake {

enum class CubeLayout { hcross, vcross, strip, hstrip };
enum class FaceOrder { gl, openexr };

/// A face and how many quarter turns, counter-clockwise as one looks at the picture, it has been given.
struct TurnedFace {
    CubeFace face;
    int turns;
};
/// What stands at place k = 0 ... 5 of a strip of this order.
TurnedFace face_at(FaceOrder order, int k) noexcept;

/// The picture of a square face turned counter-clockwise by quarter turns, any number of them.
Image<float> turned(const Image<float>& face, int quarter_turns);

/// The layout a picture of this size can only be; nothing for others.
std::optional<CubeLayout> layout_of_size(int width, int height) noexcept;

/// Cuts the faces out; cells of a cross without a face are not looked at. Throws Error{Refusal::unsuitable}, beginning
/// with `file`, when the size does not fit. Orders other than gl are for strips alone.
Cube cut_faces(const Image<float>& picture, CubeLayout layout, FaceOrder order, const std::string& file);
/// The reverse; cells without a face are 0.
Image<float> paste_faces(const Cube& cube, CubeLayout layout, FaceOrder order = FaceOrder::gl);

} // namespace bake
