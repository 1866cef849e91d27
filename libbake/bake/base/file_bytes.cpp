#include "bake/base/file_bytes.h"
#include "bake/base/descriptor.h"
#include "bake/base/error.h"
#include "bake/base/input_record.h"
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include "bake/base/system_lack.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bake {
namespace {

[[noreturn]] void refuse(const std::string& path, int reason) {
    if (reason == ENOENT || reason == ENOTDIR)
        throw Error(Refusal::unreadable, path + ": no such file; check the name");
    if (const std::string mend = mend_of_lack(reason); !mend.empty())
        throw Error(Refusal::unsuitable, path + ": cannot be opened (" + std::strerror(reason) + "); " + mend);
    throw Error(Refusal::unreadable, path + ": cannot be read (" + std::strerror(reason) +
                                         "); check its permissions and those of its folders");
}

} // namespace

FileBytes read_file(const std::string& path) {
    // Without O_NONBLOCK, opening a pipe would wait for a writer for ever.
    const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (file.number < 0) refuse(path, errno);
    struct stat status {};
    if (fstat(file.number, &status) != 0) refuse(path, errno);
    if (S_ISDIR(status.st_mode)) throw Error(Refusal::unreadable, path + ": is a folder; name a file in it");
    if (!S_ISREG(status.st_mode))
        throw Error(Refusal::unreadable, path + ": is not a regular file; copy its contents into one");

    remember_input(path, status);
    FileBytes bytes;
    bytes.size = std::size_t(status.st_size);
    const MemoryLimit memory = memory_limit();
    if (bytes.size > memory.bytes)
        throw Error(Refusal::unsuitable, path + ": " + std::to_string(bytes.size) + " bytes are more than " +
                                             memory.described() + "; split the file, or " + memory.advice());
    bytes.data.reset(static_cast<char*>(allocate_pages(bytes.size + 1)));
    bytes.data[bytes.size] = '\n';

    const std::int64_t grain = std::int64_t(1) << 20;
    for_rows(std::int64_t(bytes.size), grain, [&](std::int64_t begin, std::int64_t end) {
        while (begin < end) {
            const ssize_t got = pread(file.number, bytes.data.get() + begin, std::size_t(end - begin), begin);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) refuse(path, errno);
            if (got == 0) throw Error(Refusal::unreadable, path + ": shrank while it was read; try again");
            begin += got;
        }
    });
    input_was_read(file.number);
    return bytes;
}

} // namespace bake
