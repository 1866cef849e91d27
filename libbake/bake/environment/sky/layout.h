// Layouts of six faces in one picture, and rotation of faces.
//
//   hcross: 4 x 3 cells     py           vcross: 3 x 4 cells     py         strip: the six faces, one below the other
//                        nx pz px nz                          nx pz px      hstrip: the same, side by side
//                           ny                                   ny
//                                                                nz turned by 180 deg, so that it joins ny
//
// A strip has OpenGL's order px nx py ny pz nz, which is also Direct3D's and RenderMan's, or OpenEXR's order +X -X +Y -Y +Z
// -Z. OpenEXR's axes are those of the world, so that x changes sign: nx px py ny pz nz, with py and ny turned by 180 deg.
#pragma once
#include "bake/environment/sky/cube.h"
#include <string>

namespace bake {

enum class CubeLayout { hcross, vcross, strip, hstrip };
enum class FaceOrder { gl, openexr };

/// A face, and the number of quarter turns by which it is turned in the picture, counter-clockwise as seen by a viewer.
struct TurnedFace {
    CubeFace face;
    int turns;
};
/// The face at position k = 0 ... 5 of a strip of this order.
TurnedFace face_at(FaceOrder order, int k) noexcept;

/// A square face turned counter-clockwise by any number of quarter turns.
Image<float> turned(const Image<float>& face, int quarter_turns);

/// Cuts the faces out of a picture; cells of a cross without a face are ignored. Throws Error{Refusal::unsuitable}, beginning
/// with `file`, when the size does not fit. Orders other than gl are for strips alone.
Cube cut_faces(const Image<float>& picture, CubeLayout layout, FaceOrder order, const std::string& file);
/// The reverse of cut_faces; cells without a face are 0.
Image<float> paste_faces(const Cube& cube, CubeLayout layout, FaceOrder order = FaceOrder::gl);

} // namespace bake
