// subdivision_bench MESHES: compares the limit evaluator with the two evaluators of OpenSubdiv, Bfr (with its defaults, and at
// the level whose error is closest to that of bake) and Far (patch table, patch map and basis weights). All are in double, on
// one thread, over the same lattice of each patch. The construction of surfaces, tables and control points is not timed; its
// time is in the note. The error is the angle between the normal of the timed output and that of exact limit masks at all
// points of the lattice, or, without derivatives, the distance over the diagonal; the largest distance is in the note. MESHES is the folder that contains opensubdiv/ and spot/.
// size counts points; ratio is the time over that of Bfr at its defaults for the same derivatives.
#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/subdivision/subdivision.h"
#include "bench/bench.h"
#include "oracle/limit_masks.h"
#include "oracle/surfaces.h"
#include <memory>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

using namespace bake;
using namespace OpenSubdiv;

namespace {

constexpr int rate = 16, levels = 4; // the lattice, and the refinement levels of the oracle with the same points

// Points and first derivatives of the measured patches, (rate + 1)^2 each, in rows. There are 32 patches, distributed evenly
// over the cage: a round takes about a millisecond, which is seldom interrupted on a shared machine.
using Samples = std::vector<LimitPoint>;
constexpr std::size_t per_patch = (rate + 1) * (rate + 1);

std::vector<std::uint32_t> some_patches(std::uint32_t all) {
    std::vector<std::uint32_t> patches;
    const std::uint32_t count = std::min(all, 32u);
    for (std::uint32_t i = 0; i < count; ++i) patches.push_back(std::uint32_t(std::uint64_t(i) * all / count));
    return patches;
}

Vec2d lattice_point(std::size_t i) { return Vec2d(double(i % (rate + 1)) / rate, double(i / (rate + 1)) / rate); }

/// Angles of the normals where there are derivatives, else distances over the diagonal. The largest of these is also left in
/// position.
bench::Errors errors_of(const Samples& samples, const std::vector<std::uint32_t>& patches, const oracle::Cage& fine,
                        double diagonal, bool normals, double& position) {
    const oracle::LimitMasks masks(fine);
    std::vector<float> angles, distances;
    position = 0;
    for (std::uint32_t f = 0; f < fine.faces.size(); ++f)
        for (std::uint32_t k = 0; k < 4; ++k) {
            const oracle::Cage::Face& face = fine.faces[f];
            const auto found = std::lower_bound(patches.begin(), patches.end(), face.patch);
            if (found == patches.end() || *found != face.patch) continue;
            const Vec2d at = double(rate) * face.st[k];
            const auto index =
                std::size_t(found - patches.begin()) * per_patch + std::size_t(at.y) * (rate + 1) + std::size_t(at.x);
            const oracle::Limit limit = masks.at(f, k);
            distances.push_back(float(glm::distance(samples[index].p, limit.p) / diagonal));
            position = std::max(position, double(distances.back()));
            if (normals && limit.normal && glm::length(*limit.normal) > 1e-12 * diagonal * diagonal)
                angles.push_back(
                    float(oracle::angle_deg(*limit.normal, glm::cross(samples[index].p_s, samples[index].p_t))));
        }
    return bench::errors_of(normals ? std::move(angles) : std::move(distances));
}

struct Value {
    Vec3d p{0};
    void Clear() noexcept { p = Vec3d(0); }
    void AddWithWeight(const Value& other, double weight) noexcept { p += weight * other.p; }
};

std::unique_ptr<Far::TopologyRefiner> refiner_of(const Mesh& cage) {
    std::vector<int> sizes, creases;
    std::vector<float> weights;
    for (std::size_t f = 0; f < cage.faces(); ++f) sizes.push_back(int(cage.face_begin[f + 1] - cage.face_begin[f]));
    for (const auto& crease : cage.tags.creases) {
        creases.insert(creases.end(), {int(crease.a), int(crease.b)});
        weights.push_back(crease.sharpness);
    }
    Far::TopologyDescriptor of;
    of.numVertices = int(cage.positions.size());
    of.numFaces = int(sizes.size());
    of.numVertsPerFace = sizes.data();
    of.vertIndicesPerFace = reinterpret_cast<const int*>(cage.corner_position.data());
    of.numCreases = int(weights.size());
    of.creaseVertexIndexPairs = creases.data();
    of.creaseWeights = weights.data();
    Sdc::Options rules;
    rules.SetVtxBoundaryInterpolation(cage.tags.boundary == SubdivisionTags::Boundary::edge_and_corner
                                          ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                          : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(of, Factory::Options(Sdc::SCHEME_CATMARK, rules)));
}

// Bfr: one surface per face, with its patch points.
class BfrSurfaces {
public:
    BfrSurfaces(const Mesh& cage, const Far::TopologyRefiner& refiner, int level) : faces_(cage.faces()) {
        Bfr::SurfaceFactory::Options options;
        if (level > 0) options.SetApproxLevelSmooth(level).SetApproxLevelSharp(level);
        const Bfr::RefinerSurfaceFactory<> factory(refiner, options);
        std::vector<double> positions;
        for (const Vec3f& p : cage.positions)
            for (int k = 0; k < 3; ++k) positions.push_back(double(p[k]));
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            Face& face = faces_[f];
            factory.InitVertexSurface(int(f), &face.surface);
            face.points.resize(std::size_t(face.surface.GetNumPatchPoints() * 3));
            face.surface.PreparePatchPoints(positions.data(), {3, 3}, face.points.data(), {3, 3});
        }
    }
    /// The lattice in each patch.
    void place(const SubdivisionSurface& surface, const std::vector<std::uint32_t>& patches) {
        for (const std::uint32_t patch : patches) {
            const Face& face = faces_[surface.face(patch)];
            const Bfr::Parameterization& parameters = face.surface.GetParameterization();
            places_.push_back({&face, {}});
            for (std::size_t i = 0; i < per_patch; ++i) {
                Vec2d st = lattice_point(i), uv = st;
                if (parameters.HasSubFaces())
                    parameters.ConvertNormalizedSubFaceToCoord(int(surface.corner(patch)), &st.x, &uv.x);
                places_.back().at.push_back(uv);
            }
        }
    }
    void evaluate(bool derivatives, Samples& out) const {
        LimitPoint* p = out.data();
        for (const Place& place : places_)
            for (const Vec2d& at : place.at) {
                if (derivatives)
                    place.face->surface.Evaluate(&at.x, place.face->points.data(), {3, 3}, &p->p.x, &p->p_s.x,
                                                 &p->p_t.x);
                else place.face->surface.Evaluate(&at.x, place.face->points.data(), {3, 3}, &p->p.x);
                ++p;
            }
    }

private:
    struct Face {
        Bfr::Surface<double> surface;
        std::vector<double> points;
    };
    struct Place {
        const Face* face;
        std::vector<Vec2d> at;
    };
    std::vector<Face> faces_;
    std::vector<Place> places_;
};

