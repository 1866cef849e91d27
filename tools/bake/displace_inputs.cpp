// The inputs of displace() that follow from the options.
#include "bake/relief/height/vector_height.h"
#include "camera_options.h"
#include "displace_options.h"
#include <algorithm>

namespace bake {

BaseSurface make_base(const DisplaceArgs& args) {
    BaseSurface surface = read_surface(args.surface, args.cells.value_or(std::pair(0, 0)));
    const std::vector<std::uint32_t>& uvs = surface.mesh().corner_uv;
    if (std::count(uvs.begin(), uvs.end(), no_index) == std::int64_t(uvs.size()))
        throw Error(Refusal::unsuitable,
                    args.surface.mesh + ": has no uvs, which say where the height lies; unwrap the mesh first");
    return surface;
}

ReliefFile load_relief(const DisplaceArgs& args, double size, const CommonArgs& common) {
    ReliefFile file;
    ImageInfo info;
    if (args.vector) {
        file.relief.values = read_vector_height(args.height.path, &info);
        print_notes(common, args.height.path, info);
        file.described = std::string(name(info.type)) + " vectors, " +
                         (*args.vector == VectorSpace::tangent ? "tangent" : "object") + " space";
    } else {
        HeightTexture height = load_height(args.height, common);
        file.notes = note_doubts(common, args.height, height);
        info = height.info;
        file.described = describe_levels(height);
        file.relief.values = std::move(height.values);
    }
    const Whole whole = diagonal_of(size);
    file.relief.height = height_options(args.height, info, whole);
    file.amplitude_note = default_amplitude_note(args.height, info, file.relief.height, whole);
    check_steepness(args.height, file.relief.height.amplitude, size);
    file.relief.interpolation = args.interpolation;
    file.relief.vector = args.vector;
    return file;
}

bool keeps_faces(const DisplaceArgs& args) {
    return args.surface.shape.empty() &&
           (args.kind == BaseKind::none || (args.kind == BaseKind::linear && args.levels == 0));
}

DisplaceOptions resolve_options(const DisplaceArgs& args, double size, const Vec3d& origin) {
    DisplaceOptions options;
    options.seam = args.seam;
    options.measure_error = args.measure || args.max_error;
    options.margin = args.margin;
    options.attributes = args.surface.reading.pieces; // also where faces stay: those without area do not
    const bool as_it_is = args.surface.shape.empty() && args.kind == BaseKind::none;
    options.rates.levels = args.levels.value_or(as_it_is ? 0 : default_levels);
    if (args.max_error) {
        options.rates.rule = Rates::Rule::error;
        options.rates.error = args.max_error->in_units(size);
    }
    if (args.edge_px) {
        options.rates.rule = Rates::Rule::edge_size;
        options.rates.size = *args.edge_px;
        SceneCamera camera = parse_camera("--camera", args.camera);
        camera.frame.position = Vec3f(Vec3d(camera.frame.position) - origin);
        options.rates.measure = [camera](const Vec3d& a, const Vec3d& b) {
            return pixels_at_most(camera.frame, 0.5 * (a + b), glm::length(b - a), camera.height);
        };
    }
    return options;
}

} // namespace bake
