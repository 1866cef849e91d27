// Reads the values of a glTF accessor, as floats or as indices, after its ranges in the buffers have been checked.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bake {

/// Component types by their numbers in the file (those of OpenGL).
enum class GltfType : int { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// Size in bytes; 0 for a number that is not a component type of glTF.
std::size_t size_of(GltfType type) noexcept;

/// The elements that a sparse accessor replaces, in ascending order, and for each the number of its new value.
struct GltfSparse {
    std::vector<std::uint32_t> element, value;
};

/// `count` elements of `components` values, `stride` bytes apart, all within `bytes`; zeros if `bytes` is empty.
/// `sparse_values`, which have no gaps, replace the elements that `sparse` names.
struct GltfAccessor {
    GltfType type = GltfType::float32;
    int components = 1;
    bool normalized = false; ///< integers represent [0,1] or [-1,1]
    std::size_t count = 0;
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0;
    std::shared_ptr<const GltfSparse> sparse; ///< null: none; each element is below count
    std::span<const std::uint8_t> sparse_values;
};

/// The elements of an accessor that are read.
struct GltfUsed {
    std::size_t count = 0;              ///< elements that the accessor has
    std::vector<std::uint32_t> element; ///< ascending; empty: all of them

    std::size_t size() const noexcept { return element.empty() ? count : element.size(); }
};

/// Writes used.size() * components floats to `out`. Returns false if one of them is not finite.
bool read_floats(const GltfAccessor& accessor, const GltfUsed& used, float* out);

/// Writes count indices. The type must be an unsigned integer, and `components` must be 1.
void read_indices(const GltfAccessor& accessor, std::uint32_t* out);

} // namespace bake
