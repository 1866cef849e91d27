// A picture file while it is read: opened once, whatever decoder reads it.
#pragma once
#include "bake/base/error.h"
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <cstdint>
#include <string>

namespace bake {

class PictureFile {
public:
    /// Throws Error{Refusal::unreadable} for what is missing, empty or no regular file.
    explicit PictureFile(const std::string& path);
    ~PictureFile();
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;

    const std::string& path() const noexcept { return path_; }
    std::int64_t size() const noexcept { return size_; }
    /// The first 148 bytes, fewer in a shorter file.
    const std::string& head() const noexcept { return head_; }
    /// Up to `size` bytes from `offset` on. Returns how many there were.
    std::int64_t read(std::int64_t offset, char* to, std::int64_t size) const;

private:
    std::string path_, head_;
    std::int64_t size_ = 0;
    int descriptor_;
};

/// The text in one line, without the file's own name, which every message starts with.
std::string one_line(std::string text, const std::string& path);

/// "<path>: <why>; <mend>"
Error unreadable(const std::string& path, const std::string& why,
                 const char* mend = "the file is damaged; export it again");

/// Where a part of a picture lies, in texels.
struct Window {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Window&) const = default;
};

/// What a header claims of a file's size.
struct ClaimedSize {
    Window data, picture; ///< what is stored, and what is shown of it
    int channels = 0;
    double most_per_byte = 4096; ///< samples that one stored byte can stand for
};

/// Looks at a header's claims before anything is allocated. Throws Error{Refusal::unreadable} for a picture without
/// pixels or with more than `stored` bytes can hold, and Error{Refusal::unsuitable} for one over `limits`.
void check_size(const std::string& path, std::int64_t stored, const ClaimedSize& claimed, const ReadLimits& limits);

/// The texels of the window `picture` out of those of `data`; 0 where there are none.
Image<float> place(Image<float> image, const Window& data, const Window& picture);

} // namespace bake
