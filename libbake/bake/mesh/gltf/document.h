// A glTF file before validation: its JSON, buffers and images.
#pragma once
#include "bake/base/file_bytes.h"
#include "bake/mesh/gltf/io.h"
#include <span>

namespace bake {

struct GltfDocument {
    std::string json;                   ///< without the buffers, the images, the cameras and the lights
    std::span<const std::uint8_t> text; ///< the JSON of the file, whole
    bool has_materials = false;
    std::string record;                                 ///< how the file was made, as Mesh has it
    std::string cameras = "[]";                         ///< JSON: the list of cameras
    std::string lights = "[]";                          ///< JSON: the list of KHR_lights_punctual
    std::vector<std::span<const std::uint8_t>> buffers; ///< with the lengths given in the JSON
    std::vector<GltfImage> images;                      ///< bytes are empty where image_view is not -1
    std::vector<std::int64_t> image_view;               ///< per image: its bufferView, or -1

    std::size_t bytes_beside = 0; ///< of buffers in files of their own, and of images

    FileBytes file; ///< memory of the spans
    std::vector<FileBytes> beside;
    std::vector<std::vector<std::uint8_t>> decoded;
};

/// Reads a .gltf or .glb (distinguished by its first bytes) and the files that it names. A missing image keeps its uri and
/// has no bytes. Throws Error{Refusal::unreadable} for a file that is not glTF 2.0 or is truncated, a buffer that is missing,
/// too short or not valid base64, JSON that is nested too deeply, and a uri outside of the folder. Throws
/// Error{Refusal::unsuitable} for an extension that the file requires and that is not known here, and for compressed meshes
/// without an uncompressed copy.
GltfDocument read_gltf_document(const std::string& path);

/// Throws Error{Refusal::unsuitable} if `bytes`, which `what` takes at least, are more than this machine's memory.
void refuse_unless_fits(const std::string& path, const std::string& what, double bytes);

} // namespace bake
