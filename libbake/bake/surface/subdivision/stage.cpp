#include "bake/surface/subdivision/stage.h"
#include <algorithm>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/sdc/crease.h>

namespace bake {
namespace {

using namespace OpenSubdiv;

Stage first_stage(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit) {
    Stage stage;
    UvValues uvs = uv_values(cage);
    limit.has_uv = !uvs.corner.empty();
    stage.refiner = make_refiner(refiner_input(cage, uvs), cage.tags.boundary, options);
    for (const Vec3f& p : cage.positions) stage.points.push_back({Vec3d(p)});
    stage.uvs = std::move(uvs.values);
    stage.levels = stage.total_levels = first_levels;
    for (std::uint32_t f = 0; f < cage.faces(); ++f) {
        const std::uint32_t size = cage.face_begin[f + 1] - cage.face_begin[f];
        const std::uint32_t patches = limit.triangles || size == 4 ? 1 : size;
        stage.first.push_back(int(limit.patches.size()));
        for (std::uint32_t corner = 0; corner < patches; ++corner) {
            stage.subdomains.push_back({std::int32_t(limit.patches.size())});
            limit.patches.push_back({f, corner, missing_leaf});
        }
    }
    return stage;
}

/// Whether patches along semi-sharp creases are cut into pieces (crease_pieces.h) and not refined. Far does not keep the crease in uvs
/// that are smoothed up to a seam which meets it.
bool cuts_creases(const Stage& stage, bool uvs, const SubdivisionOptions& options) {
    if (options.scheme != Scheme::catmark) return false;
    if (!uvs || options.uv != UvSmoothing::all) return true;
    const Far::TopologyLevel& level = stage.refiner->GetLevel(0);
    for (int e = 0; e < level.GetNumEdges(); ++e) {
        const float sharpness = level.GetEdgeSharpness(e);
        if (!(sharpness > 0 && sharpness < Sdc::Crease::SHARPNESS_INFINITE)) continue;
        for (const Far::Index v : level.GetEdgeVertices(e))
            if (!level.DoesVertexFVarTopologyMatch(v)) return false;
    }
    return true;
}

std::unique_ptr<Far::PatchTable> refine_topology(Stage& stage, bool uvs, bool cut_creases) {
    Far::PatchTableFactory::Options options(unsigned(stage.levels));
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    options.SetFVarPatchPrecision<double>();
    options.useInfSharpPatch = true;
    options.useSingleCreasePatch = cut_creases;
    options.generateVaryingTables = false;
    options.generateFVarTables = uvs;
    options.generateFVarLegacyLinearPatches = false;
    options.generateLegacySharpCornerPatches = false; // else Far treats smooth corners of the border as sharp
    Far::TopologyRefiner::AdaptiveOptions adaptive = options.GetRefineAdaptiveOptions();
    adaptive.SetSecondaryLevel(stage.levels);
    const Far::ConstIndexArray faces(stage.faces.data(), int(stage.faces.size()));
    stage.refiner->RefineAdaptive(adaptive, faces);
    return std::unique_ptr<Far::PatchTable>(Far::PatchTableFactory::Create(*stage.refiner, options, faces));
}

// Extends the values of the cage to all levels and to the local points of the patches.
template <class V>
void refine_values(const Far::TopologyRefiner& refiner, const Far::StencilTableReal<double>* local, bool face_varying,
                   std::vector<Weighted<V>>& values) {
    const int total = face_varying ? refiner.GetNumFVarValuesTotal(0) : refiner.GetNumVerticesTotal();
    const int own = local ? local->GetNumStencils() : 0;
    values.resize(std::size_t(total + own));
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    Weighted<V>* from = values.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        const Far::TopologyLevel& parent = refiner.GetLevel(level - 1);
        Weighted<V>* to = from + (face_varying ? parent.GetNumFVarValues(0) : parent.GetNumVertices());
        if (face_varying) primvars.InterpolateFaceVarying(level, from, to, 0);
        else primvars.Interpolate(level, from, to);
        from = to;
    }
    if (own > 0) local->UpdateValues(values.data(), values.data() + total);
}

bool has_irregular(const Far::PatchTable& table) {
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        if (is_irregular(table, array) && table.GetNumPatches(array) > 0) return true;
    return false;
}

} // namespace

void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit) {
    limit.triangles = options.scheme == Scheme::loop;
    Stage stage = first_stage(cage, options, limit);
    const double size = diagonal(bounds(cage));
    for (;;) {
        const auto table = refine_topology(stage, limit.has_uv, cuts_creases(stage, limit.has_uv, options));
        refine_values(*stage.refiner, table->GetLocalPointStencilTable<double>(), false, stage.points);
        if (limit.has_uv)
            refine_values(*stage.refiner, table->GetLocalPointFaceVaryingStencilTable<double>(0), true, stage.uvs);
        std::vector<int> to_refine;
        std::vector<Subdomain> last;
        if (stage.total_levels + further_levels <= most_normal_levels && has_irregular(*table)) {
            last = last_subdomains(stage, limit.triangles);
            to_refine = faces_to_refine(stage, *table, last, size, limit.triangles);
        }
        add_leaves(stage, *table, to_refine, limit);
        if (std::all_of(to_refine.begin(), to_refine.end(), [](int f) { return f < 0; })) break;
        stage = next_stage(stage, to_refine, last, options, limit);
    }
    // With boundary rule 0 the border faces have no surface.
    std::erase_if(limit.patches, [&](const LimitPatch& patch) { return !is_complete(limit, patch.root); });
}

} // namespace bake
