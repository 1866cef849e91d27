// Charts: what a constant scale makes of them, poles, mirrored charts and charts without area, overlaps, faces without uvs,
// and steps across seams.
#include "bake/base/error.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/normal_map.h"
#include "oracle/surfaces.h"
#include "stability/themes.h"
#include "stability/worst_angle.h"
#include <algorithm>

using namespace bake;

namespace stability {
namespace {

/// Quads over positions, with one uv per corner; `with_uv` of them, the others have none.
Mesh quads(std::vector<Vec3f> positions, const std::vector<std::uint32_t>& corners, const std::vector<Vec2f>& uvs,
           std::size_t with_uv = std::size_t(-1)) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.corner_position = corners;
    mesh.uvs = uvs;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        mesh.corner_uv.push_back(c / 4 < with_uv ? std::uint32_t(c) : no_index);
        if (c % 4 == 3) mesh.face_begin.push_back(std::uint32_t(c + 1));
    }
    return mesh;
}

std::vector<Row> constant_scale_rows(const std::vector<double>& xs, const std::function<Jet<double>(double)>& jet,
                                     const std::function<double(double)>& closed_form) {
    std::vector<Row> rows;
    for (const double x : xs) {
        const Jet<double> s = jet(x);
        const double measured = worst_angle([&](const Vec2d& slope) {
            const Height<double> h{0, slope.x, slope.y};
            return oracle::angle_deg(displaced_normal(s, h, NormalMethod::constant_scale),
                                     displaced_normal(s, h, NormalMethod::exact));
        });
        rows.push_back({"", x, measured, closed_form(x),
                        "exact is the default; for constant-scale a note tells the largest error of the map"});
    }
    return rows;
}

Jet<double> flat_jet(const Vec2d& p_u, const Vec2d& p_v) {
    Jet<double> s{};
    s.p_u = {p_u.x, p_u.y, 0}, s.p_v = {p_v.x, p_v.y, 0}, s.n = {0, 0, 1};
    return s;
}

std::vector<Row> latitude_rows(int steps) {
    return constant_scale_rows(
        linear_steps(0, 88, steps), [](double x) { return oracle::sphere(1, 0.4, glm::radians(x)); },
        [](double x) { return glm::degrees(std::asin(std::pow(std::tan(glm::radians(x / 2)), 2))); });
}

std::vector<Row> stretch_rows(int steps) {
    return constant_scale_rows(
        geometric_steps(1, 16, steps),
        [](double x) {
            return flat_jet({x, 0}, {0, 1});
        },
        [](double x) { return glm::degrees(std::asin((x - 1) / (x + 1))); });
}

std::vector<Row> shear_rows(int steps) {
    return constant_scale_rows(
        geometric_steps(1e-3, 4, steps),
        [](double x) {
            return flat_jet({1, 0}, {x, 1});
        },
        [](double x) { return glm::degrees(2 * std::atan(x / 2)); });
}

/// The tilt by one 8-bit level between two columns of a lat-long map of 2048 x 1024 texels, 1 % of the radius high.
std::vector<Row> pole_rows(int steps) {
    constexpr int rows_of_map = 1024;
    const double level = 0.01 / 255;
    HeightTexture height;
    height.values = Image<float>(64, 8, 1); // a strip of the map: only the columns beside the step count
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) height.values.at(x, y) = x < 32 ? 0.0f : float(1 / 255.0);
    const auto [step, none] =
        SlopeFilter<float>(height.values, Filter::central, Wrap::clamp, Wrap::clamp).at(31, 4, 1, 1);
    const ParametricSurface sphere("sphere:R=1");
    std::vector<Row> rows;
    for (const double row : geometric_steps(0.5, rows_of_map / 2.0, steps)) {
        const double colatitude = pi * row / rows_of_map;
        const Jet<double> s = sphere.jet(0.3, 1 - row / rows_of_map);
        const Height<double> h{0, 0.01 * double(step) * 2048, none};
        const Vec3d n = displaced_normal(s, h, NormalMethod::exact);
        rows.push_back({"", glm::degrees(colatitude), oracle::angle_deg(n, s.n),
                        glm::degrees(std::atan(0.5 * level * 2048 / (2 * pi * std::sin(colatitude)))),
                        "exit 0, the bake prints the tilt of one level; a texel on the pole is flat and counted"});
    }
    std::reverse(rows.begin(), rows.end());
    return rows;
}

