#include "bake/mesh/gltf/accessor.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace bake {
namespace {

// A value at any address, low byte first on any machine.
template <class T> T load(const std::uint8_t* p) noexcept {
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, p, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
    return std::bit_cast<T>(raw);
}

template <class T> float to_float(T value, bool normalized) noexcept {
    if constexpr (std::is_integral_v<T>)
        if (normalized) return std::max(float(value) / float(std::numeric_limits<T>::max()), -1.0f);
    return float(value);
}

/// Calls f.operator()<T>() with the type that `type` names.
template <class F> void with_type(GltfType type, F&& f) {
    switch (type) {
    case GltfType::int8: return f.template operator()<std::int8_t>();
    case GltfType::uint8: return f.template operator()<std::uint8_t>();
    case GltfType::int16: return f.template operator()<std::int16_t>();
    case GltfType::uint16: return f.template operator()<std::uint16_t>();
    case GltfType::uint32: return f.template operator()<std::uint32_t>();
    case GltfType::float32: break;
    }
    return f.template operator()<float>();
}

/// Calls put(i, bytes of the i-th used element) for all of them, then again for those that are replaced.
template <class Put> void each_element(const GltfAccessor& a, const GltfUsed& used, Put&& put) {
    const auto element = [&used](std::size_t i) { return used.element.empty() ? i : used.element[i]; };
    if (!a.bytes.empty())
        for_rows(std::int64_t(used.size()), 1 << 16, [&](std::int64_t begin, std::int64_t end) {
            for (auto i = std::size_t(begin); i < std::size_t(end); ++i) put(i, a.bytes.data() + element(i) * a.stride);
        });
    if (!a.sparse) return;
    const GltfSparse& sparse = *a.sparse;
    const std::size_t size = size_of(a.type) * std::size_t(a.components);
    for (std::size_t s = 0; s < sparse.element.size() && used.element.empty(); ++s)
        put(sparse.element[s], a.sparse_values.data() + sparse.value[s] * size);
    for (std::size_t i = 0; i < used.element.size(); ++i) {
        const auto found = std::lower_bound(sparse.element.begin(), sparse.element.end(), used.element[i]);
        if (found == sparse.element.end() || *found != used.element[i]) continue;
        put(i, a.sparse_values.data() + sparse.value[std::size_t(found - sparse.element.begin())] * size);
    }
}

} // namespace

std::size_t size_of(GltfType type) noexcept {
    switch (type) {
    case GltfType::int8:
    case GltfType::uint8: return 1;
    case GltfType::int16:
    case GltfType::uint16: return 2;
    case GltfType::uint32:
    case GltfType::float32: return 4;
    }
    return 0;
}

bool read_floats(const GltfAccessor& a, const GltfUsed& used, float* out) {
    const auto components = std::size_t(a.components);
    if (a.bytes.empty()) std::fill_n(out, used.size() * components, 0.0f);
    std::atomic<bool> finite = true;
    with_type(a.type, [&]<class T>() {
        each_element(a, used, [&](std::size_t i, const std::uint8_t* p) {
            for (std::size_t k = 0; k < components; ++k) {
                const float value = to_float(load<T>(p + k * sizeof(T)), a.normalized);
                if (!std::isfinite(value)) finite = false;
                out[i * components + k] = value;
            }
        });
    });
    return finite;
}

void read_indices(const GltfAccessor& a, std::uint32_t* out) {
    if (a.bytes.empty()) std::fill_n(out, a.count, 0u);
    with_type(a.type, [&]<class T>() {
        each_element(a, {a.count, {}},
                     [&](std::size_t i, const std::uint8_t* p) { out[i] = std::uint32_t(load<T>(p)); });
    });
}

} // namespace bake
