// read_mip FILE LEVEL: one level of a picture by OpenImageIO alone, to stdout: width, height, channels, then floats.
// Nothing when there is no such level. A program of its own, so that the tests need not load OpenImageIO.
#include <OpenImageIO/imageio.h>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
    OIIO::ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1); // colours are not multiplied by alpha
    const auto in = argc == 3 ? OIIO::ImageInput::open(argv[1], &as_stored) : nullptr;
    if (!in) return 1;
    const int level = std::atoi(argv[2]);
    if (!in->seek_subimage(0, level)) return 0;
    const OIIO::ImageSpec spec = in->spec();
    std::vector<float> values(std::size_t(spec.width) * spec.height * spec.nchannels);
    if (!in->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) return 1;
    const int size[] = {spec.width, spec.height, spec.nchannels};
    std::fwrite(size, sizeof size, 1, stdout);
    std::fwrite(values.data(), sizeof(float), values.size(), stdout);
    return 0;
}
