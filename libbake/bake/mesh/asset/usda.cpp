// The mesh as a USD layer. The lines of a prim are indented by its depth.
#include "bake/mesh/asset/usda.h"
#include "bake/mesh/mesh_corner.h"
#include "bake/mesh/triangulate.h"
#include <algorithm>
#include <array>
#include <charconv>

namespace bake {
namespace {

/// The triangles, and the positions that they use under new numbers.
struct Geometry {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> number; ///< of positions; no_index: no corner uses it
    std::vector<std::uint32_t> points; ///< positions by their new numbers
    std::vector<std::uint32_t> corner; ///< of each point: one that uses it
    bool smooth = true;                ///< all corners of a point have one normal
    bool bare = false;                 ///< some corner has no uv
};

Geometry geometry_of(const Mesh& mesh) {
    Geometry out{.triangles = triangulate(mesh), .number = {}, .points = {}, .corner = {}};
    out.number.assign(mesh.positions.size(), no_index);
    for (const Triangle& triangle : out.triangles)
        for (const std::uint32_t c : triangle.corner) {
            std::uint32_t& number = out.number[mesh.corner_position[c]];
            if (number == no_index) {
                number = std::uint32_t(out.points.size());
                out.points.push_back(mesh.corner_position[c]);
                out.corner.push_back(c);
            }
            if (normal_at(mesh, c) != normal_at(mesh, out.corner[number])) out.smooth = false;
            if (mesh.corner_uv.empty() || mesh.corner_uv[c] == no_index) out.bare = true;
        }
    return out;
}

/// Of glTF's tolerance: what rounding leaves is left as it is.
Vec3f unit_normal(const Vec3f& n) noexcept {
    return std::abs(glm::dot(n, n) - 1) <= 1e-3f ? n : Vec3f(unit_or_zero(Vec3d(n)));
}

/// "    <head> = [a, b]" and what follows; append(text, i) appends the element i.
template <class Append>
void write_list(BlockWriter& out, const char* head, std::size_t count, const Append& append, const char* tail = "\n") {
    out.write(std::string("        ") + head + " = [");
    write_rows(out, count, [&](std::string& block, std::size_t i) {
        if (i > 0) block += ", ";
        append(block, i);
    });
    out.write(std::string("]") + tail);
}

std::string interpolated(const char* how) {
    return std::string(" (\n            interpolation = \"") + how + "\"\n        )\n";
}

void put_vector(std::string& out, const Vec3f& v) { out += tuple(std::array{v.x, v.y, v.z}); }

void write_geometry(BlockWriter& out, const Mesh& mesh, const Geometry& g) {
    const std::size_t corners = 3 * g.triangles.size();
    const auto corner = [&g](std::size_t i) { return g.triangles[i / 3].corner[i % 3]; };
    Vec3f least(0), most(0);
    for (std::size_t i = 0; i < g.points.size(); ++i) {
        const Vec3f& p = mesh.positions[g.points[i]];
        least = i == 0 ? p : glm::min(least, p), most = i == 0 ? p : glm::max(most, p);
    }
    write_list(out, "float3[] extent", 2,
               [&](std::string& text, std::size_t i) { put_vector(text, i ? most : least); });
    write_list(out, "int[] faceVertexCounts", g.triangles.size(), [](std::string& text, std::size_t) { text += '3'; });
    write_list(out, "int[] faceVertexIndices", corners, [&](std::string& text, std::size_t i) {
        text += std::to_string(g.number[mesh.corner_position[corner(i)]]);
    });
    write_list(
        out, "normal3f[] normals", g.smooth ? g.points.size() : corners,
        [&](std::string& text, std::size_t i) {
            put_vector(text, unit_normal(normal_at(mesh, g.smooth ? g.corner[i] : corner(i))));
        },
        interpolated(g.smooth ? "vertex" : "faceVarying").c_str());
    write_list(out, "point3f[] points", g.points.size(),
               [&](std::string& text, std::size_t i) { put_vector(text, mesh.positions[g.points[i]]); });
    write_list(
        out, "texCoord2f[] primvars:st", mesh.uvs.size() + (g.bare ? 1 : 0),
        [&](std::string& text, std::size_t i) {
            const Vec2f uv = i < mesh.uvs.size() ? mesh.uvs[i] : Vec2f(0);
            text += tuple(std::array{uv.x, uv.y});
        },
        interpolated("faceVarying").c_str());
    write_list(out, "int[] primvars:st:indices", corners, [&](std::string& text, std::size_t i) {
        const std::uint32_t uv = mesh.corner_uv.empty() ? no_index : mesh.corner_uv[corner(i)];
        text += std::to_string(std::min<std::size_t>(uv, mesh.uvs.size()));
    });
}

void write_subsets(BlockWriter& out, const Geometry& g, const Looks& looks) {
    std::vector<std::vector<std::uint32_t>> of_look(looks.looks.size());
    for (std::size_t t = 0; t < g.triangles.size(); ++t)
        of_look[looks.of_face[g.triangles[t].face]].push_back(std::uint32_t(t));
    for (std::size_t l = 0; l < of_look.size(); ++l) {
        const std::string& name = looks.looks[l].name;
        out.write("\n        def GeomSubset \"" + name +
                  "\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n" +
                  "        )\n        {\n            uniform token elementType = \"face\"\n" +
                  "            uniform token familyName = \"materialBind\"\n    ");
        write_list(out, "int[] indices", of_look[l].size(),
                   [&](std::string& text, std::size_t i) { text += std::to_string(of_look[l][i]); });
        out.write("            rel material:binding = <" + look_path(looks.looks[l]) + ">\n        }\n");
    }
}

void write_mesh_prim(BlockWriter& out, const Mesh& mesh, const Looks& looks) {
    const Geometry g = geometry_of(mesh);
    out.write("    def Mesh \"mesh\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {\n");
    if (std::any_of(looks.looks.begin(), looks.looks.end(), [](const Look& l) { return l.values.double_sided; }))
        out.write("        uniform bool doubleSided = 1\n");
    write_geometry(out, mesh, g);
    if (looks.looks.size() == 1) out.write("        rel material:binding = <" + look_path(looks.looks[0]) + ">\n");
    else out.write("        uniform token subsetFamily:materialBind:familyType = \"partition\"\n");
    out.write("        uniform token subdivisionScheme = \"none\"\n");
    if (looks.looks.size() > 1) write_subsets(out, g, looks);
    out.write("    }\n\n");
}

std::string shortest(double value) {
    char text[32]; // a double needs at most 24
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void write_head(BlockWriter& out, const Facts& facts) {
    out.write("#usda 1.0\n(\n");
    if (const std::string record = record_text(facts); !record.empty())
        out.write(std::string("    customLayerData = {\n        string ") + record_key + " = " + quoted(record) +
                  "\n    }\n");
    out.write("    defaultPrim = \"asset\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n");
}

} // namespace

std::string quoted(const std::string& text) {
    // Some readers take a line with more '[' than ']' for a list that continues on the next line.
    const bool balanced = std::count(text.begin(), text.end(), '[') == std::count(text.begin(), text.end(), ']');
    std::string out = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') out += {'\\', c};
        else if (code < 0x20 || code == 0x7f || (!balanced && (c == '[' || c == ']')))
            out += {'\\', 'x', "0123456789abcdef"[code >> 4], "0123456789abcdef"[code & 15]};
        else out += c;
    }
    return out + '"';
}

std::string look_path(const Look& look) { return "/asset/Materials/" + look.name; }

void write_usda(BlockWriter& out, const TextAsset& asset, const Looks& looks, const Facts& facts) {
    write_head(out, facts);
    out.write("def Xform \"asset\" (\n    kind = \"component\"\n)\n{\n");
    if (const Vec3d& o = asset.mesh.origin; o != Vec3d(0))
        out.write("    double3 xformOp:translate = (" + shortest(o.x) + ", " + shortest(o.y) + ", " + shortest(o.z) +
                  ")\n    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n\n");
    write_mesh_prim(out, asset.mesh, looks);
    out.write("    def Scope \"Materials\"\n    {\n");
    for (const Look& look : looks.looks) out.write(usd_material(look) + (&look == &looks.looks.back() ? "" : "\n"));
    out.write("    }\n}\n");
}

} // namespace bake
