// Whether limits of memory hold where the tests run.
#pragma once
#include <algorithm>
#include <sys/resource.h>

namespace bake::test {

/// False with the address sanitizer, which reserves terabytes of address space, and under qemu, which runs programs of other
/// processors, takes such limits and keeps none.
inline bool keeps_memory_limits() {
#ifdef __SANITIZE_ADDRESS__
    return false;
#else
    rlimit before{}, now{};
    getrlimit(RLIMIT_AS, &before);
    rlimit lower = before;
    lower.rlim_cur = std::min(before.rlim_max, rlim_t(1) << 40);
    setrlimit(RLIMIT_AS, &lower);
    getrlimit(RLIMIT_AS, &now);
    setrlimit(RLIMIT_AS, &before);
    return now.rlim_cur == lower.rlim_cur;
#endif
}

} // namespace bake::test
