// What bake displace reports, as text, as notes and as JSON.
#pragma once
#include "bake/mesh/check/mesh_audit.h"
#include "bake/relief/displace/facet_loss.h"
#include "displace_options.h"

namespace bake {

/// Everything that the report shows.
struct DisplaceOutcome {
    std::string described; ///< the height file
    std::string base;      ///< "mesh", "catmark limit", "shape"
    std::size_t patches = 0;
    double size = 0;      ///< diagonal of the base
    double edge = 0;      ///< mean edge of the result
    double max_error = 0; ///< the limit that the user gave, object units
    double amplitude = 0, midlevel = 0;
    std::string amplitude_note;     ///< as in ReliefFile
    std::vector<std::string> notes; ///< doubts about the height
    DisplaceReport report;
    FacetLoss facets; ///< predicted
    std::optional<MeshAudit> audit;
    std::uintmax_t file_bytes = 0;
    std::vector<std::string> mesh_notes; ///< of reading the mesh
    std::size_t base_faces = 0;
};

std::string to_text(const DisplaceArgs& args, const DisplaceOutcome& outcome);
nlohmann::json to_json(const DisplaceArgs& args, const DisplaceOutcome& outcome);
/// A note for everything in the result that the user probably did not want.
void warn(const DisplaceArgs& args, const CommonArgs& common, const DisplaceOutcome& outcome);

} // namespace bake