/// A slope of .5 along a chart of width x around u = .5, of a quad of width 1.
std::vector<Row> narrow_rows(int steps) {
    const Vec3d truth(-0.5, -0.3, 1);
    std::vector<Row> rows;
    for (const double side : {1.0, -1.0})
        for (const double x : geometric_steps(1, 1e-9, steps)) {
            const auto u = float(0.5 + side * x / 2), w = float(0.5 - side * x / 2);
            const Mesh mesh =
                quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 3}, {{w, 0}, {u, 0}, {u, 1}, {w, 1}});
            const MeshSurface surface = make_mesh_surface(mesh);
            const Jet<double> s = jet_at<double>(surface, 0, 0.3, 0.3);
            const Height<double> h{0, 0.5 / (side * x), 0.3};
            const bool none = s.sigma == 0;
            const Vec3d n = none ? Vec3d(0, 0, 1) : displaced_normal(s, h, NormalMethod::exact);
            // Rounded uvs make the chart wrong by up to 2^-25 above .5 and half of that below.
            const double wrong = std::min(1.0, 1.5 * std::exp2(-25) / x);
            rows.push_back(
                {side > 0 ? "plain" : "mirrored", x, oracle::angle_deg(n, truth),
                 oracle::angle_deg({-0.5 * (1 - wrong), -0.3, 1}, truth),
                 none ? "no area in uv: triangles are counted in a note and not baked" : "relief rises outward"});
        }
    return rows;
}

std::vector<Row> overlap_rows(int steps) {
    constexpr int size = 256;
    std::vector<Row> rows;
    for (const double x : linear_steps(0, 1, steps)) {
        const auto a = float(0.5 * (1 - x)), b = a + 0.5f;
        const Mesh mesh =
            quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}}, {0, 1, 2, 3, 1, 4, 5, 2},
                  {{0, 0}, {.5f, 0}, {.5f, .5f}, {0, .5f}, {a, 0}, {b, 0}, {b, .5f}, {a, .5f}});
        const BakeTarget target = make_bake_target(mesh, "quads", size, size);
        const double share = double(target.raster.overlapped) / (size * size / 4);
        rows.push_back({"", x, share, x,
                        target.raster.overlapped > 0 ? "exit 0, texels counted in a note; the lowest face is baked"
                                                     : "exit 0, no note"});
    }
    return rows;
}

std::vector<Row> missing_rows(int steps) {
    constexpr std::size_t faces = 32;
    std::vector<Vec3f> positions;
    std::vector<Vec2f> uvs;
    std::vector<std::uint32_t> corners;
    for (std::size_t f = 0; f < faces; ++f)
        for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            corners.push_back(std::uint32_t(positions.size()));
            positions.emplace_back(f + x, y, 0);
            uvs.emplace_back(float(f + x) / faces, y);
        }
    HeightTexture height;
    height.values = Image<float>(64, 64, 1);
    std::fill_n(height.values.data(), height.values.size(), 0.5f);
    std::vector<Row> rows;
    for (const double x : linear_steps(0, 1, steps)) {
        const auto with = std::size_t(std::lround((1 - x) * double(faces)));
        const Mesh mesh = quads(positions, corners, uvs, with);
        const double share = 1 - double(with) / faces;
        try {
            const BakeTarget target = make_bake_target(mesh, "mesh", 64, 64);
            const NormalMapOptions options{.width = 64, .height = 64};
            const HeightField field(height, options.height_options, Filter::central, 64, 64);
            NormalMapReport report;
            normal_map(field, target, options, report);
            rows.push_back(
                {"", share, double(report.triangles_without_uv) / (2 * faces), share,
                 report.triangles_without_uv > 0 ? "exit 0, triangles counted in a note" : "exit 0, no note"});
        } catch (const Error& error) {
            rows.push_back({"", share, 1, share,
                            "exit " + std::to_string(int(error.refusal)) + ": refused; unwrap the mesh first"});
        }
    }
    return rows;
}

