#include "bake/relief/transfer/debug_rays.h"
#include "bake/light/frame.h"
#include <array>
#include <cmath>
#include <set>
#include <tuple>

namespace bake {
namespace {

enum Part : std::uint32_t { cage, rays, misses };

class Drawing {
public:
    explicit Drawing(const Mesh& low) : size_(float(diagonal(bounds(low)))) {
        mesh_.materials = {"cage", "rays", "misses"};
        mesh_.origin = low.origin;
    }

    std::uint32_t point(const Vec3f& p) {
        mesh_.positions.push_back(p);
        return std::uint32_t(mesh_.positions.size() - 1);
    }
    void face(std::initializer_list<std::uint32_t> points, Part part) {
        mesh_.corner_position.insert(mesh_.corner_position.end(), points);
        mesh_.face_begin.push_back(std::uint32_t(mesh_.corner_position.size()));
        mesh_.face_material.push_back(part);
    }
    /// A slender tetrahedron with its tip where the ray ends.
    void needle(const Vec3f& from, const Vec3f& to, Part part) {
        const Vec3f along = to - from;
        if (unit_or_zero(along) == Vec3f(0)) return;
        const float length = glm::length(along), wide = std::clamp(0.0015f * size_, 0.02f * length, 0.12f * length);
        const auto base = ring(from, Frame(unit_or_zero(along)), wide);
        const std::uint32_t tip = point(to);
        face({base[2], base[1], base[0]}, part);
        for (std::size_t k = 0; k < 3; ++k) face({base[k], base[(k + 1) % 3], tip}, part);
    }
    /// A prism of three sides, without its ends.
    void rod(const Vec3f& from, const Vec3f& to, Part part) {
        const Vec3f along = unit_or_zero(to - from);
        if (along == Vec3f(0)) return;
        const float wide = std::min(0.0008f * size_, 0.03f * glm::length(to - from));
        const Frame frame(along);
        const auto begin = ring(from, frame, wide), end = ring(to, frame, wide);
        for (std::size_t k = 0; k < 3; ++k) face({begin[k], begin[(k + 1) % 3], end[(k + 1) % 3], end[k]}, part);
    }
    Mesh& mesh() noexcept { return mesh_; }

private:
    /// Three points around `middle`, counter-clockwise about the axis of the frame.
    std::array<std::uint32_t, 3> ring(const Vec3f& middle, const Frame& frame, float wide) {
        std::array<std::uint32_t, 3> out;
        for (int k = 0; k < 3; ++k) {
            const auto angle = float(2 * pi * k / 3);
            out[std::size_t(k)] = point(middle + wide * (std::cos(angle) * frame.x + std::sin(angle) * frame.y));
        }
        return out;
    }

    Mesh mesh_;
    float size_; ///< of the low-poly mesh
};

/// The edges of the low-poly mesh's faces on the envelope, and nothing between them, so that what is inside shows.
void draw_cage(const BakeTarget& target, const TransferSources& sources, Drawing& to) {
    const Mesh& mesh = *target.surface.mesh;
    std::set<std::array<float, 6>> drawn; // faces share edges
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const TransferSource* const source = sources.of(f);
        if (!source) continue;
        for (std::uint32_t first = mesh.face_begin[f], end = mesh.face_begin[f + 1], c = first; c < end; ++c) {
            Vec3f a = source->casting->envelope(c), b = source->casting->envelope(c + 1 < end ? c + 1 : first);
            if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
            if (drawn.insert({a.x, a.y, a.z, b.x, b.y, b.z}).second) to.rod(a, b, cage);
        }
    }
}

void draw_cast(const Cast& cast, const HighSurface& high, Part part, Drawing& to) {
    Ray ray{cast.start, cast.inward};
    ray.t_max = cast.reach.front + cast.reach.back;
    const Hit hit = high.land(ray);
    to.needle(cast.start, cast.start + (hit ? hit.t : ray.t_max) * cast.inward, part);
}

} // namespace

Mesh debug_rays(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                std::span<const Witness> witnesses, int most) {
    Drawing out(*target.surface.mesh);
    draw_cage(target, sources, out);
    const int width = result.states.width(), height = result.states.height();
    const int step = std::max(1, int(std::ceil(std::sqrt(double(width) * height / std::max(1, most)))));
    for (int y = step / 2; y < height; y += step)
        for (int x = step / 2; x < width; x += step) {
            const TexelHit& at = target.raster.hits.at(x, y);
            if (result.states.at(x, y) != TexelState::hit || at.triangle == no_index) continue;
            if (const TransferSource* const source = sources.of(target.surface.triangles[at.triangle].face))
                draw_cast(source->casting->at(at), *source->high, rays, out);
        }
    for (const Witness& witness : witnesses)
        if (const TransferSource* const source = sources.of(witness.face); source && witness.state != TexelState::hit)
            draw_cast(witness.cast, *source->high, misses, out);
    return std::move(out.mesh());
}

} // namespace bake
