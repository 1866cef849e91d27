#include "bake/base/memory.h"
#include "bake/base/text.h"
#include <algorithm>
#include <atomic>
#include <charconv>
#include <fstream>
#include <mutex>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace bake {
namespace {

std::uint64_t page_size() { return std::uint64_t(sysconf(_SC_PAGESIZE)); }

std::uint64_t difference(std::uint64_t a, std::uint64_t b) noexcept { return a > b ? a - b : 0; }

std::vector<std::string> words(const std::string& line) {
    std::istringstream text(line);
    std::vector<std::string> all;
    for (std::string word; text >> word;) all.push_back(word);
    return all;
}

/// A mounted hierarchy of control groups.
struct Mount {
    std::string root;   ///< the group that is mounted, "/" for all
    std::string folder; ///< where
    bool unified = false;
};

/// Paths in mountinfo have \040 for a blank, and the like.
std::string unescaped(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        int code = 0;
        const bool octal = text[i] == '\\' && i + 3 < text.size() &&
                           std::from_chars(&text[i + 1], &text[i + 1] + 3, code, 8).ptr == &text[i + 1] + 3;
        out += octal ? char(code) : text[i];
        if (octal) i += 3;
    }
    return out;
}

/// The hierarchies that can limit memory. A line of mountinfo: id, parent, device, root, folder, options, any number of
/// further fields, "-", type, source, options.
std::vector<Mount> memory_mounts(const std::string& root) {
    std::ifstream file(root + "/proc/self/mountinfo");
    std::vector<Mount> mounts;
    for (std::string line; std::getline(file, line);) {
        const std::vector<std::string> fields = words(line);
        const auto dash = std::find(fields.begin(), fields.end(), "-");
        if (fields.size() < 6 || fields.end() - dash < 4) continue;
        const std::string &type = dash[1], options = "," + dash[3] + ",";
        const bool unified = type == "cgroup2";
        if (!unified && !(type == "cgroup" && options.find(",memory,") != std::string::npos)) continue;
        mounts.push_back({unescaped(fields[3]), unescaped(fields[4]), unified});
    }
    return mounts;
}

/// The group of this process in a hierarchy. A line of /proc/self/cgroup is 0::PATH, or NUMBER:CONTROLLERS:PATH.
std::optional<std::string> own_group(const std::string& root, bool unified) {
    std::ifstream file(root + "/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        if (unified ? controllers == ",," : controllers.find(",memory,") != std::string::npos)
            return line.substr(second + 1);
    }
    return {};
}

/// The number in a file; nothing for "max" or a file that is not there.
std::optional<std::uint64_t> number_in(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    return file >> number ? std::optional(number) : std::nullopt;
}

void lower(std::optional<MemoryLimit>& least, std::uint64_t bytes, const std::string& reason) {
    if (!least || bytes < least->bytes) least = MemoryLimit{bytes, reason};
}

std::optional<std::uint64_t> soft_limit(int resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    return std::uint64_t(limit.rlim_cur);
}

constexpr const char* machine = "this machine's memory";

std::atomic<const MemoryCap*> innermost = nullptr;
std::mutex one_pause;

/// RLIMIT_DATA as it was before any MemoryCap lowered it; 0 when none did.
std::atomic<std::uint64_t> data_before_caps = 0;

/// RLIMIT_DATA of others than MemoryCap.
std::optional<std::uint64_t> data_limit() {
    const std::uint64_t before = data_before_caps;
    if (before == 0) return soft_limit(RLIMIT_DATA);
    return before == RLIM_INFINITY ? std::nullopt : std::optional(before);
}

/// Returns the limit that it replaces, or nothing if that fails.
std::optional<std::uint64_t> set_data_limit(std::uint64_t bytes) noexcept {
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0) return {};
    const std::uint64_t before = limit.rlim_cur;
    limit.rlim_cur = bytes;
    return setrlimit(RLIMIT_DATA, &limit) == 0 ? std::optional(before) : std::nullopt;
}

} // namespace

std::string MemoryLimit::described() const {
    // Of address space, what is left changes with what is mapped: no number that the user gave.
    if (reason.starts_with("ulimit")) return "what " + reason + " allows";
    return "the " + in_binary_units(bytes, false) + " it may use (" + reason + ")";
}

