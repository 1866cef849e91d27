// Slopes of heights: frequency, borders, edges, levels, texels that are not square, and how normals are stored.
#include "bake/picture/image_io.h"
#include "bake/relief/height/height_notes.h"
#include "bake/relief/map/bake_budget.h"
#include "oracle/surfaces.h"
#include "stability/themes.h"
#include "stability/worst_angle.h"

using namespace bake;

namespace stability {
namespace {

template <class T, class Value> Image<T> picture(int width, int height, const Value& value) {
    Image<T> out(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) out.at(x, y) = T(value(x, y));
    return out;
}

/// Slope along u per texel at one texel.
double slope_at(const Image<double>& image, Filter filter, Wrap wrap, int x, int y) {
    return SlopeFilter<double>(image, filter, wrap, wrap).at(x, y, 1, 1).first;
}

/// Gain along a diagonal wave of w rad per texel on both axes, as published for each filter.
double closed_gain(Filter filter, double w) {
    const double central = std::sin(w) / w;
    switch (filter) {
    case Filter::sobel: return central * (1 + std::cos(w)) / 2;
    case Filter::scharr: return central * (10 + 6 * std::cos(w)) / 16;
    case Filter::order4: return (8 * std::sin(w) - std::sin(2 * w)) / (6 * w);
    case Filter::order6: return (45 * std::sin(w) - 9 * std::sin(2 * w) + std::sin(3 * w)) / (30 * w);
    case Filter::c2: return 3 * std::sin(w) / (w * (2 + std::cos(w)));
    default: return central;
    }
}

std::vector<Row> frequency_rows(int steps) {
    constexpr int n = 128, at = n / 2;
    std::vector<Row> rows;
    for (const Filter filter : all_filters)
        for (const double k : linear_steps(2, n / 2, steps)) {
            const double w = 2 * pi * std::round(k) / n;
            const auto wave = picture<double>(n, n, [&](int x, int y) { return std::sin(w * (x - at + y - at)); });
            rows.push_back({std::string(name(filter)), w / pi,
                            std::abs(1 - slope_at(wave, filter, Wrap::repeat, at, at) / w),
                            std::abs(1 - closed_gain(filter, w)),
                            "auto: sobel up to 256 levels, else c2; the budget has a line filter"});
        }
    return rows;
}

/// A wave of x periods over the picture: at whole numbers it repeats. The largest error of the slope in the border column.
std::vector<Row> border_rows(int steps) {
    constexpr int n = 64;
    std::vector<Row> rows;
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
        for (const double periods : linear_steps(4, 5, steps)) {
            const double w = 2 * pi * periods / n;
            const auto value = [&](double x) { return std::sin(w * x + 0.7); };
            const auto wave = picture<double>(n, n, [&](int x, int) { return value(x); });
            HeightTexture height;
            height.values = picture<float>(n, n, [&](int x, int) { return 0.5 + 0.4 * value(x); });
            height.levels = 257;
            double measured = 0, predicted = 0;
            for (const int x : {0, n - 1}) {
                measured = std::max(measured,
                                    std::abs(slope_at(wave, Filter::central, wrap, x, 5) / w - std::cos(w * x + 0.7)));
                // The missing neighbour: the other border, the border itself, or the parabola through three texels.
                const int in = x == 0 ? 1 : -1;
                const double beyond = wrap == Wrap::repeat   ? value(n - 1 - x)
                                      : wrap == Wrap::mirror ? value(x)
                                                             : 3 * value(x) - 3 * value(x + in) + value(x + 2 * in);
                const double slope = in * (value(x + in) - beyond) / 2;
                predicted = std::max(predicted, std::abs(slope / w - std::cos(w * x + 0.7)));
            }
            const bool noted = !height_notes(height, wrap, wrap).empty();
            rows.push_back({wrap == Wrap::repeat  ? "repeat"
                            : wrap == Wrap::clamp ? "clamp"
                                                  : "mirror",
                            periods, measured, predicted, noted ? "note: breaks off at its border" : "no note"});
        }
    return rows;
}

/// The steepest slope of an edge of Gaussian profile, relative to the true one.
std::vector<Row> edge_rows(int steps) {
    constexpr int n = 129, at = n / 2;
    const double z = std::sqrt(3.0) - 2;
    std::vector<Row> rows;
    for (const Filter filter : {Filter::central, Filter::order4, Filter::order6, Filter::c2})
        for (const double sharpness : geometric_steps(1 / 8.0, 10, steps)) {
            const double sigma = 1 / sharpness;
            const auto erf = [&](double x) { return std::erf(x / (sigma * std::sqrt(2.0))); };
            const auto edge = picture<double>(n, 5, [&](int x, int) { return 0.5 + 0.5 * erf(x - at); });
            const double steepest = 1 / (sigma * std::sqrt(2 * pi));
            double slope = 0; // half the difference of both sides of an edge is erf / 2
            switch (filter) {
            case Filter::order4: slope = (8 * erf(1) - erf(2)) / 12; break;
            case Filter::order6: slope = (45 * erf(1) - 9 * erf(2) + erf(3)) / 60; break;
            case Filter::c2:
                for (int k = 1; k < 50; ++k)
                    slope += std::sqrt(3.0) / 2 * (std::pow(z, k - 1) - std::pow(z, k + 1)) * erf(k);
                break;
            default: slope = erf(1) / 2;
            }
            rows.push_back({std::string(name(filter)), sharpness,
                            std::abs(slope_at(edge, filter, Wrap::clamp, at, 2) / steepest - 1),
                            std::abs(slope / steepest - 1), "finite slopes; no note"});
        }
    return rows;
}

/// Rms tilt by levels of x texels height, under each filter: waves between the levels of an integer file.
std::vector<Row> level_rows(int steps) {
    constexpr int n = 128;
    constexpr double tall = 20; // texels from black to white
    const auto value = [](int x, int y) {
        return 0.5 + 0.22 * std::sin(0.0617 * x + 0.0391 * y) + 0.2 * std::cos(0.0533 * y - 0.021 * x);
    };
    const auto smooth = picture<double>(n, n, value);
    std::vector<Row> rows;
    for (const auto& [filter, noise] :
         {std::pair(Filter::sobel, 0.4330), {Filter::central, 0.7071}, {Filter::order6, 1.0819}, {Filter::c2, 1.180}})
        for (const double level : geometric_steps(1e-4, 0.5, steps)) {
            const double q = level / tall;
            const auto stepped = picture<double>(n, n, [&](int x, int y) { return std::round(value(x, y) / q) * q; });
            const SlopeFilter<double> own(stepped, filter, Wrap::clamp, Wrap::clamp),
                truth(smooth, filter, Wrap::clamp, Wrap::clamp);
            double sum = 0;
            int count = 0;
            for (int y = 20; y < n - 20; y += 3)
                for (int x = 20; x < n - 20; x += 3, ++count) {
                    const double difference = tall * (own.at(x, y, 1, 1).first - truth.at(x, y, 1, 1).first);
                    sum += difference * difference;
                }
            HeightTexture height;
            height.levels = std::min(257, int(1 / q) + 1);
            rows.push_back({std::string(name(filter)), level, glm::degrees(std::atan(std::sqrt(sum / count))),
                            glm::degrees(std::atan(level / std::sqrt(12.0) * noise)),
                            "--filter auto: " + std::string(name(resolve_filter(Filter::automatic, height)))});
        }
    return rows;
}

/// Heights of 10 texels in half floats, on an offset: halves have 11 bits wherever they are.
std::vector<Row> half_rows(int steps) {
    constexpr int n = 128;
    constexpr double tall = 10;
    std::vector<Row> rows;
    for (const double offset : geometric_steps(1, 200, steps)) {
        const double low = std::exp2(std::ceil(std::log2(offset))); // inside one binade, whose spacing is even
        const auto value = [&](int x, int y) {
            return low + 0.5 + 0.22 * std::sin(0.0617 * x + 0.0391 * y) + 0.2 * std::cos(0.0533 * y - 0.021 * x);
        };
        const auto smooth = picture<double>(n, n, value);
        const auto half = picture<double>(n, n, [&](int x, int y) { return double(as_half(float(value(x, y)))); });
        const SlopeFilter<double> own(half, Filter::c2, Wrap::clamp, Wrap::clamp),
            truth(smooth, Filter::c2, Wrap::clamp, Wrap::clamp);
        double sum = 0;
        int count = 0;
        for (int y = 20; y < n - 20; y += 3)
            for (int x = 20; x < n - 20; x += 3, ++count) {
                const double difference = tall * (own.at(x, y, 1, 1).first - truth.at(x, y, 1, 1).first);
                sum += difference * difference;
            }
        rows.push_back({"c2", low, glm::degrees(std::atan(std::sqrt(sum / count))),
                        glm::degrees(std::atan(tall * low * std::exp2(-10) / std::sqrt(12.0) * 1.180)),
                        "no note: floats count as without steps"});
    }
    return rows;
}

/// A picture of x texels per row on a square: the table of slopes per texel read as if texels were square, and per unit of
/// length, which is right.
std::vector<Row> aspect_rows(int steps) {
    std::vector<Row> rows;
    for (const bool world : {false, true})
        for (const double aspect : geometric_steps(1, 16, steps)) {
            const int h = 16, w = int(std::round(aspect * h));
            HeightTexture height;
            // b = x + y on the unit square.
            height.values = picture<float>(w, h, [&](int x, int y) { return (x + 0.5) / w + 1 - (y + 0.5) / h; });
            height.levels = 257;
            const BumpTable table(height, {.filter = Filter::central,
                                           .wrap_u = Wrap::clamp,
                                           .wrap_v = Wrap::clamp,
                                           .units = world ? SlopeUnits::world : SlopeUnits::texel,
                                           .extent_u = 1,
                                           .extent_v = 1});
            std::vector<float> row(2 * w);
            SlopeFilter<float>::Scratch scratch;
            table.row(h / 2, row.data(), scratch);
            // The table's factors along x and y; read with the factor that is right along y.
            const double d_y = row[w / 2 * 2 + 1] * (world ? 1.0 : h), d_x = row[w / 2 * 2] * (world ? 1.0 : h);
            const double worst = worst_angle([&](const Vec2d& s) {
                return oracle::angle_deg({-s.x, -s.y, 1}, {-d_x * s.x, -d_y * s.y, 1});
            });
            const double a = double(w) / h;
            rows.push_back({world ? "--units world" : "--units texel, read as square", a, worst,
                            world ? 0 : glm::degrees(std::asin((a - 1) / (a + 1))),
                            "exit 0; the unit is the user's choice"});
        }
    return rows;
}

/// A ramp of slope x as a normal map of a depth: how far the slope that is read back is off, relatively.
std::vector<Row> steep_rows(int steps) {
    std::vector<Row> rows;
    const struct {
        const char* name;
        Depth depth;
        double step;
    } kinds[] = {{"8 bit", Depth::u8, 1.0 / 255},
                 {"16 bit", Depth::u16, 1.0 / 65535},
                 {"float", Depth::float32, std::exp2(-23)}};
    for (const auto& [label, depth, step] : kinds)
        for (const double slope : geometric_steps(1e-2, 1e4, steps)) {
            double measured = 0;
            for (int i = 0; i < 40; ++i) { // the worst of directions
                const double turn = 0.1 + 0.157 * i;
                const Height<double> h{0, slope * std::cos(turn), slope * std::sin(turn)};
                Jet<double> plane{};
                plane.p_u = {1, 0, 0}, plane.p_v = {0, 1, 0}, plane.n = {0, 0, 1};
                const Vec3d n = glm::normalize(displaced_normal(plane, h, NormalMethod::exact));
                const Vec3f t = decode_normal(stored_normal(encode_normal(Vec3f(n), false), depth), false);
                measured = std::max(measured, oracle::angle_deg(Vec3d(t), n));
            }
            rows.push_back({label, slope, measured, glm::degrees(std::asin(std::sqrt(3.0) * step)),
                            "exit 0; the budget has a line encoding"});
        }
    return rows;
}

} // namespace

std::vector<Sweep> slope_sweeps() {
    const std::string test = "stability/slope_test";
    return {
        {.name = "filter_frequency",
         .construction = "diagonal waves up to Nyquist; x = frequency over Nyquist, per axis",
         .x_label = "frequency / Nyquist",
         .y_label = "loss of slope",
         .log_y = true,
         .limit = 0.05,
         .closed_form = "gain of the filter, 5 % lost",
         .test = test,
         .rows = frequency_rows},
        {.name = "wrap_border",
         .construction = "waves of x periods over the picture: slope at the border, central filter",
         .x_label = "periods over the picture",
         .y_label = "largest error / largest slope",
         .limit = 0.1,
         .closed_form = "the slope with the neighbour that the wrap mode supplies, 10 % off",
         .test = test,
         .rows = border_rows},
        {.name = "step_edge",
         .construction = "an edge of Gaussian profile, sigma = 1 / x texels: its steepest slope",
         .x_label = "1 / sigma of the edge, per texel",
         .y_label = "relative error of the slope",
         .log_x = true,
         .log_y = true,
         .limit = 0.1,
         .falls = false,
         .closed_form = "the filter's taps on erf, 10 % off",
         .test = test,
         .rows = edge_rows},
        {.name = "height_levels",
         .construction =
             "an integer height 20 texels high; x = height of one level in texels (8 bits: .08, 16 bits: 3e-4)",
         .x_label = "height of one level, texels",
         .y_label = "rms tilt, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.318,
         .closed_form = "level / sqrt(12) times the filter's noise, .318 deg",
         .test = test,
         .rows = level_rows},
        {.name = "half_heights",
         .construction = "a height in half floats, 10 texels high on an offset; x = offset over height",
         .x_label = "offset / height",
         .y_label = "rms tilt, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.318,
         .closed_form = "spacing of halves / sqrt(12) times the filter's noise, .318 deg",
         .test = test,
         .rows = half_rows},
        {.name = "texel_aspect",
         .construction = "bump-table of x by 1 texels per unit, over all slopes",
         .x_label = "texels along u over texels along v",
         .y_label = "worst angle, deg",
         .log_x = true,
         .limit = 0.318,
         .closed_form = "asin((x - 1) / (x + 1)), .318 deg",
         .test = test,
         .rows = aspect_rows},
        {.name = "steep_slope",
         .construction = "a slope x in the worst direction, as a normal map",
         .x_label = "slope",
         .y_label = "worst error of the normal, deg",
         .log_x = true,
         .log_y = true,
         .limit = 0.39,
         .closed_form = "asin(sqrt(3) step) at any slope: .389 deg at 8 bits",
         .test = test,
         .rows = steep_rows},
    };
}

} // namespace stability
