#include "cubemap_options.h"
#include "cubemap_engine.h"
#include "inputs/file_kind.h"
#include "options.h"
#include <cmath>
#include <sstream>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

std::vector<double> parse_numbers(const std::string& flag, const std::string& text) {
    std::vector<double> values;
    std::istringstream parts(text + ",");
    for (std::string part; std::getline(parts, part, ',');) {
        const auto value = parse_number(part);
        if (!value) throw usage(flag + " " + text + ": is not a list of numbers; write such as 0.1,0.5,1");
        values.push_back(*value);
    }
    return values;
}

/// "sh:3", "sh:9" or "direct"
IrradianceOptions parse_irradiance(const std::string& text) {
    IrradianceOptions options;
    if (text == "direct") return options;
    const auto bands = text.starts_with("sh:") ? parse_whole_number(text.substr(3)) : std::nullopt;
    if (!bands || *bands < 1 || *bands > 99)
        throw usage("--irradiance " + text + ": is neither direct nor sh:N with N bands; write such as sh:3");
    options.method = IrradianceMethod::sh;
    options.bands = int(*bands);
    return options;
}

Vec3f parse_point(const std::string& text) {
    const std::vector<double> values = parse_numbers("--at", text);
    for (const double value : values)
        if (values.size() != 3 || std::abs(value) > 1e30)
            throw usage("--at " + text + ": is not a point; give three numbers, such as 0,1,0");
    return {float(values[0]), float(values[1]), float(values[2])};
}

std::vector<std::pair<std::string, SkyFormat>> format_names(bool for_writing) {
    std::vector<std::pair<std::string, SkyFormat>> names;
    for (const SkyFormatEntry& entry : sky_formats)
        if (!for_writing || entry.width_per_edge != 0) names.emplace_back(entry.name, entry.format);
    return names;
}

void add_filter_options(CLI::App& sub, CubemapArgs& args) {
    sub.add_flag("--mips", args.mips, "Write a mip chain, weighted by solid angle and filtered across edges");
    sub.add_option("--irradiance", args.irradiance,
                   "Write irradiance instead: sh:N, spherical harmonics of N bands, or direct")
        ->type_name("sh:N|direct");
    add_choice<Specular>(sub, "--specular", args.specular,
                         {{"none", Specular::none}, {"phong", Specular::phong}, {"ggx", Specular::ggx}},
                         "Write levels blurred by a specular lobe instead");
    sub.add_option("--roughness", args.roughness, "Of each level: alpha for ggx, exponent for phong")
        ->type_name("A,B,...");
}

} // namespace

