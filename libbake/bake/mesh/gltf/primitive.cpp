#include "bake/mesh/gltf/primitive.h"
#include "bake/base/progress.h"
#include "bake/base/text_line.h"
#include <algorithm>
#include <tiny_gltf.h>

namespace bake {
namespace {

bool starts_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

/// What the mesh calls the values that the file calls `semantic`; nothing for those that it does not keep.
std::string attribute_name(const std::string& semantic) {
    if (starts_with(semantic, "TEXCOORD_") || starts_with(semantic, "COLOR_")) return semantic;
    if (semantic.size() < 2 || semantic[0] != '_') return {};
    std::string name = semantic.substr(1);
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return name;
}

/// Adds the values of the morph targets to those of an attribute. Spec 3.7.2.2. False if none has a weight.
bool add_targets(const GltfSource& source, const GltfPrimitive& primitive, const GltfUsed& used,
                 std::span<const double> weights, const GltfAccessor& base, const std::string& semantic,
                 float* values) {
    bool any = false;
    for (std::size_t t = 0; t < std::min(weights.size(), primitive.vertices.targets.size()); ++t) {
        const auto found = primitive.vertices.targets[t].find(semantic);
        if (weights[t] == 0 || found == primitive.vertices.targets[t].end()) continue;
        const std::string use = shown(semantic) + " of morph target " + std::to_string(t);
        // The sign of a tangent does not change: its targets have three components.
        const int components = semantic == "TANGENT" ? 3 : base.components;
        throw_if_interrupted();
        const GltfAccessor target = accessor_of(source, found->second, components, used.count, use);
        const std::vector<float> added = floats_of(source, target, used, use);
        for (std::size_t i = 0; i < used.size(); ++i)
            for (std::size_t k = 0; k < std::size_t(components); ++k)
                values[i * std::size_t(base.components) + k] +=
                    float(weights[t] * double(added[i * std::size_t(components) + k]));
        any = true;
    }
    return any;
}

/// Nothing for points, lines and primitives without positions.
std::optional<GltfPrimitive> primitive_of(const GltfSource& source, const tinygltf::Primitive& from) {
    if (from.mode >= 0 && from.mode < TINYGLTF_MODE_TRIANGLES) return {}; // points and lines
    if (from.mode > TINYGLTF_MODE_TRIANGLE_FAN) source.refuse("has a primitive of mode " + std::to_string(from.mode));
    GltfPrimitive out;
    if (from.mode >= 0) out.mode = static_cast<GltfPrimitive::Mode>(from.mode);
    if (from.material >= 0) {
        if (std::size_t(from.material) >= source.model.materials.size())
            source.refuse("asks for material " + std::to_string(from.material) + " of " +
                          std::to_string(source.model.materials.size()));
        out.material = std::uint32_t(from.material);
    }
    if (from.extras.Has("group") && from.extras.Get("group").IsString())
        out.group = from.extras.Get("group").Get<std::string>();
    const auto position = from.attributes.find("POSITION");
    if (position == from.attributes.end()) return {}; // drawn by an extension, or not at all
    out.vertices = {from.attributes, from.targets};
    out.position = accessor_of(source, position->second, "POSITION");
    const auto expect = [&](const GltfAccessor& a, const std::string& use, int least, int most) {
        if (a.components < least || a.components > most)
            source.refuse("its " + use + " has " + std::to_string(a.components) + " components");
        if (a.count != out.position.count)
            source.refuse("its " + use + " has " + std::to_string(a.count) + " elements for " +
                          std::to_string(out.position.count) + " positions");
        return a;
    };
    expect(out.position, "POSITION", 3, 3);
    for (const auto& [semantic, index] : from.attributes) {
        if (semantic == "POSITION") continue;
        const std::string name = attribute_name(semantic);
        if (name.empty() && semantic != "NORMAL" && semantic != "TANGENT") continue;
        const GltfAccessor a = accessor_of(source, index, shown(semantic));
        if (semantic == "NORMAL") out.normal = expect(a, semantic, 3, 3);
        else if (semantic == "TANGENT") out.tangent = expect(a, semantic, 4, 4);
        else if (semantic == "TEXCOORD_0") out.uv = expect(a, semantic, 2, 2);
        else if (starts_with(semantic, "TEXCOORD_")) out.values.emplace_back(semantic, expect(a, semantic, 2, 2));
        else out.values.emplace_back(semantic, expect(a, shown(semantic), 1, 4));
    }
    out.indexed = from.indices >= 0;
    if (out.indexed) {
        out.indices = accessor_of(source, from.indices, "indices");
        if (out.indices.components != 1 || out.indices.normalized ||
            (out.indices.type != GltfType::uint8 && out.indices.type != GltfType::uint16 &&
             out.indices.type != GltfType::uint32))
            source.refuse("has indices that are no unsigned integers");
    }
    if (out.mode == GltfPrimitive::Mode::triangles && out.index_count() % 3 != 0)
        source.refuse("has a list of triangles of " + std::to_string(out.index_count()) +
                      " indices, which is no multiple of 3");
    return out;
}

} // namespace

GltfPrimitives primitives_of(const GltfSource& source) {
    GltfPrimitives meshes;
    for (const tinygltf::Mesh& mesh : source.model.meshes) {
        if (meshes.size() % 1024 == 0) throw_if_interrupted();
        std::vector<GltfPrimitive>& out = meshes.emplace_back();
        std::map<GltfVertexSource, std::size_t> first;
        for (const tinygltf::Primitive& from : mesh.primitives) {
            std::optional<GltfPrimitive> primitive = primitive_of(source, from);
            if (!primitive || primitive->most_triangles() == 0) continue;
            primitive->number = std::size_t(&from - mesh.primitives.data());
            primitive->vertices_of = first.try_emplace(primitive->vertices, out.size()).first->second;
            out.push_back(std::move(*primitive));
        }
    }
    return meshes;
}

std::vector<std::uint32_t> triangles_of(const GltfSource& source, const GltfPrimitive& primitive) {
    std::vector<std::uint32_t> index(primitive.index_count());
    if (primitive.indexed) read_indices(primitive.indices, index.data());
    else
        for (std::uint32_t i = 0; i < index.size(); ++i) index[i] = i;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index[i] >= primitive.position.count)
            source.refuse("has index " + std::to_string(index[i]) + " of " + std::to_string(primitive.position.count) +
                          " positions");
    if (primitive.mode == GltfPrimitive::Mode::triangles) return index;
    std::vector<std::uint32_t> out;
    out.reserve(3 * primitive.most_triangles());
    for (std::size_t i = 0; i + 2 < index.size(); ++i) {
        const bool strip = primitive.mode == GltfPrimitive::Mode::strip;
        const std::uint32_t a = strip ? index[i] : index[i + 1], b = strip ? index[i + 1 + i % 2] : index[i + 2],
                            c = strip ? index[i + 2 - i % 2] : index[0];
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    }
    return out;
}

