#include "bake/verdict/inspect.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <array>
#include <cctype>

namespace bake {
namespace {

/// read_mesh() and, for glTF files, the content besides the mesh.
Mesh read_parts(const std::string& path, const InspectOptions& options, std::optional<GltfParts>& parts) {
    if (mesh_format(path) != MeshFormat::gltf) return read_mesh(path, options.read);
    Gltf gltf = read_gltf(path, {.flip_v = !options.read.flip_v});
    take_texture_uvs(gltf, path, {.uv_set = options.read.uv_set, .flip_v = !options.read.flip_v});
    parts.emplace();
    parts->nodes = gltf.nodes.size();
    parts->images = gltf.images.size();
    for (const GltfImage& image : gltf.images) parts->missing_images += image.bytes.empty() ? 1 : 0;
    for (const GltfMaterial& material : gltf.materials) parts->normal_textures += material.normal ? 1 : 0;
    parts->tangents = !gltf.mesh.tangents.empty();
    parts->notes = gltf.notes;
    return flatten(std::move(gltf));
}

/// The grey as an option of a bake; empty for the default.
std::string option_name(Grey grey) {
    switch (grey) {
    case Grey::r: return "r";
    case Grey::g: return "g";
    case Grey::b: return "b";
    case Grey::a: return "a";
    case Grey::luma: return "luma";
    case Grey::mean: break;
    }
    return "";
}

} // namespace

bool named_like_a_mesh(const std::string& path) {
    constexpr std::array<const char*, 9> endings = {".obj",  ".ply", ".off", ".stl", ".fbx",
                                                    ".gltf", ".glb", ".usd", ".abc"};
    return std::find(endings.begin(), endings.end(), ending(path)) != endings.end();
}

MeshReport inspect_mesh(const std::string& path, const InspectOptions& options) {
    MeshReport report;
    report.file = path;
    const Mesh mesh = read_parts(path, options, report.gltf);
    const std::vector<Triangle> triangles = triangulate(mesh);
    report.check = check_mesh(mesh, triangles, options.mesh);
    report.uv = check_uvs(mesh, triangles, options.uv);
    report.audited = options.audit;
    report.origin = mesh.origin;
    report.record = mesh.record;
    if (options.audit) report.audit = audit(mesh, triangles);
    report.audit.first_place += mesh.origin;
    report.findings = judge(report);
    report.findings.notes.insert(report.findings.notes.end(), mesh.notes.begin(), mesh.notes.end());
    return report;
}

DistanceReport inspect_distance(const std::string& path, const std::string& other_path, const InspectOptions& options) {
    DistanceReport report;
    report.file = path;
    report.other = other_path;
    report.limit = options.limit;
    const Mesh mesh = read_mesh(path);
    Mesh other = read_mesh(other_path);
    move_origin(other, mesh.origin);
    report.distance = mesh_distance(mesh, triangulate(mesh), other, triangulate(other), options.distance);
    for (Vec3d* place : {&report.distance.there.farthest, &report.distance.there.nearest,
                         &report.distance.back.farthest, &report.distance.back.nearest})
        *place += mesh.origin;
    report.findings = judge(report);
    return report;
}

ImageReport inspect_image(const std::string& path, const InspectOptions&) {
    ImageReport report;
    report.file = path;
    ImageInfo info;
    const Image<float> image = read_image(path, &info);
    report.check = check_image(image, info);
    report.step = step_slope(report.check.grey_step, image.width());
    report.findings = judge(report);
    return report;
}

PairReport inspect_pair(const std::string& height_path, const std::string& normal_path, const InspectOptions& options) {
    PairReport report;
    report.height_file = height_path;
    report.normal_file = normal_path;
    const HeightTexture height = read_height(height_path, options.height_channel);
    ImageInfo info;
    const Image<float> normals = read_image(normal_path, &info);
    if (normals.channels() < 2)
        throw Error(Refusal::unsuitable, normal_path +
                                             ": has one channel, a normal map has two or three; give the normal "
                                             "map as the second file");
    if (!std::all_of(normals.data(), normals.data() + normals.size(), [](float v) { return v - v == 0; }))
        throw Error(Refusal::unsuitable, normal_path + ": has NaN or Inf values; export it again");
    report.normal_values = guess_normal_values(normals, info);
    report.height_width = height.values.width();
    report.height_height = height.values.height();
    report.normal_width = normals.width();
    report.normal_height = normals.height();
    report.check = check_pair(height.values, decode_normals(normals, report.normal_values));
    report.directx = options.directx;
    report.recipe = pair_recipe(report.check, double(report.height_height) / report.height_width);
    report.height_channel = option_name(options.height_channel);
    report.findings = judge(report);
    for (const std::string& line : height.info.notes) report.findings.notes.push_back(height_path + ": " + line);
    for (const std::string& line : info.notes) report.findings.notes.push_back(normal_path + ": " + line);
    return report;
}

} // namespace bake
