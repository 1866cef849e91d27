#include "displace_options.h"
#include "bake/relief/height/vector_height.h"
#include "camera_options.h"
#include <cctype>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

/// The input with the scheme that --subdivide names.
SurfaceInput surface_input(const DisplaceArgs& args) {
    SurfaceInput input = args.surface;
    if (args.kind == BaseKind::catmark) input.scheme = Scheme::catmark;
    if (args.kind == BaseKind::loop) input.scheme = Scheme::loop;
    return input;
}

bool has_rates(const DisplaceArgs& args) { return args.levels || !args.edge_px.empty() || !args.max_error.empty(); }

BaseKind resolve_kind(const DisplaceArgs& args) {
    if (args.kind != BaseKind::automatic) return args.kind;
    return has_rates(args) ? BaseKind::linear : BaseKind::none;
}

int resolve_levels(const DisplaceArgs& args) {
    const bool as_it_is = args.surface.shape.empty() && resolve_kind(args) == BaseKind::none;
    return args.levels.value_or(as_it_is ? 0 : default_levels);
}

/// A height or a vector at every texel.
Image<float> read_vectors(const DisplaceArgs& args, ImageInfo& info, std::string& described) {
    Image<float> vectors = read_vector_height(args.height.path, &info);
    described = std::string(name(info.type)) + " vectors, " +
                (*args.vector == VectorSpace::tangent ? "tangent" : "object") + " space";
    return vectors;
}

} // namespace

void add_displace_options(CLI::App& sub, DisplaceArgs& args) {
    add_surface_input(sub, args.surface);
    sub.add_option("--height", args.height.path,
                   "Height picture; values are taken as they are stored, never sRGB-decoded")
        ->required()
        ->check(not_empty());
    sub.add_option("-o,--out", args.out, "Mesh to write: .obj, .ply, .glb or .gltf")->required()->check(not_empty());
    sub.add_option(
           "--amplitude", args.amplitude,
           "Height of white above black: object units, or 1% of the bounding box's diagonal [1%; 1 for float files]")
        ->check(not_empty());
    sub.add_option("--midlevel", args.midlevel, "Value that lies on the surface [0.5; 0 for float files of vectors]");
    add_choice<BaseKind>(sub, "--subdivide", args.kind,
                         {{"auto", BaseKind::automatic},
                          {"none", BaseKind::none},
                          {"linear", BaseKind::linear},
                          {"catmark", BaseKind::catmark},
                          {"loop", BaseKind::loop}},
                         "What is displaced: the mesh as it is, its faces cut finer, or the limit of Catmull-Clark or "
                         "Loop; auto: none, or linear once a rate is given");
    sub.add_option("--levels", args.levels, "Every edge is cut into 2^N [3; 0 for the mesh as it is]")
        ->check(CLI::Range(0, 10))
        ->type_name("N");
    sub.add_option("--edge-px", args.edge_px, "Edges no longer than P pixels in the picture of --camera")
        ->check(not_empty())
        ->type_name("P");
    sub.add_option("--camera", args.camera, "Scene file, or position=0,1,5:target=0,0,0:fov-deg=40:height=1080")
        ->check(not_empty());
    sub.add_option("--max-error", args.max_error,
                   "Cut where it needs to be, to stay within E of the displaced surface: object units or 0.1%")
        ->check(not_empty())
        ->type_name("E");
    add_choice<Seam>(sub, "--seam", args.seam,
                     {{"average", Seam::average}, {"owner", Seam::owner}, {"blend", Seam::blend}},
                     "Height of a point on a uv seam: the mean of its sides, that of the first face, or the mean with "
                     "both sides led to it");
    sub.add_option_function<std::string>(
           "--vector",
           [&args](const std::string& space) {
               args.vector = space == "tangent" ? VectorSpace::tangent : VectorSpace::object;
           },
           "Displace by three channels instead of one: along T, B, n or along x, y, z")
        ->check(one_of({"tangent", "object"}))
        ->type_name("tangent|object");
    add_height_reading_options(sub, args.height);
    add_choice<Interpolation>(
        sub, "--interpolation", args.interpolation,
        {{"bilinear", Interpolation::bilinear}, {"catmull-rom", Interpolation::catmull_rom}, {"c2", Interpolation::c2}},
        "Between texels; c2: cubic spline, smooth to the second derivative");
    sub.add_flag("--measure", args.measure, "Measure the distance of the result from the displaced surface");
    sub.add_flag("--margin", args.margin, "Write the fold margin, smallest 1 + b a, as an attribute (fold_margin)");
    sub.add_flag("--audit", args.audit, "Test the result for self-intersections and orientation, exactly (slow)");
    sub.add_option("--max-memory", args.max_memory,
                   "Refuse what needs more, such as 2G; unless given, what the machine has")
        ->check(not_empty())
        ->type_name("SIZE");
}

