// Finds faults that image decoders do not report, such as missing pixels, before a decoder opens the file.
#pragma once
#include <cstdint>
#include <string>

namespace bake {

/// The reason why a file must not be read, "" if there is none: DDS and TIFF with fewer bytes than their headers
/// require, and formats whose decoders are not safe (DPX, Cineon, IFF, Softimage, zfile). The decoders of other formats
/// detect truncated files. `stored` is the size of the file in bytes.
std::string image_fault(const std::string& path, std::int64_t stored);

} // namespace bake
