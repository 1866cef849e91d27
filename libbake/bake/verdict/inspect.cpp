#include "bake/verdict/inspect.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/mesh/gltf/io.h"
#include <algorithm>
#include <array>
#include <cctype>

namespace bake {
namespace {

/// read_mesh() and, for glTF files, the content besides the mesh.
Mesh read_parts(const std::string& path, const InspectOptions& options, std::optional<GltfParts>& parts) {
    if (mesh_format(path) != MeshFormat::gltf) return read_mesh(path, options.read);
    Gltf gltf = read_gltf(path, {.flip_v = !options.read.flip_v});
    parts.emplace();
    parts->nodes = gltf.nodes.size();
    parts->images = gltf.images.size();
    for (const GltfImage& image : gltf.images) parts->missing_images += image.bytes.empty() ? 1 : 0;
    for (const GltfMaterial& material : gltf.materials) parts->normal_textures += material.normal ? 1 : 0;
    parts->tangents = !gltf.mesh.tangents.empty();
    return flatten(std::move(gltf));
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
    if (options.audit) report.audit = audit(mesh, triangles);
    report.findings = judge(report);
    return report;
}

DistanceReport inspect_distance(const std::string& path, const std::string& other_path, const InspectOptions& options) {
    DistanceReport report;
    report.file = path;
    report.other = other_path;
    report.limit = options.limit;
    const Mesh mesh = read_mesh(path), other = read_mesh(other_path);
    report.distance = mesh_distance(mesh, triangulate(mesh), other, triangulate(other), options.distance);
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
    const Image<float> normals = read_image(normal_path);
    if (normals.channels() < 3)
        throw Error(Refusal::unsuitable,
                    normal_path + ": has " + std::to_string(normals.channels()) +
                        " channels, a normal map has three; give the normal map as the second file");
    if (!std::all_of(normals.data(), normals.data() + normals.size(), [](float v) { return v - v == 0; }))
        throw Error(Refusal::unsuitable, normal_path + ": has NaN or Inf values; export it again");
    report.height_width = height.values.width();
    report.height_height = height.values.height();
    report.normal_width = normals.width();
    report.normal_height = normals.height();
    report.check = check_pair(height.values, normals);
    report.directx = options.directx;
    report.findings = judge(report);
    return report;
}

} // namespace bake
