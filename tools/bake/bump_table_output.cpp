#include "bump_table_output.h"
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr const char* bumpslopes_channels[] = {"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};

Vec2d extent_of(const BumpTableArgs& args, const BumpTable& table) {
    return resolve_extent(args.options.extent_u, args.options.extent_v, table.width(), table.height());
}

WriteOptions write_options(const BumpTableArgs& args, const Vec2d& extent, Depth depth, bool png,
                           const std::optional<SlopeCode>& code = {}) {
    WriteOptions options{.depth = depth,
                         .compression = args.compression,
                         .mips = args.layout == TableLayout::bumpslopes && !args.no_mips};
    if (args.layout == TableLayout::bumpslopes)
        options.channels.assign(std::begin(bumpslopes_channels), std::end(bumpslopes_channels));
    else options.channels = {"b_u", "b_v"};
    if (png) options.channels = {"R", "G", "B"};
    if (code) options.description = to_text(*code);
    options.facts = {{"content", std::string("bump table")},
                     {"slope_units", std::string(name(args.options.units))},
                     {"amplitude", args.options.amplitude},
                     {"units", std::string("object units")}};
    if (code) options.facts.push_back({"range", std::vector<double>{-double(code->range), double(code->range)}});
    if (args.options.units == SlopeUnits::world)
        options.facts.push_back({"extent", std::vector<double>{extent.x, extent.y}});
    return options;
}

/// Rows of pairs as the file has them: biased, and with a third, zero channel in PNG, where two would mean alpha.
class TableSink {
public:
    TableSink(ImageWriter& writer, int width, const std::optional<SlopeCode>& code, bool third, float limit,
              const std::string& path)
        : writer_(writer), width_(width), code_(code), third_(third), limit_(limit), path_(path) {}

    void operator()(const float* pairs, int rows) {
        const std::size_t count = 2 * std::size_t(rows) * width_;
        if (limit_ > 0)
            for (std::size_t i = 0; i < count; ++i)
                if (!(std::abs(pairs[i]) <= limit_))
                    throw Error(Refusal::unsuitable,
                                path_ +
                                    format(": a slope of %g does not fit half floats; use --depth float", pairs[i]));
        if (!code_) return writer_.write(pairs, rows);
        const int channels = third_ ? 3 : 2;
        room_.resize(count / 2 * channels);
        for (std::size_t i = 0; i < count / 2; ++i) {
            room_[i * channels] = code_->encode(pairs[2 * i]);
            room_[i * channels + 1] = code_->encode(pairs[2 * i + 1]);
            if (third_) room_[i * channels + 2] = 0;
        }
        writer_.write(room_.data(), rows);
    }

private:
    ImageWriter& writer_;
    int width_;
    std::optional<SlopeCode> code_;
    bool third_;
    float limit_;
    std::string path_;
    std::vector<float> room_;
};

constexpr float largest_half = 65504;

void write_slopes(const BumpTableArgs& args, const BumpTable& table, Depth depth, const std::optional<SlopeCode>& code,
                  Progress& progress) {
    const bool png = code && picture_format(args.out) == PictureFormat::png;
    ImageWriter writer(args.out, table.width(), table.height(), png ? 3 : 2,
                       write_options(args, extent_of(args, table), depth, png, code));
    TableSink sink(writer, table.width(), code, png, depth == Depth::half ? largest_half : 0, args.out);
    for_bands(table, std::ref(sink), &progress);
    writer.finish();
}

void write_moments(const BumpTableArgs& args, const BumpTable& table, Depth depth, Progress& progress) {
    ImageWriter writer(args.out, table.width(), table.height(), table.channels(),
                       write_options(args, extent_of(args, table), depth, false));
    const auto write = [&](const float* values, int rows, int width) {
        const std::size_t count = std::size_t(6) * rows * width;
        const float most = depth == Depth::half ? largest_half : std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < count; ++i)
            if (!(std::abs(values[i]) <= most))
                throw Error(Refusal::unsuitable,
                            args.out + format(": a moment of %g does not fit its file; use --depth float, --units "
                                              "texel or a smaller --amplitude",
                                              values[i]));
        writer.write(values, rows);
    };
    for_bands(
        table, [&](const float* values, int rows) { write(values, rows, table.width()); }, &progress);
    if (!args.no_mips && (table.width() > 1 || table.height() > 1)) {
        Image<float> level = halve(table);
        for (;;) {
            writer.next_level();
            write(level.data(), level.height(), level.width());
            if (level.width() == 1 && level.height() == 1) break;
            level = halve(level);
        }
    }
    writer.finish();
}

std::string_view described(SlopeUnits units) {
    switch (units) {
    case SlopeUnits::difference: return "difference h[+1] - h[-1]";
    case SlopeUnits::texel: return "per texel";
    case SlopeUnits::uv: return "per unit of u and v";
    case SlopeUnits::world: return "per object unit";
    }
    return "";
}

} // namespace

void write_table(const BumpTableArgs& args, const BumpTable& table, Depth depth, const std::optional<SlopeCode>& code,
                 Progress& progress) {
    if (args.layout == TableLayout::slopes) write_slopes(args, table, depth, code, progress);
    else write_moments(args, table, depth, progress);
}

std::string to_text(const BumpTableArgs& args, const BumpTableReport& r) {
    std::string text =
        format("%s: %d x %d, slopes %s, filter %s (%s), amplitude %g\n", printable(args.out).c_str(), r.table.width(),
               r.table.height(), std::string(described(args.options.units)).c_str(),
               std::string(name(r.table.filter())).c_str(), describe_levels(r.height).c_str(), args.options.amplitude);
    if (r.code) text += "stored biased: " + to_text(*r.code) + "\n";
    if (r.height.step > 0)
        text += format("one level of the height tilts the normal by %.3f deg at extent %g x %g\n", r.tilt_deg,
                       r.extent.x, r.extent.y);
    return text + to_text(r.budget) + "\n";
}

nlohmann::json to_json(const BumpTableArgs& args, const BumpTableReport& r) {
    nlohmann::json result = {{"out", args.out},
                             {"width", r.table.width()},
                             {"height", r.table.height()},
                             {"channels", r.table.channels()},
                             {"filter", name(r.table.filter())},
                             {"units", described(args.options.units)},
                             {"amplitude", args.options.amplitude},
                             {"levels", r.height.levels},
                             {"step", r.height.step},
                             {"step_tilt_deg", r.tilt_deg},
                             {"slope_loss", r.loss},
                             {"error_budget", to_json(r.budget)}};
    if (!r.notes.empty()) result["notes"] = r.notes;
    if (r.advice) result["better_filter"] = to_json(*r.advice);
    if (r.code) result["bias"] = {{"range", r.code->range}, {"zero_level", 32768}, {"levels_per_range", 32767}};
    return result;
}

} // namespace bake