// Far: finds the patch by the patch map, computes the weights of its points, and sums them.
class FarTable {
public:
    FarTable(const Mesh& cage, Far::TopologyRefiner& refiner, int level) {
        Far::PatchTableFactory::Options options{unsigned(level)};
        options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
        options.SetPatchPrecision<double>();
        options.useInfSharpPatch = true;
        options.generateLegacySharpCornerPatches = false;
        refiner.RefineAdaptive(options.GetRefineAdaptiveOptions());
        table_.reset(Far::PatchTableFactory::Create(refiner, options));
        map_ = std::make_unique<Far::PatchMap>(*table_);
        points_.resize(std::size_t(refiner.GetNumVerticesTotal() + table_->GetNumLocalPoints()));
        for (std::size_t i = 0; i < cage.positions.size(); ++i) points_[i].p = Vec3d(cage.positions[i]);
        const Far::PrimvarRefinerReal<double> primvars(refiner);
        Value* from = points_.data();
        for (int i = 1; i <= refiner.GetMaxLevel(); ++i) {
            Value* to = from + refiner.GetLevel(i - 1).GetNumVertices();
            primvars.Interpolate(i, from, to);
            from = to;
        }
        if (table_->GetNumLocalPoints() > 0)
            table_->GetLocalPointStencilTable<double>()->UpdateValues(points_.data(),
                                                                      points_.data() + refiner.GetNumVerticesTotal());
    }
    void evaluate(const std::vector<std::uint32_t>& patches, bool derivatives, Samples& out) const {
        LimitPoint* p = out.data();
        double w[20], ds[20], dt[20];
        for (const std::uint32_t patch : patches)
            for (std::size_t i = 0; i < per_patch; ++i, ++p) {
                const Vec2d st = lattice_point(i);
                const Far::PatchMap::Handle* handle = map_->FindPatch(int(patch), st.x, st.y);
                table_->EvaluateBasis(*handle, st.x, st.y, w, derivatives ? ds : nullptr, derivatives ? dt : nullptr);
                const Far::ConstIndexArray index = table_->GetPatchVertices(*handle);
                p->p = p->p_s = p->p_t = Vec3d(0);
                for (int k = 0; k < index.size(); ++k) {
                    const Vec3d& q = points_[std::size_t(index[k])].p;
                    p->p += w[k] * q;
                    if (derivatives) p->p_s += ds[k] * q, p->p_t += dt[k] * q;
                }
            }
    }

private:
    std::unique_ptr<Far::PatchTable> table_;
    std::unique_ptr<Far::PatchMap> map_;
    std::vector<Value> points_;
};

