// A file descriptor that is closed at the end.
#pragma once
#include <unistd.h>
#include <utility>

namespace bake {

struct Descriptor {
    int number = -1; ///< negative: none
    explicit Descriptor(int opened) noexcept : number(opened) {}
    ~Descriptor() {
        if (number >= 0) close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    /// The caller closes it from now on.
    int release() noexcept { return std::exchange(number, -1); }
};

} // namespace bake
