#include "bake/picture/picture_reply.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace bake {
namespace {

constexpr std::size_t most_text = 16 << 20, most_names = 64, most_notes = 64;
constexpr std::int64_t largest_size = 1 << 30;

class Writer {
public:
    void number(std::int64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void text(std::string_view text) {
        const std::string_view kept = text.substr(0, most_text);
        number(std::int64_t(kept.size()));
        bytes_ += kept;
    }
    void texts(const std::vector<std::string>& texts, std::size_t most) {
        const std::size_t count = std::min(texts.size(), most);
        number(std::int64_t(count));
        for (std::size_t i = 0; i < count; ++i) text(texts[i]);
    }
    void window(const Window& window) {
        for (const int value : {window.x, window.y, window.width, window.height}) number(value);
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Once a value is missing or out of its range, all that follow are 0 or empty.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    std::int64_t number(std::int64_t low, std::int64_t high) noexcept {
        std::int64_t value = 0;
        good_ = good_ && bytes_.size() >= sizeof value;
        if (!good_) return 0;
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
        good_ = value >= low && value <= high;
        return good_ ? value : 0;
    }
    int small(std::int64_t low, std::int64_t high) noexcept { return int(number(low, high)); }
    std::string text() {
        const auto size = std::size_t(number(0, std::int64_t(std::min(most_text, bytes_.size()))));
        good_ = good_ && size <= bytes_.size();
        if (!good_) return {};
        std::string text(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return text;
    }
    std::vector<std::string> texts(std::size_t most) {
        std::vector<std::string> texts(std::size_t(number(0, std::int64_t(most))));
        for (std::string& text : texts) text = this->text();
        return texts;
    }
    Window window() noexcept {
        const int x = small(-largest_size, largest_size), y = small(-largest_size, largest_size);
        const int width = small(0, largest_size), height = small(0, largest_size);
        return {x, y, width, height};
    }
    bool ended() const noexcept { return good_ && bytes_.empty(); }

private:
    std::string_view bytes_;
    bool good_ = true;
};

bool is_sent(SampleType type) noexcept {
    return type == SampleType::u8 || type == SampleType::u16 || type == SampleType::float32;
}

} // namespace

std::string to_bytes(const ReplyFailure& failure) {
    Writer writer;
    writer.number(std::int64_t(failure.refusal));
    writer.text(std::string_view(failure.message).substr(0, most_failure_bytes / 2));
    return writer.take();
}

std::string to_bytes(const ReplyHeader& header) {
    const ImageInfo& info = header.info;
    Writer writer;
    writer.window(header.data), writer.window(header.picture);
    writer.texts(info.channels, most_names);
    writer.number(std::int64_t(info.type)), writer.number(info.bits);
    writer.number(info.srgb_tagged), writer.number(info.palette);
    writer.number(info.alpha_channel), writer.number(info.colours);
    writer.number(std::int64_t(info.environment));
    writer.text(info.description);
    writer.texts(info.notes, most_notes);
    writer.number(header.orientation);
    writer.number(std::int64_t(header.sent));
    writer.text(header.icc);
    return writer.take();
}

std::optional<ReplyFailure> failure_from(std::string_view bytes) {
    Reader reader(bytes);
    ReplyFailure failure;
    failure.refusal = Refusal(reader.small(int(Refusal::unreadable), int(Refusal::unsuitable)));
    failure.message = reader.text();
    return reader.ended() ? std::optional(failure) : std::nullopt;
}

std::optional<ReplyHeader> header_from(std::string_view bytes) {
    Reader reader(bytes);
    ReplyHeader header;
    ImageInfo& info = header.info;
    header.data = reader.window(), header.picture = reader.window();
    info.width = header.picture.width, info.height = header.picture.height;
    info.channels = reader.texts(most_names);
    const auto channels = int(info.channels.size());
    info.type = SampleType(reader.small(0, int(SampleType::other))), info.bits = reader.small(1, 64);
    info.srgb_tagged = reader.small(0, 1) != 0, info.palette = reader.small(0, 1) != 0;
    info.alpha_channel = reader.small(-1, channels - 1), info.colours = reader.small(0, std::min(3, channels));
    info.environment = EnvironmentTag(reader.small(0, int(EnvironmentTag::cube)));
    info.description = reader.text();
    info.notes = reader.texts(most_notes);
    header.orientation = reader.small(0, 9);
    header.sent = SampleType(reader.small(0, int(SampleType::other)));
    header.icc = reader.text();
    return reader.ended() && is_sent(header.sent) ? std::optional(header) : std::nullopt;
}

void ReplyStream::send(ReplyFrame::Kind kind, const void* bytes, std::size_t size) {
    const ReplyFrame frame{kind, std::uint32_t(size)};
    write(&frame, sizeof frame);
    write(bytes, size);
}

void ReplyStream::write(const void* bytes, std::size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t done = ::write(descriptor_, at, size);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) _exit(1);
        at += done, size -= std::size_t(done);
    }
}

std::size_t sent_bytes(SampleType sent) noexcept {
    return sent == SampleType::u8 ? 1 : sent == SampleType::u16 ? 2 : 4;
}

} // namespace bake
