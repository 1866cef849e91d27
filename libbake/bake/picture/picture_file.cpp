#include "bake/picture/picture_file.h"
#include "bake/base/input_record.h"
#include "bake/base/memory.h"
#include "bake/base/system_lack.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace bake {

PictureFile::PictureFile(const std::string& path)
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    : PictureFile(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC), path) {
    struct stat status {};
    if (fstat(descriptor_, &status) == 0) remember_input(path, status);
}

PictureFile::PictureFile(int descriptor, const std::string& path) : path_(path), descriptor_(descriptor) {
    struct stat status {};
    const int reason = descriptor_ < 0 || fstat(descriptor_, &status) != 0 ? errno : 0;
    const bool folder = S_ISDIR(status.st_mode), regular = S_ISREG(status.st_mode);
    size_ = status.st_size;
    if (reason == 0 && regular && size_ > 0) {
        head_.resize(1200);
        head_.resize(std::size_t(read(0, head_.data(), std::int64_t(head_.size()))));
        return;
    }
    if (descriptor_ >= 0) close(descriptor_);
    if (reason == ENOENT || reason == ENOTDIR) throw unreadable(path, "no such file", "check the name");
    if (const std::string mend = mend_of_lack(reason); !mend.empty())
        throw Error(Refusal::unsuitable, path + ": cannot be opened (" + std::strerror(reason) + "); " + mend);
    if (reason) throw unreadable(path, std::strerror(reason), "check its permissions");
    if (folder) throw unreadable(path, "is a folder", "name an image file in it");
    if (!regular) throw unreadable(path, "is not a regular file", "name an image file");
    throw unreadable(path, "is empty");
}

PictureFile::~PictureFile() {
    try {
        input_was_read(descriptor_);
    } catch (const std::bad_alloc&) { // without memory the file stays without a hash
    }
    close(descriptor_);
}

std::int64_t PictureFile::read(std::int64_t offset, char* to, std::int64_t size) const {
    std::int64_t done = 0;
    while (done < size) {
        const ssize_t got = pread(descriptor_, to + done, std::size_t(size - done), offset + done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += got;
    }
    return done;
}

int PictureFile::duplicate(int at_least) const noexcept { return fcntl(descriptor_, F_DUPFD_CLOEXEC, at_least); }

std::string one_line(std::string text, const std::string& path) {
    const std::string ours = "the file";
    for (const std::string& name : {'"' + path + '"', path})
        for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += ours.size())
            text.replace(at, name.size(), ours);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32) c = ' ';
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text.empty() ? "unknown error" : text;
}

Error unreadable(const std::string& path, const std::string& why, const char* mend) {
    return Error(Refusal::unreadable, path + ": " + one_line(why, path) + "; " + mend);
}

Error out_of_memory(const std::string& path) {
    const MemoryLimit memory = memory_limit();
    return Error(Refusal::unsuitable, path + ": reading it takes more memory than " + memory.described() +
                                          "; scale it down, or " + memory.advice());
}

Error decoder_failed(const std::string& path, const std::string& what) {
    return unreadable(path, "its decoder " + what, "the file is damaged; export it again, as EXR, TIFF or PNG");
}

ReadLimits within_memory(ReadLimits limits) {
    const MemoryLimit memory = memory_limit();
    if (memory.bytes < std::uint64_t(limits.max_bytes))
        limits = {.max_bytes = std::int64_t(memory.bytes), .reason = memory.reason};
    return limits;
}

void check_size(const std::string& path, std::int64_t stored, const ClaimedSize& claimed, const ReadLimits& limits) {
    // A display window that is mostly empty costs no bytes in the file. More than this must be earned.
    constexpr double free_window_bytes = 256 << 20, window_ratio = 20000;
    const Window &data = claimed.data, &picture = claimed.picture;
    if (std::min({data.width, data.height, picture.width, picture.height, claimed.channels}) <= 0)
        throw unreadable(path, "has no pixels");
    // In double, as a hostile header overflows 64 bits.
    const double decoded = double(data.width) * data.height * claimed.channels,
                 shown = 4.0 * picture.width * picture.height * claimed.channels;
    const int width = std::max(data.width, picture.width), height = std::max(data.height, picture.height);
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (decoded > claimed.most_per_byte * double(stored) + 65536 ||
        (shown > free_window_bytes && shown > window_ratio * double(stored)))
        throw unreadable(path, "claims " + size + " pixels in " + std::to_string(stored) + " bytes");
    constexpr int longest = 1 << 20;
    if (std::max(width, height) > longest)
        throw Error(Refusal::unsuitable, path + ": " + size + " pixels are more than the " + std::to_string(longest) +
                                             " along a side that are read; scale it down");
    const double needed = std::max(4 * decoded, shown);
    if (needed <= double(limits.max_bytes)) return;
    const MemoryLimit limit{std::uint64_t(limits.max_bytes), limits.reason};
    const std::string needs =
        path + ": " + size + " pixels need " + in_binary_units(std::uint64_t(needed), true) + " of memory, more than ";
    if (limit.reason.empty())
        throw Error(Refusal::unsuitable,
                    needs + "the " + in_binary_units(limit.bytes, false) + " of a picture that is read; scale it down");
    throw Error(Refusal::unsuitable, needs + limit.described() + "; scale it down, or " + limit.advice());
}

Image<float> place(Image<float> image, const Window& data, const Window& picture) {
    if (data == picture) return image;
    const int channels = image.channels();
    Image<float> placed(picture.width, picture.height, channels);
    std::fill_n(placed.data(), placed.size(), 0.0f);
    const int left = std::max(data.x, picture.x), right = std::min(data.x + data.width, picture.x + picture.width);
    const int top = std::max(data.y, picture.y), bottom = std::min(data.y + data.height, picture.y + picture.height);
    for (int y = top; y < bottom && left < right; ++y)
        std::copy_n(&image.at(left - data.x, y - data.y), std::size_t(right - left) * channels,
                    &placed.at(left - picture.x, y - picture.y));
    return placed;
}

} // namespace bake
