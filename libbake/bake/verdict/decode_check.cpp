#include "bake/verdict/decode_check.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/relief/height/normal_values.h"
#include "bake/relief/map/normal_code.h"
#include "bake/verdict/report_text.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

constexpr double most_texels = 1e6; ///< that are compared; of larger maps every n-th row and column

double degrees(const Vec3f& a, const Vec3f& b) noexcept {
    return std::atan2(double(glm::length(glm::cross(a, b))), double(glm::dot(a, b))) * 180 / pi;
}

/// T, B and N of a triangle from p_u and p_v, N as interpolated.
Vec3f by_derivatives(const MeshSurface& surface, const TexelHit& at, const Vec3f& N, const Vec3f& t) noexcept {
    const Mesh& mesh = *surface.mesh;
    const auto& corner = surface.triangles[at.triangle].corner;
    const auto p = [&](std::size_t k) { return mesh.positions[mesh.corner_position[corner[k]]]; };
    const auto uv = [&](std::size_t k) { return mesh.uvs[mesh.corner_uv[corner[k]]]; };
    const Vec3f n = unit_or_zero(N), e1 = p(1) - p(0), e2 = p(2) - p(0);
    const Vec2f d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const Vec3f across2 = glm::cross(e2, n), across1 = glm::cross(n, e1);
    const Vec3f T = across2 * d1.x + across1 * d2.x, B = across2 * d1.y + across1 * d2.y;
    const float longer = std::sqrt(std::max(glm::dot(T, T), glm::dot(B, B)));
    if (!(longer > 0)) return Vec3f(0);
    return unit_or_zero(t.x / longer * T + t.y / longer * B + t.z * n);
}

struct Sums {
    std::vector<std::array<float, std::size(all_decodings) - 1>> errors; ///< per texel
    double relief = 0;
};

DecodedError error_of(std::vector<float> values, Decoding decoding) {
    DecodedError out{decoding};
    if (values.empty()) return out;
    for (const float v : values) out.mean += double(v) / double(values.size());
    const auto place = values.begin() + std::ptrdiff_t(0.95 * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    out.percentile_95 = double(*place), out.max = double(*std::max_element(place, values.end()));
    return out;
}

Sums compare(const BakeTarget& target, const Image<float>& map, bool directx) {
    const int step = std::max(1, int(std::ceil(std::sqrt(double(map.width()) * map.height() / most_texels))));
    const int rows = (map.height() + step - 1) / step;
    std::vector<Sums> of_row(static_cast<std::size_t>(rows));
    for_rows(rows, 8, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = int(begin); i < int(end); ++i)
            for (int x = 0; x < map.width(); x += step) {
                const TexelHit& at = target.raster.hits.at(x, i * step);
                if (at.triangle == no_index) continue;
                const float* c = &map.at(x, i * step);
                const Vec3f t = directx ? Vec3f(c[0], -c[1], c[2]) : Vec3f(c[0], c[1], c[2]);
                const Vec3f right = decoded(target, at, t, Decoding::mikktspace);
                const Vec3f flat = decoded(target, at, Vec3f(0, 0, 1), Decoding::mikktspace);
                if (right == Vec3f(0) || flat == Vec3f(0)) continue;
                Sums& sums = of_row[std::size_t(i)];
                sums.relief += degrees(right, flat);
                auto& errors = sums.errors.emplace_back();
                for (std::size_t d = 1; d < std::size(all_decodings); ++d)
                    errors[d - 1] = float(degrees(right, decoded(target, at, t, all_decodings[d])));
            }
    });
    Sums all;
    for (const Sums& row : of_row) {
        all.errors.insert(all.errors.end(), row.errors.begin(), row.errors.end());
        all.relief += row.relief;
    }
    return all;
}

void judge(DecodeReport& report) {
    constexpr double shows = 1, disagrees = 5; // degrees
    for (const DecodedError& e : report.errors)
        if (e.decoding != Decoding::green_over && e.percentile_95 > shows)
            report.findings.notes.push_back(
                std::string(name(e.decoding)) +
                format(" differs by more than %.3g deg in 5 %% of the texels; write tangents "
                       "into the mesh, so that viewers need not make their own",
                       e.percentile_95));
    if (report.seams.percentile_95 > disagrees)
        report.findings.warnings.push_back(format(
            "the two sides of the seams differ by more than %.3g deg in 5 %% of their length; is the map of this "
            "mesh, with this green, and padded?",
            report.seams.percentile_95));
}

} // namespace

const char* name(Decoding decoding) noexcept {
    switch (decoding) {
    case Decoding::mikktspace: return "MikkTSpace";
    case Decoding::green_over: return "green the other way up";
    case Decoding::unit_frame: return "frames of unit length";
    case Decoding::uv_derivatives: break;
    }
    return "frames from derivatives";
}

std::string viewers_of(Decoding decoding, bool directx) {
    const std::string up = "Blender, glTF, Godot, Unity", down = "Unreal, DirectX";
    switch (decoding) {
    case Decoding::mikktspace: return directx ? down : up;
    case Decoding::green_over: return directx ? up : down;
    case Decoding::unit_frame: return "shaders that orthonormalise";
    case Decoding::uv_derivatives: break;
    }
    return "three.js for meshes without tangents";
}

