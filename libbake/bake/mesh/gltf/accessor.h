// Values of a glTF accessor, as floats or as indices, once its places in the buffers are known to be there.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

/// Component types by their numbers in the file (those of OpenGL).
enum class GltfType : int { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// 0 for what is no component type of glTF.
std::size_t size_of(GltfType type) noexcept;

/// `count` elements of `components` values, `stride` bytes apart, all of them inside `bytes`; zeros where `bytes` is
/// empty. Of them, sparse_index[i] is replaced by the i-th of sparse_values, which lie close together.
struct GltfAccessor {
    GltfType type = GltfType::float32;
    int components = 1;
    bool normalized = false; ///< integers stand for [0,1] or [-1,1]
    std::size_t count = 0;
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0;
    std::vector<std::uint32_t> sparse_index; ///< each below count
    std::span<const std::uint8_t> sparse_values;
};

/// Writes count * components floats to `out`; where that is not finite, false.
bool read_floats(const GltfAccessor& accessor, float* out);

/// Writes count indices; the types are unsigned ones, the components one.
void read_indices(const GltfAccessor& accessor, std::uint32_t* out);

} // namespace bake
