// Meshes that the tests of transfer share, and a bake with everything it needs.
#pragma once
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/transfer.h"
#include "oracle/surfaces.h"
#include "relief/displace/displace_meshes.h"
#include <cstring>

namespace bake::test {

struct PatchPoint {
    Vec3d p{0}, n{0};
    Vec2d uv{0};
};

/// Adds columns x rows quads over [0,1]^2 with positions, normals and uvs of their own.
template <class At> void add_patch(Mesh& mesh, int columns, int rows, const At& at) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const PatchPoint point = at(double(i) / columns, double(j) / rows);
            mesh.positions.emplace_back(point.p), mesh.normals.emplace_back(point.n), mesh.uvs.emplace_back(point.uv);
        }
    const auto index = [&](int i, int j) { return first + std::uint32_t(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            for (const std::uint32_t c : {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)})
                mesh.corner_position.push_back(c), mesh.corner_normal.push_back(c), mesh.corner_uv.push_back(c);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
}

/// [0,1]^2 at this height, facing +z, with uv = (x, y).
inline Mesh unit_plane(double z = 0, int cells = 1) {
    Mesh mesh;
    add_patch(mesh, cells, cells, [&](double x, double y) { return PatchPoint{{x, y, z}, {0, 0, 1}, {x, y}}; });
    return mesh;
}

/// Around z, u the longitude and v the latitude; the seam and the poles are equal positions.
inline Mesh lat_long_sphere(int columns, int rows, double radius = 1) {
    Mesh mesh;
    add_patch(mesh, columns, rows, [&](double u, double v) {
        const double east = 2 * pi * (u < 1 ? u : 0), north = pi * (v - 0.5),
                     ring = v > 0 && v < 1 ? std::cos(north) : 0;
        const Vec3d n(ring * std::cos(east), ring * std::sin(east), std::sin(north));
        return PatchPoint{radius * n, n, {u, v}};
    });
    return mesh;
}

/// The sides of a box [-1,1]^3: outward along axis i % 3, up for i < 3, with a chart in cell i of 3 x 2 that leaves a
/// fiftieth of the cell free on every side. s and t in [0, 1] run along the next two axes.
struct BoxSide {
    int index;
    int axis() const { return index % 3; }
    int u() const { return (axis() + 1) % 3; }
    int v() const { return (axis() + 2) % 3; }
    double sign() const { return index < 3 ? 1 : -1; }
    Vec3d at(double s, double t) const {
        Vec3d p(0);
        p[axis()] = sign(), p[u()] = 2 * s - 1, p[v()] = sign() * (2 * t - 1);
        return p;
    }
    Vec3d normal() const {
        Vec3d n(0);
        n[axis()] = sign();
        return n;
    }
    Vec2d uv(double s, double t) const {
        return {(index % 3 + 0.02 + 0.96 * s) / 3,
                (index / 3 + 0.02 + 0.96 * t) / 2}; // NOLINT(bugprone-integer-division)
    }
};

/// The box with the normals of its sides.
inline Mesh sharp_box() {
    Mesh mesh;
    for (int i = 0; i < 6; ++i)
        add_patch(mesh, 1, 1, [side = BoxSide{i}](double s, double t) {
            return PatchPoint{side.at(s, t), side.normal(), side.uv(s, t)};
        });
    return mesh;
}

inline constexpr double bolt_radius = 0.1, bolt_height = 0.05, bolt_places[] = {-0.6, 0, 0.6};

/// The box with edges rounded by `radius`, cells x cells quads on each side and exact normals; with nine bolts on each side
/// that are bolt_height (1 - r^2)^2 high at r bolt radii from their middle.
inline Mesh rounded_box(int cells, double radius, bool bolts = false) {
    Mesh mesh;
    for (int i = 0; i < 6; ++i)
        add_patch(mesh, cells, cells, [&, side = BoxSide{i}](double s, double t) {
            const Vec3d sharp = side.at(s, t), core = glm::clamp(sharp, radius - 1, 1 - radius);
            PatchPoint point{.n = glm::normalize(sharp - core)};
            point.p = core + radius * point.n;
            for (const double u : bolt_places)
                for (const double v : bolt_places) {
                    const double x = (point.p[side.u()] - u) / bolt_radius, y = (point.p[side.v()] - v) / bolt_radius;
                    const double inside = 1 - x * x - y * y;
                    if (!bolts || inside <= 0) continue;
                    point.p[side.axis()] += side.sign() * bolt_height * inside * inside;
                    point.n[side.u()] = 4 * bolt_height / bolt_radius * inside * x;
                    point.n[side.v()] = 4 * bolt_height / bolt_radius * inside * y;
                    point.n = glm::normalize(point.n);
                }
            return point;
        });
    return mesh;
}

/// The same with the other side outward.
inline Mesh turned_over(Mesh mesh) {
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (auto* corners : {&mesh.corner_position, &mesh.corner_normal, &mesh.corner_uv})
            if (!corners->empty())
                std::reverse(corners->begin() + mesh.face_begin[f], corners->begin() + mesh.face_begin[f + 1]);
    for (Vec3f& n : mesh.normals) n = -n;
    return mesh;
}

inline std::vector<HighMesh> named(std::vector<Mesh> meshes) {
    std::vector<HighMesh> out;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        out.push_back({std::move(meshes[i]), std::string("high") + char('0' + i)});
    return out;
}

struct JobOptions {
    TransferOptions transfer;
    CastBy cast = CastBy::blend;
    std::optional<Reach> reach; ///< none: measured
    HighNormals normals = HighNormals::smooth;
};

inline JobOptions job_options(int width, int height, std::vector<DetailMap> maps = {}) {
    JobOptions options;
    options.transfer.width = width, options.transfer.height = height;
    options.transfer.details.maps = std::move(maps);
    return options;
}

/// A bake, and all that the result refers to.
struct Job {
    Job(Mesh low_mesh, std::vector<Mesh> high_meshes, JobOptions with)
        : options(std::move(with)), low(std::move(low_mesh)),
          target(make_bake_target(low, "low", options.transfer.width, options.transfer.height)),
          high(named(std::move(high_meshes)), low.origin, options.normals, 1e4),
          casting(target.surface, options.cast,
                  options.reach ? constant_reach(target.surface, *options.reach)
                                : measured_reach(target.surface, high)),
          result(transfer(target, high, casting, options.transfer, "low")) {}
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    const TransferReport& report() const { return result.report; }
    TransferSources sources() const { return {{{&high, &casting}}, {}}; }
    const TexelHit& at(int x, int y) const { return target.raster.hits.at(x, y); }
    /// The value of a texel, decoded.
    Vec3d normal(int x, int y) const {
        const float* rgb = &result.map.at(x, y);
        return 2.0 * Vec3d(rgb[0], rgb[1], rgb[2]) - 1.0;
    }
    /// Of the low-poly mesh at a texel.
    Vec3d point(int x, int y) const {
        const Cast cast = casting.at(at(x, y));
        return Vec3d(cast.start) + double(cast.reach.front) * Vec3d(cast.inward);
    }

    JobOptions options;
    Mesh low;
    BakeTarget target;
    HighSurface high;
    Casting casting;
    Transfer result;
};

template <class T> bool same_bytes(const Image<T>& a, const Image<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

} // namespace bake::test
