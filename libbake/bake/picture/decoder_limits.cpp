#include "bake/picture/decoder_limits.h"
#include <algorithm>
#include <csignal>
#include <sys/prctl.h>
#include <sys/resource.h>

namespace bake {
namespace {

/// The address sanitizer reserves terabytes of address space.
#ifdef __SANITIZE_ADDRESS__
constexpr bool limits_memory = false;
#else
constexpr bool limits_memory = true;
#endif

void set_limit(int resource, std::int64_t soft, std::int64_t hard) noexcept {
    rlimit limit{};
    getrlimit(resource, &limit);
    // Of unsigned numbers, "no limit" is the largest.
    limit.rlim_max = std::min(limit.rlim_max, rlim_t(hard));
    limit.rlim_cur = std::min(limit.rlim_max, rlim_t(soft));
    setrlimit(resource, &limit);
}

} // namespace

DecoderLimits decoder_limits(std::int64_t stored, double samples) noexcept {
    // JPEG 2000 takes most of both: 4 bytes per sample in each of three copies, and 0.1 s per million samples.
    constexpr std::int64_t bytes = 256 << 20, seconds = 4, bytes_per_sample = 16, bytes_per_second = 1 << 20;
    constexpr double samples_per_second = 5e5, most_samples = 1e14;
    const double counted = std::clamp(samples, 0.0, most_samples);
    return {.bytes = bytes + 2 * stored + std::int64_t(counted) * bytes_per_sample,
            .seconds = seconds + stored / bytes_per_second + std::int64_t(counted / samples_per_second)};
}

std::optional<MemoryLimit> binding_limit(std::int64_t stored, double samples) {
    constexpr std::uint64_t libraries = 512 << 20; // address space of OpenImageIO with what it uses
    auto limit = started_process_limit();
    if (limit && limit->bytes >= libraries + std::uint64_t(decoder_limits(stored, samples).bytes)) limit.reset();
    return limit;
}

void limit_decoder(const DecoderLimits& limits, const DecoderLimits& largest, std::int64_t libraries) noexcept {
    set_limit(RLIMIT_CORE, 0, 0);
    // Beyond the hard limit the kernel kills without saying why.
    set_limit(RLIMIT_CPU, limits.seconds, largest.seconds + 5);
    if (limits_memory && libraries > 0) set_limit(RLIMIT_AS, libraries + limits.bytes, libraries + largest.bytes);
}

void end_with(pid_t parent) noexcept {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
}

} // namespace bake
