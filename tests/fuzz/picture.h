// One decoder of pictures.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include "bake/picture/picture_file.h"
#include "bake/picture/picture_kind.h"
#include "fuzz/fuzz.h"

namespace bake::fuzz {

/// Reads header and texels if the bytes are of the format, each as a verb would.
template <class Read> int read_picture(PictureKind kind, Read&& read, const std::uint8_t* data, std::size_t size) {
    return attempt([&] {
        const InputFile input(data, size);
        const PictureFile file(input.path());
        if (picture_kind(file) != kind) return;
        const ReadLimits limits{.max_bytes = std::int64_t(64) << 20};
        ImageInfo header, info;
        read(file, limits, header, static_cast<Image<float>*>(nullptr));
        Image<float> image;
        read(file, limits, info, &image);
        require(header.width == info.width && header.height == info.height && header.channels == info.channels,
                "the header tells what the texels are");
        if (image.empty()) return; // left to another decoder
        require(image.width() == info.width && image.height() == info.height &&
                    std::size_t(image.channels()) == info.channels.size(),
                "the texels are as many as the header tells");
        require(info.alpha_channel < image.channels() && info.colours <= image.channels(), "channels are in range");
        // Every texel has been written: the memory sanitizer and valgrind see those that are not.
        volatile float sum = 0;
        for (std::size_t i = 0; i < image.size(); ++i) sum = sum + image.data()[i];
    });
}

} // namespace bake::fuzz
