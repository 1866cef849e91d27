// MaterialX 1.38: standard_surface 1.0.1, which renderers and engines share.
#include "bake/mesh/asset/looks.h"
#include <array>

namespace bake {
namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c == '&') out += "&amp;";
        else if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '"') out += "&quot;";
        else out += static_cast<unsigned char>(c) < 0x20 ? '_' : c; // XML 1.0 has no other control characters
    return out;
}

/// A comment must not have two hyphens together. In JSON they stand in texts alone, where one can be written by its code.
std::string without_double_hyphens(std::string json) {
    for (std::size_t at; (at = json.find("--")) != std::string::npos;) json.replace(at + 1, 1, "\\u002d");
    return json;
}

std::string list(std::span<const float> values) { return tuple(values, "", ""); }

const char* address_mode(int gltf) { return gltf == 33071 ? "clamp" : gltf == 33648 ? "mirror" : "periodic"; }

/// Collects the nodes of one graph, and the inputs of the surface.
class Graph {
public:
    Graph(const Look& look, std::string name) : look_(look), name_(std::move(name)) {}

    void value(const char* input, const char* type, const std::string& text) {
        inputs_ += line(4, "input", input, type, "value=\"" + text + "\" /");
    }
    /// The input is what the node gives.
    void connect(const char* input, const char* type, const std::string& node) {
        inputs_ += line(4, "input", input, type, "nodegraph=\"" + name_ + "\" output=\"" + input + "_out\" /");
        outputs_ += line(4, "output", std::string(input) + "_out", type, "nodename=\"" + node + "\" /");
    }
    /// Reads a picture; `space` is that of its texels.
    std::string image(const std::string& node, const char* type, const LookTexture& map, const char* space) {
        nodes_ += line(4, "image", node, type, "");
        nodes_ +=
            line(6, "input", "file", "filename", "value=\"" + escaped(map.file) + "\" colorspace=\"" + space + "\" /");
        if (look_.uvs.set != 0) nodes_ += line(6, "input", "texcoord", "vector2", "nodename=\"uv\" /");
        for (const auto& [input, mode] :
             {std::pair("uaddressmode", map.sampler.wrap_u), {"vaddressmode", map.sampler.wrap_v}})
            nodes_ += line(6, "input", input, "string", std::string("value=\"") + address_mode(mode) + "\" /");
        nodes_ += "    </image>\n";
        return node;
    }
    /// A node with an input from another node and, where `second` has a name, one with a value.
    std::string node(const char* kind, const std::string& name, const char* type, const char* input,
                     const char* input_type, const std::string& from, const std::string& second = "",
                     const char* second_type = "", const std::string& value = "") {
        nodes_ += line(4, kind, name, type, "");
        nodes_ += line(6, "input", input, input_type, "nodename=\"" + from + "\" /");
        if (!second.empty()) nodes_ += line(6, "input", second, second_type, "value=\"" + value + "\" /");
        nodes_ += std::string("    </") + kind + ">\n";
        return name;
    }
    std::string text(const std::string& surface) const {
        std::string out;
        if (!nodes_.empty()) {
            out += "  <nodegraph name=\"" + name_ + "\">\n";
            if (look_.uvs.set != 0)
                out += line(4, "texcoord", "uv", "vector2", "") +
                       line(6, "input", "index", "integer", "value=\"" + std::to_string(look_.uvs.set) + "\" /") +
                       "    </texcoord>\n";
            out += nodes_ + outputs_ + "  </nodegraph>\n";
        }
        out += line(2, "standard_surface", surface, "surfaceshader", "") + inputs_ + "  </standard_surface>\n";
        const std::string title = look_.title == look_.name ? "" : "doc=\"" + escaped(look_.title) + "\"";
        return out + line(2, "surfacematerial", look_.name, "material", title) +
               line(4, "input", "surfaceshader", "surfaceshader", "nodename=\"" + surface + "\" /") +
               "  </surfacematerial>\n";
    }

private:
    static std::string line(int indent, const char* element, const std::string& name, const char* type,
                            const std::string& rest) {
        return std::string(std::size_t(indent), ' ') + "<" + element + " name=\"" + name + "\" type=\"" + type + "\"" +
               (rest.empty() ? "" : " " + rest) + ">\n";
    }

    const Look& look_;
    std::string name_, nodes_, outputs_, inputs_;
};

/// A colour: a factor, or a picture times the factor.
void add_colour(Graph& graph, const char* input, const LookTexture& map, const Vec3f& factor) {
    const std::string value = list(std::array{factor.x, factor.y, factor.z});
    if (!map) return graph.value(input, "color3", value);
    std::string node = graph.image(std::string(input) + "_image", "color3", map, "srgb_texture");
    if (factor != Vec3f(1))
        node = graph.node("multiply", input, "color3", "in1", "color3", node, "in2", "color3", value);
    graph.connect(input, "color3", node);
}

void add_channel(Graph& graph, const char* input, const std::string& image, int channel, float factor) {
    std::string node = graph.node("extract", std::string(input) + "_channel", "float", "in", "vector3", image, "index",
                                  "integer", std::to_string(channel));
    if (factor != 1)
        node = graph.node("multiply", input, "float", "in1", "float", node, "in2", "float", list(std::array{factor}));
    graph.connect(input, "float", node);
}

void fill(Graph& graph, const Look& look) {
    const GltfMaterial& m = look.values;
    graph.value("base", "float", "1");
    add_colour(graph, "base_color", look.base_color, Vec3f(m.base_color_factor));
    if (look.metallic_roughness) {
        const std::string image =
            graph.image("metallic_roughness_image", "vector3", look.metallic_roughness, "lin_rec709");
        add_channel(graph, "metalness", image, 2, m.metallic);
        add_channel(graph, "specular_roughness", image, 1, m.roughness);
    } else {
        graph.value("metalness", "float", list(std::array{m.metallic}));
        graph.value("specular_roughness", "float", list(std::array{m.roughness}));
    }
    if (const Vec3f e = m.emissive_strength * m.emissive_factor; e != Vec3f(0)) {
        graph.value("emission", "float", "1");
        add_colour(graph, "emission_color", look.emissive, e);
    }
    if (const float a = m.base_color_factor.w; m.alpha_mode == "BLEND" && a != 1)
        graph.value("opacity", "color3", list(std::array{a, a, a}));
    if (!look.normal) return;
    const std::string image = graph.image("normal_image", "vector3", look.normal, "lin_rec709");
    graph.connect("normal", "vector3", graph.node("normalmap", "normal", "vector3", "in", "vector3", image));
}

} // namespace

void write_mtlx(BlockWriter& out, const Looks& looks, const Facts& facts) {
    out.write("<?xml version=\"1.0\"?>\n<materialx version=\"1.38\" colorspace=\"lin_rec709\">\n");
    if (const std::string record = record_text(facts); !record.empty())
        out.write(std::string("  <!-- ") + record_key + " " + without_double_hyphens(record) + " -->\n");
    std::set<std::string> taken;
    for (const Look& look : looks.looks) taken.insert(look.name);
    for (const Look& look : looks.looks) {
        Graph graph(look, unique_name(look.name + "_graph", taken));
        fill(graph, look);
        out.write(graph.text(unique_name(look.name + "_surface", taken)));
    }
    out.write("</materialx>\n");
}

} // namespace bake
