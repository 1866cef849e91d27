// The header of a KTX2: what it says of its texels, and whether those of its largest level are there.
#pragma once
#include "bake/picture/dds_header.h"

namespace bake {

/// Throws Error{Refusal::unreadable} for a header that is damaged, for a format of texels that is not read, for
/// supercompression and for a file that lacks a level that its index claims, and Error{Refusal::unsuitable} for a volume, a
/// cube map and a picture stored turned over.
DdsHeader read_ktx2_header(const PictureFile& file);

} // namespace bake
