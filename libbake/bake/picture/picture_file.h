// A picture file that is opened once and read by any of the decoders.
#pragma once
#include "bake/base/error.h"
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <cstdint>
#include <string>

namespace bake {

class PictureFile {
public:
    /// Throws Error{Refusal::unreadable} for a file that is missing, empty or not a regular file.
    explicit PictureFile(const std::string& path);
    /// Takes over the descriptor of an open file, which `path` names in messages, and which is no input of the run.
    PictureFile(int descriptor, const std::string& path);
    ~PictureFile();
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;

    const std::string& path() const noexcept { return path_; }
    std::int64_t size() const noexcept { return size_; }
    /// The first 1200 bytes, fewer in a shorter file.
    const std::string& head() const noexcept { return head_; }
    /// Reads up to `size` bytes from `offset` on. Returns their number.
    std::int64_t read(std::int64_t offset, char* to, std::int64_t size) const;
    /// Another descriptor of the open file, `at_least` or higher, which the caller closes; -1 when there is none to be had.
    int duplicate(int at_least = 0) const noexcept;

private:
    std::string path_, head_;
    std::int64_t size_ = 0;
    int descriptor_;
};

/// The text in one line, without the name of the file, because every message starts with it.
std::string one_line(std::string text, const std::string& path);

/// "<path>: <why>; <mend>"
Error unreadable(const std::string& path, const std::string& why,
                 const char* mend = "the file is damaged; export it again");

/// For a picture whose reading ends with std::bad_alloc.
Error out_of_memory(const std::string& path);

/// "<path>: its decoder <what>; ..."
Error decoder_failed(const std::string& path, const std::string& what);

/// The limits, or what memory_limit() allows if that is less.
ReadLimits within_memory(ReadLimits limits);

/// Position and size of a part of a picture, in texels.
struct Window {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Window&) const = default;
};

/// Sizes that a header claims.
struct ClaimedSize {
    Window data, picture; ///< the part that is stored, and the part that is shown
    int channels = 0;
    double most_per_byte = 4096; ///< largest number of samples that one stored byte can represent
};

/// Checks the claims of a header before memory is allocated. Throws Error{Refusal::unreadable} for a picture without
/// pixels or with more than `stored` bytes can hold, and Error{Refusal::unsuitable} for one that exceeds `limits`.
void check_size(const std::string& path, std::int64_t stored, const ClaimedSize& claimed, const ReadLimits& limits);

/// Copies the texels of the window `data` to the window `picture`; texels outside of `data` are 0.
Image<float> place(Image<float> image, const Window& data, const Window& picture);

} // namespace bake
