#include "bake/preview/scene_lights.h"
#include <cmath>

namespace bake {
namespace {

/// A unit vector.
Vec3f read_direction(const Section& in, const char* key, const char* what) {
    Vec3f direction(0);
    if (!read(in, key, direction)) refuse(in, in.table, in_quotes(key) + " is missing; give " + what);
    direction = unit_or_zero(direction);
    if (direction == Vec3f(0)) refuse(in, *in.table.get(key), in_quotes(key) + " is zero; give a direction");
    return direction;
}

void read_position(const Section& in, Light<float>& light) {
    if (!read(in, "position", light.position))
        refuse(in, in.table, "\"position\" is missing; give the position of the light");
    Vec3f falloff(1, 0, 0);
    if (read(in, "falloff", falloff, 0) && falloff == Vec3f(0))
        refuse(in, *in.table.get("falloff"),
               "\"falloff\" is all zero; give constant, linear, quadratic, such as [1, 0, 0]");
    light.falloff = {falloff.x, falloff.y, falloff.z};
}

void read_cone(const Section& in, Light<float>& light) {
    light.from = -read_direction(in, "direction", "the direction in which the light shines");
    float inner = 0, outer = 45;
    read(in, "outer-deg", outer, 0.1, 180);
    read(in, "inner-deg", inner, 0, 180);
    if (!(inner < outer))
        refuse(in, *in.table.get(in.table.get("inner-deg") ? "inner-deg" : "outer-deg"),
               "\"inner-deg\" is not smaller than \"outer-deg\"; give half the angle of the inner cone, then of the "
               "outer");
    light.cos_inner = float(std::cos(inner * (pi / 180))), light.cos_outer = float(std::cos(outer * (pi / 180)));
}

/// Its two edges, or a direction and the size of a square.
void read_quad(const Section& in, Light<float>& light) {
    if (!read(in, "position", light.position))
        refuse(in, in.table, "\"position\" is missing; give the centre of the light");
    const bool edges = read(in, "edge-u", light.edge_u);
    if (read(in, "edge-v", light.edge_v) != edges)
        refuse(in, in.table, "\"edge-u\" and \"edge-v\" belong together; give both, or \"direction\" and \"size\"");
    for (const char* key : {"direction", "size"})
        if (const toml::node* node = in.table.get(key); node && edges)
            refuse(in, *node, in_quotes(key) + " and the edges exclude each other; give one of them");
    if (!edges) {
        const Vec3f direction =
            read_direction(in, "direction", "the direction in which the light shines, or its edges");
        float size = 1;
        read(in, "size", size, 0);
        const Vec3f across = std::abs(direction.y) < 0.9f ? Vec3f(0, 1, 0) : Vec3f(0, 0, 1);
        const Vec3f u = unit_or_zero(glm::cross(across, direction));
        light.edge_u = size * u, light.edge_v = size * glm::cross(direction, u);
    }
    if (glm::cross(light.edge_u, light.edge_v) == Vec3f(0))
        refuse(in, in.table, "the light has no area; give edges that are not parallel, or a \"size\" above 0");
}

} // namespace

void read_light(const Section& in, SceneEntries& scene) {
    scene.any_light = true;
    enum class Type { directional, point, spot, quad, ambient } type = Type::directional;
    if (!in.table.get("type"))
        refuse(in, in.table, "\"type\" is missing; give \"directional\", \"point\", \"spot\", \"quad\" or \"ambient\"");
    read_choice<Type>(in, "type", type,
                      {{"directional", Type::directional},
                       {"point", Type::point},
                       {"spot", Type::spot},
                       {"quad", Type::quad},
                       {"ambient", Type::ambient}});
    Light<float> light;
    float intensity = 1;
    Vec3f ambient(0);
    read_colour(in, "colour", light.colour);
    read(in, "intensity", intensity, 0);
    light.colour *= intensity;
    if (type == Type::ambient) {
        allow_only(in, {"type", "colour", "intensity"});
        scene.ambient += light.colour;
        return;
    }
    read_colour(in, "diffuse", light.diffuse);
    read_colour(in, "specular", light.specular);
    read_colour(in, "ambient", ambient);
    scene.ambient += ambient * light.colour;
    switch (type) {
    case Type::point:
        allow_only(in, {"type", "position", "falloff", "colour", "intensity", "ambient", "diffuse", "specular"});
        light.kind = LightKind::point;
        read_position(in, light);
        break;
    case Type::spot:
        allow_only(in, {"type", "position", "direction", "inner-deg", "outer-deg", "falloff", "colour", "intensity",
                        "ambient", "diffuse", "specular"});
        light.kind = LightKind::spot;
        read_position(in, light);
        read_cone(in, light);
        break;
    case Type::quad:
        allow_only(in, {"type", "position", "direction", "size", "edge-u", "edge-v", "colour", "intensity", "ambient",
                        "diffuse", "specular"});
        light.kind = LightKind::quad;
        read_quad(in, light);
        break;
    default:
        allow_only(in, {"type", "from", "colour", "intensity", "ambient", "diffuse", "specular"});
        light.from = read_direction(in, "from", "the direction the light comes from");
    }
    scene.lights.push_back(light);
}

} // namespace bake