/// Two quads that share an edge, each with a chart, whose heights differ by x edges of the result: the steepest edge.
std::vector<Row> seam_rows(int steps) {
    const Mesh mesh =
        quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}}, {0, 1, 2, 3, 1, 4, 5, 2},
              {{.1f, .1f}, {.4f, .1f}, {.4f, .9f}, {.1f, .9f}, {.6f, .1f}, {.9f, .1f}, {.9f, .9f}, {.6f, .9f}});
    const BaseSurface base{Mesh(mesh)};
    constexpr double edge = 1.0 / 16;
    std::vector<Row> rows;
    for (const Seam seam : {Seam::average, Seam::owner, Seam::blend})
        for (const double x : geometric_steps(0.1, 30, steps)) {
            Relief relief;
            relief.values = Image<float>(64, 4, 1);
            for (int y = 0; y < 4; ++y)
                for (int i = 0; i < 64; ++i) relief.values.at(i, y) = i < 32 ? 0.0f : 1.0f;
            relief.height = {.amplitude = x * edge, .midlevel = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
            relief.interpolation = Interpolation::bilinear;
            DisplaceOptions options;
            options.rates.levels = 4, options.seam = seam;
            const Displaced out = displace(base, relief, options);
            double steepest = 0;
            for (std::size_t f = 0; f < out.mesh.faces(); ++f)
                for (std::uint32_t c = out.mesh.face_begin[f]; c < out.mesh.face_begin[f + 1]; ++c) {
                    const std::uint32_t next = c + 1 < out.mesh.face_begin[f + 1] ? c + 1 : out.mesh.face_begin[f];
                    const Vec3f way = out.mesh.positions[out.mesh.corner_position[next]] -
                                      out.mesh.positions[out.mesh.corner_position[c]];
                    steepest = std::max(steepest, std::abs(double(way.z)) / edge);
                }
            const bool noted = seam != Seam::blend && out.report.seam_mismatch > 3 * edge;
            std::optional<double> predicted;
            if (seam != Seam::blend) predicted = seam == Seam::average ? x / 2 : x;
            rows.push_back({seam == Seam::average ? "average"
                            : seam == Seam::owner ? "owner"
                                                  : "blend",
                            x, steepest, predicted,
                            noted ? "exit 0, a note from 3 edges on with average and owner: use blend"
                                  : "exit 0, the mismatch in the report"});
        }
    return rows;
}

} // namespace

std::vector<Sweep> chart_sweeps() {
    const std::string test = "stability/chart_test";
    return {
        {.name = "constant_scale_latitude",
         .construction = "constant-scale on a sphere, scaled at the equator, over all slopes",
         .x_label = "latitude, deg",
         .y_label = "worst angle, deg",
         .limit = 0.318,
         .closed_form = "asin(tan(x / 2)^2), .318 deg",
         .test = test,
         .rows = latitude_rows},
        {.name = "constant_scale_stretch",
         .construction = "constant-scale on a chart stretched by x along u",
         .x_label = "stretch",
         .y_label = "worst angle, deg",
         .log_x = true,
         .limit = 0.318,
         .closed_form = "asin((x - 1) / (x + 1)), .318 deg",
         .test = test,
         .rows = stretch_rows},
        {.name = "constant_scale_shear",
         .construction = "constant-scale on a chart sheared by x",
         .x_label = "shear",
         .y_label = "worst angle, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.318,
         .closed_form = "2 atan(x / 2), .318 deg",
         .test = test,
         .rows = shear_rows},
        {.name = "pole",
         .construction =
             "one 8-bit level of a relief of 1 % of R on a lat-long map of 2048 x 1024; x = distance from the pole",
         .x_label = "distance from the pole, deg",
         .y_label = "tilt by one level, deg",
         .log_x = true,
         .log_y = true,
         .limit = 1,
         .closed_form = "atan(level W / (4 pi sin x)), 1 deg",
         .test = test,
         .rows = pole_rows},
        {.name = "narrow_chart",
         .construction = "a quad whose chart has the width x, down to none, plain and mirrored",
         .x_label = "width of the chart in uv",
         .y_label = "error of the normal, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.318,
         .closed_form = "uvs round to 2^-25 above .5: a slope off by that over x",
         .test = test,
         .rows = narrow_rows},
        {.name = "uv_overlap",
         .construction = "two quads whose charts share x of their area",
         .x_label = "share of the charts",
         .y_label = "overlapped texels / chart",
         .limit = 0,
         .closed_form = "x, from 0",
         .test = test,
         .rows = overlap_rows},
        {.name = "uv_missing",
         .construction = "a strip of quads, a part x of them without uvs",
         .x_label = "faces without uvs",
         .y_label = "triangles not baked",
         .limit = 0,
         .closed_form = "x, from 0",
         .test = test,
         .rows = missing_rows},
        {.name = "seam_step",
         .construction = "displace two charts whose heights differ by x edges of the result",
         .x_label = "difference across the seam, edges",
         .y_label = "steepest edge: rise / length",
         .log_x = true,
         .log_y = true,
         .limit = 1.5,
         .closed_form = "average x / 2, owner x; a slope of 1.5",
         .test = test,
         .rows = seam_rows},
    };
}

} // namespace stability