void append(const GltfSource& source, const GltfPrimitive& primitive, const GltfUsed& used,
            std::span<const double> weights, bool flip_v, GltfVertices& out) {
    const std::size_t first = out.positions.size(), count = used.size();
    bool bent = false; // by morph targets
    const auto take = [&](const GltfAccessor& a, float* to, const std::string& use) {
        const bool named_by_us = use == "POSITION" || use == "NORMAL" || use == "TANGENT" || use == "TEXCOORD_0";
        if (!read_floats(a, used, to))
            source.refuse("its " + (named_by_us ? use : shown(use)) + " has a value that is not finite");
        bent = add_targets(source, primitive, used, weights, a, use, to);
    };
    const auto flip = [&](float* v, std::size_t values) {
        for (std::size_t i = 1; flip_v && i < values; i += 2) v[i] = 1 - v[i];
    };
    out.positions.resize(first + count);
    if (count == 0) return;
    take(primitive.position, &out.positions[first].x, "POSITION");
    if (primitive.normal) {
        out.normals.resize(first + count);
        take(*primitive.normal, &out.normals[first].x, "NORMAL");
        for (std::size_t i = first; bent && i < first + count; ++i) out.normals[i] = unit_or_zero(out.normals[i]);
    }
    if (primitive.uv) {
        out.uvs.resize(first + count);
        take(*primitive.uv, &out.uvs[first].x, "TEXCOORD_0");
        flip(&out.uvs[first].x, 2 * count);
    }
    if (primitive.tangent) {
        out.tangents.resize(first, Vec4f(0, 0, 0, 1));
        out.tangents.resize(first + count);
        take(*primitive.tangent, &out.tangents[first].x, "TANGENT");
        for (std::size_t i = first; bent && i < first + count; ++i)
            out.tangents[i] = Vec4f(unit_or_zero(Vec3f(out.tangents[i])), out.tangents[i].w);
    }
    std::vector<float> values;
    for (const auto& [semantic, accessor] : primitive.values) {
        const std::string name = attribute_name(semantic);
        const auto components = std::size_t(accessor.components);
        values.resize(count * components);
        take(accessor, values.data(), semantic);
        if (starts_with(name, "TEXCOORD_")) flip(values.data(), values.size());
        Attribute& to = attribute_named(out, name, accessor.components);
        const auto width = std::size_t(to.components);
        to.values.resize(first * width, default_value(name));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < width; ++k)
                to.values.push_back(k < components ? values[i * components + k] : default_value(name));
    }
    for (std::size_t i = 0; i < count; ++i) {
        out.has_normal.push_back(primitive.normal.has_value());
        out.has_uv.push_back(primitive.uv.has_value());
    }
}

} // namespace bake
