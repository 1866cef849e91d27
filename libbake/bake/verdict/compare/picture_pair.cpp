#include "bake/verdict/compare/picture_pair.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/provenance.h"
#include "bake/picture/image_io.h"
#include "bake/preview/tone.h"
#include "bake/relief/height/picture_kind.h"
#include "bake/verdict/compare/finite_pixels.h"

namespace bake {
namespace {

struct File {
    Image<float> image;
    ImageInfo info;
    int colours = 3; ///< 1 or 3
};

File read(const std::string& path) {
    File file;
    file.image = read_image(path, &file.info);
    file.colours = colour_channels(file.info, file.image.channels());
    if (file.image.channels() == 2 && file.info.alpha_channel < 0)
        throw Error(Refusal::unsuitable, path + ": has two channels, which are no colour; to compare normals give "
                                                "`normals`");
    require_finite_pixels(file.image, file.colours, path);
    linearise(file.image, ColourSpace::automatic, file.info);
    return file;
}

/// The first three channels, or the first one three times.
Image<float> three_channels(File file) {
    if (file.image.channels() == 3 && file.colours == 3) return std::move(file.image);
    Image<float> out(file.image.width(), file.image.height(), 3);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            for (int c = 0; c < 3; ++c) out.at(x, y, c) = file.image.at(x, y, file.colours == 3 ? c : 0);
    return out;
}

std::string colours_of(const File& file) { return file.colours == 3 ? "three colour channels" : "one grey channel"; }

} // namespace

PicturePair read_picture_pair(const std::string& reference, const std::string& test) {
    File a = read(reference), b = read(test);
    require_one_size(a.image, reference, b.image, test);
    if (a.colours != b.colours)
        throw Error(Refusal::unsuitable, test + ": has " + colours_of(b) + ", where " + reference + " has " +
                                             colours_of(a) + "; convert one to the other's");
    PicturePair pair{.grey = a.colours == 1, .integers = is_integer(a.info.type) || is_integer(b.info.type)};
    for (const auto& [name, file] : {std::pair<const std::string&, const File&>(reference, a), {test, b}}) {
        for (const std::string& line : file.info.notes) pair.notes.push_back(name + ": " + line);
        if (record_word(file.info.record, "content") == "normal map")
            pair.notes.push_back(name + ": its record says that it is a normal map; `normals` compares the angles");
        if (file.info.alpha_channel > 0) pair.notes.push_back(name + ": alpha is not compared");
    }
    pair.reference = three_channels(std::move(a));
    pair.test = three_channels(std::move(b));
    return pair;
}

Image<float> shown(const Image<float>& light, float exposure) {
    Image<float> out(light.width(), light.height(), light.channels());
    const std::size_t row = std::size_t(light.width()) * std::size_t(light.channels());
    for_rows(light.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (std::size_t i = 0; i < row; ++i) out.row(y)[i] = shown_value(light.row(y)[i], exposure, Tone::srgb);
    });
    return out;
}

} // namespace bake
