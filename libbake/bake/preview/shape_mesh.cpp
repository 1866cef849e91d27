#include "bake/preview/shape_mesh.h"
#include "bake/base/error.h"
#include "bake/base/parse_double.h"
#include "bake/preview/nearest_key.h"
#include "bake/surface/analytic/parametric.h"
#include "bake/surface/analytic/parametric_shapes.h"
#include <array>
#include <filesystem>

namespace bake {
namespace {

/// Edge of "cube" or "cube:a=EDGE".
double cube_edge(const std::string& shape) {
    if (shape == "cube") return 1;
    const auto edge = shape.starts_with("cube:a=") ? parse_finite(std::string_view(shape).substr(7)) : std::nullopt;
    if (!edge || !(*edge >= 1e-9 && *edge <= 1e9))
        throw Error(Refusal::usage, shape + ": is no cube; write cube:a=1, with an edge between 1e-09 and 1e+09");
    return *edge;
}

/// ParametricSurface does not know the cube, so that its own refusal would not name it.
void refuse_unknown(const std::string& shape) {
    const std::string name = shape.substr(0, shape.find(':'));
    std::vector<std::string> names = {"cube"};
    std::string known = "cube";
    for (const ShapeKind& kind : shape_kinds()) {
        if (name == kind.name) return;
        names.emplace_back(kind.name);
        known += std::string(", ") + kind.name;
    }
    const std::string meant = did_you_mean(name, names);
    throw Error(Refusal::usage,
                "shape \"" + name + "\" does not exist; " + (meant.empty() ? "give one of " + known : meant));
}

Mesh cube_mesh(double edge, int columns, int rows) {
    // u and v of each side, seen from outside; v is up on the four walls.
    constexpr std::array<std::array<Vec3f, 2>, 6> sides = {{{Vec3f(0, 0, -1), Vec3f(0, 1, 0)},
                                                            {Vec3f(0, 0, 1), Vec3f(0, 1, 0)},
                                                            {Vec3f(1, 0, 0), Vec3f(0, 0, -1)},
                                                            {Vec3f(1, 0, 0), Vec3f(0, 0, 1)},
                                                            {Vec3f(1, 0, 0), Vec3f(0, 1, 0)},
                                                            {Vec3f(-1, 0, 0), Vec3f(0, 1, 0)}}};
    Mesh mesh;
    for (const auto& [along_u, along_v] : sides) {
        const Vec3f n = glm::cross(along_u, along_v);
        const auto normal = std::uint32_t(mesh.normals.size()), first = std::uint32_t(mesh.positions.size());
        mesh.normals.push_back(n);
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i) {
                const Vec2f uv(float(i) / float(columns), float(j) / float(rows));
                const Vec3f p = 0.5f * n + (uv.x - 0.5f) * along_u + (uv.y - 0.5f) * along_v;
                mesh.positions.push_back(float(edge) * p);
                mesh.uvs.push_back(uv);
            }
        const auto at = [&](int i, int j) { return first + std::uint32_t(j * (columns + 1) + i); };
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                for (const std::uint32_t c : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) {
                    mesh.corner_position.push_back(c);
                    mesh.corner_normal.push_back(normal);
                    mesh.corner_uv.push_back(c);
                }
                mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
            }
    }
    return mesh;
}

} // namespace

Mesh shape_mesh(const std::string& shape, int columns, int rows) {
    if (shape == "cube" || shape.starts_with("cube:"))
        return cube_mesh(cube_edge(shape), columns > 0 ? columns : 1, rows > 0 ? rows : 1);
    refuse_unknown(shape);
    const ParametricSurface surface(shape);
    const auto resolution = surface.default_resolution();
    return without_repeats(
        tessellate(surface, columns > 0 ? columns : resolution.first, rows > 0 ? rows : resolution.second));
}

std::string shape_beside(const std::string& file, const std::string& shape) {
    for (const ShapeKind& kind : shape_kinds()) {
        if (!kind.file_key || !shape.starts_with(kind.name + std::string(":"))) continue;
        for (const char before : {':', ','}) {
            const std::string key = before + std::string(kind.file_key) + "=";
            const std::size_t at = shape.find(key);
            if (at == std::string::npos) continue;
            const std::size_t begin = at + key.size(), end = std::min(shape.find(',', begin), shape.size());
            const std::filesystem::path folder = std::filesystem::path(file).parent_path();
            return shape.substr(0, begin) + (folder / shape.substr(begin, end - begin)).lexically_normal().string() +
                   shape.substr(end);
        }
    }
    return shape;
}

} // namespace bake
