#include "inputs/file_kind.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include <algorithm>

namespace bake {

FileKind file_kind(const std::string& path) {
    constexpr const char* pictures[] = {".png", ".exr", ".tif",  ".tiff", ".jpg", ".jpeg", ".hdr", ".tga", ".bmp",
                                        ".dds", ".psd", ".webp", ".pfm",  ".pgm", ".ppm",  ".jp2", ".ktx", ".ktx2"};
    const std::string end = ending(path);
    if (named_like_a_mesh(path)) return FileKind::mesh;
    if (std::find(std::begin(pictures), std::end(pictures), end) != std::end(pictures)) return FileKind::picture;
    return end == ".toml" ? FileKind::scene : FileKind::unknown;
}

namespace {

void expect(FileKind wanted, const std::string& path, const std::string& what_to_give) {
    const FileKind kind = file_kind(path);
    if (kind == wanted || kind == FileKind::unknown) return;
    const char* const names[] = {"a mesh", "a picture", "a scene"};
    throw Error(Refusal::unreadable,
                path + ": is " + names[int(kind)] + ", where " + names[int(wanted)] + " is expected; " + what_to_give);
}

} // namespace

void expect_picture(const std::string& path) {
    expect(FileKind::picture, path, "give a .png, .exr, .tif, .jpg or other image here");
}
void expect_mesh(const std::string& path) { expect(FileKind::mesh, path, "give a .obj, .ply, .glb or .gltf here"); }
void expect_scene(const std::string& path) {
    expect(FileKind::scene, path, "give a .toml; a line of it such as mesh = [{file = \"torus.obj\"}] names a mesh");
}

} // namespace bake
