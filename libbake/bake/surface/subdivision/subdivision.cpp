#include "bake/surface/subdivision/subdivision.h"
#include "bake/base/error.h"
#include "bake/surface/subdivision/stage.h"
#include <new>

namespace bake {

struct SubdivisionSurface::Limit {
    LimitPatches patches;
};

namespace {

[[noreturn]] void refuse_nothing_left(const Mesh& cage, const std::string& path) {
    const std::string why =
        cage.faces() == 0 ? "the cage has no faces; export it as a polygon mesh"
        : cage.tags.boundary == SubdivisionTags::Boundary::none
            ? "its boundary rule, interpolateboundary 0, leaves out the faces at the border, and the "
              "cage has no others; remove the tag, or write 1 (sharp corners) or 2 (round corners)"
            : "OpenSubdiv gives none of its faces a limit surface; check the cage";
    throw Error(Refusal::unsuitable, path + ": " + why);
}

} // namespace

SubdivisionSurface::SubdivisionSurface(const Mesh& cage, const SubdivisionOptions& options, const std::string& path)
    : limit_(std::make_unique<Limit>()) {
    if (cage.faces() == 0) refuse_nothing_left(cage, path);
    try {
        make_patches(cage, options, limit_->patches);
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, path +
                                             ": the subdivision surface does not fit in memory; use a smaller cage or "
                                             "fewer semi-sharp creases");
    }
    if (limit_->patches.patches.empty()) refuse_nothing_left(cage, path);
}
SubdivisionSurface::~SubdivisionSurface() = default;
SubdivisionSurface::SubdivisionSurface(SubdivisionSurface&&) noexcept = default;

std::uint32_t SubdivisionSurface::patches() const noexcept { return std::uint32_t(limit_->patches.patches.size()); }
std::uint32_t SubdivisionSurface::face(std::uint32_t patch) const noexcept {
    return limit_->patches.patches[patch].face;
}
std::uint32_t SubdivisionSurface::corner(std::uint32_t patch) const noexcept {
    return limit_->patches.patches[patch].corner;
}
bool SubdivisionSurface::has_uv() const noexcept { return limit_->patches.has_uv; }

void SubdivisionSurface::evaluate(std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
                                  std::span<LimitPoint> out) const noexcept {
    bake::evaluate(limit_->patches, patch, st, order, out);
}

void SubdivisionSurface::evaluate_lattice(std::uint32_t patch, int rate, Derivatives order,
                                          std::span<LimitPoint> out) const noexcept {
    evaluate_rows(patch, rate, 0, rate + 1, order, out);
}

void SubdivisionSurface::evaluate_rows(std::uint32_t patch, int rate, int row_begin, int row_end, Derivatives order,
                                       std::span<LimitPoint> out) const noexcept {
    bake::evaluate_rows(limit_->patches, patch, rate, row_begin, row_end, order, out);
}

} // namespace bake
