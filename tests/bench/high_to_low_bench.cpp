// high_to_low_bench
//
// Time and error of relief/transfer on the reference job: a torus of 4096 triangles takes the relief of one of a million, 1 and
// 4 x 4 rays per texel, with smooth and with curved normals. Trees, tangents and the raster of centres are made before. The
// limit is Embree alone: the same rays, made before and in the order of the texels, in coherent packets of 16 through a tree with
// the same flags. The map has 512^2 texels for several rays, because the limit keeps all rays in memory. Errors are those of every
// 16th texel against the exact normals of the relief, over the ray or over the texel.
#include "bake/relief/transfer/gauss_legendre.h"
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/transfer.h"
#include "bench.h"
#include "relief/transfer/relief_torus.h"
#include <atomic>
#include <embree3/rtcore.h>

using namespace bake;
using oracle::TorusRelief;

namespace {

/// Rays as Embree takes them, the rays of 16 samples in each element.
using Packets = std::vector<RTCRay16>;

/// The rays of a map, texel by texel; for one ray of each texel in blocks of 4 x 4.
Packets packets_of(const MeshSurface& low, const Casting& casting, int size, int rays) {
    const std::vector<QuadraturePoint> rule = gauss_legendre(rays);
    const PlaceRaster raster(*low.mesh, low.triangles, size, size);
    Packets out(std::size_t(size) * std::size_t(size) * rule.size() * rule.size() / 16);
    const int rows = PlaceRaster::band_rows, block = rays == 1 ? 4 : 1;
    for_rows(raster.bands(), 1, [&](std::int64_t band, std::int64_t) {
        std::vector<std::vector<TexelHit>> hits;
        for (const QuadraturePoint& v : rule)
            for (const QuadraturePoint& u : rule) {
                hits.emplace_back(std::size_t(rows) * std::size_t(size));
                raster.band(int(band), {u.at, v.at}, hits.back());
            }
        std::size_t number = std::size_t(band) * rows * std::size_t(size) * hits.size();
        for (int top = 0; top < rows; top += block)
            for (int left = 0; left < size; left += block)
                for (int i = 0; i < block * block; ++i)
                    for (const auto& places : hits) {
                        const int x = left + i % block, y = top + i / block;
                        const Cast cast = casting.at(places[std::size_t(y) * std::size_t(size) + std::size_t(x)]);
                        RTCRay16& packet = out[number / 16];
                        const std::size_t lane = number++ % 16;
                        packet.org_x[lane] = cast.start.x, packet.org_y[lane] = cast.start.y;
                        packet.org_z[lane] = cast.start.z, packet.dir_x[lane] = cast.inward.x;
                        packet.dir_y[lane] = cast.inward.y, packet.dir_z[lane] = cast.inward.z;
                        packet.tnear[lane] = 0, packet.tfar[lane] = cast.reach.front + cast.reach.back;
                        packet.time[lane] = 0, packet.mask[lane] = ~0u, packet.id[lane] = packet.flags[lane] = 0;
                    }
    });
    return out;
}

class Embree {
public:
    explicit Embree(const Mesh& mesh) {
        const std::vector<Triangle> triangles = triangulate(mesh);
        device_ = rtcNewDevice(nullptr), scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const positions = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.positions.size()));
        std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
        auto* const corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) corners[3 * t + k] = mesh.corner_position[triangles[t].corner[k]];
        rtcCommitGeometry(geometry), rtcAttachGeometry(scene_, geometry), rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~Embree() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    std::int64_t hits(const Packets& packets) const {
        std::atomic<std::int64_t> hits = 0;
        for_rows(std::int64_t(packets.size()), 1024, [&](std::int64_t begin, std::int64_t end) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            alignas(64) int valid[16];
            std::fill_n(valid, 16, -1);
            std::int64_t own = 0;
            for (std::int64_t i = begin; i < end; ++i) {
                alignas(64) RTCRayHit16 query;
                query.ray = packets[std::size_t(i)];
                for (unsigned& id : query.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
                for (unsigned& id : query.hit.instID[0]) id = RTC_INVALID_GEOMETRY_ID;
                rtcIntersect16(valid, scene_, &context, &query);
                for (const unsigned id : query.hit.geomID) own += id != RTC_INVALID_GEOMETRY_ID;
            }
            hits += own;
        });
        return hits;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

/// Of every 16th texel, degrees.
bench::Errors errors(const Image<float>& map, const oracle::LowTorus& low, const TorusRelief& relief, int rays) {
    const oracle::GaussRule rule(4);
    const int size = map.width();
    std::vector<float> angles;
    for (int y = 3; y < size; y += 16)
        for (int x = 5; x < size; x += 16) {
            const double u = (x + 0.5) / size, v = 1 - (y + 0.5) / size;
            const Vec3d truth = rays == 1 ? oracle::one_ray_normal(low, relief, u, v)
                                          : oracle::box_normal(low, relief, rule, u, v, 1.0 / size, 1.0 / size);
            const Vec3d found = 2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0;
            angles.push_back(float(oracle::angle_deg(found, truth)));
        }
    return bench::errors_of(std::move(angles));
}

} // namespace

int main() {
    const TorusRelief relief;
    const oracle::LowTorus torus;
    const Mesh mesh = oracle::relief_mesh(relief, 1000, 500);
    const Embree embree(mesh);
    for (const auto& [name, normals] : {std::pair("smooth", HighNormals::smooth), {"curved", HighNormals::curved}})
        for (const auto& [size, rays] : {std::pair(1024, 1), {512, 4}}) {
            const BakeTarget target = make_bake_target(torus.mesh(), "low", size, size);
            const HighSurface high({{mesh, "high"}}, torus.mesh().origin, normals, 1e9);
            const Casting casting(target.surface, CastBy::blend, measured_reach(target.surface, high, {}));
            TransferOptions options;
            options.width = options.height = size, options.rays = rays, options.padding = 0;
            const Packets packets = packets_of(target.surface, casting, size, rays);
            std::int64_t landed = 0;
            const auto turns =
                bench::in_turn(5, {[&] { landed = embree.hits(packets); }},
                               {{[&] { return transfer(target, high, casting, options, "low"); },
                                 [&](const Transfer& out) { return errors(out.map, torus, relief, rays); }}});
            const double count = 16.0 * double(packets.size()), alone = turns.limits[0].median();
            if (double(landed) < 0.999 * count) return std::fprintf(stderr, "high_to_low_bench: rays are missing\n"), 1;
            bench::print_row(turns.works[0],
                             {"high_to_low", bench::text("%s_%d_rays", name, rays * rays), size, count,
                              turns.works[0].ratio_to(turns.limits[0]), "the same rays through Embree alone",
                              bench::text("%.1f M rays/s; Embree alone %.1f", 1e-6 * count / turns.works[0].median(),
                                          1e-6 * count / alone)});
        }
}
