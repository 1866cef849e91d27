// Options of bake displace, and the inputs of the library that follow from them.
#pragma once
#include "bake/relief/displace/displace.h"
#include "inputs/surface_input.h"

namespace bake {

/// The surface that is displaced.
enum class BaseKind {
    automatic, ///< none without rates, linear with them
    none,      ///< the vertices of the mesh
    linear,    ///< the mesh, with its faces cut finer
    catmark,   ///< the limit surface of the mesh as a cage, by Catmull-Clark
    loop,      ///< the same by Loop
};

struct DisplaceArgs {
    SurfaceInput surface;
    BaseKind kind = BaseKind::automatic;
    std::optional<std::pair<int, int>> cells; ///< of a shape
    std::string out, camera;
    HeightInput height;
    std::optional<Length> max_error;
    std::optional<double> edge_px;
    std::optional<int> levels;
    Seam seam = DisplaceOptions{}.seam;
    std::optional<VectorSpace> vector;
    Interpolation interpolation = Interpolation::c2;
    bool measure = false, margin = false, audit = false, tangents = false;
    std::optional<std::uint64_t> max_memory;
};

void add_displace_options(CLI::App& sub, DisplaceArgs& args);
/// Completes the options that depend on each other. Throws Error{Refusal::usage} for those that contradict each other,
/// before anything is read.
void complete(DisplaceArgs& args);
/// Whether the result has the faces of the mesh.
bool keeps_faces(const DisplaceArgs& args);
/// The level of a refinement or limit surface for which the user gives no rate.
inline constexpr int default_levels = 3;

/// Throws Error{Refusal::unsuitable} for a mesh without uvs and for a cage that has no limit surface.
BaseSurface make_base(const DisplaceArgs& args);

/// The relief, and how its file is described.
struct ReliefFile {
    Relief relief;
    std::string described;          ///< "8-bit height, 231 levels"
    std::vector<std::string> notes; ///< doubts about the height
    std::string amplitude_note;     ///< which amplitude stands in for one that the user did not give; may be empty
};
/// `size` is the diagonal of the surface, to which amplitudes in per cent refer.
ReliefFile load_relief(const DisplaceArgs& args, double size, const CommonArgs& common);

/// Reads the camera file if --camera names one. `origin` is that of the mesh.
DisplaceOptions resolve_options(const DisplaceArgs& args, double size, const Vec3d& origin);

} // namespace bake
