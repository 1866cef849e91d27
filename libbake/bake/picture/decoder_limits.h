// What a decoder may use. It runs in a process of its own, which ends when it exceeds one of these.
#pragma once
#include "bake/base/memory.h"
#include <cstdint>
#include <optional>
#include <sys/types.h>

namespace bake {

struct DecoderLimits {
    std::int64_t bytes = 0;   ///< of address space, beyond that of the libraries
    std::int64_t seconds = 0; ///< of processor time
};

/// Limits for a file of `stored` bytes whose picture has `samples` samples (all channels of all texels; 0 while that is not
/// known), many times what a file that is not damaged needs.
DecoderLimits decoder_limits(std::int64_t stored, double samples) noexcept;

/// The limit that this process passes on to a decoder (ulimit), if it may be too low for such a file, the libraries of the
/// decoder included; nothing if there is none.
std::optional<MemoryLimit> binding_limit(std::int64_t stored, double samples);

/// Limits this process to `limits` beyond `libraries` bytes. It can raise them again, up to `largest`. A crash leaves no
/// core file.
void limit_decoder(const DecoderLimits& limits, const DecoderLimits& largest, std::int64_t libraries) noexcept;

/// Ends this process when `parent` ends, at once if it has ended already.
void end_with(pid_t parent) noexcept;

} // namespace bake
