#include "bake/verdict/plan/manifest.h"
#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "bake/preview/shape_mesh.h"
#include "bake/surface/analytic/parametric.h"
#include "bake/verdict/plan/folder_from.h"
#include "bake/verdict/plan/manifest_high.h"
#include "bake/verdict/plan/manifest_sky.h"
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/planned_scene.h"
#include "bake/verdict/plan/texture_plan.h"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>

namespace bake {
namespace {

namespace fs = std::filesystem;

/// The shortest text that is read as the same number.
template <class T> std::string text_of(T value) {
    char text[64];
    return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

bool is_cube(const std::string& shape) { return shape == "cube" || shape.starts_with("cube:"); }

bool bakes_table(Shade shade) { return shade == Shade::bump || shade == Shade::bump_roughness; }
bool bakes_map(Shade shade) { return shade == Shade::normal || shade == Shade::displace_normal; }

class Lister {
public:
    Lister(const SceneEntries& entries, const ScenePlan& plan, const std::string& out)
        : entries_(entries), plan_(plan) {
        // Absolute paths in the entries are the user's own, unless the scene itself was named so.
        const fs::path file(entries.file);
        moves_ = !file.is_absolute();
        folder_ = folder_from(moves_ ? "here" : entries.file, out);
    }

    void add(const std::string& object, int mesh, const ShadeMethod& method);
    void add(const SkyPlan& sky);
    void add(const TexturePlan& texture);
    Manifest take() { return std::move(manifest_); }

private:
    struct Job {
        const std::string& object;
        const MeshEntry& mesh;
        const ReliefEntry& relief;
        ShadeMethod method;
        const TexturePlan* map; ///< of what is baked; null: not decided
    };
    std::string path(const std::string& file) const;
    std::string shape(const MeshEntry& mesh) const { return shape_beside((folder_ / "manifest").string(), mesh.shape); }
    std::string add(Bake bake, const std::string& object, const std::string& ending);
    std::string output_of(const std::string& bake) const;
    const char* obstacle(const Job& job) const;
    ImageInfo height_info(const ReliefEntry& relief) const;
    std::string amplitude(const Job& job, bool of_mesh);
    int halvings(const Job& job) const;
    void height_options(const Job& job, Bake& bake, bool of_mesh);
    void mesh_options(const MeshEntry& mesh, Bake& bake) const;
    void table(const Job& job);
    std::string displaced(const Job& job);
    void normals(const Job& job, const std::string& displaced);
    void detail(const std::string& object, const MeshEntry& mesh, const TexturePlan* map);
    void note_missing(const std::string& object, const ShadeMethod& method, const char* why);
    std::string shape_file(const Job& job, Bake& bake);

    const SceneEntries& entries_;
    const ScenePlan& plan_;
    fs::path folder_;
    bool moves_ = true;
    Manifest manifest_;
    std::set<std::string> names_;
};

/// As the manifest calls a file of the scene.
std::string Lister::path(const std::string& file) const {
    if (fs::path(file).is_relative()) return (folder_ / file).lexically_normal().generic_string();
    if (moves_) return file;
    const fs::path from_scene = fs::path(file).lexically_relative(fs::path(entries_.file).parent_path());
    return (folder_ / from_scene).lexically_normal().generic_string();
}

/// A bake that is there already serves the object too. Names the bake and its output by the object. Returns the name.
std::string Lister::add(Bake bake, const std::string& object, const std::string& ending) {
    for (Bake& known : manifest_.bakes) {
        if (known.verb != bake.verb || known.files != bake.files || known.inputs != bake.inputs ||
            known.options != bake.options || known.use != bake.use)
            continue;
        if (std::find(known.objects.begin(), known.objects.end(), object) == known.objects.end())
            known.objects.push_back(object);
        return known.name;
    }
    std::string stem;
    for (const char c : object) stem += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    const std::size_t dot = ending.find('.');
    const std::string first = stem + "_" + ending.substr(0, dot);
    bake.name = first;
    for (int number = 2; !names_.insert(bake.name).second; ++number) bake.name = first + "_" + std::to_string(number);
    bake.outputs.emplace_back("out", bake.name + ending.substr(dot));
    bake.objects.push_back(object);
    manifest_.bakes.push_back(std::move(bake));
    return manifest_.bakes.back().name;
}

std::string Lister::output_of(const std::string& bake) const {
    for (const Bake& known : manifest_.bakes)
        if (known.name == bake) return known.outputs.front().second;
    return {};
}

/// Why no command bakes what the tracer does; null if one does.
const char* Lister::obstacle(const Job& job) const {
    const MeshEntry& mesh = job.mesh;
    const Shade shade = job.method.shade;
    const Vec2f repeat = mesh.repeat * entries_.materials[std::size_t(mesh.material)].repeat;
    for (const std::string& file : {job.relief.file, mesh.file, mesh.shape})
        if (file.find_first_of(reserved_in_paths) != std::string::npos) return reserved_path;
    if (bakes_table(shade)) return nullptr;
    if (repeat != Vec2f(1)) return "its uvs repeat, and bake displace and bake normal-map take each texture once";
    if (is_cube(mesh.shape)) return "its shape, a cube, is one of scenes alone; write it as a file";
    if (job.method.levels < 0 && displaces(shade)) return "how fine it is depends on the memory; give segments";
    if (mesh.subdivide && bakes_map(shade) && mesh.columns == 0)
        return "its cage is cut as fine as looks smooth; give the mesh \"segments\"";
    return nullptr;
}

ImageInfo Lister::height_info(const ReliefEntry& relief) const {
    const auto known = entries_.pictures.find(relief.file);
    return known != entries_.pictures.end() ? known->second->info : read_image_info(relief.file);
}

/// From the map that the command bakes, which has the size of the height, to the planned one. The map of the scene may be
/// smaller, by "relief-size".
int Lister::halvings(const Job& job) const {
    const ImageInfo height = height_info(job.relief);
    TexturePlan baked = *job.map;
    baked.source_width = height.width, baked.source_height = height.height;
    return form_of(baked).halvings;
}

/// In object units; empty: that of the command.
std::string Lister::amplitude(const Job& job, bool of_mesh) {
    const ReliefEntry& relief = job.relief;
    if (relief.amplitude && !relief.relative) return text_of(*relief.amplitude);
    if (of_mesh) return relief.amplitude ? text_of(100 * *relief.amplitude) + "%" : "";
    // A table knows no mesh whose size it could be a part of.
    SceneEntries one;
    one.file = entries_.file;
    one.meshes = {job.mesh};
    one.meshes[0].material = -1, one.meshes[0].own_materials = false, one.meshes[0].placement = {};
    one.any_light = true;
    const double size = diagonal(bounds(load(one)));
    return text_of(float(relief_options(relief, height_info(relief), size).height.amplitude));
}

void Lister::height_options(const Job& job, Bake& bake, bool of_mesh) {
    const ReliefEntry& relief = job.relief;
    if (const std::string value = amplitude(job, of_mesh); !value.empty())
        bake.options.emplace_back("amplitude", value);
    if (of_mesh && relief.midlevel) bake.options.emplace_back("midlevel", text_of(*relief.midlevel));
    if (relief.wrap != Wrap::repeat) bake.options.emplace_back("wrap", relief.wrap == Wrap::clamp ? "clamp" : "mirror");
    if (relief.filter != Filter::automatic && bake.verb != "displace")
        bake.options.emplace_back("filter", std::string(name(relief.filter)));
}

void Lister::mesh_options(const MeshEntry& mesh, Bake& bake) const {
    if (mesh.flip_v) bake.options.emplace_back("flip-v", "");
    if (mesh.uv_set >= 0) bake.options.emplace_back("uv-set", std::to_string(mesh.uv_set));
    if (mesh.subdivide) bake.options.emplace_back("subdivide", *mesh.subdivide == Scheme::loop ? "loop" : "catmark");
}

void Lister::table(const Job& job) {
    Bake bake{.verb = "bump-table", .files = {path(job.relief.file)}, .use = "bump"};
    height_options(job, bake, false);
    const bool integers = job.map && !job.map->half;
    if (integers) bake.options.emplace_back("depth", "16");
    add(std::move(bake), job.object, integers ? "bump.png" : "bump.exr");
}

/// Returns the name of the bake.
std::string Lister::displaced(const Job& job) {
    Bake bake{.verb = "displace", .inputs = {{"height", path(job.relief.file)}}, .use = "file"};
    if (job.mesh.shape.empty()) bake.files = {path(job.mesh.file)};
    else bake.options.emplace_back("shape", shape(job.mesh));
    if (!job.mesh.shape.empty() && job.mesh.columns > 0)
        bake.options.emplace_back("resolution", std::to_string(job.mesh.columns) + "x" + std::to_string(job.mesh.rows));
    mesh_options(job.mesh, bake);
    bake.options.emplace_back("levels", std::to_string(job.method.levels));
    if (job.method.shade == Shade::displace_normal) bake.options.emplace_back("seam", "average");
    height_options(job, bake, true);
    return add(std::move(bake), job.object, "displaced.glb");
}

/// The mesh that shows a shape or a cage as a file. Adds its bake, if there is one, to what `bake` needs.
std::string Lister::shape_file(const Job& job, Bake& bake) {
    const MeshEntry& mesh = job.mesh;
    if (mesh.shape.empty() && !mesh.subdivide) return path(mesh.file);
    Bake surface{.verb = "surface"};
    std::pair<int, int> cells = {mesh.columns, mesh.rows};
    if (mesh.shape.empty()) {
        surface.files = {path(mesh.file)};
        mesh_options(mesh, surface);
        cells.second = cells.first;
    } else {
        surface.options.emplace_back("shape", shape(mesh));
        if (cells.first == 0) cells = ParametricSurface(mesh.shape).default_resolution();
    }
    const std::string along = std::to_string(cells.first);
    surface.options.emplace_back("resolution", mesh.subdivide ? along : along + "x" + std::to_string(cells.second));
    bake.after.push_back(add(std::move(surface), job.object, "surface.glb"));
    return output_of(bake.after.back());
}

/// `displaced`: the bake of the mesh that the map is relative to; empty: none.
void Lister::normals(const Job& job, const std::string& displaced) {
    Bake bake{.verb = "normal-map", .inputs = {{"height", path(job.relief.file)}}, .use = "normal"};
    bake.files = {shape_file(job, bake)};
    if (bake.after.empty()) mesh_options(job.mesh, bake);
    height_options(job, bake, true);
    const bool bc5 = job.map && job.map->bits == bc5_bits;
    if (bc5) {
        bake.options.emplace_back("depth", "bc5");
        if (const int skipped = halvings(job); skipped > 0)
            bake.options.emplace_back("skip-mips", std::to_string(skipped));
    }
    if (job.map && job.map->bits == 8) bake.options.emplace_back("depth", "8");
    if (!displaced.empty()) {
        bake.inputs.emplace_back("residual-of", output_of(displaced));
        bake.after.push_back(displaced);
    }
    const std::string kind = displaced.empty() ? "normal" : "detail";
    add(std::move(bake), job.object, kind + (bc5 ? ".ktx2" : ".png"));
}

void Lister::detail(const std::string& object, const MeshEntry& mesh, const TexturePlan* map) {
    for (const std::string& file : {mesh.file, mesh.high.file})
        if (file.find_first_of(reserved_in_paths) != std::string::npos)
            return note_missing(object, {Shade::normal}, reserved_path);
    Bake bake = high_bake(mesh.high, path(mesh.file), path(mesh.high.file), map);
    mesh_options(mesh, bake);
    add(std::move(bake), object, high_ending(mesh.high, map));
}

void Lister::note_missing(const std::string& object, const ShadeMethod& method, const char* why) {
    const std::string line = object + ": no command bakes its " + bake::name(method) + ": " + why;
    if (std::find(manifest_.notes.begin(), manifest_.notes.end(), line) == manifest_.notes.end())
        manifest_.notes.push_back(line);
}

void Lister::add(const std::string& object, int index, const ShadeMethod& method) {
    const MeshEntry& mesh = entries_.meshes[std::size_t(index)];
    const TexturePlan* map = nullptr;
    for (const TexturePlan& texture : plan_.textures)
        if (std::find(texture.meshes.begin(), texture.meshes.end(), index) != texture.meshes.end()) map = &texture;
    if (!mesh.high.file.empty()) {
        if (method.shade == Shade::normal) detail(object, mesh, map);
        return;
    }
    const Job job{object, mesh, entries_.materials[std::size_t(mesh.material)].relief, method, map};
    const Shade shade = method.shade;
    if (!bakes_table(shade) && !bakes_map(shade) && !displaces(shade)) return;
    if (const char* why = obstacle(job)) return note_missing(object, method, why);
    if (bakes_table(shade)) return table(job);
    const std::string mesh_bake = displaces(shade) ? displaced(job) : std::string();
    if (bakes_map(shade)) normals(job, mesh_bake);
}

/// Files of normals are not baked again: what no command makes of them is told.
void Lister::add(const TexturePlan& texture) {
    if (texture.materials.empty() || map_form(texture).depth != NormalDepth::bc5) return;
    manifest_.notes.push_back(path(texture.file) +
                              ": no command stores a file of normals in BC5; bake it anew to .ktx2, or leave "
                              "\"normal-depth\" in the scene, which shows it so");
}

void Lister::add(const SkyPlan& sky) {
    if (sky.model == "faces" && sky.face >= sky.source_face) return;
    if (const char* why = sky_obstacle(entries_.sky, sky)) {
        const std::string what = sky.model == "faces"      ? "smaller faces"
                                 : sky.model == "constant" ? "mean"
                                                           : "harmonics";
        manifest_.notes.push_back("sky: no command bakes its " + what + ": " + why);
        return;
    }
    Bake bake = sky_bake(entries_.sky, sky, [&](const std::string& file) { return path(file); });
    bake.name = "sky_" + std::to_string(sky.face);
    while (!names_.insert(bake.name).second) bake.name += "_sky"; // an object has the name
    bake.outputs.emplace_back("out", bake.name + "_%s.exr");
    manifest_.bakes.push_back(std::move(bake));
}

} // namespace

Manifest plan_manifest(const SceneEntries& entries, const ScenePlan& plan, const std::string& out) {
    Lister lister(entries, plan, out);
    for (const ObjectPlan& object : plan.objects)
        for (const int mesh : object.meshes) {
            const MeshEntry& entry = entries.meshes[std::size_t(mesh)];
            const auto method = planned_method(plan, mesh);
            if ((entry.material >= 0 || !entry.high.file.empty()) && method) lister.add(object.object, mesh, *method);
        }
    for (const TexturePlan& texture : plan.textures) {
        lister.add(texture);
        for (const int mesh : texture.meshes) { // whose models are those of the scene
            const MeshEntry& entry = entries.meshes[std::size_t(mesh)];
            const auto shade = entry.high.file.empty() ? entries.materials[std::size_t(entry.material)].relief.shade
                                                       : ShadeMethod{entry.high.shade};
            if (!planned_method(plan, mesh) && shade) lister.add(texture.file, mesh, *shade);
        }
    }
    if (plan.sky) lister.add(*plan.sky);
    return lister.take();
}

std::vector<std::string> command_of(const Bake& bake) {
    std::vector<std::string> words = {bake.verb};
    for (const std::string& file : bake.files)
        words.push_back(file.starts_with('-') ? "./" + file : file); // else it would be an option
    for (const Bake::Values* values : {&bake.inputs, &bake.options, &bake.outputs})
        for (const auto& [option, value] : *values)
            words.push_back("--" + option + (value.empty() ? "" : "=" + value)); // a value may begin with a dash
    return words;
}

} // namespace bake
