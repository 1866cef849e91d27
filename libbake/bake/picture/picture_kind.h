// The format of a picture, recognised by the contents of its file.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// The formats that are read.
enum class PictureKind { png, exr, tiff, hdr, jpeg, tga, bmp, pnm, pfm, dds, ktx2, psd, jpeg2000, webp };

/// The format of the file whatever its name is; only TGA, which has no signature, may need its ending. Throws
/// Error{Refusal::unreadable} for any other format, with its name if it is a well-known one.
PictureKind picture_kind(const PictureFile& file);

} // namespace bake
