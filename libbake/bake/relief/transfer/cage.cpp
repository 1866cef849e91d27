#include "bake/relief/transfer/cage.h"
#include "bake/mesh/weld.h"
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <algorithm>

namespace bake {
namespace {

constexpr int rounds = 10, steps = 2;    ///< of smoothing; after each round distances are raised to what is needed
constexpr std::size_t high_valence = 64; ///< faces at a vertex, from which on add_face() takes too long
constexpr double least_cosine = 0.35;    ///< as in measured_reach()

/// Of a vertex.
struct Push {
    Vec3d direction{0};
    double needed = 0; ///< along it
};

/// Calls visit(corner, cast) for each corner of each triangle that has a source.
template <class Visit> void for_casts(const MeshSurface& low, const TransferSources& sources, const Visit& visit) {
    for (std::uint32_t t = 0; t < low.triangles.size(); ++t) {
        const TransferSource* const source = sources.of(low.triangles[t].face);
        for (std::size_t k = 0; k < 3 && source; ++k)
            visit(low.triangles[t].corner[k], source->casting->at({t, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f}));
    }
}

double needed_of(const Reach& reach) noexcept { return std::max(double(reach.front), 0.5 * double(reach.back)); }

std::vector<Push> pushes(const MeshSurface& low, const TransferSources& sources,
                         const std::vector<std::uint32_t>& vertex) {
    const Mesh& mesh = *low.mesh;
    std::vector<Push> out(vertex.size());
    const auto of = [&](std::uint32_t corner) -> Push& { return out[vertex[mesh.corner_position[corner]]]; };
    double most = 0;
    for_casts(low, sources, [&](std::uint32_t corner, const Cast& cast) {
        of(corner).direction -= Vec3d(cast.inward);
        most = std::max(most, needed_of(cast.reach));
    });
    for (Push& push : out) push.direction = unit_or_zero(push.direction);
    for_casts(low, sources, [&](std::uint32_t corner, const Cast& cast) {
        Push& push = of(corner);
        const double cosine = std::max(least_cosine, -glm::dot(push.direction, Vec3d(cast.inward)));
        push.needed = std::max(push.needed, needed_of(cast.reach) / cosine);
    });
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        Push& push = of(std::uint32_t(c));
        if (push.needed == 0) push = {Vec3d(low.n[c]), most};
    }
    return out;
}

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Graph = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

/// The vertices and faces of the mesh, without positions. Faces that OpenMesh cannot represent are left out.
Graph graph_of(const Mesh& mesh, const std::vector<std::uint32_t>& vertex) {
    // OpenMesh reports each refused face on stderr, which is ours to write.
    [[maybe_unused]] static const bool silenced = (omerr().disable(), true);
    std::vector<std::size_t> valence(vertex.size());
    for (const std::uint32_t position : mesh.corner_position) ++valence[vertex[position]];
    Graph graph;
    for (std::size_t v = 0; v < vertex.size(); ++v) graph.add_vertex({0, 0, 0});
    std::vector<OpenMesh::VertexHandle> ring;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        ring.clear();
        bool simple = true;
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            const std::uint32_t v = vertex[mesh.corner_position[c]];
            ring.emplace_back(int(v));
            simple = simple && valence[v] <= high_valence;
        }
        std::vector<OpenMesh::VertexHandle> sorted = ring;
        std::sort(sorted.begin(), sorted.end());
        if (simple && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) graph.add_face(ring);
    }
    return graph;
}

/// Raises what is needed to smooth distances: the points of the graph are the distances, on a line.
std::vector<double> smoothed(Graph graph, const std::vector<Push>& pushes) {
    const auto point = [&](std::size_t v) { return OpenMesh::VertexHandle(int(v)); };
    for (std::size_t v = 0; v < pushes.size(); ++v) graph.set_point(point(v), {pushes[v].needed, 0, 0});
    using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Graph>;
    Smoother smoother(graph);
    smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
    for (int round = 0; round < rounds; ++round) {
        smoother.smooth(steps);
        for (std::size_t v = 0; v < pushes.size(); ++v)
            graph.set_point(point(v), {std::max(pushes[v].needed, graph.point(point(v))[0]), 0, 0});
    }
    std::vector<double> out;
    for (std::size_t v = 0; v < pushes.size(); ++v) out.push_back(graph.point(point(v))[0]);
    return out;
}

} // namespace

Mesh envelope_cage(const MeshSurface& low, const TransferSources& sources) {
    Mesh cage = *low.mesh;
    const std::vector<std::uint32_t> vertex = first_equal(cage.positions);
    const std::vector<Push> push = pushes(low, sources, vertex);
    const std::vector<double> distance = smoothed(graph_of(cage, vertex), push);
    for (std::size_t i = 0; i < cage.positions.size(); ++i)
        cage.positions[i] = Vec3f(Vec3d(cage.positions[i]) + distance[vertex[i]] * push[vertex[i]].direction);
    cage.normals.clear(), cage.corner_normal.clear(), cage.tangents.clear(), cage.attributes.clear(), cage.tags = {};
    return cage;
}

} // namespace bake