Vec3f decoded(const BakeTarget& target, const TexelHit& at, const Vec3f& t, Decoding decoding) noexcept {
    const MeshSurface& surface = target.surface;
    const auto& corner = surface.triangles[at.triangle].corner;
    const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
    Vec3f T(0), N(0);
    for (std::size_t k = 0; k < 3; ++k) T += b[k] * Vec3f(target.tangents[corner[k]]), N += b[k] * surface.n[corner[k]];
    const float sign = target.tangents[corner[0]].w;
    const float y = decoding == Decoding::green_over ? -t.y : t.y;
    if (decoding == Decoding::uv_derivatives) return by_derivatives(surface, at, N, t);
    if (decoding == Decoding::unit_frame) {
        N = unit_or_zero(N);
        T = unit_or_zero(T - glm::dot(T, N) * N);
    }
    return unit_or_zero(t.x * T + y * sign * glm::cross(N, T) + t.z * N);
}

DecodeReport inspect_decoding(const std::string& map_path, const std::string& mesh_path, bool directx,
                              const InspectOptions& options, int tile) {
    ImageInfo info;
    const Image<float> colours = read_image(map_path, &info);
    if (colours.channels() - (info.alpha_channel >= 0) < 2)
        throw Error(Refusal::unsuitable, map_path +
                                             ": has one channel, a normal map has two or three; give the normal map "
                                             "first, then the mesh");
    if (!std::all_of(colours.data(), colours.data() + colours.size(), [](float v) { return v - v == 0; }))
        throw Error(Refusal::unsuitable, map_path + ": has NaN or Inf values; export it again");
    const Mesh mesh = read_mesh(mesh_path, options.read);
    const BakeTarget target = make_bake_target(mesh, mesh_path, colours.width(), colours.height(), tile);
    const Image<float> map = decode_normals(colours, guess_normal_values(colours, info));
    DecodeReport report{.file = map_path,
                        .mesh = mesh_path,
                        .width = map.width(),
                        .height = map.height(),
                        .tile = tile,
                        .directx = directx};
    const Sums sums = compare(target, map, directx);
    report.texels = std::int64_t(sums.errors.size());
    if (report.texels > 0) report.relief_deg = sums.relief / double(report.texels);
    for (std::size_t d = 1; d < std::size(all_decodings); ++d) {
        std::vector<float> values;
        for (const auto& errors : sums.errors) values.push_back(errors[d - 1]);
        report.errors.push_back(error_of(std::move(values), all_decodings[d]));
    }
    Image<float> encoded(map.width(), map.height(), 3);
    for (std::size_t i = 0; i < encoded.size(); ++i) encoded.data()[i] = 0.5f * map.data()[i] + 0.5f;
    report.seams = seam_disagreement(target, encoded, Space::tangent, directx, tile);
    judge(report);
    for (const std::string& line : info.notes) report.findings.notes.push_back(map_path + ": " + line);
    for (const std::string& line : mesh.notes) report.findings.notes.push_back(mesh_path + ": " + line);
    return report;
}

std::string to_text(const DecodeReport& report) {
    std::string text = printable(report.file + " on " + report.mesh) + "\n";
    text += row("map", format("%d x %d, green %s; %lld texels compared", report.width, report.height,
                              report.directx ? "down" : "up", static_cast<long long>(report.texels)));
    if (report.tile != 0) text += row("tile", std::to_string(report.tile));
    text += row("relief", format("the map tilts normals by %.3g deg in the mean", report.relief_deg));
    text += row("seen right", "MikkTSpace, green " + std::string(report.directx ? "down" : "up") + ": " +
                                  viewers_of(Decoding::mikktspace, report.directx));
    for (const DecodedError& e : report.errors)
        text += row("else", format("%s: mean %.3g, p95 %.3g, max %.3g deg (%s)", name(e.decoding), e.mean,
                                   e.percentile_95, e.max, viewers_of(e.decoding, report.directx).c_str()));
    if (report.seams.samples > 0)
        text += row("seams", format("%lld, whose sides differ by mean %.3g, p95 %.3g, max %.3g deg",
                                    static_cast<long long>(report.seams.seams), report.seams.mean,
                                    report.seams.percentile_95, report.seams.max));
    return text + endings(report.findings);
}

std::string to_json(const DecodeReport& report) {
    using Json = nlohmann::ordered_json;
    Json errors = Json::array();
    for (const DecodedError& e : report.errors)
        errors.push_back({{"decoding", name(e.decoding)},
                          {"viewers", viewers_of(e.decoding, report.directx)},
                          {"mean_deg", e.mean},
                          {"p95_deg", e.percentile_95},
                          {"max_deg", e.max}});
    Json json = {{"file", report.file},
                 {"mesh", report.mesh},
                 {"kind", "decoding"},
                 {"size", {report.width, report.height}},
                 {"green", report.directx ? "down" : "up"},
                 {"texels", report.texels},
                 {"relief_deg", report.relief_deg},
                 {"decodings", errors},
                 {"seams",
                  {{"edges", report.seams.seams},
                   {"mean_deg", report.seams.mean},
                   {"p95_deg", report.seams.percentile_95},
                   {"max_deg", report.seams.max}}},
                 {"warnings", report.findings.warnings},
                 {"notes", report.findings.notes}};
    if (report.tile != 0) json["tile"] = report.tile;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace bake
