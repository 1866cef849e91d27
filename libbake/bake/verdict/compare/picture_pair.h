// Two picture files as metrics take them.
#pragma once
#include "bake/picture/image.h"
#include <string>
#include <vector>

namespace bake {

struct PicturePair {
    Image<float> reference, test; ///< linear light, three channels; those of a grey picture are equal
    bool grey = false;            ///< both files are grey
    bool integers = false;        ///< one of the files has integer samples, which are meant to be shown as they are
    std::vector<std::string> notes;
};

/// Reads two pictures of one size, both of colour or both grey. Alpha and channels beyond the third are left out. Throws the
/// errors of read_image(), and Error{Refusal::unsuitable} naming the file: sizes or channels differ, two channels that are no
/// colour, NaN or Inf.
PicturePair read_picture_pair(const std::string& reference, const std::string& test);

/// What a screen shows: each value as shown_value() of preview/tone gives it with the sRGB curve.
Image<float> shown(const Image<float>& light, float exposure);

} // namespace bake
