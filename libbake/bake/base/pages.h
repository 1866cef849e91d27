// Memory for large arrays in huge pages. The system hands out fresh pages of 4 KiB slowly: they took a fifth of the time
// of a displacement of a million faces.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace bake {

/// Memory for `bytes` bytes, in huge pages where it spans several. Freed by std::free (FreePages). Throws std::bad_alloc.
void* allocate_pages(std::size_t bytes);

struct FreePages {
    void operator()(void* pages) const noexcept { std::free(pages); }
};

/// Asks for huge pages wherever they fit between `begin` and `end`. Worth it before the first write.
void use_huge_pages(void* begin, void* end);

/// values.resize(count, value) in huge pages.
template <class T> void resize_in_pages(std::vector<T>& values, std::size_t count, const T& value = {}) {
    values.reserve(count);
    use_huge_pages(values.data() + values.size(), values.data() + count);
    values.resize(count, value);
}

} // namespace bake
