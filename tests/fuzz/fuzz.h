// What the fuzz targets share. A target is one LLVMFuzzerTestOneInput() that gives the bytes to one reader: a refusal
// (bake::Error) is an answer; a crash, a sanitizer's report, any other exception and a broken promise are findings.
#pragma once
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace bake::fuzz {

/// Ends the process, which the engine records as a finding, if what a reader promises does not hold.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "promise broken: %s\n", what);
    std::abort();
}

/// The bytes as a regular file in memory, for readers that take a path.
class InputFile {
public:
    InputFile(const std::uint8_t* data, std::size_t size) : number_(memfd_create("input", MFD_CLOEXEC)) {
        require(number_ >= 0, "a file in memory can be made");
        for (std::size_t done = 0; done < size;) {
            const ssize_t written = write(number_, data + done, size - done);
            require(written > 0, "a file in memory can be written");
            done += std::size_t(written);
        }
        path_ = "/proc/self/fd/" + std::to_string(number_);
    }
    ~InputFile() { close(number_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& path() const noexcept { return path_; }

private:
    int number_;
    std::string path_;
};

/// Runs a reader on one thread, so that the same bytes take the same way each time.
template <class Read> int attempt(Read&& read) {
    static const ThreadLimit one(1);
    try {
        read();
    } catch (const Error& refusal) {
        require(refusal.what()[0] != '\0', "a refusal has a reason");
    }
    return 0;
}

} // namespace bake::fuzz
