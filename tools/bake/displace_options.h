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
    std::string out, amplitude, edge_px, camera, max_error, max_memory;
    HeightArgs height;
    std::optional<double> midlevel;
    std::optional<int> levels;
    Seam seam = Seam::average;
    std::optional<VectorSpace> vector;
    Interpolation interpolation = Interpolation::c2;
    bool measure = false, margin = false, audit = false;
};

void add_displace_options(CLI::App& sub, DisplaceArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other, before anything is read.
void check_usage(const DisplaceArgs& args);
/// The level of a refinement or limit surface for which the user gives no rate.
inline constexpr int default_levels = 3;

/// Throws Error{Refusal::unsuitable} for a mesh without uvs and for a cage that has no limit surface. `notes` receives those
/// of read_mesh().
BaseSurface make_base(const DisplaceArgs& args);

/// The relief, and how its file is described.
struct ReliefFile {
    Relief relief;
    std::string described; ///< "8-bit height, 231 levels"
    bool default_amplitude = false;
    std::vector<std::string> notes; ///< doubts about the height
};
/// `size` is the diagonal of the surface, to which amplitudes in per cent refer.
ReliefFile load_relief(const DisplaceArgs& args, double size, const CommonArgs& common);

/// Reads the camera file if --camera names one. `origin` is that of the mesh.
DisplaceOptions resolve_options(const DisplaceArgs& args, double size, const Vec3d& origin);

/// "2G", "1.5GiB", "500M" or bytes. Throws Error{Refusal::usage}.
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);
/// "1.2 GiB".
std::string describe_bytes(double bytes);

} // namespace bake
