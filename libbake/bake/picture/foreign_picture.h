// Pictures that OpenImageIO decodes, in a process of its own.
#pragma once
#include "bake/picture/picture_kind.h"

namespace bake {

/// As read_image() and read_image_info(), for formats that no other reader here handles. Damaged files may make a decoder
/// crash, take memory or not end: that is a refusal as any other. No process and no descriptor is left behind.
void read_foreign(const PictureFile& file, PictureKind kind, const ReadLimits& limits, ImageInfo& info,
                  Image<float>* image);

/// The same by a program of this name, which is started and answers as bake_formats.
void read_by_program(const std::string& program, const PictureFile& file, PictureKind kind, const ReadLimits& limits,
                     ImageInfo& info, Image<float>* image);

} // namespace bake
