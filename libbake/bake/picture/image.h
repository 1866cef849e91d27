// An image in memory: rows of interleaved channels, row 0 at the top.
#pragma once
#include "bake/base/pages.h"
#include <cstddef>
#include <memory>
#include <type_traits>

namespace bake {

/// Owns width * height * channels values, texel (x, y) at row(y)[x * channels]. New values are NOT initialised, which
/// would take a second pass over a large image. An image can be moved, but not copied.
/// Texel (x, y) has its centre at u = (x + 0.5) / width, v = 1 - (y + 0.5) / height.
template <class T> class Image {
public:
    Image() = default;
    Image(int width, int height, int channels)
        : width_(width), height_(height), channels_(channels),
          values_(static_cast<T*>(allocate_pages(size() * sizeof(T)))) {}

    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }
    int channels() const noexcept { return channels_; }
    bool empty() const noexcept { return !values_; }
    /// width * height * channels
    std::size_t size() const noexcept { return std::size_t(width_) * height_ * channels_; }

    T* data() noexcept { return values_.get(); }
    const T* data() const noexcept { return values_.get(); }
    T* row(int y) noexcept { return values_.get() + std::size_t(y) * width_ * channels_; }
    const T* row(int y) const noexcept { return values_.get() + std::size_t(y) * width_ * channels_; }
    T& at(int x, int y, int c = 0) noexcept { return row(y)[std::size_t(x) * channels_ + c]; }
    const T& at(int x, int y, int c = 0) const noexcept { return row(y)[std::size_t(x) * channels_ + c]; }

private:
    int width_ = 0, height_ = 0, channels_ = 0;
    static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);
    std::unique_ptr<T[], FreePages> values_;
};

} // namespace bake
