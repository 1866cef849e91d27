// What check predicts of a height on a mesh, beside what bakes and displacements measure.
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/loaded_picture.h"
#include "bake/relief/displace/displace.h"
#include "bake/verdict/relief_check.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

using namespace bake;

namespace {

struct Job {
    const Mesh& mesh;
    const HeightTexture& height;
    HeightOptions options;
    Filter filter = Filter::automatic;
};

ReliefCheck check_of(const Job& job) { return check_relief(job.mesh, job.height, job.filter, job.options); }

/// A whole map of normals in object space, and what it counts.
Image<float> map_of(const Job& job, const BakeTarget& target, NormalMapReport& report) {
    NormalMapOptions options;
    options.width = job.height.values.width(), options.height = job.height.values.height();
    options.space = Space::object, options.padding = 0, options.filter = job.filter;
    options.height_options = job.options;
    const HeightField field(job.height, job.options, resolve_filter(job.filter, job.height), options.width,
                            options.height);
    return normal_map(field, target, options, report);
}

/// Root mean square of the angle between two maps over covered texels of the columns for which `counts` is true.
template <class Counts> double rms_deg(const Job& a, const Job& b, const Counts& counts) {
    const int width = a.height.values.width(), height = a.height.values.height();
    const BakeTarget target = make_bake_target(a.mesh, "mesh", width, height);
    NormalMapReport report;
    const Image<float> first = map_of(a, target, report), second = map_of(b, target, report);
    double squares = 0, texels = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!counts(x) || target.raster.hits.at(x, y).triangle == no_index) continue;
            const auto n = [&](const Image<float>& map) {
                return 2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0;
            };
            const double angle = oracle::angle_deg(n(first), n(second));
            squares += angle * angle, ++texels;
        }
    return std::sqrt(squares / std::max(1.0, texels));
}
bool everywhere(int) { return true; }

void check_within_two(double told, double measured) {
    CAPTURE(told);
    CAPTURE(measured);
    CHECK(told / measured < 2);
    CHECK(told / measured > 0.5);
}

HeightTexture rounded_to_8_bits(const HeightTexture& from) {
    HeightTexture height;
    const float* first = from.values.data();
    const auto [least, most] = std::minmax_element(first, first + from.values.size());
    height.values = copied(from.values);
    for (std::size_t i = 0; i < height.values.size(); ++i)
        height.values.data()[i] = std::round((first[i] - *least) / (*most - *least) * 255) / 255;
    height.levels = 256, height.step = 1 / 255.0;
    return height;
}

/// The same in [0, 1] without steps.
HeightTexture unit_range(const HeightTexture& from) {
    HeightTexture height;
    const float* first = from.values.data();
    const auto [least, most] = std::minmax_element(first, first + from.values.size());
    height.values = copied(from.values);
    for (std::size_t i = 0; i < height.values.size(); ++i)
        height.values.data()[i] = (first[i] - *least) / (*most - *least);
    height.levels = 257;
    return height;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : triangulate(mesh)) {
        const auto p = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[std::size_t(k)]]]); };
        sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
    }
    return sum;
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : triangulate(mesh)) {
        const auto p = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[std::size_t(k)]]]); };
        sum += glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
    }
    return sum;
}

/// By how much displacement grows the body, over its area.
double measured_shift(const Job& job) {
    Relief relief;
    relief.values = copied(job.height.values), relief.height = job.options;
    const Displaced displaced = displace(BaseSurface(Mesh(job.mesh)), relief, {});
    return (volume(displaced.mesh) - volume(job.mesh)) / area(job.mesh);
}

/// A ramp along u, which does not tile.
HeightTexture ramp(int size) {
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) height.values.at(x, y) = float(x) / float(size);
    height.levels = 257;
    return height;
}

