#include "inputs/file_kind.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include <algorithm>

namespace bake {
namespace {

enum class Kind { mesh, picture, scene, unknown };

Kind kind_of(const std::string& path) {
    constexpr const char* pictures[] = {".png", ".exr", ".tif",  ".tiff", ".jpg", ".jpeg", ".hdr", ".tga", ".bmp",
                                        ".dds", ".psd", ".webp", ".pfm",  ".pgm", ".ppm",  ".jp2", ".ktx", ".ktx2"};
    const std::string end = ending(path);
    if (named_like_a_mesh(path)) return Kind::mesh;
    if (std::find(std::begin(pictures), std::end(pictures), end) != std::end(pictures)) return Kind::picture;
    return end == ".toml" ? Kind::scene : Kind::unknown;
}

void expect(Kind wanted, const std::string& path, const std::string& what_to_give) {
    const Kind kind = kind_of(path);
    if (kind == wanted || kind == Kind::unknown) return;
    const char* const names[] = {"a mesh", "a picture", "a scene"};
    throw Error(Refusal::unreadable,
                path + ": is " + names[int(kind)] + ", where " + names[int(wanted)] + " is expected; " + what_to_give);
}

} // namespace

void expect_picture(const std::string& path) {
    expect(Kind::picture, path, "give a .png, .exr, .tif, .jpg or other image here");
}
void expect_mesh(const std::string& path) { expect(Kind::mesh, path, "give a .obj, .ply, .glb or .gltf here"); }
void expect_scene(const std::string& path) {
    expect(Kind::scene, path, "give a .toml; a line of it such as mesh = [{file = \"torus.obj\"}] names a mesh");
}

} // namespace bake
