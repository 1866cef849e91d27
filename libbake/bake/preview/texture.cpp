#include "bake/preview/texture.h"
#include "bake/base/error.h"
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/slope_code.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

void require_finite(const Image<float>& image, const std::string& file) {
    const float* begin = image.data();
    const float* bad = std::find_if_not(begin, begin + image.size(), [](float v) { return std::isfinite(v); });
    if (bad == begin + image.size()) return;
    const std::size_t texel = std::size_t(bad - begin) / image.channels();
    throw Error(Refusal::unsuitable, file + ": holds NaN or Inf at column " + std::to_string(texel % image.width()) +
                                         ", row " + std::to_string(texel / image.width()) + "; give it a finite value");
}

/// The channels named, in that order, as an image of their own.
template <std::size_t N> Image<float> pick(const Image<float>& source, const std::array<int, N>& channels) {
    Image<float> picked(source.width(), source.height(), int(N));
    for (int y = 0; y < source.height(); ++y)
        for (int x = 0; x < source.width(); ++x)
            for (std::size_t c = 0; c < N; ++c) picked.at(x, y, int(c)) = source.at(x, y, channels[c]);
    return picked;
}

void tell(const std::string& file, const ImageInfo& info, std::vector<std::string>* notes) {
    for (const std::string& line : info.notes)
        if (notes) notes->push_back(file + ": " + line);
}

Texture shared(Image<float>&& image) { return std::make_shared<const Image<float>>(std::move(image)); }

} // namespace

Texture read_albedo(const std::string& file, ColourSpace space, std::vector<std::string>* notes,
                    const LoadedPictures& known) {
    const auto picture = loaded_picture(known, file);
    ImageInfo info = picture->info;
    Image<float> image = copied(picture->image);
    require_finite(image, file);
    linearise(image, space, info);
    tell(file, info, notes);
    return shared(image.channels() >= 3 ? pick<3>(image, {0, 1, 2}) : pick<3>(image, {0, 0, 0}));
}

Texture read_bump_table(const std::string& file, float scale, std::vector<std::string>* notes,
                        const LoadedPictures& known) {
    const auto picture = loaded_picture(known, file);
    const ImageInfo& info = picture->info;
    const Image<float>& image = picture->image;
    tell(file, info, notes);
    const auto refuse = [&](const std::string& why) { throw Error(Refusal::unsuitable, file + ": " + why); };
    const bool integers = is_integer(info.type);
    const std::optional<SlopeCode> code = integers ? slope_code(info.description) : std::nullopt;
    if (integers && !code)
        refuse("holds unsigned integers and does not state the slope of a level; bake the table by bump-table");
    const auto named = [&](const char* name) {
        const auto at = std::find(info.channels.begin(), info.channels.end(), name);
        return at == info.channels.end() ? -1 : int(at - info.channels.begin());
    };
    std::array<int, 2> slopes = {named("b_u"), named("b_v")};
    if (slopes[0] < 0 || slopes[1] < 0) {
        if (image.channels() < 2) refuse("has one channel, not b_u and b_v; bake a table if it is a height");
        if (image.channels() >= 6) refuse("looks like a bumpslopes texture; bake a table of two channels");
        slopes = {0, 1};
    }
    Image<float> table = pick<2>(image, slopes);
    const Vec2f factors = Vec2f(recorded_scale(info.record, image.width(), image.height())) * scale;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float value = table.data()[i];
        table.data()[i] = factors[int(i % 2)] * (code ? code->decode(value) : value);
    }
    require_finite(table, file);
    return shared(std::move(table));
}

Texture read_normal_map(const std::string& file, NormalEncoding encoding, bool directx, std::vector<std::string>* notes,
                        const LoadedPictures& known) {
    const auto picture = loaded_picture(known, file);
    const ImageInfo& info = picture->info;
    const Image<float>& image = picture->image;
    tell(file, info, notes);
    if (image.channels() < 2)
        throw Error(Refusal::unsuitable,
                    file + ": has one channel; a normal map has red, green and blue, or x and y alone");
    NormalValues values = guess_normal_values(image, info);
    // An encoding that the scene states needs no word.
    if (encoding != NormalEncoding::automatic) values.encoding = NormalEncoding::unorm;
    std::string note = values.usual() ? "" : file + ": " + describe(values);
    if (values.encoding == NormalEncoding::srgb_encoded || values.encoding == NormalEncoding::srgb_decoded) {
        values.encoding = NormalEncoding::unorm;
        note += "; they were taken as stored; export them as data, not as colour";
    }
    if (notes && !note.empty()) notes->push_back(std::move(note));
    const std::string green = record_word(info.record, "green");
    if (notes && !green.empty() && (green == "down") != directx)
        notes->push_back(file + ": its record says that green points " + green + ", but it is read as pointing " +
                         (directx ? "down" : "up") + "; set directx = " + (directx ? "false" : "true"));
    if (encoding != NormalEncoding::automatic) values.encoding = encoding;
    Image<float> normals = decode_normals(image, values);
    require_finite(normals, file);
    if (directx)
        for (std::size_t i = 1; i < normals.size(); i += 3) normals.data()[i] = -normals.data()[i];
    return shared(std::move(normals));
}

Vec2f lookup2(const Image<float>& image, const Vec2f& uv) noexcept {
    const auto value = bilinear<2>(image, uv);
    return {value[0], value[1]};
}

Vec3f lookup3(const Image<float>& image, const Vec2f& uv) noexcept {
    const auto value = bilinear<3>(image, uv);
    return {value[0], value[1], value[2]};
}

Vec3f lookup3(const Texture& texture, const Vec2f& uv, const Footprint& footprint) noexcept {
    if (!texture.mips) return lookup3(*texture, uv);
    const Taps taps = taps_of(*texture.mips, uv, footprint);
    const auto value = mean_over<3>(*texture.mips, taps, [&](const Vec2f& at) { return bilinear<3>(*texture, at); });
    return {value[0], value[1], value[2]};
}

} // namespace bake
