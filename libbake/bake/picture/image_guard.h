// Finds faults that image decoders do not report, such as missing pixels, before a decoder opens the file.
#pragma once
#include "bake/picture/picture_file.h"
#include <string>

namespace bake {

/// The reason why a file must not be read, "" if there is none: DDS with fewer bytes than the header requires or with
/// samples that the decoder would cut, and formats whose decoders are not safe (DPX, Cineon, IFF, Softimage, zfile). The
/// decoders of other formats detect truncated files.
std::string image_fault(const PictureFile& file);

} // namespace bake
