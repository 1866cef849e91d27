#include "bake/relief/map/bake_budget.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

using namespace bake;
using oracle::relief_options;
using oracle::relief_texture;
using oracle::TorusRelief;

namespace {

/// The promise of error_budget: the measured rms lies within the total, and the total within 3 times the measured rms.
void check_budget(const ErrorBudget& budget, double measured_rms) {
    MESSAGE("budget " << budget.total_deg << " (filter " << budget.filter_deg << ", quantisation "
                      << budget.quantisation_deg << ", encoding " << budget.encoding_deg << ", method "
                      << budget.method_deg << ") against " << measured_rms << " deg measured, x"
                      << budget.total_deg / measured_rms);
    CHECK(measured_rms <= budget.total_deg);
    CHECK(budget.total_deg <= 3 * measured_rms);
}

int bits_of(Depth depth) { return depth == Depth::u8 ? 8 : depth == Depth::u16 ? 16 : 0; }

/// Rms of a plane map's error against slopes given per unit of uv.
template <class Slope> double plane_rms(const Image<float>& map, const Vec2d& extent, Depth depth, const Slope& slope) {
    double sum = 0;
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) {
            const Vec3f rgb = stored_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, depth);
            const Vec2d s = slope(x, y);
            const double angle =
                oracle::angle_deg(Vec3d(decode_normal(rgb, false)), {-s.x / extent.x, -s.y / extent.y, 1});
            sum += angle * angle;
        }
    return std::sqrt(sum / (double(map.width()) * map.height()));
}

/// A lat-long sphere mesh of radius 1, poles at v = 0 and 1, exact normals.
Mesh sphere_mesh(int columns, int rows) {
    Mesh mesh;
    mesh.face_begin = {0};
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const Jet<double> s = oracle::sphere(1, 2 * pi * i / columns, pi * (double(j) / rows - 0.5));
            mesh.positions.emplace_back(s.p);
            mesh.normals.emplace_back(s.n);
            mesh.uvs.emplace_back(double(i) / columns, double(j) / rows);
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int a, int b) { return std::uint32_t((j + b) * (columns + 1) + i + a); };
            for (const std::uint32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}) {
                mesh.corner_position.push_back(corner);
                mesh.corner_normal.push_back(corner);
                mesh.corner_uv.push_back(corner);
            }
            mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
        }
    return mesh;
}

/// A fine height as a continuous, band-limited one: the sum of its texels under Lanczos-3 kernels four texels wide.
/// Its values at every fourth texel are the coarse height, its analytic slopes the truth.
struct Resampled {
    HeightTexture coarse;
    Image<double> slope_u, slope_v; ///< per unit of u and v
};

double lanczos(double t) {
    const auto sinc = [](double x) { return x == 0 ? 1.0 : std::sin(pi * x) / (pi * x); };
    return std::abs(t) < 12 ? sinc(t / 4) * sinc(t / 12) / 4 : 0;
}