std::string MemoryLimit::advice() const {
    if (reason == machine) return "use a machine with more memory";
    return "raise " + (reason.find(" of control group ") == std::string::npos ? reason : "that limit");
}

ProcessMemory process_memory() {
    std::ifstream file("/proc/self/statm"); // pages: size, resident, shared, text, library, data, dirty
    std::uint64_t size = 0, resident = 0, skipped = 0, data = 0;
    file >> size >> resident >> skipped >> skipped >> skipped >> data;
    return {size * page_size(), resident * page_size(), data * page_size()};
}

std::uint64_t peak_memory() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return std::uint64_t(used.ru_maxrss) * 1024;
}

std::optional<MemoryLimit> control_group_limit(const std::string& root) {
    std::optional<MemoryLimit> least;
    for (const Mount& mount : memory_mounts(root)) {
        std::string group = own_group(root, mount.unified).value_or("/");
        // In a container the mounted folder may be the group itself.
        if (mount.root != "/" && group.starts_with(mount.root)) group = group.substr(mount.root.size());
        while (!group.empty() && group.back() == '/') group.pop_back();
        for (;;) {
            for (const char* name : {"memory.max", "memory.high", "memory.limit_in_bytes"})
                if (const auto bytes = number_in(root + mount.folder + group + "/" + name))
                    lower(least, *bytes, std::string(name) + " of control group " + (group.empty() ? "/" : group));
            if (group.empty()) break;
            group.resize(group.find_last_of('/') == std::string::npos ? 0 : group.find_last_of('/'));
        }
    }
    return least;
}

MemoryLimit memory_limit() {
    const ProcessMemory now = process_memory();
    std::optional<MemoryLimit> least = MemoryLimit{std::uint64_t(sysconf(_SC_PHYS_PAGES)) * page_size(), machine};
    if (const auto group = control_group_limit()) lower(least, group->bytes, group->reason);
    if (const auto bytes = soft_limit(RLIMIT_AS))
        lower(least, difference(*bytes, difference(now.address_space, now.resident)), "ulimit -v");
    if (const auto bytes = data_limit()) // resident pages of files are not data
        lower(least, difference(*bytes + now.resident, now.data), "ulimit -d");
    for (const MemoryCap* cap = innermost; cap; cap = cap->outer_) lower(least, cap->limit_.bytes, cap->limit_.reason);
    return *least;
}

std::optional<MemoryLimit> started_process_limit() {
    std::optional<MemoryLimit> least;
    if (const auto bytes = soft_limit(RLIMIT_AS)) lower(least, *bytes, "ulimit -v");
    if (const auto bytes = data_limit()) lower(least, *bytes, "ulimit -d");
    return least;
}

void return_free_memory() noexcept {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

MemoryCap::MemoryCap(const MemoryLimit& limit, [[maybe_unused]] int threads)
    : limit_(limit), outer_(innermost.exchange(this)) {
#if !defined(__SANITIZE_ADDRESS__) // the sanitizer ends the process where an allocation fails
    rlimit present{};
    if (getrlimit(RLIMIT_DATA, &present) != 0) return;
    // Threads that have not started yet map their stacks, and use little of them.
    constexpr std::uint64_t stack = std::uint64_t(8) << 20;
    const ProcessMemory now = process_memory();
    const std::uint64_t most = now.data + difference(limit.bytes, now.resident) + std::uint64_t(threads) * stack;
    const auto before = set_data_limit(std::min<std::uint64_t>(present.rlim_cur, most));
    before_ = before.value_or(0), set_ = before.has_value();
    if (set_ && data_before_caps == 0) data_before_caps = before_;
#endif
}

MemoryCap::~MemoryCap() {
    innermost = outer_;
    if (set_) set_data_limit(before_);
    if (!outer_) data_before_caps = 0;
}

MemoryCapPause::MemoryCapPause() {
    one_pause.lock();
    const std::uint64_t before = data_before_caps;
    const auto paused = before != 0 ? set_data_limit(before) : std::nullopt;
    paused_ = paused.value_or(0), set_ = paused.has_value();
}

MemoryCapPause::~MemoryCapPause() {
    if (set_) set_data_limit(paused_);
    one_pause.unlock();
}

} // namespace bake
