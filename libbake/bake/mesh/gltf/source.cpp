#include "bake/mesh/gltf/source.h"
#include "bake/base/error.h"
#include <algorithm>
#include <numeric>
#include <tiny_gltf.h>

namespace bake {

void GltfSource::refuse(const std::string& why) const {
    throw Error(Refusal::unreadable, path + ": " + why + "; export the file again");
}

std::span<const std::uint8_t> view_bytes(const GltfSource& source, std::int64_t index, const std::string& what) {
    if (index < 0 || std::size_t(index) >= source.model.bufferViews.size())
        source.refuse(what + " asks for bufferView " + std::to_string(index) + " of " +
                      std::to_string(source.model.bufferViews.size()));
    const tinygltf::BufferView& view = source.model.bufferViews[std::size_t(index)];
    const std::string name = "its bufferView " + std::to_string(index);
    if (view.buffer < 0 || std::size_t(view.buffer) >= source.document.buffers.size())
        source.refuse(name + " asks for buffer " + std::to_string(view.buffer) + " of " +
                      std::to_string(source.document.buffers.size()));
    const std::span<const std::uint8_t> buffer = source.document.buffers[std::size_t(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        source.refuse(name + " reaches behind the " + std::to_string(buffer.size()) + " bytes of its buffer");
    return buffer.subspan(view.byteOffset, view.byteLength);
}

namespace {

/// The part of `bytes` from `offset` on, which must hold `count` elements of `size` bytes, `stride` apart.
std::span<const std::uint8_t> elements(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t count,
                                       std::size_t size, std::size_t stride, const std::string& what,
                                       const GltfSource& source) {
    if (count == 0) return {};
    if (offset > bytes.size() || size > bytes.size() - offset || (count - 1) > (bytes.size() - offset - size) / stride)
        source.refuse(what + " reaches behind the " + std::to_string(bytes.size()) + " bytes of its bufferView");
    return bytes.subspan(offset);
}

/// The last value of each element counts.
GltfSparse in_order(const std::vector<std::uint32_t>& elements) {
    GltfSparse out;
    out.value.resize(elements.size());
    std::iota(out.value.begin(), out.value.end(), 0u);
    if (!std::is_sorted(elements.begin(), elements.end()))
        std::stable_sort(out.value.begin(), out.value.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return elements[a] < elements[b]; });
    std::size_t kept = 0;
    for (const std::uint32_t v : out.value) {
        if (kept > 0 && out.element[kept - 1] == elements[v]) --kept;
        else out.element.push_back(elements[v]);
        out.value[kept++] = v;
    }
    out.value.resize(kept);
    return out;
}

/// Reads where the accessor's values are replaced, and by what.
void read_sparse(const GltfSource& source, int index, const std::string& what, GltfAccessor& out) {
    const tinygltf::Accessor& from = source.model.accessors[std::size_t(index)];
    const auto& sparse = from.sparse;
    const std::size_t size = size_of(out.type) * std::size_t(out.components);
    const auto type = static_cast<GltfType>(sparse.indices.componentType);
    if (sparse.count < 0 || std::size_t(sparse.count) > out.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0 ||
        (type != GltfType::uint8 && type != GltfType::uint16 && type != GltfType::uint32))
        source.refuse(what + " has sparse values that make no sense");
    const auto count = std::size_t(sparse.count);
    GltfAccessor indices{.type = type, .count = count};
    indices.stride = size_of(type);
    indices.bytes =
        elements(view_bytes(source, sparse.indices.bufferView, what), std::size_t(sparse.indices.byteOffset), count,
                 indices.stride, indices.stride, what, source);
    out.sparse_values = elements(view_bytes(source, sparse.values.bufferView, what),
                                 std::size_t(sparse.values.byteOffset), count, size, size, what, source);
    std::shared_ptr<const GltfSparse>& known = source.sparse[index];
    if (!known) {
        std::vector<std::uint32_t> elements(count);
        read_indices(indices, elements.data());
        for (const std::uint32_t i : elements)
            if (i >= out.count)
                source.refuse(what + " has a sparse index outside its " + std::to_string(out.count) + " elements");
        known = std::make_shared<GltfSparse>(in_order(elements));
    }
    out.sparse = known;
}

} // namespace

GltfAccessor accessor_of(const GltfSource& source, int index, const std::string& use) {
    const tinygltf::Model& model = source.model;
    if (index < 0 || std::size_t(index) >= model.accessors.size())
        source.refuse(use + " asks for accessor " + std::to_string(index) + " of " +
                      std::to_string(model.accessors.size()));
    const tinygltf::Accessor& from = model.accessors[std::size_t(index)];
    const std::string what = "its accessor " + std::to_string(index) + " (" + use + ")";
    GltfAccessor out;
    out.type = static_cast<GltfType>(from.componentType);
    out.components = from.type == TINYGLTF_TYPE_SCALAR ? 1 : from.type == TINYGLTF_TYPE_MAT4 ? 16 : from.type;
    out.normalized = from.normalized;
    out.count = from.count;
    const std::size_t component = size_of(out.type);
    if (component == 0 || out.components < 1 || (out.components > 4 && out.components != 16))
        source.refuse(what + " has a type that no mesh has");
    if (out.count >= no_index)
        throw Error(Refusal::unsuitable,
                    source.path + ": " + what + " has more than 2^32 - 2 elements; split the mesh");
    const std::size_t size = component * std::size_t(out.components);
    if (from.bufferView >= 0) {
        const auto bytes = view_bytes(source, from.bufferView, what);
        const std::size_t stride = source.model.bufferViews[std::size_t(from.bufferView)].byteStride;
        out.stride = stride == 0 ? size : stride;
        if (out.stride < size) source.refuse(what + " has elements that overlap");
        out.bytes = elements(bytes, from.byteOffset, out.count, size, out.stride, what, source);
    } else if (out.count > std::size_t(1) << 24) {
        // Zeros cost the file nothing, and us memory.
        throw Error(Refusal::unsuitable, source.path + ": " + what + " has " + std::to_string(out.count) +
                                             " elements and no bytes; export the file again");
    }
    if (from.sparse.isSparse) read_sparse(source, index, what, out);
    return out;
}

GltfAccessor accessor_of(const GltfSource& source, int index, int components, std::size_t count,
                         const std::string& use) {
    GltfAccessor accessor = accessor_of(source, index, use);
    if (accessor.components != components)
        source.refuse("its " + use + " has " + std::to_string(accessor.components) + " components");
    if (accessor.count != count)
        source.refuse("its " + use + " has " + std::to_string(accessor.count) + " elements for " +
                      std::to_string(count) + " positions");
    return accessor;
}

std::vector<float> floats_of(const GltfSource& source, const GltfAccessor& accessor, const GltfUsed& used,
                             const std::string& use) {
    std::vector<float> out(used.size() * std::size_t(accessor.components));
    if (!read_floats(accessor, used, out.data())) source.refuse("its " + use + " has a value that is not finite");
    return out;
}

std::vector<float> floats_of(const GltfSource& source, int index, int components, const std::string& use) {
    const GltfAccessor accessor = accessor_of(source, index, use);
    if (accessor.components != components)
        source.refuse("its " + use + " has " + std::to_string(accessor.components) + " components");
    return floats_of(source, accessor, {accessor.count, {}}, use);
}

} // namespace bake
