// Textures of the preview: read once, shared by materials, looked up bilinearly with repeat.
#pragma once
#include "bake/base/vec.h"
#include "bake/environment/file/radiance.h"
#include "bake/preview/loaded_picture.h"
#include "bake/preview/texture_mips.h"
#include "bake/relief/height/normal_values.h"
#include <concepts>
#include <memory>
#include <string>
#include <vector>

namespace bake {

/// Shared by all materials that name the same file; false: none.
class Texture {
public:
    Texture() = default;
    template <class Pointer>
    requires std::convertible_to<Pointer, std::shared_ptr<const Image<float>>> Texture(Pointer&& image)
        : image_(std::forward<Pointer>(image)) {}
    explicit operator bool() const noexcept { return bool(image_); }
    const Image<float>& operator*() const noexcept { return *image_; }
    const Image<float>* operator->() const noexcept { return image_.get(); }
    const Image<float>* get() const noexcept { return image_.get(); }
    bool operator==(const Texture& other) const noexcept { return image_ == other.image_; } ///< of the same picture

    std::shared_ptr<const Mips> mips; ///< for lookups over a footprint; null: lookups are at a point

private:
    std::shared_ptr<const Image<float>> image_;
};

/// Colour (three channels, linear); a grey picture gives three equal ones. All readers throw Error naming the file:
/// unreadable, or unsuitable for what the comment of each says, and for NaN or Inf.
/// `notes` receives what reading the file has to tell. A file among `known` is not read again.
Texture read_albedo(const std::string& file, ColourSpace space = ColourSpace::automatic,
                    std::vector<std::string>* notes = nullptr, const LoadedPictures& known = {});
/// Bump table: two channels, (b_u, b_v), slopes per unit of u and v in object units, times `scale`. The channels are
/// those named b_u and b_v, otherwise the first two. Integer samples are decoded by the SlopeCode that the file states. Where
/// the record of the file names other units, they are converted.
/// Unsuitable: integer samples without a SlopeCode; one channel; six and more, as in OpenImageIO's bumpslopes, which are
/// in other units.
Texture read_bump_table(const std::string& file, float scale = 1, std::vector<std::string>* notes = nullptr,
                        const LoadedPictures& known = {});
/// Tangent-space normals, decoded to vectors (three channels), green up unless `directx`. Channels and an automatic encoding
/// are those of guess_normal_values(), but no sRGB curve is applied. `notes` also receives what is said of values that are
/// not the usual ones. Unsuitable: one channel.
Texture read_normal_map(const std::string& file, NormalEncoding encoding = NormalEncoding::automatic,
                        bool directx = false, std::vector<std::string>* notes = nullptr,
                        const LoadedPictures& known = {});

/// Value at uv (v up), bilinear between texel centres, repeated in both directions; of two or three channels.
/// A uv that is not finite counts as 0.
Vec2f lookup2(const Image<float>& image, const Vec2f& uv) noexcept;
Vec3f lookup3(const Image<float>& image, const Vec2f& uv) noexcept;
/// The mean over a footprint around uv; without mips the value at uv.
Vec3f lookup3(const Texture& texture, const Vec2f& uv, const Footprint& footprint) noexcept;

} // namespace bake
