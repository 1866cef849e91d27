// A whole file in memory.
#pragma once
#include "bake/base/pages.h"
#include <cstddef>
#include <memory>
#include <string>

namespace bake {

/// The bytes of a file and one '\n' after them, so that a scan for the end of a line needs no other bound.
/// A copy and not a mapping: what another program does to the file meanwhile cannot reach us.
struct FileBytes {
    std::unique_ptr<char[], FreePages> data; ///< size + 1
    std::size_t size = 0;

    const char* begin() const noexcept { return data.get(); }
    const char* end() const noexcept { return data.get() + size; }
};

/// Reads the regular file `path`, in parallel. Throws Error{Refusal::unreadable} with the system's reason, and
/// Error{Refusal::unsuitable} when it is larger than memory_limit().
FileBytes read_file(const std::string& path);

} // namespace bake