Resampled resample(const Image<float>& fine, int bits) {
    constexpr int factor = 4, reach = 12;
    double value_weight[2 * reach], slope_weight[2 * reach];
    for (int k = 0; k < 2 * reach; ++k) {
        const double t = reach - 0.5 - k; // from texel to the coarse centre, which lies between two texels
        value_weight[k] = lanczos(t);
        slope_weight[k] = (lanczos(t + 1e-5) - lanczos(t - 1e-5)) / 2e-5;
    }
    const int width = fine.width() / factor, height = fine.height() / factor;
    const int fine_width = width * factor, fine_height = height * factor;
    Image<double> row_value(width, fine_height, 1), row_slope(width, fine_height, 1);
    for (int y = 0; y < fine_height; ++y)
        for (int x = 0; x < width; ++x) {
            double value = 0, slope = 0;
            for (int k = 0; k < 2 * reach; ++k) {
                const double h = fine.at(wrap_index(x * factor + 2 - reach + k, fine_width, Wrap::repeat), y);
                value += value_weight[k] * h;
                slope += slope_weight[k] * h;
            }
            row_value.at(x, y) = value;
            row_slope.at(x, y) = slope;
        }
    Resampled out;
    out.coarse.values = Image<float>(width, height, 1);
    out.slope_u = Image<double>(width, height, 1);
    out.slope_v = Image<double>(width, height, 1);
    const double largest = std::exp2(bits) - 1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double value = 0, along_x = 0, along_y = 0;
            for (int k = 0; k < 2 * reach; ++k) {
                const int j = wrap_index(y * factor + 2 - reach + k, fine_height, Wrap::repeat);
                value += value_weight[k] * row_value.at(x, j);
                along_x += value_weight[k] * row_slope.at(x, j);
                along_y += slope_weight[k] * row_value.at(x, j);
            }
            out.coarse.values.at(x, y) = float(bits > 0 ? std::round(value * largest) / largest : value);
            out.slope_u.at(x, y) = along_x * fine_width;
            out.slope_v.at(x, y) = -along_y * fine_height;
        }
    out.coarse.levels = bits > 0 && bits <= 8 ? 256 : 257;
    out.coarse.step = bits > 0 ? 1 / largest : 0;
    return out;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("error_budget: holds on the torus, by height depth, map depth and method") {
        const Mesh mesh = oracle::torus_mesh(1024, 512);
        const TorusRelief r;
        const BakeTarget target = make_bake_target(mesh, "torus", 512, 512);
        const struct {
            int height_bits;
            Depth depth;
            Filter filter;
            NormalMethod method;
        } cases[] = {{8, Depth::u16, Filter::automatic, NormalMethod::exact},
                     {8, Depth::u8, Filter::automatic, NormalMethod::exact},
                     {8, Depth::u16, Filter::c2, NormalMethod::exact},
                     {0, Depth::u16, Filter::central, NormalMethod::exact},
                     {0, Depth::half, Filter::automatic, NormalMethod::exact},
                     {16, Depth::u16, Filter::sobel, NormalMethod::blinn},
                     {16, Depth::u16, Filter::automatic, NormalMethod::constant_scale}};
        for (const auto& c : cases) {
            CAPTURE(c.height_bits);
            const HeightTexture height = relief_texture(r, 512, c.height_bits);
            const NormalMapOptions options = relief_options(r, 512, c.filter, c.method);
            const HeightField field(height, options.height_options, c.filter, 512, 512);
            NormalMapReport report;
            Image<float> map = normal_map(field, target, options, report);
            if (c.depth == Depth::half)
                for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = as_half(map.data()[i]);
            const auto errors = oracle::map_errors(map, target, bits_of(c.depth),
                                                   [&](double u, double v) { return oracle::relief_normal(r, u, v); });
            check_budget(error_budget(mesh_budget(height, field, options, target, c.depth)),
                         oracle::spread(errors).rms);
        }
    }

    TEST_CASE("error_budget: holds on the sphere, poles included") {
        const Mesh mesh = sphere_mesh(512, 1024);
        const TorusRelief r{0.005, 16, 8};
        const BakeTarget target = make_bake_target(mesh, "sphere", 512, 256);
        for (const int bits : {8, 0}) {
            HeightTexture height;
            height.values = Image<float>(512, 256, 1);
            const HeightTexture square = relief_texture(r, 512, bits);
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 512; ++x) {
                    const double value = oracle::relief(r, (x + 0.5) / 512, 1 - (y + 0.5) / 256).b / (2 * r.A) + 0.5;
                    height.values.at(x, y) = float(bits ? std::round(value * 255) / 255 : value);
                }
            height.levels = square.levels, height.step = square.step;
            NormalMapOptions options = relief_options(r, 512, Filter::automatic);
            options.height = 256;
            options.height_options.wrap_v = Wrap::repeat;
            const HeightField field(height, options.height_options, Filter::automatic, 512, 256);
            NormalMapReport report;
            const Image<float> map = normal_map(field, target, options, report);
            const auto errors = oracle::map_errors(map, target, 16, [&](double u, double v) {
                const Jet<double> s = oracle::sphere(1, 2 * pi * u, pi * (v - 0.5));
                const Height<double> h = oracle::relief(r, u, v);
                return glm::cross(2 * pi * s.p_u + h.b_u * s.n + 2 * pi * h.b * s.n_u,
                                  pi * s.p_v + h.b_v * s.n + pi * h.b * s.n_v);
            });
            check_budget(error_budget(mesh_budget(height, field, options, target, Depth::u16)),
                         oracle::spread(errors).rms);
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE(
        "better_filter: advises the spline where steps are small against the detail, and sobel where they are not") {
        const auto advice = [](const TorusRelief& r, int bits, Filter filter) {
            const HeightTexture height = relief_texture(r, 512, bits);
            const NormalMapOptions options = relief_options(r, 512, filter);
            const HeightField field(height, options.height_options, filter, 512, 512);
            const BudgetInput input = plane_budget(height, field, options, {1, 1}, Depth::u16);
            return better_filter(input, error_budget(input));
        };
        // 8 texels a period: sobel loses a tenth of every slope, 8-bit steps cost less.
        REQUIRE(advice({0.01, 64, 64}, 8, Filter::sobel));
        CHECK(advice({0.01, 64, 64}, 8, Filter::sobel)->filter != Filter::sobel);
        REQUIRE(advice({0.01, 3, 2}, 8, Filter::c2));
        CHECK(advice({0.01, 3, 2}, 8, Filter::c2)->filter == Filter::sobel);
        CHECK_FALSE(advice({0.01, 3, 2}, 8, Filter::sobel));
        CHECK_FALSE(advice({0.01, 4, 4}, 0, Filter::c2)); // the encoding is all there is
    }

    TEST_CASE("error_budget: a lossy height is told apart, and gets no advice") {
        HeightTexture height = relief_texture({0.01, 64, 64}, 512, 8);
        const NormalMapOptions options = relief_options({0.01, 64, 64}, 512, Filter::sobel);
        const HeightField field(height, options.height_options, Filter::sobel, 512, 512);
        const auto budget = [&] {
            const BudgetInput input = plane_budget(height, field, options, {1, 1}, Depth::u16);
            const ErrorBudget own = error_budget(input);
            return std::pair{own.lossy, better_filter(input, own).has_value()};
        };
        CHECK(budget() == std::pair{false, true});
        height.info.format = "jpeg";
        CHECK(budget() == std::pair{true, false});
    }

    TEST_CASE(
        "error_budget: relief that is too steep for its texels is not judged, and no bound is above 180 degrees") {
        // A flat height whose steps of 8 bits are cliffs at this amplitude.
        HeightTexture height = relief_texture({0.01, 3, 2}, 512, 8);
        std::fill_n(height.values.data(), height.values.size(), 0.5f);
        NormalMapOptions options = relief_options({0.01, 3, 2}, 512, Filter::sobel);
        options.height_options.amplitude = 100;
        const HeightField field(height, options.height_options, Filter::sobel, 512, 512);
        const BudgetInput input = plane_budget(height, field, options, {1, 1}, Depth::u16);
        const ErrorBudget budget = error_budget(input);
        CHECK_FALSE(budget.judged());
        CHECK(budget.total_deg == 180);
        CHECK_FALSE(better_filter(input, budget));
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("error_budget: holds on three real heights resampled from finer ones") {
        const auto data = test::shared_data();
        for (const char* name : {"meshes/leeperrysmith/Infinite-Level_02_Disp_NoSmoothUV-4096.jpg",
                                 "textures/pairs/ambientcg_Rock020/Rock020_1K_Displacement.jpg",
                                 "textures/heights/terrain3d_stones.exr"}) {
            const HeightTexture fine = read_height((data / name).string());
            for (const int bits : {8, 16, 0}) {
                const Resampled r = resample(fine.values, bits);
                const int width = r.coarse.values.width(), height = r.coarse.values.height();
                const Vec2d extent(1, double(height) / width);
                NormalMapOptions options;
                options.width = width, options.height = height;
                options.height_options.amplitude = 0.05;
                for (const Filter filter : {Filter::automatic, Filter::central, Filter::c2}) {
                    options.filter = filter;
                    const HeightField field(r.coarse, options.height_options, filter, width, height);
                    const Image<float> map = normal_map(field, extent, options);
                    const double measured = plane_rms(map, extent, Depth::u16, [&](int x, int y) {
                        return 0.05 * Vec2d(r.slope_u.at(x, y), r.slope_v.at(x, y));
                    });
                    MESSAGE(std::string(name) << ", " << bits << " bit, " << std::string(bake::name(filter)));
                    check_budget(error_budget(plane_budget(r.coarse, field, options, extent, Depth::u16)), measured);
                }
            }
        }
    }
}
