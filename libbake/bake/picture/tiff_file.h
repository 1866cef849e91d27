// A TIFF file opened by libtiff, which reads it through PictureFile and prints nothing.
#pragma once
#include "bake/picture/picture_file.h"
#include <string>
#include <tiffio.h>

namespace bake {

/// Messages of libtiff while a file is open.
struct TiffMessages {
    std::string error;      ///< the first one, with the system's reason
    bool cut_short = false; ///< a warning says that samples are missing
};

/// Stores libtiff's messages about one file in `messages`, which must outlive the file. Other files keep their handlers.
class TiffOptions {
public:
    explicit TiffOptions(TiffMessages& messages);
    ~TiffOptions() { TIFFOpenOptionsFree(options_); }
    TiffOptions(const TiffOptions&) = delete;
    TiffOptions& operator=(const TiffOptions&) = delete;
    TIFFOpenOptions* get() const noexcept { return options_; }

private:
    TIFFOpenOptions* options_;
};

class TiffFile {
public:
    /// Throws Error{Refusal::unreadable}.
    explicit TiffFile(const PictureFile& file);
    ~TiffFile() { TIFFClose(tiff_); }
    TiffFile(const TiffFile&) = delete;
    TiffFile& operator=(const TiffFile&) = delete;

    TIFF* get() const noexcept { return tiff_; }
    const PictureFile& file() const noexcept { return source_.file; }
    TiffMessages& messages() noexcept { return messages_; }

    /// The value of a tag, or its default; 0 if there is none.
    template <class Value> Value value(std::uint32_t tag) const {
        Value value{};
        return TIFFGetFieldDefaulted(tiff_, tag, &value) == 1 ? value : Value{};
    }
    /// The text of a tag that libtiff may not know by name; empty without one.
    std::string text(std::uint32_t tag) const;
    [[noreturn]] void fail(const std::string& why) const;

    struct Source {
        const PictureFile& file;
        std::int64_t at = 0;
    };

private:
    Source source_;
    TiffMessages messages_;
    TIFF* tiff_;
};

} // namespace bake
