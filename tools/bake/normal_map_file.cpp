#include "normal_map_file.h"
#include "bake/picture/texture_file.h"
#include "bake/relief/map/dither.h"
#include "bake/relief/map/normal_mips.h"
#include <algorithm>
#include <bit>
#include <span>

namespace bake {
namespace {

/// (n + 1) / 2
Image<float> as_colours(const Image<float>& normals) {
    Image<float> colours(normals.width(), normals.height(), 3);
    for (std::size_t i = 0; i < colours.size(); ++i) colours.data()[i] = 0.5f * normals.data()[i] + 0.5f;
    return colours;
}

StoredNormalMap write_levels(BlockWriter& out, const std::string& path, std::span<const NormalLevel> mips, Depth depth,
                             bool dither, const Facts& facts) {
    const TexelFormat format = depth == Depth::u8    ? TexelFormat::rgba8
                               : depth == Depth::u16 ? TexelFormat::rgba16
                                                     : TexelFormat::bc5;
    const bool blocks = format == TexelFormat::bc5;
    std::vector<TextureLevel> levels;
    for (const NormalLevel& mip : mips)
        levels.push_back(blocks   ? pack_level(mip.normal, format)
                         : dither ? pack_level(dithered(as_colours(mip.normal)), format)
                                  : pack_level(as_colours(mip.normal), format));
    const TextureContainer container = *texture_container(path);
    write_texture(out, container, format, levels, 1, facts);
    const StoredError error = stored_error(read_back(out, path, container), mips[0].normal);
    out.commit();
    StoredNormalMap stored{int(levels.size()), levels[0].width, levels[0].height, blocks, error, {}};
    if (dither) stored.undithered = stored_error(rounded(as_colours(mips[0].normal)), mips[0].normal);
    return stored;
}

StoredNormalMap dithered_picture(const Image<float>& map, const Image<float>& pattern) {
    Image<float> normals(map.width(), map.height(), 3);
    for (std::size_t i = 0; i < map.size(); ++i) normals.data()[i] = 2 * map.data()[i] - 1;
    return {0, map.width(), map.height(), false, stored_error(pattern, normals), stored_error(rounded(map), normals)};
}

void write_roughness(BlockWriter& out, const std::string& path, std::span<const NormalLevel> mips, double roughness) {
    std::vector<TextureLevel> levels;
    for (const NormalLevel& mip : mips)
        levels.push_back(pack_level(roughness_map(mip, float(roughness)), TexelFormat::r8));
    write_texture(out, *texture_container(path), TexelFormat::r8, levels, 1, {{"content", std::string("roughness")}});
    out.commit();
}

void write_with_alpha(ImageWriter& writer, const Image<float>& map, const Image<float>& alpha) {
    std::vector<float> row(4 * std::size_t(map.width()));
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            std::copy_n(&map.at(x, y), 3, &row[4 * std::size_t(x)]);
            row[4 * std::size_t(x) + 3] = alpha.at(x, y);
        }
        writer.write(row.data(), 1);
    }
}

} // namespace

Facts normal_map_facts(const NormalMapArgs& args, const HeightOptions* relief) {
    Facts facts = {{"content", std::string("normal map")},
                   {"space", std::string(args.space == Space::tangent ? "tangent" : "object")},
                   {"green", std::string(args.directx ? "down" : "up")},
                   {"decode", std::string("2 rgb - 1")},
                   {"range", std::vector<double>{-1, 1}}};
    if (args.space == Space::tangent && !args.mesh.empty()) facts.push_back({"tangents", std::string("MikkTSpace")});
    if (relief) {
        facts.push_back({"amplitude", relief->amplitude});
        facts.push_back({"midlevel", relief->midlevel});
        if (args.height.invert) facts.push_back({"inverted", true}); // with --like no option says so
        facts.push_back({"units", std::string("object units")});
    }
    return facts;
}

std::string to_text(const StoredNormalMap& stored) {
    const StoredError& error = stored.error;
    std::string text = stored.mips > 0 ? format("%d mips; largest level, %d x %d, as it is read back", stored.mips,
                                                stored.width, stored.height)
                                       : "dithered";
    text += format(": mean %.4f, p95 %.4f, max %.4f, rms %.4f deg", error.mean_deg, error.p95_deg, error.max_deg,
                   error.rms_deg);
    if (stored.undithered)
        text += format("; without --dither mean %.4f, max %.4f deg", stored.undithered->mean_deg,
                       stored.undithered->max_deg);
    return text;
}

nlohmann::json to_json(const StoredNormalMap& stored) {
    nlohmann::json out = {{"mips", stored.mips},
                          {"width", stored.width},
                          {"height", stored.height},
                          {"mean_deg", stored.error.mean_deg},
                          {"p95_deg", stored.error.p95_deg},
                          {"max_deg", stored.error.max_deg},
                          {"rms_deg", stored.error.rms_deg}};
    if (stored.undithered)
        out["undithered"] = {{"mean_deg", stored.undithered->mean_deg}, {"max_deg", stored.undithered->max_deg}};
    return out;
}

NormalMapFile::NormalMapFile(const NormalMapArgs& args, int width, int height, Depth depth, const HeightOptions* relief)
    : args_(args), depth_(depth), facts_(normal_map_facts(args, relief)) {
    const int levels = std::bit_width(unsigned(std::max(width, height)));
    if (args.skip_mips >= levels)
        throw Error(Refusal::usage, format("--skip-mips %d: a map of %d x %d has %d levels; leave one of them",
                                           args.skip_mips, width, height, levels));
    if (texture_container(args.out)) texture_.emplace(args.out);
    else if (writes_asset(args)) const OutputFile writable(args.out);
    else {
        WriteOptions options{.depth = depth, .channels = {"R", "G", "B"}, .facts = facts_};
        if (args.high.alpha) options.channels.push_back("A");
        picture_.emplace(args.out, width, height, int(options.channels.size()), options);
    }
    if (!args.roughness_map.empty()) roughness_.emplace(args.roughness_map);
}

std::optional<StoredNormalMap> NormalMapFile::write(const Image<float>& map, const Image<float>& alpha) {
    std::optional<StoredNormalMap> stored;
    if (picture_ || writes_asset(args_)) {
        const Image<float> pattern = args_.dither ? dithered(map) : Image<float>();
        const Image<float>& colours = args_.dither ? pattern : map;
        if (!picture_) asset_map_ = bake::asset_map(GltfMap::Slot::normal, colours, depth_);
        else if (alpha.empty()) picture_->write(colours.data(), map.height());
        else write_with_alpha(*picture_, colours, alpha);
        if (picture_) picture_->finish();
        if (args_.dither) stored = dithered_picture(map, pattern);
    }
    if (!texture_ && !roughness_) return stored;
    const std::vector<NormalLevel> all = normal_mips(map, args_.directx);
    const std::span<const NormalLevel> mips = std::span(all).subspan(std::size_t(args_.skip_mips));
    if (roughness_) write_roughness(*roughness_, args_.roughness_map, mips, args_.roughness);
    if (!texture_) return stored;
    return write_levels(*texture_, args_.out, mips, depth_, args_.dither, facts_);
}

} // namespace bake
