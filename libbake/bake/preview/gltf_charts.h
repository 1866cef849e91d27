// How the textures of a glTF material lie on its faces: the sets of uvs and the transforms that they name.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace bake {

/// Each distinct pair of uv set and transform is one chart; the first is that of the normal texture, if there is one, so that
/// tangents belong to it.
class GltfCharts {
public:
    explicit GltfCharts(const GltfMaterial& material);

    /// Number of the texture's chart. It must be a texture of the material.
    int number_of(const GltfTexture& texture) const noexcept;
    /// Whether tangents of the file, which belong to set 0 without a transform, are those of the first chart.
    bool keeps_tangents() const noexcept { return charts_.empty() || charts_[0] == Chart{}; }
    /// Makes chart 0 the uvs of the mesh, and chart k its attribute k - 1. Of the mesh's other attributes only COLOR_0
    /// stays, behind these, unless it is white. `flip_v`: v of the mesh points up. A set that the mesh lacks is replaced by set 0. Returns the sets
    /// that are missing. Throws Error{Refusal::unreadable} for uvs that are not finite after the transform.
    std::vector<std::uint32_t> apply(Mesh& mesh, bool flip_v, const std::string& path) const;

private:
    struct Chart {
        std::uint32_t set = 0;
        GltfTransform transform{};
        bool operator==(const Chart&) const = default;
    };
    std::vector<Chart> charts_;
};

} // namespace bake
