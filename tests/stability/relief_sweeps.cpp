// Values that are no numbers, vectors that fold, limits at vertices of high valence, and floats beside doubles.
#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/normal_map.h"
#include "bake/surface/subdivision/subdivision.h"
#include "oracle/limit_masks.h"
#include "oracle/surfaces.h"
#include "stability/themes.h"
#include "surface/subdivision/cages.h"
#include <algorithm>
#include <filesystem>
#include <limits>
#include <unistd.h>

using namespace bake;

namespace stability {
namespace {

std::vector<Row> not_a_number_rows(int steps) {
    const auto folder = std::filesystem::temp_directory_path() / ("sweep_" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    const std::string file = (folder / "height.exr").string();
    std::vector<Row> rows;
    for (const bool nan : {true, false})
        for (int count = 0; count < std::min(steps, 6); ++count) {
            Image<float> values(8, 8, 1);
            std::fill_n(values.data(), values.size(), 0.25f);
            for (int i = 0; i < count; ++i)
                values.at(i, 3) =
                    nan ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
            write_image(file, values, {.depth = Depth::float32});
            Row row{nan ? "NaN" : "Inf", double(count), 0, double(count), "exit 0"};
            try {
                read_height(file);
            } catch (const Error& error) {
                const std::string said = error.what(), told = said.substr(said.find(": ") + 2);
                row.measured = std::atof(told.c_str());
                row.program =
                    "exit " + std::to_string(int(error.refusal)) + ": refused with their number and the first place";
            }
            rows.push_back(row);
        }
    std::filesystem::remove_all(folder);
    return rows;
}

/// Vectors (x / (2 pi)) sin(2 pi u) along u, on the unit square: the smallest ratio of a displaced step to the step.
std::vector<Row> vector_rows(int steps) {
    Mesh square = bake_tests::cage_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
    square.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, square.corner_uv = square.corner_position;
    const BaseSurface base{Mesh(square)};
    std::vector<Row> rows;
    for (const VectorSpace space : {VectorSpace::object, VectorSpace::tangent})
        for (const double x : linear_steps(0, 2, steps)) {
            Relief relief;
            relief.values = Image<float>(64, 4, 3);
            std::fill_n(relief.values.data(), relief.values.size(), 0.0f);
            for (int y = 0; y < 4; ++y)
                for (int i = 0; i < 64; ++i) relief.values.at(i, y, 0) = float(std::sin(2 * pi * (i + 0.5) / 64));
            relief.height = {.amplitude = x / (2 * pi), .midlevel = 0};
            relief.vector = space;
            DisplaceOptions options;
            options.rates.levels = 6;
            const Displaced out = displace(base, relief, options);
            double least = 10;
            for (std::size_t f = 0; f < out.mesh.faces();
                 ++f) // one row of quads is enough: corners 0 and 1 lie along u
                for (std::uint32_t c = out.mesh.face_begin[f]; c + 1 < out.mesh.face_begin[f + 1]; ++c) {
                    const Vec2f from = out.mesh.uvs[out.mesh.corner_uv[c]],
                                to = out.mesh.uvs[out.mesh.corner_uv[c + 1]];
                    if (std::abs(to.x - from.x) < 1e-6f) continue;
                    const Vec3f way = out.mesh.positions[out.mesh.corner_position[c + 1]] -
                                      out.mesh.positions[out.mesh.corner_position[c]];
                    least = std::min(least, double(way.x / (to.x - from.x)));
                }
            rows.push_back({space == VectorSpace::object ? "object space" : "tangent space", x, least, 1 - x,
                            out.report.folded > 0 ? "exit 0, points counted, a note: face against the surface"
                                                  : "exit 0, no note"});
        }
    return rows;
}

struct LimitError {
    double position = 0, normal_deg = 0;
};

/// The largest errors around the centre of a dome of n faces, from two levels below the cage down to 10.
LimitError limit_error(const Mesh& cage, Scheme scheme) {
    const SubdivisionSurface surface(cage, {scheme});
    const double size = diagonal(bounds(cage));
    oracle::Cage near = oracle::neighbourhood(oracle::subdivide(oracle::subdivide(oracle::cage_of(cage, scheme))), 0);
    LimitError worst;
    for (int level = 3; level <= 10; ++level) {
        near = oracle::neighbourhood(oracle::subdivide(near), 0);
        const oracle::LimitMasks masks(near);
        for (std::uint32_t f = 0; f < near.faces.size(); ++f) {
            const oracle::Cage::Face& face = near.faces[f];
            if (std::find(face.vertex.begin(), face.vertex.end(), 0u) == face.vertex.end()) continue;
            std::vector<LimitPoint> points(face.st.size());
            surface.evaluate(face.patch, face.st, Derivatives::first, points);
            for (std::uint32_t k = 0; k < face.vertex.size(); ++k) {
                if (level == 3 || face.vertex[k] != 0) continue; // the ring is no border of the surface
                const oracle::Limit limit = masks.at(f, k);
                worst.position = std::max(worst.position, glm::distance(points[k].p, limit.p) / size);
                if (limit.normal)
                    worst.normal_deg = std::max(
                        worst.normal_deg, oracle::angle_deg(*limit.normal, glm::cross(points[k].p_s, points[k].p_t)));
            }
        }
    }
    return worst;
}

std::vector<Row> valence_rows(int steps, bool normals) {
    std::vector<Row> rows;
    for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
        int before = 0;
        for (const double x : geometric_steps(3, 50, steps)) {
            const int n = int(std::lround(x));
            if (n == before) continue;
            before = n;
            const Mesh cage = bake_tests::dome(n);
            const LimitError error =
                limit_error(scheme == Scheme::loop ? bake_tests::in_triangles(cage) : cage, scheme);
            rows.push_back({scheme == Scheme::catmark ? "catmark" : "loop", double(scheme == Scheme::loop ? 2 * n : n),
                            normals ? error.normal_deg : error.position, normals ? 0.01 : 1e-6,
                            "within the documented error"});
        }
    }
    return rows;
}

/// The kernel in float beside double, over directions and points of a torus, at slopes of size x.
std::vector<Row> float_normal_rows(int steps) {
    std::vector<Row> rows;
    for (const NormalMethod method : all_normal_methods)
        for (const double x : geometric_steps(1e-3, 1e6, steps)) {
            double worst = 0;
            for (int i = 0; i < 300; ++i) {
                const Jet<double> s = oracle::torus(2, 0.7, 0.731 * i, 0.417 * i);
                const double turn = 0.213 * i;
                const Height<double> h{0.1 * std::sin(i), x * std::cos(turn), x * std::sin(turn)};
                const Jet<float> f{Vec3f(s.p), Vec3f(s.p_u), Vec3f(s.p_v), Vec3f(s.n), Vec3f(s.n_u), Vec3f(s.n_v), 1};
                const Vec3f single = displaced_normal(f, Height<float>{float(h.b), float(h.b_u), float(h.b_v)}, method);
                worst = std::max(worst, oracle::angle_deg(Vec3d(single), displaced_normal(s, h, method)));
            }
            // As a cross product of p'_u and p'_v the normal loses what n x n does not cancel.
            const bool crossed = method == NormalMethod::exact || method == NormalMethod::blinn;
            rows.push_back({std::string(name(method)), x, worst, glm::degrees((crossed ? 8 + x : 8) * std::exp2(-24)),
                            "finite, no note"});
        }
    return rows;
}

/// Slopes in float of a height of unit size on an offset of x, which is stored in float: rms error.
std::vector<Row> float_offset_rows(int steps) {
    constexpr int n = 128;
    const auto value = [](int x, int y) { return 0.5 * std::sin(0.0617 * x + 0.0391 * y); };
    std::vector<Row> rows;
    for (const bool sampler : {false, true})
        for (const double x : geometric_steps(1, 3e5, steps)) {
            const double low = std::exp2(std::ceil(std::log2(x))) * 1.25 + 0.5; // inside one binade
            Image<float> values(n, n, 1);
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) values.at(i, j) = float(low + value(i, j));
            const SlopeFilter<float> filter(values, Filter::c2, Wrap::clamp, Wrap::clamp);
            const HeightSampler<float> samples(values, Interpolation::c2,
                                               {.midlevel = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp});
            double sum = 0;
            int count = 0;
            for (int j = 20; j < n - 20; j += 3)
                for (int i = 20; i < n - 20; i += 3, ++count) {
                    const double truth = 0.5 * 0.0617 * std::cos(0.0617 * i + 0.0391 * j);
                    const double found =
                        sampler ? double(samples.at(float((i + 0.5) / n), float(1 - (j + 0.5) / n)).b_u) / n
                                : double(filter.at(i, j, 1.0f, 1.0f).first);
                    sum += (found - truth) * (found - truth);
                }
            const double spacing = std::exp2(std::floor(std::log2(low)) - 23);
            std::optional<double> predicted; // the sampler rounds its coefficients too
            if (!sampler) predicted = spacing / std::sqrt(12.0) * 1.180 / (0.5 * 0.0617);
            rows.push_back({sampler ? "HeightSampler c2" : "SlopeFilter c2", low,
                            std::sqrt(sum / count) / (0.5 * 0.0617), predicted,
                            "exit 0, no note: floats count as without steps"});
        }
    return rows;
}

} // namespace

