// The memory that this process may use, and what it uses.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace bake {

struct MemoryLimit {
    std::uint64_t bytes = 0;
    /// "this machine's memory", "memory.max of control group /build", "ulimit -v", or the option that sets it
    std::string reason;

    /// "the 1.2 GiB it may use (this machine's memory)", "what ulimit -v allows".
    std::string described() const;
    /// "raise ulimit -v": how to get more.
    std::string advice() const;
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
/// RLIMIT_DATA, and of each MemoryCap in force. Of RLIMIT_AS and RLIMIT_DATA, address space that is mapped but not resident
/// is taken off.
MemoryLimit memory_limit();

/// The least limit of the control groups, or nothing; `root` stands for the folder with proc/ and sys/.
std::optional<MemoryLimit> control_group_limit(const std::string& root = "");

/// The least of RLIMIT_AS and RLIMIT_DATA as a process that is started now has them, or nothing. No MemoryCap counts.
std::optional<MemoryLimit> started_process_limit();

/// Returns memory that has been freed to the system, so that what comes next does not add to it.
void return_free_memory() noexcept;

/// During the lifetime of this object, allocations fail (std::bad_alloc) that would raise the resident memory of the process
/// above `limit`, which memory_limit() knows. For work whose need is not known before, such as reading a file. Address space
/// counts as soon as it is allocated, so some allocations fail earlier; the stacks of `threads` threads that are yet to
/// start do not count. Caps of a job end in the reverse order of their beginning. A higher one does not raise a lower one.
/// The allocations of other jobs of the process fail too.
class MemoryCap {
public:
    MemoryCap(const MemoryLimit& limit, int threads);
    ~MemoryCap();
    MemoryCap(const MemoryCap&) = delete;
    MemoryCap& operator=(const MemoryCap&) = delete;

private:
    friend MemoryLimit memory_limit();
    MemoryLimit limit_;
    const MemoryCap* outer_;
    std::optional<std::uint64_t> most_; ///< RLIMIT_DATA
};

/// During the lifetime of this object no MemoryCap is in force: a process that is started meanwhile does not inherit one.
class MemoryCapPause {
public:
    MemoryCapPause();
    ~MemoryCapPause();
    MemoryCapPause(const MemoryCapPause&) = delete;
    MemoryCapPause& operator=(const MemoryCapPause&) = delete;
};

} // namespace bake
