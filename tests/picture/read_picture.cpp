// read_picture FILE: size and mean of a picture. Its exit code is that of the refusal, whose message goes to stderr.
#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include <cstdio>
#include <numeric>

int main(int argc, char** argv) try {
    const bake::Image<float> image = bake::read_image(argc == 2 ? argv[1] : "");
    const double mean = std::accumulate(image.data(), image.data() + image.size(), 0.0) / double(image.size());
    std::printf("%d %d %d %.3f\n", image.width(), image.height(), image.channels(), mean);
    return 0;
} catch (const bake::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return int(error.refusal);
}
