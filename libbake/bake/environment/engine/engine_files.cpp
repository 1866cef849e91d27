#include "bake/environment/engine/engine_files.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/environment/engine/dfg.h"
#include "bake/environment/engine/encoding_error.h"
#include "bake/picture/ktx1_writer.h"
#include "bake/picture/rgb9e5.h"
#include "bake/picture/texture_file.h"

namespace bake {
namespace {

constexpr int dfg_size = 128;

float largest_of(TexelFormat texels) noexcept { return texels == TexelFormat::rgb9e5 ? rgb9e5_largest : 65504; }

std::vector<TextureLevel> packed(std::span<const Cube> levels, TexelFormat texels) {
    std::vector<TextureLevel> out;
    for (const Cube& cube : levels) {
        TextureLevel level{cube.size(), cube.size()};
        for (const Image<float>& face : cube.faces) level.bytes += pack_level(face, texels).bytes;
        out.push_back(std::move(level));
    }
    return out;
}

EngineFile write_cube(const std::string& path, const char* what, std::span<const Cube> levels,
                      const EngineOptions& options, const ShCoefficients& sh) {
    const LevelsRule& rule = *entry_of(options.consumer).levels;
    EngineFile file{path, what, levels[0].size(), int(levels.size()), options.texels.value_or(rule.texels)};
    std::vector<Cube> turned;
    if (rule.mirrored)
        for (const Cube& level : levels) turned.push_back(mirrored_x(level));
    const std::span<const Cube> stored = rule.mirrored ? std::span<const Cube>(turned) : levels;
    const std::vector<TextureLevel> bytes = packed(stored, file.texels);
    BlockWriter out(path);
    std::vector<Image<float>> read;
    if (const auto container = texture_container(path)) {
        write_texture(out, *container, file.texels, bytes, 6);
        read = read_back_levels(out, path, *container);
    } else {
        write_ktx1_cube(out, bytes, {{"sh", to_text(sh)}});
        for (const TextureLevel& level : bytes) read.push_back(halves_of(level, 6));
    }
    file.error = encoding_error(stored, read, largest_of(file.texels));
    file.bytes = out.bytes();
    out.commit();
    return file;
}

EngineFile write_dfg(const std::string& path) {
    BlockWriter out(path);
    write_texture(out, *texture_container(path), TexelFormat::rg16f,
                  {pack_level(dfg_table(dfg_size), TexelFormat::rg16f)});
    EngineFile file{path, "dfg", dfg_size, 1, TexelFormat::rg16f, out.bytes(), {}};
    out.commit();
    return file;
}

} // namespace

const char* name(TexelFormat texels) noexcept {
    switch (texels) {
    case TexelFormat::rgb9e5: return "rgb9e5";
    case TexelFormat::bc6h: return "bc6h";
    default: return "half";
    }
}

bool is_latlong_file(const std::string& path) { return ending(path) == ".hdr" || ending(path) == ".exr"; }

void check_engine_file(const std::string& path, const EngineOptions& options) {
    const ConsumerEntry& consumer = entry_of(options.consumer);
    const std::string end = ending(path);
    const auto refuse = [&](const std::string& why) { throw Error(Refusal::usage, path + ": " + why); };
    if (consumer.latlong && is_latlong_file(path)) return;
    if (!consumer.levels) refuse(std::string(consumer.name) + " takes a lat-long picture; write .hdr or .exr");
    const bool filament = options.consumer == Consumer::filament;
    if (end != ".dds" && end != ".ktx2" && !(end == ".ktx" && filament))
        refuse(std::string("is no cube map for ") + consumer.name + "; write " + (filament ? ".ktx" : ".dds or .ktx2") +
               (consumer.latlong ? ", .hdr or .exr for a lat-long," : ",") + " or a folder");
    if (end == ".ktx" && options.texels.value_or(TexelFormat::rgba16f) != TexelFormat::rgba16f)
        refuse("holds half floats; leave out `texels`");
}

std::vector<EngineFile> write_engine_files(const EngineLevels& made, const EngineOptions& options,
                                           const std::string& ending,
                                           const std::function<std::string(const std::string&)>& path) {
    std::vector<EngineFile> files;
    const auto write = [&](const std::string& stem, const char* what, std::span<const Cube> levels) {
        files.push_back(write_cube(path(stem + ending), what, levels, options, made.sh));
    };
    if (options.levels_as_files)
        for (std::size_t k = 0; k < made.levels.size(); ++k)
            write("environment_" + std::to_string(k), "environment", {&made.levels[k], 1});
    else write("environment", "environment", made.levels);
    if (!options.whole_set) return files;
    write("skybox", "skybox", made.skybox);
    write("irradiance", "irradiance", {&made.irradiance, 1});
    files.push_back(write_dfg(path(std::string("dfg") + (ending == ".dds" ? ".dds" : ".ktx2"))));
    files.push_back({.path = path("sh.txt"), .what = "sh", .bytes = std::int64_t(to_text(made.sh).size())});
    write_sh_text(files.back().path, made.sh);
    return files;
}

} // namespace bake
