// OpenUSD, UsdPreviewSurface Specification, version 2.6. A texture reader gives texel * scale + bias.
#include "bake/mesh/asset/usda.h"
#include <array>

namespace bake {
namespace {

const char* wrap_mode(int gltf) { return gltf == 33071 ? "clamp" : gltf == 33648 ? "mirror" : "repeat"; }

/// Collects the shaders of one material, and the inputs of its surface.
class Network {
public:
    explicit Network(const Look& look) : look_(look) {}

    void value(const std::string& type_and_name, const std::string& text) {
        inputs_ += "                " + type_and_name + " = " + text + "\n";
    }
    void connect(const std::string& type_and_name, const char* shader, const char* output) {
        value(type_and_name + ".connect", "<" + look_path(look_) + "/" + shader + ".outputs:" + output + ">");
    }
    /// `colour`: sRGB or raw. `keyword`: before scale and bias, which are left out where they change nothing.
    void texture(const char* name, const LookTexture& map, const char* colour, const std::array<float, 4>& scale,
                 const std::array<float, 4>& bias, const std::vector<std::string>& outputs, const char* keyword = "") {
        const std::string in = "                ";
        std::string text = in + "uniform token info:id = \"UsdUVTexture\"\n";
        if (bias != std::array<float, 4>{0, 0, 0, 0})
            text += in + keyword + "float4 inputs:bias = " + tuple(bias) + "\n";
        text += in + "asset inputs:file = @./" + map.file + "@\n";
        if (scale != std::array<float, 4>{1, 1, 1, 1})
            text += in + keyword + "float4 inputs:scale = " + tuple(scale) + "\n";
        text += in + "token inputs:sourceColorSpace = \"" + colour + "\"\n";
        text += in + "float2 inputs:st.connect = <" + look_path(look_) + "/uv.outputs:result>\n";
        text += in + "token inputs:wrapS = \"" + wrap_mode(map.sampler.wrap_u) + "\"\n";
        text += in + "token inputs:wrapT = \"" + wrap_mode(map.sampler.wrap_v) + "\"\n";
        for (const std::string& output : outputs) text += in + output + "\n";
        shader(name, text);
    }
    std::string text() const {
        const std::string title =
            look_.title == look_.name ? "" : " (\n            displayName = " + quoted(look_.title) + "\n        )";
        return "        def Material \"" + look_.name + "\"" + title + "\n        {\n" +
               "            token outputs:surface.connect = <" + look_path(look_) + "/surface.outputs:surface>\n\n" +
               "            def Shader \"surface\"\n            {\n" +
               "                uniform token info:id = \"UsdPreviewSurface\"\n" + inputs_ +
               "                token outputs:surface\n            }\n" + shaders_ + "        }\n";
    }
    void shader(const char* name, const std::string& content) {
        shaders_ +=
            std::string("\n            def Shader \"") + name + "\"\n            {\n" + content + "            }\n";
    }

private:
    const Look& look_;
    std::string inputs_, shaders_;
};

void add_colour(Network& network, const Look& look) {
    const GltfMaterial& m = look.values;
    const Vec4f& c = m.base_color_factor;
    const bool masked = m.alpha_mode == "MASK", seen_through = masked || m.alpha_mode == "BLEND";
    if (look.base_color) {
        network.connect("color3f inputs:diffuseColor", "base_color", "rgb");
        if (seen_through) network.connect("float inputs:opacity", "base_color", "a");
        network.texture("base_color", look.base_color, "sRGB", {c.x, c.y, c.z, c.w}, {0, 0, 0, 0},
                        {"float outputs:a", "float3 outputs:rgb"});
    } else {
        network.value("color3f inputs:diffuseColor", tuple(std::array{c.x, c.y, c.z}));
        if (seen_through) network.value("float inputs:opacity", tuple(std::array{c.w}, "", ""));
    }
    if (masked) network.value("float inputs:opacityThreshold", tuple(std::array{m.alpha_cutoff}, "", ""));
}

void add_emission(Network& network, const Look& look) {
    const Vec3f e = look.values.emissive_strength * look.values.emissive_factor;
    if (e == Vec3f(0)) return;
    if (!look.emissive) return network.value("color3f inputs:emissiveColor", tuple(std::array{e.x, e.y, e.z}));
    network.connect("color3f inputs:emissiveColor", "emissive", "rgb");
    network.texture("emissive", look.emissive, "sRGB", {e.x, e.y, e.z, 1}, {0, 0, 0, 0}, {"float3 outputs:rgb"});
}

void add_metallic_roughness(Network& network, const Look& look) {
    const GltfMaterial& m = look.values;
    if (!look.metallic_roughness) {
        network.value("float inputs:metallic", tuple(std::array{m.metallic}, "", ""));
        network.value("float inputs:roughness", tuple(std::array{m.roughness}, "", ""));
        return;
    }
    network.connect("float inputs:metallic", "metallic_roughness", "b");
    network.connect("float inputs:roughness", "metallic_roughness", "g");
    network.texture("metallic_roughness", look.metallic_roughness, "raw", {1, m.roughness, m.metallic, 1}, {0, 0, 0, 0},
                    {"float outputs:b", "float outputs:g"});
}

} // namespace

std::string usd_material(const Look& look) {
    Network network(look);
    add_colour(network, look);
    add_emission(network, look);
    add_metallic_roughness(network, look);
    if (look.normal) {
        network.connect("normal3f inputs:normal", "normal", "rgb");
        // The word `custom` changes no value. three.js r187 doubles the slopes of a map whose scale it sees: it takes the
        // scale for a strength, on top of its own 2 rgb - 1. It does not see what is `custom`.
        network.texture("normal", look.normal, "raw", {2, 2, 2, 1}, {-1, -1, -1, 0}, {"float3 outputs:rgb"}, "custom ");
    }
    if (look.occlusion) {
        const auto s = float(look.occlusion_strength); // 1 + strength (red - 1)
        network.connect("float inputs:occlusion", "occlusion", "r");
        network.texture("occlusion", look.occlusion, "raw", {s, s, s, 1}, {1 - s, 1 - s, 1 - s, 0},
                        {"float outputs:r"});
    }
    network.shader("uv", "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
                         "                string inputs:varname = \"st\"\n"
                         "                float2 outputs:result\n");
    return network.text();
}

} // namespace bake
