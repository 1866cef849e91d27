// Meaning of the values of a height by the sample type of its file.
#pragma once
#include "bake/picture/image_types.h"

namespace bake {

/// Half, float and double: their values are lengths, those of integers fractions of the range.
bool is_float(const ImageInfo& info) noexcept;
/// Two's complement integers, read as fractions from -1 to 1.
bool is_signed_integer(const ImageInfo& info) noexcept;

/// The value of zero height unless the user gives one: 0 for floats and signed integers, which have a zero of their own,
/// and 0.5 for unsigned integers.
double default_midlevel(const ImageInfo& info) noexcept;

/// Height of white above black unless the user gives one: the values of floats are lengths, the range of integers is 1 % of
/// `whole`, the size of what the height is on.
double default_amplitude(const ImageInfo& info, double whole) noexcept;

/// The reader of the format gives fewer bits than the file has, as that of 16-bit DDS does.
bool is_cut(const ImageInfo& info) noexcept;
/// The format's compression changes values.
bool is_lossy(const ImageInfo& info) noexcept;

} // namespace bake
