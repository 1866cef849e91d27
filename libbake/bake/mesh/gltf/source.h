// A glTF file that is being read: its document, the model parsed from it, and the bytes that both name.
#pragma once
#include "bake/mesh/gltf/accessor.h"
#include "bake/mesh/gltf/document.h"
#include <map>

namespace tinygltf {
class Model;
}

namespace bake {

struct GltfSource {
    const std::string& path;
    const GltfDocument& document;
    const tinygltf::Model& model;
    mutable std::map<int, std::shared_ptr<const GltfSparse>> sparse = {}; ///< of the accessors asked for so far

    /// Throws Error{Refusal::unreadable}.
    [[noreturn]] void refuse(const std::string& why) const;
};

/// The bytes of a view; `what` names their use in messages.
std::span<const std::uint8_t> view_bytes(const GltfSource& source, std::int64_t index, const std::string& what);

/// The accessor of that number, all of its elements inside the buffers. `use` names its use in messages.
/// Throws Error{Refusal::unsuitable} for more elements than fit.
GltfAccessor accessor_of(const GltfSource& source, int index, const std::string& use);

/// Refuses an accessor that has other than `components` components, and other than `count` elements.
GltfAccessor accessor_of(const GltfSource& source, int index, int components, std::size_t count,
                         const std::string& use);

/// The values of the used elements of an accessor. Refuses values that are not finite.
std::vector<float> floats_of(const GltfSource& source, const GltfAccessor& accessor, const GltfUsed& used,
                             const std::string& use);
/// All values of an accessor. Refuses one of other than `components` components, and values that are not finite.
std::vector<float> floats_of(const GltfSource& source, int index, int components, const std::string& use);

} // namespace bake
