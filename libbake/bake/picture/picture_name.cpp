#include "bake/picture/picture_name.h"
#include "bake/base/output_file.h"
#include "bake/base/text.h"

namespace bake {

PictureFormat picture_format(const std::string& path) {
    if (path == null_device) return PictureFormat::exr;
    const std::string end = ending(path);
    return end == ".png"                     ? PictureFormat::png
           : end == ".exr"                   ? PictureFormat::exr
           : end == ".tif" || end == ".tiff" ? PictureFormat::tiff
                                             : PictureFormat::unknown;
}

} // namespace bake
