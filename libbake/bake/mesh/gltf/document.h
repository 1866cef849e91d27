// A glTF file as it lies on disk: its JSON, its buffers and its pictures, before anything in them is trusted.
#pragma once
#include "bake/base/file_bytes.h"
#include "bake/mesh/gltf/io.h"
#include <span>

namespace bake {

struct GltfDocument {
    std::string json;                                   ///< all but the buffers and the images
    std::vector<std::span<const std::uint8_t>> buffers; ///< of the length that the JSON names
    std::vector<GltfImage> images;                      ///< bytes as yet empty where image_view is not -1
    std::vector<std::int64_t> image_view;               ///< per image: the bufferView that holds it, or -1

    FileBytes file; ///< what the spans point into
    std::vector<FileBytes> beside;
    std::vector<std::vector<std::uint8_t>> decoded;
};

/// Reads a .gltf or .glb (told apart by its first bytes) and the files that it names. A picture that is not there keeps
/// its uri and has no bytes. Throws Error{Refusal::unreadable}: no glTF 2.0, cut short, a buffer that is not there,
/// shorter than it says or not base64, JSON nested deeper than any writer nests it, a uri that leads elsewhere.
GltfDocument read_gltf_document(const std::string& path);

} // namespace bake