double case_of(const std::string& name, const std::string& file) {
    Mesh cage = read_mesh(file);
    check_cage(cage, Scheme::catmark, file);
    cage.corner_uv.clear(); // Bfr and Far have no uvs either
    const double size = diagonal(bounds(cage));
    oracle::Cage fine = oracle::cage_of(cage, Scheme::catmark);
    for (int i = 0; i < levels; ++i) fine = oracle::subdivide(fine);

    std::unique_ptr<SubdivisionSurface> ours;
    std::unique_ptr<BfrSurfaces> bfr, fine_bfr;
    std::unique_ptr<FarTable> far;
    const auto refiner = refiner_of(cage), far_refiner = refiner_of(cage);
    const double make_ours = bench::seconds([&] { ours = std::make_unique<SubdivisionSurface>(cage); });
    const double make_bfr = bench::seconds([&] { bfr = std::make_unique<BfrSurfaces>(cage, *refiner, 0); });
    const double make_fine = bench::seconds([&] { fine_bfr = std::make_unique<BfrSurfaces>(cage, *refiner, 10); });
    const double make_far = bench::seconds([&] { far = std::make_unique<FarTable>(cage, *far_refiner, 10); });

    const std::vector<std::uint32_t> patches = some_patches(ours->patches());
    const std::size_t count = per_patch * patches.size();
    bfr->place(*ours, patches);
    fine_bfr->place(*ours, patches);
    std::vector<Vec2d> lattice;
    for (std::size_t i = 0; i < per_patch; ++i) lattice.push_back(lattice_point(i));
    std::vector<Samples> out(5, Samples(count));
    double speed_up = 0;
    for (const bool derivatives : {false, true}) {
        const Derivatives order = derivatives ? Derivatives::first : Derivatives::none;
        const auto patch_of = [&](Samples& samples, std::size_t i) {
            return std::span(samples).subspan(i * per_patch, per_patch);
        };
        std::vector<double> position(5);
        const std::vector<std::function<void()>> ways = {
            [&] { bfr->evaluate(derivatives, out[0]); }, [&] { fine_bfr->evaluate(derivatives, out[1]); },
            [&] { far->evaluate(patches, derivatives, out[2]); },
            [&] {
                for (std::size_t i = 0; i < patches.size(); ++i)
                    ours->evaluate(patches[i], lattice, order, patch_of(out[3], i));
            },
            [&] {
                for (std::size_t i = 0; i < patches.size(); ++i)
                    ours->evaluate_lattice(patches[i], rate, order, patch_of(out[4], i));
            }};
        std::vector<bench::Work> works;
        for (std::size_t i = 0; i < ways.size(); ++i)
            works.push_back({[&, i]() -> const Samples& { return ways[i](), out[i]; },
                             [&, i](const Samples& samples) {
                                 return errors_of(samples, patches, fine, size, derivatives, position[i]);
                             }});
        const std::vector<bench::Measured> found = bench::in_turn(51, {}, works).works;
        const char* names[] = {"bfr", "bfr_level10", "far_level10", "points", "lattice"};
        const double made[] = {make_bfr, make_fine, make_far, make_ours, make_ours};
        for (std::size_t i = 0; i < found.size(); ++i)
            bench::print_row(found[i],
                             {"subdivision", name + (derivatives ? "_P_Du_Dv_" : "_P_") + names[i], std::int64_t(count),
                              double(count), found[i].ratio_to(found[0]), "bfr",
                              (derivatives ? "" : "errors are distances over the diagonal; ") +
                                  bench::text("position error %.2g of the diagonal; %.1f M points/s; made in %.1f ms",
                                              position[i], double(count) / found[i].median() * 1e-6, made[i] * 1e3)});
        if (derivatives) speed_up = 1 / found[4].ratio_to(found[0]);
    }
    std::vector<LimitPoint> patch(per_patch);
    const auto lattices = [&] {
        for (const std::uint32_t p : patches) ours->evaluate_lattice(p, rate, Derivatives::second, patch);
    };
    const bench::Times second = bench::in_turn(51, {lattices}, {}).limits[0];
    std::printf("# %s: second derivatives too, lattice by lattice in the cache: %.1f ns per point\n", name.c_str(),
                second.median() / double(count) * 1e9);
    return speed_up;
}

} // namespace

int main(int argc, char** argv) {
    const std::string meshes = argc > 1 ? argv[1] : "../shared/data/meshes";
    const ThreadLimit one(1);
    double sum = 0;
    const std::pair<const char*, const char*> cases[] = {{"torus", "/opensubdiv/catmark_torus.obj"},
                                                         {"spot", "/spot/spot_control_mesh.obj"},
                                                         {"nonquads", "/opensubdiv/catmark_nonquads.obj"}};
    for (const auto& [name, file] : cases) sum += case_of(name, meshes + file);
    std::printf("# %.1f times as fast as Bfr with first derivatives, on average\n", sum / 3);
}