void add_cubemap_options(CLI::App& sub, CubemapArgs& args) {
    sub.add_option("input", args.inputs,
                   "Six faces in any order, a pattern with %s, one image, or labels: the built-in test sky");
    sub.add_option(
           "-o,--out", args.target.file,
           "File to write (.exr, .tif, .png); with %s: six files, named px nx py ny pz nz; with --for also .dds, .ktx2 "
           "or a folder")
        ->required();
    add_choice(sub, "--from", args.reading.from, format_names(false),
               "Format of the input; auto: by its tag or its shape");
    add_choice(sub, "--to", args.target.to, format_names(true),
               "Format to write; auto: faces for a %s, openexr-cube for .exr, else a strip");
    add_integer_option(sub, "--size", args.target.size, 0, 32768,
                       "Texels: the edge of a face, or the width of any other picture; 0: as fine as the input")
        ->default_str(std::to_string(args.target.size));
    add_choice<Samples>(
        sub, "--samples", args.resampling.samples,
        {{"auto", Samples::automatic}, {"1", Samples::one}, {"4x4", Samples::grid4}, {"exact", Samples::exact}},
        "Samples of the input per texel; exact: by overlap of solid angles, no light is lost");
    add_filter_options(sub, args);
    add_engine_options(sub, args);
    add_choice<FaceOrder>(
        sub, "--order", args.target.order, {{"gl", FaceOrder::gl}, {"openexr", FaceOrder::openexr}},
        "Order and rotation of written faces and strips; gl is also Direct3D's, Vulkan's and RenderMan's");
    const auto add_angle = [&](const std::string& flag, double& degrees, const char* help) {
        add_number_option(sub, flag, degrees, -1e6, 1e6, help)->default_str("0");
    };
    add_angle("--yaw", args.yaw, "Turn the sky, degrees: what is ahead moves to the right");
    add_angle("--pitch", args.pitch, "Then what is ahead moves up");
    add_angle("--roll", args.roll, "Then the picture ahead turns clockwise");
    sub.add_flag("--fix-orientation", args.reading.fix_orientation,
                 "Turn, swap or mirror faces so that their seams match");
    add_choice<BadPolicy>(sub, "--bad", args.target.bad,
                          {{"refuse", BadPolicy::refuse}, {"zero", BadPolicy::zero}, {"clamp", BadPolicy::clamp}},
                          "NaN, infinite and negative texels, and with --depth half those too bright for it");
    CLI::Option* const linear = sub.add_flag(
        "--linear", args.linear, "Input is linear, whatever its tags say; 8- and 16-bit output then is too");
    sub.add_flag("--srgb", args.srgb,
                 "Input is sRGB-encoded, whatever its tags say; without either: by its tags, untagged 8 bits are sRGB")
        ->excludes(linear);
    sub.add_option("--capture", args.capture, "Scene (TOML) to capture instead of reading an input, with --at");
    sub.add_option("--at", args.at, "Point to look from, in world space")->type_name("X,Y,Z");
    add_choice<Depth>(sub, "--depth", args.target.depth,
                      {{"auto", Depth::automatic},
                       {"8", Depth::u8},
                       {"16", Depth::u16},
                       {"half", Depth::half},
                       {"float", Depth::float32}},
                      "auto: half for .exr (float for radiance above 65504), float for .tif, 8 for .png from 8-bit "
                      "input, else 16");
}

void check_cubemap_options(CubemapArgs& args) {
    const bool specular = args.specular != Specular::none;
    if (!args.irradiance.empty() && specular)
        throw usage("--irradiance: and --specular are two bakes; run one after the other");
    if (specular && args.roughness.empty())
        throw usage("--specular: needs --roughness, one for each level, such as 0,0.1,0.3,0.6,1");
    if (!specular && !args.roughness.empty()) throw usage("--roughness: is for --specular ggx or phong; add it");
    if ((specular || !args.irradiance.empty()) && args.mips)
        throw usage("--mips: gives the plain chain; --specular writes its own levels, --irradiance has one");
    if (!args.capture.empty() && !args.inputs.empty())
        throw usage(args.inputs[0] + ": is an input, but --capture makes the sky from a scene; give one of the two");
    if (args.capture.empty() && args.inputs.empty())
        throw usage("no input: give six faces, a pattern with %s, one image, labels, or --capture scene.toml");
    if (args.capture.empty() != args.at.empty())
        throw usage(args.at.empty() ? "--capture: needs --at x,y,z, the point to look from"
                                    : "--at: is for --capture; add a scene");
    check_engine_options(args);
    for (const std::string& input : args.inputs) expect_picture(input);
    if (!args.capture.empty()) expect_scene(args.capture);
    if (!args.at.empty()) args.position = parse_point(args.at);
    if (!args.irradiance.empty()) args.wanted_irradiance = parse_irradiance(args.irradiance);
    if (specular)
        args.wanted_specular = {.lobe = args.specular == Specular::ggx ? SpecularLobe::ggx : SpecularLobe::phong,
                                .roughness = parse_numbers("--roughness", args.roughness)};
    args.resampling.turn = turn_of(args.yaw, args.pitch, args.roll);
    args.reading.space = args.linear ? ColourSpace::linear : args.srgb ? ColourSpace::srgb : ColourSpace::automatic;
    args.reading.bad = args.target.bad;
    args.target.encode_srgb = !args.linear;
}

} // namespace bake
