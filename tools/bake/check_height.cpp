#include "check_height.h"
#include "inputs/file_kind.h"

namespace bake {

ReliefReport inspect_height(const std::string& file, const HeightInput& input, const HeightTexture& height,
                            const InspectOptions& options, const CommonArgs& common) {
    const Mesh mesh = read_mesh(file, options.read);
    const double size = diagonal(bounds(mesh));
    const HeightOptions relief = height_options(input, height.info, diagonal_of(size));
    check_steepness(input, relief.amplitude, size);
    note(common, default_amplitude_note(input, height.info, relief, diagonal_of(size)));
    return inspect_relief(file, mesh, input.path, height, input.filter, relief);
}

void add_height_check(CLI::App& sub, HeightInput& input) {
    CLI::Option* height = add_height_path(sub, "--height", input);
    height->description(
        "Report what each method does wrong with the relief of this picture on the meshes, as predicted");
    add_relief_options(sub, input);
    add_height_options(sub, input);
    for (const char* flag : {"--amplitude", "--midlevel", "--filter", "--wrap", "--wrap-u", "--wrap-v", "--channel",
                             "--invert", "--dequantise"})
        sub.get_option(flag)->needs(height);
}

void check_height_usage(const HeightInput& input, const std::vector<std::string>& files) {
    if (input.path.empty()) return;
    expect_picture(input.path);
    if (files.empty()) throw Error(Refusal::usage, "--height: needs a mesh that the relief is for; name it first");
    for (const std::string& file : files)
        if (!named_like_a_mesh(file))
            throw Error(Refusal::usage, file + ": is no mesh, which --height needs; check the picture separately");
}

} // namespace bake
