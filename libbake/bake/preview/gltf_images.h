// The pictures of a glTF file as textures.
#pragma once
#include "bake/mesh/gltf/io.h"
#include "bake/preview/texture.h"
#include <map>
#include <tuple>

namespace bake {

/// Decodes each image once for each use. An image that is missing or cannot be read gives no texture, and one note.
class GltfImages {
public:
    /// `path`: of the glTF file. All must outlive the object.
    GltfImages(const std::string& path, const std::vector<GltfImage>& images, std::vector<std::string>& notes);

    /// sRGB-encoded, as the format asks, whatever the picture states.
    Texture colour(std::uint32_t image);
    /// As stored.
    Texture data(std::uint32_t image);
    /// Vectors of tangent space, of which x and y are scaled.
    Texture normals(std::uint32_t image, float scale);
    /// Three equal channels; null if the picture has no alpha, or is opaque.
    Texture alpha(std::uint32_t image);

private:
    enum class Use { colour, data, normals, alpha };
    template <class Read> Texture read(std::uint32_t image, Use use, float scale, Read&& read_file);

    const std::string& path_;
    const std::vector<GltfImage>& images_;
    std::vector<std::string>& notes_;
    std::map<std::tuple<std::uint32_t, Use, float>, Texture> known_;
    std::vector<bool> failed_;
};

} // namespace bake
