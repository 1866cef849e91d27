#include "bake/picture/foreign_picture.h"
#include "bake/base/progress.h"
#include "bake/picture/claimed_size.h"
#include "bake/picture/decoder_limits.h"
#include "bake/picture/decoder_process.h"
#include "bake/picture/decoder_program.h"
#include "bake/picture/icc.h"
#include "bake/picture/picture_reply.h"
#include "bake/picture/upright.h"
#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <unistd.h>

namespace bake {
namespace {

const char* decoder_name(PictureKind kind) noexcept {
    switch (kind) {
    case PictureKind::exr: return "openexr";
    case PictureKind::jpeg: return "jpeg";
    case PictureKind::tga: return "targa";
    case PictureKind::bmp: return "bmp";
    case PictureKind::pnm:
    case PictureKind::pfm: return "pnm";
    case PictureKind::psd: return "psd";
    case PictureKind::jpeg2000: return "jpeg2000";
    case PictureKind::webp: return "webp";
    default: return "dds";
    }
}

/// Samples that the file claims where decoders need to know it early, 0 elsewhere. Throws as check_size().
double claimed_samples(const PictureFile& file, PictureKind kind, const ReadLimits& limits) {
    const auto size = claimed_size(file, kind);
    if (!size) return 0;
    const Window window{0, 0, size->width, size->height};
    check_size(file.path(), file.size(), {window, window, size->channels}, limits);
    return double(size->width) * size->height * size->channels;
}

double samples_of(const ReplyHeader& header) noexcept {
    return double(header.data.width) * header.data.height * double(header.info.channels.size());
}

/// A process may have to wait for others: many times what it may take of a processor.
std::chrono::seconds waiting_time(const PictureFile& file, double samples) noexcept {
    return std::chrono::seconds(60 + 20 * decoder_limits(file.size(), samples).seconds);
}

std::string read_bytes(DecoderProcess& decoder, std::uint32_t size) {
    std::string bytes(size, '\0');
    decoder.read(bytes.data(), bytes.size());
    return bytes;
}

/// A refusal by the decoder, in one line that begins with the name of the file.
Error refused(const std::string& path, const std::string& bytes) {
    const auto failure = failure_from(bytes);
    if (!failure || !failure->message.starts_with(path + ": ")) return decoder_failed(path, "crashed");
    return Error(failure->refusal, path + ": " + one_line(failure->message.substr(path.size() + 2), path));
}

/// Checks what the decoder says of the picture, as if it were a file.
ReplyHeader checked_header(const PictureFile& file, PictureKind kind, const std::string& bytes,
                           const ReadLimits& limits) {
    auto header = header_from(bytes);
    if (!header) throw decoder_failed(file.path(), "crashed");
    const double most_per_byte = kind == PictureKind::exr ? 32768 : 4096; // the decoder may know a lower one
    check_size(file.path(), file.size(),
               {header->data, header->picture, int(header->info.channels.size()), most_per_byte}, limits);
    for (std::string& note : header->info.notes) note = one_line(note, file.path());
    return std::move(*header);
}

template <class Level> void to_floats(const char* from, float* to, std::size_t count) noexcept {
    constexpr float step = 1.0f / std::numeric_limits<Level>::max();
    for (std::size_t i = 0; i < count; ++i) {
        Level level;
        std::memcpy(&level, from + i * sizeof level, sizeof level);
        to[i] = float(level) * step;
    }
}

/// Reads `count` samples of the type `sent`.
void read_samples(DecoderProcess& decoder, SampleType sent, float* to, std::size_t count) {
    if (sent == SampleType::float32) return decoder.read(to, count * sizeof(float));
    constexpr std::size_t most = 1 << 18;
    std::string part(std::min(count, most) * sent_bytes(sent), '\0');
    for (std::size_t done = 0; done < count; done += most) {
        const std::size_t now = std::min(most, count - done);
        decoder.read(part.data(), now * sent_bytes(sent));
        if (sent == SampleType::u8) to_floats<std::uint8_t>(part.data(), to + done, now);
        else to_floats<std::uint16_t>(part.data(), to + done, now);
    }
}

/// The header, and the texels if they were asked for.
ReplyHeader read_reply(DecoderProcess& decoder, const PictureFile& file, PictureKind kind, const ReadLimits& limits,
                       Image<float>* image) {
    ReplyFrame start;
    decoder.read(&start, sizeof start);
    if (start.kind != ReplyFrame::started || start.size != 0) throw decoder_failed(file.path(), "crashed");
    std::optional<ReplyHeader> header;
    std::size_t done = 0, total = 0; // samples
    for (;;) {
        throw_if_interrupted();
        ReplyFrame frame;
        decoder.read(&frame, sizeof frame);
        const bool sized = header && frame.size % sent_bytes(header->sent) == 0 &&
                           frame.size / sent_bytes(header->sent) <= total - done;
        if (frame.kind == ReplyFrame::failure && frame.size <= most_failure_bytes) {
            throw refused(file.path(), read_bytes(decoder, frame.size));
        } else if (frame.kind == ReplyFrame::header && frame.size <= most_header_bytes && !header) {
            header = checked_header(file, kind, read_bytes(decoder, frame.size), limits);
            decoder.allow(waiting_time(file, samples_of(*header)));
            if (image) {
                *image = Image<float>(header->data.width, header->data.height, int(header->info.channels.size()));
                total = image->size();
            }
        } else if (frame.kind == ReplyFrame::texels && sized && image) {
            const std::size_t count = frame.size / sent_bytes(header->sent);
            read_samples(decoder, header->sent, image->data() + done, count);
            done += count;
        } else if (frame.kind == ReplyFrame::end && header && done == total) {
            return std::move(*header);
        } else {
            throw decoder_failed(file.path(), "crashed");
        }
    }
}

/// read_reply(), whose refusal does not blame a file where a limit may have been at fault.
ReplyHeader read_reply_in_limits(DecoderProcess& decoder, const PictureFile& file, PictureKind kind,
                                 const ReadLimits& limits, double claimed, Image<float>* image) try {
    return read_reply(decoder, file, kind, limits, image);
} catch (const Error& error) {
    const auto limit = binding_limit(file.size(), std::max(claimed, image ? double(image->size()) : 0));
    if (error.refusal != Refusal::unreadable || !limit) throw;
    throw Error(Refusal::unsuitable, file.path() + ": cannot be decoded within " + limit->described() + "; " +
                                         limit->advice() + ", or give a PNG, EXR or TIFF");
}

} // namespace

void read_by_program(const std::string& program, const PictureFile& file, PictureKind kind, const ReadLimits& limits,
                     ImageInfo& info, Image<float>* image) {
    const double claimed = claimed_samples(file, kind, limits);
    DecoderProcess decoder(program,
                           {decoder_name(kind), file.path(), std::to_string(limits.max_bytes),
                            image ? "texels" : "header", std::to_string(claimed), std::to_string(getpid()),
                            limits.reason},
                           file);
    decoder.allow(waiting_time(file, claimed));
    ReplyHeader header = read_reply_in_limits(decoder, file, kind, limits, claimed, image);
    info = std::move(header.info);
    info.format = decoder_name(kind);
    if (!header.icc.empty()) info.colour = read_icc(header.icc);
    if (!info.colour.curves.empty()) info.srgb_tagged = info.colour.is_srgb();
    turn_upright(info, header.orientation);
    if (image) *image = upright(place(std::move(*image), header.data, header.picture), header.orientation);
}

void read_foreign(const PictureFile& file, PictureKind kind, const ReadLimits& limits, ImageInfo& info,
                  Image<float>* image) {
    read_by_program(decoder_program(file.path()), file, kind, limits, info, image);
}

} // namespace bake
