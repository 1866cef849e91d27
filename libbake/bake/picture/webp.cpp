#include "bake/picture/webp.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include <webp/decode.h>
#include <webp/encode.h>

namespace bake {
namespace {

/// Frees what libwebp allocates.
struct Encoder {
    Encoder() {
        WebPPictureInit(&picture);
        WebPMemoryWriterInit(&memory);
    }
    ~Encoder() {
        WebPPictureFree(&picture);
        WebPMemoryWriterClear(&memory);
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    WebPPicture picture;
    WebPMemoryWriter memory;
};

} // namespace

std::string encode_webp(const Image<unsigned char>& rgb, int quality) {
    const int w = rgb.width(), h = rgb.height();
    if (rgb.empty() || rgb.channels() != 3 || w > webp_longest_side || h > webp_longest_side)
        throw Error(Refusal::unsuitable,
                    format("a picture of %d x %d pixels cannot be stored as WebP; its sides must be "
                           "from 1 to %d",
                           w, h, webp_longest_side));
    WebPConfig config;
    WebPConfigInit(&config);
    config.lossless = quality > 100;
    config.quality = float(config.lossless ? 50 : quality); // of a lossless file: effort
    // The smallest squared error for the size, rather than a pleasant look.
    config.sns_strength = 0, config.filter_strength = 20;
    Encoder encoder;
    WebPPicture& picture = encoder.picture;
    picture.use_argb = config.lossless;
    picture.width = w, picture.height = h;
    picture.writer = WebPMemoryWrite, picture.custom_ptr = &encoder.memory;
    if (!WebPPictureImportRGB(&picture, rgb.data(), 3 * w) || !WebPEncode(&config, &picture))
        throw Error(Refusal::unsuitable, format("a picture of %d x %d pixels cannot be stored as WebP (error %d of "
                                                "libwebp); use a smaller picture",
                                                w, h, int(picture.error_code)));
    return {reinterpret_cast<const char*>(encoder.memory.mem), encoder.memory.size};
}

Image<unsigned char> decode_webp(const std::string& file) {
    int w = 0, h = 0;
    const auto* bytes = reinterpret_cast<const unsigned char*>(file.data());
    if (!WebPGetInfo(bytes, file.size(), &w, &h)) return {};
    Image<unsigned char> rgb(w, h, 3);
    if (!WebPDecodeRGBInto(bytes, file.size(), rgb.data(), rgb.size(), 3 * w)) return {};
    return rgb;
}

} // namespace bake
