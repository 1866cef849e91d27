// What viewers that decode a normal map in different ways make of it on a mesh.
#pragma once
#include "bake/relief/map/bake_target.h"
#include "bake/relief/transfer/seams.h"
#include "bake/verdict/inspect.h"

namespace bake {

/// Ways to turn the colour of a texel into a normal of the surface.
enum class Decoding {
    mikktspace,     ///< T and N interpolated as they are, B = sign (N x T): what bakers write for
    green_over,     ///< the same, with green the other way up
    unit_frame,     ///< T, B and N made perpendicular and of unit length at each point
    uv_derivatives, ///< the frame of p_u and p_v of the triangle, with the interpolated N: no tangents needed
};
inline constexpr Decoding all_decodings[] = {Decoding::mikktspace, Decoding::green_over, Decoding::unit_frame,
                                             Decoding::uv_derivatives};
/// "MikkTSpace", and the viewers that are known to do so.
const char* name(Decoding decoding) noexcept;
std::string viewers_of(Decoding decoding, bool directx);

/// The unit normal at a point, zero where there is none. `t`: decoded from the map with green up; of any length.
/// uv_derivatives: Mikkelsen's perturbation by derivatives, as Schueler, Normal Mapping without Precomputed Tangents,
/// ShaderX 5, 2006, has it; T and B keep their ratio of lengths.
Vec3f decoded(const BakeTarget& target, const TexelHit& at, const Vec3f& t, Decoding decoding) noexcept;

/// Degrees between a decoding and MikkTSpace, over texels of the charts.
struct DecodedError {
    Decoding decoding = Decoding::mikktspace;
    double mean = 0, percentile_95 = 0, max = 0;
};

struct DecodeReport {
    std::string file, mesh;
    int width = 0, height = 0;
    int tile = 0;                     ///< UDIM number of the tile of the charts; 0: all charts, modulo 1
    bool directx = false;             ///< which green was taken for right
    std::int64_t texels = 0;          ///< that were compared
    std::vector<DecodedError> errors; ///< in the order of all_decodings, without the first
    SeamDisagreement seams;
    double relief_deg = 0; ///< mean angle between the map's normals and those of the mesh, to compare the errors with
    Findings findings;
};

/// `directx`: the map was made with green down. `tile`: UDIM number of the tile that it was baked for; 0: all charts,
/// modulo 1. Throws as read_image() and read_mesh(), and Error{Refusal::unsuitable} for a mesh without uvs and a
/// picture with one channel or values that are not finite.
DecodeReport inspect_decoding(const std::string& map_path, const std::string& mesh_path, bool directx,
                              const InspectOptions& options = {}, int tile = 0);

std::string to_text(const DecodeReport& report);
std::string to_json(const DecodeReport& report);

} // namespace bake