std::vector<Sweep> relief_sweeps() {
    const std::string test = "stability/relief_test";
    return {
        {.name = "not_a_number",
         .construction = "a float height with x texels of NaN or infinity",
         .x_label = "texels",
         .y_label = "texels that the message counts",
         .limit = 0,
         .closed_form = "x, from 1",
         .test = test,
         .rows = not_a_number_rows},
        {.name = "vector_fold",
         .construction = "vectors along the surface, (x / 2 pi) sin(2 pi u): smallest stretch",
         .x_label = "amplitude times 2 pi",
         .y_label = "smallest stretch",
         .limit = 0,
         .falls = true,
         .closed_form = "1 - x = 0",
         .test = test + "; relief/displace/vector_test",
         .rows = vector_rows},
        {.name = "valence_position",
         .construction = "limit points around a vertex of valence x against limit masks",
         .x_label = "valence",
         .y_label = "error / diagonal",
         .log_x = true,
         .log_y = true,
         .limit = 1e-6,
         .closed_form = "documented: 1e-6 of the diagonal",
         .test = test,
         .rows = [](int steps) { return valence_rows(steps, false); }},
        {.name = "valence_normal",
         .construction = "limit normals around a vertex of valence x against limit masks",
         .x_label = "valence",
         .y_label = "error, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.01,
         .closed_form = "documented: .01 deg",
         .test = test,
         .rows = [](int steps) { return valence_rows(steps, true); }},
        {.name = "float_normal",
         .construction = "displaced normals in float against double on a torus, slopes of size x",
         .x_label = "slope",
         .y_label = "largest angle, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.0015,
         .closed_form = "8 units in the last place, and x more by a cross product; .0015 deg, one step of 16 bits",
         .test = test,
         .rows = float_normal_rows},
        {.name = "float_offset",
         .construction = "slopes in float of waves of unit height on an offset x",
         .x_label = "offset / height",
         .y_label = "rms error / largest slope",
         .log_x = true,
         .log_y = true,
         .limit = 0.01,
         .closed_form = "spacing of floats / sqrt(12) times the filter's noise, 1 %",
         .test = test,
         .rows = float_offset_rows},
    };
}

} // namespace stability
