// Decodes pictures by OpenImageIO: the inner part of the program bake_formats, and no part of the library.
#pragma once
#include "bake/picture/decoder_limits.h"
#include "bake/picture/picture_file.h"
#include "bake/picture/picture_reply.h"
#include <string>

namespace bake {

struct DecodeRequest {
    std::string format; ///< OpenImageIO's name of the decoder
    ReadLimits limits;
    bool texels = false;        ///< or the header alone
    double samples = 0;         ///< what the header claims; 0: not known
    DecoderLimits largest;      ///< that the limits of this process may be raised to
    std::int64_t libraries = 0; ///< address space of this process before it decodes
};

/// Answers with a header and, if asked for, texels. Raises the limits of this process to those of a picture of its size once
/// the size has been checked. Throws Error for a picture that cannot be read; what the decoder itself throws passes through.
void decode(const PictureFile& file, const DecodeRequest& request, ReplyStream& reply);

} // namespace bake
