#include "bake/relief/transfer/debug_rays.h"
#include "bake/light/frame.h"
#include <cmath>

namespace bake {
namespace {

enum Part : std::uint32_t { cage, rays, misses };

class Drawing {
public:
    Drawing() { mesh_.materials = {"cage", "rays", "misses"}; }

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
        const Frame frame(unit_or_zero(along));
        const float wide = 0.02f * glm::length(along);
        std::uint32_t base[3];
        for (int k = 0; k < 3; ++k) {
            const auto angle = float(2 * pi * k / 3);
            base[k] = point(from + wide * (std::cos(angle) * frame.x + std::sin(angle) * frame.y));
        }
        const std::uint32_t tip = point(to);
        face({base[2], base[1], base[0]}, part);
        for (int k = 0; k < 3; ++k) face({base[k], base[(k + 1) % 3], tip}, part);
    }
    Mesh& mesh() noexcept { return mesh_; }

private:
    Mesh mesh_;
};

void draw_cage(const BakeTarget& target, const TransferSources& sources, Drawing& to) {
    for (const Triangle& t : target.surface.triangles) {
        const TransferSource* const source = sources.of(t.face);
        if (!source) continue;
        std::uint32_t at[3];
        for (std::size_t k = 0; k < 3; ++k) at[k] = to.point(source->casting->envelope(t.corner[k]));
        to.face({at[0], at[1], at[2]}, cage);
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
    Drawing out;
    out.mesh().origin = target.surface.mesh->origin;
    draw_cage(target, sources, out);
    const int width = result.states.width(), height = result.states.height();
    const int step = std::max(1, int(std::ceil(std::sqrt(double(width) * height / std::max(1, most)))));
    for (int y = step / 2; y < height; y += step)
        for (int x = step / 2; x < width; x += step) {
            const TexelHit& at = target.raster.hits.at(x, y);
            if (result.states.at(x, y) != TexelState::hit || at.triangle == no_index) continue;
            const TransferSource& source = *sources.of(target.surface.triangles[at.triangle].face);
            draw_cast(source.casting->at(at), *source.high, rays, out);
        }
    for (const Witness& witness : witnesses)
        if (const TransferSource* const source = sources.of(witness.face); source && witness.state != TexelState::hit)
            draw_cast(witness.cast, *source->high, misses, out);
    return std::move(out.mesh());
}

} // namespace bake
