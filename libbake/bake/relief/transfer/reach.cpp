#include "bake/relief/transfer/reach.h"
#include "bake/base/parallel.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <atomic>
#include <cmath>

namespace bake {
namespace {

constexpr std::size_t most_samples = 150000; ///< corners of the high-poly mesh; its neighbours are as far away
constexpr double farthest = 0.1; ///< of the diagonal of the low-poly mesh: what is beyond belongs to something else
constexpr float wider = 1.2f, least = 1e-4f; ///< of the extremes; of the diagonal

void raise(float& value, float to) noexcept {
    std::atomic_ref<float> shared(value);
    for (float old = shared.load(); to > old && !shared.compare_exchange_weak(old, to);) {
    }
}

/// Extremes of the signed distance; low above high where nothing was measured.
struct Extremes {
    float out = -1, in = -1; ///< at least 0 once measured
    bool measured() const noexcept { return out >= 0; }
    void include(const Extremes& other) noexcept { out = std::max(out, other.out), in = std::max(in, other.in); }
};

std::vector<Triangle> triangles_of(const MeshSurface& low, std::span<const std::uint8_t> faces) {
    if (faces.empty()) return low.triangles;
    std::vector<Triangle> out;
    for (const Triangle& t : low.triangles)
        if (faces[t.face]) out.push_back(t);
    return out;
}

class Measure {
public:
    Measure(const MeshSurface& low, const HighSurface& high, std::span<const std::uint8_t> faces)
        : low_(low), high_(high), vertex_(first_equal(low.mesh->positions)), triangles_(triangles_of(low, faces)),
          tree_(*low.mesh, triangles_), most_(farthest * diagonal(bounds(*low.mesh))),
          extremes_(low.mesh->positions.size()) {
        std::size_t all = 0;
        for (std::size_t i = 0; i < high.count(); ++i) all += high.triangles(i).size();
        const std::size_t stride = all / most_samples + 1;
        for (std::size_t i = 0; i < high.count(); ++i)
            for_rows(std::int64_t((high.triangles(i).size() + stride - 1) / stride), 1024,
                     [&](std::int64_t begin, std::int64_t end) {
                         std::uint32_t start = no_index;
                         for (std::int64_t t = begin; t < end; ++t)
                             add(i, std::uint32_t(std::size_t(t) * stride), start);
                     });
        spread();
    }
    const std::vector<Extremes>& extremes() const noexcept { return extremes_; }
    const std::vector<std::uint32_t>& vertex() const noexcept { return vertex_; }

private:
    void add(std::size_t mesh, std::uint32_t triangle, std::uint32_t& start) {
        const Mesh& detail = high_.mesh(mesh);
        const std::uint32_t corner = high_.triangles(mesh)[triangle].corner[triangle % 3];
        const Vec3d p(detail.positions[detail.corner_position[corner]]);
        const NearestPoint nearest = tree_.nearest(p, start);
        start = nearest.triangle;
        if (start == no_index || !(nearest.distance2 <= most_ * most_)) return;
        const Triangle& below = triangles_[tree_.index(start)];
        const auto& c = tree_.corners(start);
        const Vec3f n = glm::cross(c[1] - c[0], c[2] - c[0]);
        if (!(glm::dot(n, high_.facet_normal(mesh, triangle)) > 0)) return;
        const auto distance = float(std::sqrt(nearest.distance2));
        const bool outside = glm::dot(Vec3d(n), p - nearest.point) >= 0;
        for (const std::uint32_t k : below.corner) {
            Extremes& at = extremes_[vertex_[low_.mesh->corner_position[k]]];
            raise(at.out, outside ? distance : 0), raise(at.in, outside ? 0 : distance);
        }
    }
    /// To the neighbours, so that detail that hangs over an edge is within reach of both sides.
    void spread() {
        std::vector<Extremes> wide = extremes_;
        for (const Triangle& t : triangles_) {
            Extremes all;
            for (const std::uint32_t k : t.corner) all.include(extremes_[vertex_[low_.mesh->corner_position[k]]]);
            for (const std::uint32_t k : t.corner) wide[vertex_[low_.mesh->corner_position[k]]].include(all);
        }
        extremes_ = std::move(wide);
    }

    const MeshSurface& low_;
    const HighSurface& high_;
    std::vector<std::uint32_t> vertex_;
    std::vector<Triangle> triangles_;
    TriangleTree tree_;
    double most_;
    std::vector<Extremes> extremes_; ///< of the first of equal positions
};

/// Per position, the least cosine between the mean direction there and a facet.
std::vector<float> least_cosines(const MeshSurface& low, const std::vector<std::uint32_t>& vertex) {
    const Mesh& mesh = *low.mesh;
    std::vector<Vec3f> sum(mesh.positions.size(), Vec3f(0));
    const auto facet = [&](const Triangle& t) {
        const auto at = [&](std::size_t k) { return mesh.positions[mesh.corner_position[t.corner[k]]]; };
        return unit_or_zero(glm::cross(at(1) - at(0), at(2) - at(0)));
    };
    for (const Triangle& t : low.triangles)
        for (const std::uint32_t k : t.corner) sum[vertex[mesh.corner_position[k]]] += facet(t);
    std::vector<float> cosine(mesh.positions.size(), 1);
    for (const Triangle& t : low.triangles)
        for (const std::uint32_t k : t.corner) {
            float& least_cosine = cosine[vertex[mesh.corner_position[k]]];
            least_cosine =
                std::min(least_cosine, glm::dot(facet(t), unit_or_zero(sum[vertex[mesh.corner_position[k]]])));
        }
    return cosine;
}

} // namespace

std::vector<Reach> measured_reach(const MeshSurface& low, const HighSurface& high,
                                  std::span<const std::uint8_t> faces) {
    const Measure measure(low, high, faces);
    const std::vector<std::uint32_t>& vertex = measure.vertex();
    const std::vector<float> cosine = least_cosines(low, vertex);
    const auto extent = float(diagonal(bounds(*low.mesh)));
    Extremes all;
    for (const Extremes& own : measure.extremes()) all.include(own);
    if (!all.measured()) all = {0.02f * extent, 0.02f * extent}; // nothing is near: a search that finds nothing
    std::vector<Reach> reach(vertex.size());
    for (std::size_t i = 0; i < reach.size(); ++i) {
        const Extremes& own = measure.extremes()[vertex[i]];
        const Extremes& at = own.measured() ? own : all;
        const float margin = 0.1f * (at.out + at.in) + least * extent, skew = 1 / std::max(0.35f, cosine[vertex[i]]);
        reach[i] = {skew * (wider * at.out + margin), 2 * skew * (wider * at.in + margin),
                    blend_width(wider * at.out, wider * at.in)};
    }
    return reach;
}

std::vector<Reach> constant_reach(const MeshSurface& low, const Reach& reach) {
    return std::vector<Reach>(low.mesh->positions.size(), reach);
}

} // namespace bake
