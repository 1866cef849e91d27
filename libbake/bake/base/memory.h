// The memory that this process may use, and what it uses.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace bake {

struct MemoryLimit {
    std::uint64_t bytes = 0;
    std::string reason; ///< "this machine's memory", "memory.max of control group /build", "ulimit -v"
};

/// What /proc/self/statm says, in bytes.
struct ProcessMemory {
    std::uint64_t address_space = 0; ///< mapped, whether used or not
    std::uint64_t resident = 0;      ///< in memory, with the pages of the program and its libraries
    std::uint64_t data = 0;          ///< mapped, writable and private
};
ProcessMemory process_memory();

/// The largest resident memory of this process so far.
std::uint64_t peak_memory();

/// The resident memory that this process may have: the least of the machine's memory, the limits of the control groups of
/// this process and of all groups around them (memory.max and memory.high, or memory.limit_in_bytes), RLIMIT_AS and
/// RLIMIT_DATA. Of the last two, address space that is mapped but not resident is taken off.
MemoryLimit memory_limit();

/// The least limit of the control groups, or nothing; `root` stands for the folder with proc/ and sys/.
std::optional<MemoryLimit> control_group_limit(const std::string& root = "");

/// Returns memory that has been freed to the system, so that what comes next does not add to it.
void return_free_memory() noexcept;

/// During the lifetime of this object, allocations fail (std::bad_alloc) that would raise the resident memory of the process
/// above `bytes`. For work whose need is not known before, such as reading a file. Address space counts as soon as it
/// is allocated, so some allocations fail earlier; the stacks of `threads` threads that are yet to start do not count.
class MemoryCap {
public:
    MemoryCap(std::uint64_t bytes, int threads);
    ~MemoryCap();
    MemoryCap(const MemoryCap&) = delete;
    MemoryCap& operator=(const MemoryCap&) = delete;

private:
    std::uint64_t before_ = 0;
    bool set_ = false;
};

} // namespace bake
