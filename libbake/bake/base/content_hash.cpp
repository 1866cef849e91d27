#include "bake/base/content_hash.h"
#include "bake/base/descriptor.h"
#include <cerrno>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace bake {
namespace {

std::string digits_of(const XXH128_hash_t& hash) {
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, hash);
    std::string text;
    for (const unsigned char byte : bytes.digest)
        text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    return text;
}

} // namespace

std::string content_hash(const void* bytes, std::size_t size) { return digits_of(XXH3_128bits(bytes, size)); }

std::optional<std::string> file_hash(const std::string& path) {
    return file_hash(Descriptor(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)).number);
}

std::optional<std::string> file_hash(int descriptor) {
    struct stat status {};
    if (descriptor < 0 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return {};
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
    if (!state) return {};
    XXH3_128bits_reset(state.get());
    std::vector<char> block(std::size_t(1) << 18); // fits in a cache of the second level
    for (off_t at = 0;;) {
        const ssize_t got = pread(descriptor, block.data(), block.size(), at);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return {};
        if (got == 0) return digits_of(XXH3_128bits_digest(state.get()));
        XXH3_128bits_update(state.get(), block.data(), std::size_t(got));
        at += got;
    }
}

} // namespace bake
