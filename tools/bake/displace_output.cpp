#include "displace_output.h"
#include "bake/mesh/check/mesh_audit.h"
#include "bake/mesh/file/write_memory.h"
#include "bake/surface/chart/tangent_space.h"
#include "gltf_output.h"

namespace bake {
namespace {

/// Makes the fold margin an attribute of the corners.
void add_margin(Displaced& displaced) {
    Attribute attribute{.name = "fold_margin", .components = 1, .values = {}};
    attribute.values.reserve(displaced.mesh.corners());
    for (const std::uint32_t p : displaced.mesh.corner_position) attribute.values.push_back(displaced.margin[p]);
    displaced.mesh.attributes.push_back(std::move(attribute));
    displaced.margin = {};
}

} // namespace

std::int64_t write_displaced(const DisplaceArgs& args, bool has_tangents, Displaced& displaced, const Facts& facts,
                             std::vector<std::string>& notes) {
    Mesh& mesh = displaced.mesh;
    if (args.margin) add_margin(displaced);
    GltfCarry carry{.positions = true, .tangents = args.tangents || has_tangents, .same_faces = keeps_faces(args)};
    if (args.margin) carry.attributes = {"fold_margin"};
    if (args.tangents || (has_tangents && keeps_file(args.surface, args.out))) add_tangents(mesh);
    carry.facts = facts;
    return write_result(args.out, args.surface, mesh, carry, notes);
}

std::vector<LaterStep> later_steps(const DisplaceArgs& args, const BaseSurface& base) {
    const bool margin = args.margin, parts = base.mesh().materials.size() > 1 || base.mesh().groups.size() > 1;
    std::size_t values = margin; // of each corner
    for (const Attribute& a : base.mesh().attributes)
        values += args.surface.reading.pieces ? std::size_t(a.components) : 0;
    const bool tangents = args.tangents || (args.surface.reading.pieces && !base.mesh().tangents.empty());
    values += tangents ? 4 : 0;
    const bool twice = args.surface.reading.pieces; // in the space of the nodes too
    const auto attribute = [=](const DisplaceCount& c) {
        const std::uint64_t corners = c.corners * values * sizeof(float);
        const std::uint64_t copy =
            corners + (c.points + c.normals) * sizeof(Vec3f) + c.uvs * sizeof(Vec2f) + 4 * c.corners * sizeof(float);
        return corners + (twice ? copy : 0);
    };
    std::vector<LaterStep> steps;
    steps.push_back(
        {"", [=, format = mesh_format(args.out)](const DisplaceCount& c) {
             return attribute(c) + write_memory(format, {c.points, c.normals, c.uvs, c.faces, c.corners, parts});
         }});
    if (args.audit)
        steps.push_back({"audit", [=](const DisplaceCount& c) {
                             return attribute(c) + audit_memory(c.points, c.corners - 2 * c.faces);
                         }});
    return steps;
}

} // namespace bake
