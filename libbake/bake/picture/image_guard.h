// What image decoders let pass: files that lack pixels and say nothing of it. Looked for before a decoder sees the file.
#pragma once
#include <cstdint>
#include <string>

namespace bake {

/// Why the file is not to be read, "" when nothing speaks against it: DDS and TIFF with fewer bytes than their headers ask
/// for, and formats whose decoders are not safe (DPX, Cineon, IFF, Softimage, zfile). Other formats are told apart from
/// cut ones by their decoders. `stored` is the file's size in bytes.
std::string image_fault(const std::string& path, std::int64_t stored);

} // namespace bake
