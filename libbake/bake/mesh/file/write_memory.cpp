#include "bake/mesh/file/write_memory.h"
#include "bake/base/parallel.h"

namespace bake {

std::uint64_t write_memory(MeshFormat format, const MeshSize& size) noexcept {
    const std::uint64_t index = sizeof(std::uint32_t);
    // Blocks of 32768 faces or 8192 lines, one for each slot.
    const std::uint64_t blocks = std::uint64_t(slot_count()) * (std::uint64_t(2) << 20);
    if (format == MeshFormat::obj) return blocks;
    // distinct_corners(): corners and vertices, two tables of the positions, and those corners that are not equal to
    // the first one of their position, about four to each further normal or uv.
    const std::uint64_t further = size.normals - size.positions + (size.uvs > 0 ? size.uvs - size.positions : 0);
    const std::uint64_t vertices = size.positions + further, others = 4 * further;
    std::uint64_t bytes = blocks + (size.corners + vertices + 2 * size.positions) * index;
    if (further > 0) bytes += (2 * others + size.positions) * index;
    if (format == MeshFormat::gltf && size.parts) bytes += size.faces * index;
    return bytes;
}

} // namespace bake
