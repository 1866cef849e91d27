#include "bake/base/pages.h"
#include <new>
#include <sys/mman.h>

namespace bake {
namespace {

constexpr std::uintptr_t huge = std::uintptr_t(2) << 20;

} // namespace

void* allocate_pages(std::size_t bytes) {
    const std::size_t whole = (bytes + huge - 1) / huge * huge;
    void* const pages = bytes < 2 * huge ? std::malloc(bytes > 0 ? bytes : 1) : std::aligned_alloc(huge, whole);
    if (!pages) throw std::bad_alloc();
    if (bytes >= 2 * huge) madvise(pages, whole, MADV_HUGEPAGE);
    return pages;
}

void use_huge_pages(void* begin, void* end) {
    const auto first = (reinterpret_cast<std::uintptr_t>(begin) + huge - 1) / huge * huge;
    const auto last = reinterpret_cast<std::uintptr_t>(end) / huge * huge;
    if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

} // namespace bake
