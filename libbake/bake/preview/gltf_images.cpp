#include "bake/preview/gltf_images.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/base/text_line.h"
#include "bake/preview/surface_maps.h"
#include <filesystem>
#include <unistd.h>

namespace bake {
namespace {

namespace fs = std::filesystem;

/// An image in a file, which readers of pictures ask for: the file beside the glTF, or a temporary one.
class ImageFile {
public:
    ImageFile(const std::string& gltf, const GltfImage& image) {
        if (!image.uri.empty()) {
            path_ = (fs::path(gltf).parent_path() / image.uri).string();
            return;
        }
        path_ = (fs::temp_directory_path() / "bake_image_XXXXXX").string();
        const int file = mkstemp(path_.data());
        if (file < 0) throw Error(Refusal::unwritable, path_ + ": cannot be made; set TMPDIR to another folder");
        temporary_ = true;
        const std::uint8_t* p = image.bytes.data();
        for (std::size_t left = image.bytes.size(); left > 0;) {
            const ssize_t written = ::write(file, p, left);
            if (written <= 0) break; // the reader finds a picture that is cut short
            p += written, left -= std::size_t(written);
        }
        ::close(file);
    }
    ~ImageFile() {
        if (temporary_) ::unlink(path_.c_str());
    }
    ImageFile(const ImageFile&) = delete;
    ImageFile& operator=(const ImageFile&) = delete;

    const std::string& path() const noexcept { return path_; }
    /// The message of a reader without the name of the file.
    std::string without_path(std::string message) const {
        const std::size_t at = message.find(path_ + ": ");
        return at == std::string::npos ? message : message.erase(at, path_.size() + 2);
    }

private:
    std::string path_;
    bool temporary_ = false;
};

std::string name_of(std::uint32_t number, const GltfImage& image) {
    const std::string& name = image.uri.empty() ? image.name : image.uri;
    return "image " + std::to_string(number) + (name.empty() ? "" : " " + shown(name));
}

Texture scaled(const Texture& normals, float scale) {
    if (scale == 1) return normals;
    Image<float> image(normals->width(), normals->height(), 3);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = i % 3 == 2 ? normals->data()[i] : scale * normals->data()[i];
    return std::make_shared<const Image<float>>(std::move(image));
}

} // namespace

GltfImages::GltfImages(const std::string& path, const std::vector<GltfImage>& images, std::vector<std::string>& notes)
    : path_(path), images_(images), notes_(notes), failed_(images.size()) {}

template <class Read> Texture GltfImages::read(std::uint32_t image, Use use, float scale, Read&& read_file) {
    if (image >= images_.size() || failed_[image]) return nullptr;
    const auto [found, added] = known_.try_emplace({image, use, scale});
    if (!added) return found->second;
    throw_if_interrupted();
    const std::string name = name_of(image, images_[image]);
    if (images_[image].bytes.empty()) {
        failed_[image] = true;
        notes_.push_back(path_ + ": " + name + " is missing; its materials are shown without it");
        return nullptr;
    }
    const ImageFile file(path_, images_[image]);
    try {
        found->second = read_file(file.path());
    } catch (const Error& error) {
        if (error.refusal != Refusal::unreadable && error.refusal != Refusal::unsuitable) throw;
        failed_[image] = true;
        std::string why = file.without_path(error.what());
        why = why.substr(0, why.find(';'));
        notes_.push_back(path_ + ": " + name + " cannot be used (" + why + "); its materials are shown without it");
    }
    return found->second;
}

Texture GltfImages::colour(std::uint32_t image) {
    return read(image, Use::colour, 1, [](const std::string& file) { return read_albedo(file, ColourSpace::srgb); });
}

Texture GltfImages::data(std::uint32_t image) {
    return read(image, Use::data, 1, [](const std::string& file) { return read_albedo(file, ColourSpace::linear); });
}

Texture GltfImages::normals(std::uint32_t image, float scale) {
    return read(image, Use::normals, scale, [scale](const std::string& file) {
        return scaled(read_normal_map(file, NormalEncoding::unorm), scale);
    });
}

Texture GltfImages::alpha(std::uint32_t image) {
    return read(image, Use::alpha, 1, [](const std::string& file) { return read_alpha(file); });
}

} // namespace bake
