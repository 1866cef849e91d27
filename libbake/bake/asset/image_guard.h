// What image decoders let pass: files that lack pixels and say nothing of it. Looked for before a decoder sees the file.
#pragma once
#include <cstdint>
#include <string>

namespace bake {

/// Why the file cannot be whole, "" when nothing speaks against it. Knows OpenEXR (attributes that are missing, run past
/// the end or have unprintable channel names; more chunks than bytes), DDS and IFF (fewer bytes than the header asks
/// for); other formats are told apart from cut ones by their decoders. `stored` is the file's size in bytes.
std::string image_fault(const std::string& path, std::int64_t stored);

} // namespace bake