bool has(const std::vector<std::string>& lines, const std::string& part) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(part) != line.npos; });
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "check_relief: the share of a torus that folds, where, and the focal radius are those of the closed form") {
        const Mesh mesh = oracle::torus_mesh(96, 48);
        const oracle::TorusRelief r{0.6, 5, 3};
        const HeightTexture height = oracle::relief_texture(r, 128);
        const ReliefCheck check = check_of({mesh, height, {.amplitude = 2 * r.A, .midlevel = 0.5}});
        double folded = 0, all = 0, margin = 1;
        for (int i = 0; i < 150; ++i)
            for (int j = 0; j < 150; ++j) {
                const double u = (i + 0.5) / 150, v = (j + 0.5) / 150, b = oracle::relief(r, u, v).b;
                const double c = std::cos(2 * oracle::pi * v), ring = 1 + 0.4 * c;
                const double own = std::min(1 + b / 0.4, 1 + b * c / ring);
                all += ring, folded += own <= 0 ? ring : 0, margin = std::min(margin, own);
            }
        CHECK(check.folded == doctest::Approx(folded / all).epsilon(0.05));
        CHECK(check.fold_margin == doctest::Approx(margin).epsilon(0.05));
        CHECK(check.focal == doctest::Approx(0.4).epsilon(0.02));
    }

    TEST_CASE("check_relief: on a torus the errors of levels, of filters and of a border are those of whole maps") {
        const Mesh mesh = oracle::torus_mesh(64, 32);
        const oracle::TorusRelief slow{0.02, 3, 2}, fast{0.004, 16, 2};
        const HeightOptions options{.amplitude = 0.04, .midlevel = 0.5}, small{.amplitude = 0.008, .midlevel = 0.5};
        const HeightTexture bytes = oracle::relief_texture(slow, 128, 8), floats = oracle::relief_texture(slow, 128);
        const Job coarse{mesh, bytes, options, Filter::central}, exact{mesh, floats, options, Filter::central};
        check_within_two(check_of(coarse).budget->quantisation_deg, rms_deg(coarse, exact, everywhere));

        const HeightTexture waves = oracle::relief_texture(fast, 128); // of 8 texels
        const Job central{mesh, waves, small, Filter::central}, spline{mesh, waves, small, Filter::c2};
        const ReliefCheck told = check_of(central);
        check_within_two(told.budget->filter_deg, rms_deg(central, spline, everywhere));
        CHECK(told.better_filter);
        CHECK(told.budget->quantisation_deg == 0);

        const HeightTexture rises = ramp(128);
        for (const Filter filter : {Filter::central, Filter::c2}) {
            const Job repeated{mesh, rises, options, filter};
            Job clamped = repeated;
            clamped.options.wrap_u = Wrap::clamp;
            const ReliefCheck ridge = check_of(repeated);
            check_within_two(ridge.ridge_u_deg, rms_deg(repeated, clamped, [](int x) { return x == 0 || x == 127; }));
            CHECK(ridge.ridge_v_deg == 0);
        }
    }

    TEST_CASE("check_relief: the mean of the height is by how much displacement grows a torus over its area") {
        const Mesh mesh = oracle::torus_mesh(96, 48);
        const HeightTexture height = oracle::relief_texture({0.01, 5, 3}, 128);
        for (const double midlevel : {0.1, 0.9}) {
            const Job job{mesh, height, {.amplitude = 0.02, .midlevel = midlevel}};
            const double told = check_of(job).mean;
            CHECK(told == doctest::Approx(0.02 * (0.5 - midlevel)).epsilon(0.02));
            check_within_two(told, measured_shift(job));
        }
    }

    TEST_CASE("check_relief: the methods are off by what method_error finds at the texels of a map") {
        const Mesh mesh = oracle::torus_mesh(64, 32);
        const oracle::TorusRelief r{0.05, 5, 3};
        const HeightTexture height = oracle::relief_texture(r, 128);
        double largest = 0;
        for (int i = 0; i < 100; ++i)
            for (int j = 0; j < 100; ++j) {
                const Jet<double> s = oracle::unit_torus(0.01 * i, 0.01 * j);
                const Height<double> h = oracle::relief(r, 0.01 * i, 0.01 * j);
                largest = std::max(largest, oracle::angle_deg(displaced_normal(s, h, NormalMethod::blinn),
                                                              displaced_normal(s, h, NormalMethod::exact)));
            }
        const ReliefCheck check = check_of({mesh, height, {.amplitude = 0.1}, Filter::c2});
        CHECK(check.blinn.largest_deg == doctest::Approx(largest).epsilon(0.1));
        CHECK(check.constant_scale.largest_deg > check.blinn.largest_deg);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("inspect_relief: each error has one line with a remedy, and without errors there is none") {
        const Mesh mesh = oracle::torus_mesh(48, 24);
        const HeightTexture deep = oracle::relief_texture({0.6, 5, 3}, 64, 8), rises = ramp(64);
        const HeightOptions much{.amplitude = 1.2, .midlevel = 0.5};
        const Findings found = inspect_relief("a.obj", mesh, "b.png", deep, Filter::central, much).findings;
        REQUIRE(found.warnings.size() == 1);
        CHECK(has(found.warnings, "turns inside out, where the height is beyond the focal radius"));
        // The amplitude that it names does not fold.
        const auto at = found.warnings[0].find("`amplitude` to ");
        REQUIRE(at != std::string::npos);
        const double safe = std::atof(found.warnings[0].c_str() + at + 15);
        CHECK(safe < 0.8);
        CHECK(safe > 0.75);
        CHECK(check_of({mesh, deep, {.amplitude = safe}}).folded == 0);
        CHECK(has(found.notes, "constant-scale is off by up to"));
        CHECK(has(found.notes, "blinn is off by up to"));
        CHECK(has(found.notes, "the levels of the height tilt the normal by"));
        const Findings moved =
            inspect_relief("a.obj", mesh, "b.png", rises, Filter::central, {.amplitude = 0.04, .midlevel = 0}).findings;
        CHECK(has(moved.warnings, "the height does not tile in x"));
        CHECK(has(moved.notes, "displacement moves the whole surface out by so much"));
        CHECK(has(moved.notes, "set `midlevel` to 0.49"));
        HeightTexture smooth = oracle::relief_texture({1, 2, 2}, 64);
        const Findings none = inspect_relief("a.obj", mesh, "b.exr", smooth, Filter::c2, {.amplitude = 1e-4}).findings;
        CHECK(none.warnings.empty());
        CHECK_MESSAGE(none.notes.empty(), none.notes.front());
    }

    TEST_CASE("inspect_relief: text and JSON have the same figures") {
        const Mesh mesh = oracle::torus_mesh(48, 24);
        const HeightTexture height = oracle::relief_texture({0.05, 5, 3}, 64, 8);
        const ReliefReport report =
            inspect_relief("a.obj", mesh, "b.png", height, Filter::automatic, {.amplitude = 0.1});
        const auto json = nlohmann::json::parse(to_json(report));
        CHECK(json["kind"] == "relief");
        CHECK(json["filter"] == "sobel");
        CHECK(json["blinn"]["largest_deg"].get<double>() == report.check.blinn.largest_deg);
        CHECK(json["fold"]["share"] == 0);
        CHECK(to_text(report).starts_with("a.obj + b.png\n"));
        CHECK(to_text(report).find("nothing wrong\n") != std::string::npos);
        CHECK(json["notes"].size() == report.findings.notes.size());
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE(
        "check_relief: on real meshes under real heights every prediction is within a factor of 2 of the measured") {
        const auto data = test::shared_data();
        const HeightTexture read = read_height((data / "textures/heights/terrain3d_mountain1.exr").string());
        Image<float> minified = box_minify(read.values, 256, 256);
        HeightTexture small;
        small.values = std::move(minified);
        const HeightTexture floats = unit_range(small), bytes = rounded_to_8_bits(small);
        const Mesh spot = read_mesh((data / "meshes/spot/spot_triangulated.obj").string());
        const double size = diagonal(bounds(spot));
        const HeightOptions options{.amplitude = 0.02 * size, .midlevel = 0};
        const Job coarse{spot, bytes, options, Filter::sobel}, fine{spot, floats, options, Filter::sobel};
        const ReliefCheck told = check_of(coarse), smooth = check_of(fine);
        const double levels = rms_deg(coarse, fine, everywhere);
        MESSAGE("levels: told " << told.budget->quantisation_deg << ", measured " << levels);
        check_within_two(told.budget->quantisation_deg, levels);
        Job spline = fine;
        spline.filter = Filter::c2;
        const double filter = rms_deg(fine, spline, everywhere);
        MESSAGE("filter: told " << smooth.budget->filter_deg << ", measured " << filter);
        check_within_two(smooth.budget->filter_deg, filter);
        const double shift = measured_shift(fine);
        MESSAGE("shift: told " << smooth.mean << ", measured " << shift);
        check_within_two(smooth.mean, shift);
        const Job deep{spot, floats, {.amplitude = 0.2 * size, .midlevel = 1}, Filter::c2};
        const BakeTarget target = make_bake_target(spot, "spot", 256, 256);
        NormalMapReport report;
        map_of(deep, target, report);
        const double folded = double(report.folded) / double(report.covered);
        const double told_folds = check_of(deep).folded;
        MESSAGE("folds: told " << told_folds << ", measured " << folded);
        check_within_two(told_folds, folded);
        const HeightTexture rises = ramp(256);
        const Job repeated{spot, rises, options, Filter::central};
        Job clamped = repeated;
        clamped.options.wrap_u = Wrap::clamp;
        const double ridge = rms_deg(repeated, clamped, [](int x) { return x == 0 || x == 255; });
        const double told_ridge = check_of(repeated).ridge_u_deg;
        MESSAGE("border: told " << told_ridge << ", measured " << ridge);
        check_within_two(told_ridge, ridge);
    }
}
