// other HEIGHT OUT.png: a normal map by libbake as it is installed. Prints the version and the mean normal.
#include <bake/base/error.h>
#include <bake/base/version.h>
#include <bake/relief/map/normal_map.h>
#include <cstdio>

int main(int argc, char** argv) try {
    if (argc != 3) return 2;
    const bake::HeightTexture height = bake::read_height(argv[1]);
    bake::NormalMapOptions options;
    options.height_options.amplitude = 0.05;
    const bake::HeightField field(height, options.height_options, options.filter, height.values.width(),
                                  height.values.height());
    const bake::Image<float> map = bake::normal_map(field, {1, 1}, options);
    bake::write_image(argv[2], map);
    double sum[3] = {};
    for (std::size_t i = 0; i < map.size(); ++i) sum[i % 3] += map.data()[i];
    const double texels = map.size() / 3.0;
    std::printf("libbake %s: mean colour %.3f %.3f %.3f\n", bake::version(), sum[0] / texels, sum[1] / texels,
                sum[2] / texels);
} catch (const bake::Error& error) {
    std::fprintf(stderr, "other: %s\n", error.what());
    return int(error.refusal);
}
