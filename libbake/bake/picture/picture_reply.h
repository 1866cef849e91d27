// What the program bake_formats answers about a picture, and how it is written as bytes.
//
// The answer is a row of frames: the start; then a failure; or a header, then texels in the order of their rows, in any number of frames,
// and the end.
#pragma once
#include "bake/picture/picture_file.h"
#include <optional>
#include <string>
#include <string_view>

namespace bake {

struct ReplyFrame {
    enum Kind : std::uint32_t { failure = 1, header = 2, texels = 3, end = 4, started = 5 };
    std::uint32_t kind = 0;
    std::uint32_t size = 0; ///< bytes that follow
};

/// Most bytes of a failure and of a header.
constexpr std::uint32_t most_failure_bytes = 16 << 10, most_header_bytes = 64 << 20;

struct ReplyFailure {
    Refusal refusal = Refusal::unreadable;
    std::string message = {};
};

struct ReplyHeader {
    ImageInfo info; ///< without the format and the colour tag, which follow from the request and from the profile
    Window data, picture;
    int orientation = 1;                   ///< as in upright.h
    SampleType sent = SampleType::float32; ///< of the texels that follow: u8, u16 or float32
    std::string icc = {};                  ///< ICC profile, empty without one
};

std::string to_bytes(const ReplyFailure& failure);
std::string to_bytes(const ReplyHeader& header);

/// Nothing for bytes that to_bytes() does not give: a decoder that overwrote its own memory may send anything. Sizes of
/// windows are in [0, 2^30]; whether they are allowed is check_size()'s matter.
std::optional<ReplyFailure> failure_from(std::string_view bytes);
std::optional<ReplyHeader> header_from(std::string_view bytes);

/// Writes frames. The process ends if its reader has gone.
class ReplyStream {
public:
    explicit ReplyStream(int descriptor) : descriptor_(descriptor) {}
    void send(ReplyFrame::Kind kind, const void* bytes = nullptr, std::size_t size = 0);
    void send(ReplyFrame::Kind kind, const std::string& bytes) { send(kind, bytes.data(), bytes.size()); }

private:
    void write(const void* bytes, std::size_t size);
    int descriptor_;
};

/// Bytes of a sample of the type `sent`.
std::size_t sent_bytes(SampleType sent) noexcept;

} // namespace bake
