// What several jobs of one process read from the same file, decoded once.
#pragma once
#include "bake/base/input_record.h"
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace bake {

/// While it lives, shared_load() keeps what it reads from some files. One at most lives in a process; for all jobs.
class SharedLoads {
public:
    /// `files`: those that are worth it, by the names under which they are read. `most_bytes`: what is kept takes no more
    /// memory than this; what was used last stays.
    SharedLoads(std::unordered_set<std::string> files, std::size_t most_bytes);
    ~SharedLoads();
    SharedLoads(const SharedLoads&) = delete;
    SharedLoads& operator=(const SharedLoads&) = delete;

    /// While it lives, nothing is kept: for a job that has a limit on the memory of the process.
    class Pause {
    public:
        explicit Pause(SharedLoads& loads);
        ~Pause();
        Pause(const Pause&) = delete;
        Pause& operator=(const Pause&) = delete;

    private:
        SharedLoads& loads_;
    };

    struct Load {
        FileStamp stamp; ///< of the file when it was read
        std::shared_ptr<const void> value;
        std::size_t bytes = 0;
        std::uint64_t used = 0; ///< the larger the later
    };

    /// For shared_load(). The key has the name of the file and how it is read.
    bool is_shared(const std::string& path);
    std::shared_ptr<const void> find(const std::string& key, const FileStamp& now);
    /// Whether so much may be kept now.
    bool fits(std::size_t bytes);
    void keep(const std::string& key, Load load);

private:
    std::mutex mutex_;
    const std::unordered_set<std::string> files_;
    const std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    std::uint64_t uses_ = 0;
    bool paused_ = false;
    std::unordered_map<std::string, Load> loads_;
};

/// That of the process, or null; for shared_load().
SharedLoads* shared_loads() noexcept;
/// The file as it is now, remembered as one that the current job reads (remember_input()); nothing if it is absent.
std::optional<FileStamp> stamp_of_input(const std::string& path);

/// A value that depends on one file and on `how` alone: read(), or `copy` of what was read before if the file is the same by its
/// FileStamp. `bytes`: the memory of the value. The job reads the file in either case, as far as InputRecord tells.
template <class T>
T shared_load(const std::string& path, const std::string& how, const std::function<T()>& read,
              const std::function<T(const T&)>& copy, const std::function<std::size_t(const T&)>& bytes) {
    SharedLoads* const loads = shared_loads();
    if (!loads || !loads->is_shared(path)) return read();
    const std::optional<FileStamp> stamp = stamp_of_input(path);
    if (!stamp) return read(); // which tells why it cannot be read
    const std::string key = how + '\0' + path;
    if (const auto kept = loads->find(key, *stamp)) return copy(*static_cast<const T*>(kept.get()));
    T value = read();
    const std::size_t size = bytes(value);
    if (!loads->fits(size)) return value;
    try {
        // A file that changed meanwhile has another stamp now, and is not found again.
        loads->keep(key, {*stamp, std::make_shared<const T>(copy(value)), size});
    } catch (const std::bad_alloc&) { // the next job reads it again
    }
    return value;
}

} // namespace bake
