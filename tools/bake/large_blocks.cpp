// Large blocks in huge pages. Meshes of millions of faces live in vectors of many megabytes, each written once: with
// pages of 4 KiB the system's handing out of them was a fifth of all time of bake displace.
#include "bake/picture/image.h"
#include <cstdlib>
#include <new>

// The address sanitizer brings operators of its own, which know more.
#ifndef __SANITIZE_ADDRESS__

[[gnu::noinline]] void* operator new(std::size_t bytes) {
    if (bytes >= std::size_t(1) << 20) return bake::detail::allocate_pages(bytes);
    void* const block = std::malloc(bytes > 0 ? bytes : 1);
    if (!block) throw std::bad_alloc();
    return block;
}

// Not inlined: the compiler would take what it then sees for a delete that does not match its new.
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