void check_usage(const DisplaceArgs& args) {
    check_usage(surface_input(args), "displace");
    if (mesh_format(args.out) == MeshFormat::unknown)
        throw usage("--out " + args.out + ": is not a mesh format known here; use .obj, .ply, .glb or .gltf");
    if (args.margin && mesh_format(args.out) == MeshFormat::obj)
        throw usage("--margin: .obj has no place for attributes; write .ply or .glb");
    if (!args.surface.shape.empty() && args.kind != BaseKind::automatic)
        throw usage("--subdivide: a shape is smooth already; leave it out with --shape");
    if (args.levels.has_value() + !args.edge_px.empty() + !args.max_error.empty() > 1)
        throw usage("--levels, --edge-px, --max-error: are three ways to say how fine; give one");
    if (args.kind == BaseKind::none &&
        (args.levels.value_or(0) > 0 || !args.edge_px.empty() || !args.max_error.empty()))
        throw usage("--subdivide none: leaves the faces as they are; take linear to cut them finer, catmark or loop "
                    "for the limit surface");
    if (args.edge_px.empty() != args.camera.empty())
        throw usage(args.camera.empty() ? "--edge-px: needs the --camera whose pixels they are"
                                        : "--camera: is for --edge-px; give both or none");
    if (!args.edge_px.empty()) {
        const auto pixels = parse_number(args.edge_px);
        if (!pixels || !(*pixels >= 0.01) || *pixels > 1e6)
            throw usage("--edge-px " + args.edge_px + ": is not a length in pixels; write 0.01 to 1e6, such as 2");
    }
    if (args.vector && (args.height.grey != Grey::mean || args.height.invert || args.height.dequantise))
        throw usage("--vector: takes three channels as they are; leave out --channel, --invert and --dequantise");
    if (args.midlevel && !(*args.midlevel * 0 == 0)) throw usage("--midlevel: is not a finite number; write 0.5");
    if (!args.amplitude.empty()) parse_amplitude(args.amplitude);
    if (!args.max_error.empty()) parse_length("--max-error", args.max_error);
    if (!args.max_memory.empty()) parse_bytes("--max-memory", args.max_memory);
}

BaseSurface make_base(const DisplaceArgs& args) {
    BaseSurface surface = read_surface(surface_input(args));
    if (surface.mesh().corner_uv.empty())
        throw Error(Refusal::unsuitable,
                    args.surface.mesh + ": has no uvs, which say where the height lies; unwrap the mesh first");
    return surface;
}

ReliefFile load_relief(const DisplaceArgs& args, double size, const CommonArgs& common) {
    ReliefFile file;
    ImageInfo info;
    if (args.vector) {
        file.relief.values = read_vectors(args, info, file.described);
        print_notes(common, args.height.path, info);
    } else {
        HeightTexture height = load_height(args.height, common);
        info = height.info;
        file.notes = note_doubts(common, args.height, height);
        file.described = describe_levels(height);
        file.relief.values = std::move(height.values);
    }
    const bool floats = info.type == SampleType::half || info.type == SampleType::float32;
    file.default_amplitude = args.amplitude.empty();
    const Amplitude amplitude = file.default_amplitude ? (floats ? Amplitude{1, false} : Amplitude{0.01, true})
                                                       : parse_amplitude(args.amplitude);
    file.relief.height = {.amplitude = amplitude.value * (amplitude.percent ? size : 1),
                          .midlevel = args.midlevel.value_or(args.vector && floats ? 0 : 0.5),
                          .wrap_u = args.height.wrap_u(),
                          .wrap_v = args.height.wrap_v()};
    check_steepness(file.default_amplitude ? "1" : args.amplitude, file.relief.height.amplitude, size);
    file.relief.interpolation = args.interpolation;
    file.relief.vector = args.vector;
    return file;
}

DisplaceOptions resolve_options(const DisplaceArgs& args, double size, const Vec3d& origin) {
    DisplaceOptions options;
    options.seam = args.seam;
    options.measure_error = args.measure || !args.max_error.empty();
    options.margin = args.margin;
    if (!args.max_memory.empty()) options.max_bytes = parse_bytes("--max-memory", args.max_memory);
    options.rates.levels = resolve_levels(args);
    if (!args.max_error.empty()) {
        const Amplitude error = parse_length("--max-error", args.max_error);
        options.rates.rule = Rates::Rule::error;
        options.rates.error = error.value * (error.percent ? size : 1);
    }
    if (!args.edge_px.empty()) {
        options.rates.rule = Rates::Rule::edge_size;
        options.rates.size = *parse_number(args.edge_px);
        auto camera = parse_camera("--camera", args.camera);
        camera.frame.position = Vec3f(Vec3d(camera.frame.position) - origin);
        options.rates.measure = [camera](const Vec3d& a, const Vec3d& b) {
            return pixels_at_most(camera.frame, 0.5 * (a + b), glm::length(b - a), camera.height);
        };
    }
    return options;
}

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
    const std::size_t end = text.find_last_of("0123456789.");
    const double value = end == std::string::npos ? -1 : parse_number(text.substr(0, end + 1)).value_or(-1);
    std::string unit = end == std::string::npos ? "" : text.substr(end + 1);
    for (char& c : unit) c = char(std::toupper(static_cast<unsigned char>(c)));
    const std::string letters = "KMGT";
    const std::size_t power = unit.empty() ? std::string::npos : letters.find(unit[0]);
    const std::string rest = unit.empty() || power == std::string::npos ? unit : unit.substr(1);
    const bool known = rest.empty() || rest == "B" || (rest == "IB" && power != std::string::npos);
    const double bytes = known ? value * std::exp2(power == std::string::npos ? 0 : 10.0 * double(power + 1)) : -1;
    if (!(bytes >= 1) || bytes > 1e18)
        throw usage(flag + " " + text + ": is not a size; write bytes, or such as 500M or 2G");
    return std::uint64_t(bytes);
}

std::string describe_bytes(double bytes) {
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    int unit = 0;
    while (bytes >= 1024 && unit < 4) bytes /= 1024, ++unit;
    return format(unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
}

} // namespace bake
