#include "bake/picture/image.h"
#include <new>
#include <sys/mman.h>

namespace bake {

void* detail::allocate_pages(std::size_t bytes) {
    constexpr std::size_t huge = std::size_t(2) << 20;
    if (bytes < 2 * huge) {
        if (void* const pages = std::malloc(bytes > 0 ? bytes : 1)) return pages;
        throw std::bad_alloc();
    }
    void* const pages = std::aligned_alloc(huge, (bytes + huge - 1) / huge * huge);
    if (!pages) throw std::bad_alloc();
    madvise(pages, (bytes + huge - 1) / huge * huge, MADV_HUGEPAGE);
    return pages;
}

} // namespace bake
