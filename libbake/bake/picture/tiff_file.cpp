#include "bake/picture/tiff_file.h"
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace bake {
namespace {

int keep_error(TIFF*, void* messages, const char*, const char* format, va_list values) {
    const int reason = errno;
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    std::string& kept = static_cast<TiffMessages*>(messages)->error;
    if (kept.empty()) kept = reason == 0 ? text : std::string(text) + ": " + std::strerror(reason);
    return 1;
}

int keep_warning(TIFF*, void* messages, const char*, const char* format, va_list values) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    if (std::strstr(text, "remature") || std::strstr(text, "orrupt"))
        static_cast<TiffMessages*>(messages)->cut_short = true;
    return 1;
}

TiffFile::Source& source(thandle_t handle) { return *static_cast<TiffFile::Source*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t size) {
    const std::int64_t got = source(handle).file.read(source(handle).at, static_cast<char*>(to), size);
    source(handle).at += got;
    return got;
}

tmsize_t write_bytes(thandle_t, void*, tmsize_t) { return -1; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
    const std::int64_t base = whence == SEEK_CUR   ? source(handle).at
                              : whence == SEEK_END ? source(handle).file.size()
                                                   : 0;
    return toff_t(source(handle).at = base + std::int64_t(offset));
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return toff_t(source(handle).file.size()); }

} // namespace

TiffOptions::TiffOptions(TiffMessages& messages) : options_(TIFFOpenOptionsAlloc()) {
    TIFFOpenOptionsSetErrorHandlerExtR(options_, keep_error, &messages);
    TIFFOpenOptionsSetWarningHandlerExtR(options_, keep_warning, &messages);
    errno = 0;
}

TiffFile::TiffFile(const PictureFile& file) : source_{file} {
    const TiffOptions options(messages_);
    // No buffer needs more than the file has; a decoded strip or tile is in one of ours.
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), std::max<tmsize_t>(1 << 28, file.size()));
    // Not mapped, as the file may shrink, and strips as they are stored.
    tiff_ = TIFFClientOpenExt(file.path().c_str(), "rmc", &source_, read_bytes, write_bytes, seek, close_nothing,
                              size_of, nullptr, nullptr, options.get());
    if (!tiff_) throw unreadable(file.path(), "is cut short or damaged (" + messages_.error + ")");
}

std::string TiffFile::text(std::uint32_t tag) const {
    // The other look-up takes a tag that libtiff does not know for an error.
    const TIFFField* const field = TIFFFindField(tiff_, tag, TIFF_ANY);
    if (!field || TIFFFieldDataType(field) != TIFF_ASCII) return {};
    char* text = nullptr;
    if (!TIFFFieldPassCount(field)) return TIFFGetField(tiff_, tag, &text) == 1 && text ? text : "";
    if (TIFFFieldReadCount(field) == TIFF_VARIABLE2) {
        std::uint32_t count = 0;
        if (TIFFGetField(tiff_, tag, &count, &text) != 1 || !text) return {};
        return {text, strnlen(text, count)};
    }
    std::uint16_t count = 0;
    if (TIFFGetField(tiff_, tag, &count, &text) != 1 || !text) return {};
    return {text, strnlen(text, count)};
}

void TiffFile::fail(const std::string& why) const { throw unreadable(file().path(), why); }

} // namespace bake
