// The primitives of a glTF: their vertices, triangles and morph targets.
#pragma once
#include "bake/mesh/gltf/source.h"
#include "bake/mesh/gltf/vertices.h"
#include <map>
#include <optional>
#include <span>

namespace tinygltf {
struct Primitive;
}

namespace bake {

/// Accessors of the vertices by their names in the file, and of their morph targets. Primitives of a node that have the
/// same ones share their vertices.
struct GltfVertexSource {
    std::map<std::string, int> attributes;
    std::vector<std::map<std::string, int>> targets;

    auto operator<=>(const GltfVertexSource&) const = default;
};

/// One primitive. Values are those of TEXCOORD_1 and on, COLOR_n and _CUSTOM, by these names.
struct GltfPrimitive {
    GltfAccessor position, indices;
    std::optional<GltfAccessor> normal, uv, tangent;
    std::vector<std::pair<std::string, GltfAccessor>> values;
    bool indexed = false;
    enum class Mode { triangles = 4, strip = 5, fan = 6 } mode = Mode::triangles; ///< as numbered in the file
    std::uint32_t material = no_index;
    std::string group;
    GltfVertexSource vertices;
    std::size_t number = 0;      ///< among all primitives of its mesh in the file
    std::size_t vertices_of = 0; ///< first primitive of its mesh that has the same `vertices`

    std::size_t index_count() const { return indexed ? indices.count : position.count; }
    /// More than there are where a strip repeats indices.
    std::size_t most_triangles() const {
        const std::size_t n = index_count();
        return mode == Mode::triangles ? n / 3 : n < 3 ? 0 : n - 2;
    }
};

/// Of each mesh of the file the primitives that have triangles: points, lines and primitives without positions are left
/// out.
using GltfPrimitives = std::vector<std::vector<GltfPrimitive>>;
GltfPrimitives primitives_of(const GltfSource& source);

/// Three indices of each triangle, all below the count of positions.
std::vector<std::uint32_t> triangles_of(const GltfSource& source, const GltfPrimitive& primitive);

/// Appends the used vertices of a primitive, with its morph targets added by `weights`; missing weights are 0.
void append(const GltfSource& source, const GltfPrimitive& primitive, const GltfUsed& used,
            std::span<const double> weights, bool flip_v, GltfVertices& out);

} // namespace bake
