#include "bake/base/memory.h"
#include "bake/base/job.h"
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

/// RLIMIT_DATA as it was before any MemoryCap lowered it; 0 when none did.
std::atomic<std::uint64_t> data_before_caps = 0;

/// RLIMIT_DATA of others than MemoryCap.
std::optional<std::uint64_t> data_limit() {
    const std::uint64_t before = data_before_caps;
    if (before == 0) return soft_limit(RLIMIT_DATA);
    return before == RLIM_INFINITY ? std::nullopt : std::optional(before);
}

/// What the caps of all jobs make of RLIMIT_DATA, which belongs to the process. Caps of different jobs end in any order.
struct DataCaps {
    std::mutex mutex;
    std::vector<std::uint64_t> most;
    int pauses = 0;

    /// Under the mutex.
    void apply() noexcept {
        rlimit limit{};
        if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
        if (data_before_caps == 0) data_before_caps = limit.rlim_cur;
        limit.rlim_cur = data_before_caps;
        if (pauses == 0)
            for (const std::uint64_t bytes : most) limit.rlim_cur = std::min<std::uint64_t>(limit.rlim_cur, bytes);
        setrlimit(RLIMIT_DATA, &limit);
        if (most.empty()) data_before_caps = 0;
    }
};

DataCaps& data_caps() {
    static DataCaps caps;
    return caps;
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
    for (const Job* job : {&current_job(), &process_job()})
        for (const MemoryCap* cap = job->caps; cap; cap = cap->outer_)
            lower(least, cap->limit_.bytes, cap->limit_.reason);
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
    : limit_(limit), outer_(current_job().caps.exchange(this)) {
#if !defined(__SANITIZE_ADDRESS__) // the sanitizer ends the process where an allocation fails
    // Threads that have not started yet map their stacks, and use little of them.
    constexpr std::uint64_t stack = std::uint64_t(8) << 20;
    const ProcessMemory now = process_memory();
    most_ = now.data + difference(limit.bytes, now.resident) + std::uint64_t(threads) * stack;
    DataCaps& caps = data_caps();
    const std::lock_guard lock(caps.mutex);
    caps.most.push_back(*most_);
    caps.apply();
#endif
}

MemoryCap::~MemoryCap() {
    current_job().caps = outer_;
    if (!most_) return;
    DataCaps& caps = data_caps();
    const std::lock_guard lock(caps.mutex);
    caps.most.erase(std::find(caps.most.begin(), caps.most.end(), *most_));
    caps.apply();
}

MemoryCapPause::MemoryCapPause() {
    DataCaps& caps = data_caps();
    const std::lock_guard lock(caps.mutex);
    ++caps.pauses;
    caps.apply();
}

MemoryCapPause::~MemoryCapPause() {
    DataCaps& caps = data_caps();
    const std::lock_guard lock(caps.mutex);
    --caps.pauses;
    caps.apply();
}

} // namespace bake
