#include "bake/verdict/compare/normals_report.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/picture/image_io.h"
#include "bake/relief/height/sample_type.h"
#include "bake/verdict/compare/finite_pixels.h"
#include "bake/verdict/finding_text.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Negative values need no decoding. Floats without any have the encoding that makes them unit.
NormalEncoding object_encoding(const Image<float>& image, const ImageInfo& info) {
    bool below = is_signed_integer(info);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c) below = below || image.at(x, y, c) < 0;
    if (below) return NormalEncoding::signed_;
    const auto misfit = [&](NormalEncoding encoding) {
        return measure_normals(image, {.encoding = encoding}).length_error;
    };
    return is_float(info) && misfit(NormalEncoding::signed_) < misfit(NormalEncoding::unorm) ? NormalEncoding::signed_
                                                                                             : NormalEncoding::unorm;
}

/// The vectors of a file, y as stored.
Image<float> read_normals(const std::string& file, NormalSpace space, NormalValues& values, Findings& findings) {
    ImageInfo info;
    const Image<float> image = read_image(file, &info);
    const int least = space == NormalSpace::object ? 3 : 2;
    if (image.channels() < least)
        throw Error(Refusal::unsuitable, file + ": has " + counted(std::size_t(image.channels()), "channel") +
                                             ", where normals have " + (least == 3 ? "three" : "two or three") +
                                             "; give a normal map");
    require_finite_pixels(image, std::min(image.channels(), 4), file);
    if (space == NormalSpace::tangent) {
        values = guess_normal_values(image, info);
        if (const std::string note = describe(values); !note.empty()) findings.notes.push_back(file + ": " + note);
    } else {
        values.encoding = object_encoding(image, info);
    }
    for (const std::string& line : info.notes) findings.notes.push_back(file + ": " + line);
    return decode_normals(image, values);
}

/// Says what the slopes tell of the green of the two, and turns the second one's green if it points the other way.
void settle_green(const Image<float>& a, Image<float>& b, NormalsReport& report) {
    const PairCheck& c = report.check = check_normals(a, b);
    const auto note = [&](const std::string& line) { report.findings.notes.push_back(line); };
    if (c.flat) return note("one of the two is flat, so its green cannot point anywhere");
    if (c.height_decided && c.inverted)
        report.findings.warnings.push_back("the slopes along u are opposed: the second shows the relief inverted, or "
                                           "its red is; compared as it is");
    else if (c.directx) {
        report.green_turned = true;
        for (std::size_t i = 1; i < b.size(); i += 3) b.data()[i] = -b.data()[i];
        note("green of the second points the other way (OpenGL against DirectX): turned before comparing");
    } else if (!c.green_decided) {
        note(
            format("the slopes agree too little to tell where green points (correlation x %+.2f, y %+.2f): compared as "
                   "it is",
                   c.corr_x, c.corr_y));
    }
}

void measure(const Image<float>& a, const Image<float>& b, NormalsReport& report) {
    report.errors = Image<float>(a.width(), a.height(), 1);
    std::vector<double> angles;
    angles.reserve(report.errors.size());
    for (std::size_t i = 0; i < report.errors.size(); ++i) {
        const float *p = a.data() + 3 * i, *q = b.data() + 3 * i;
        const Vec3d n(p[0], p[1], p[2]), m(q[0], q[1], q[2]);
        report.errors.data()[i] = 0;
        if (n == Vec3d(0) || m == Vec3d(0)) {
            ++report.left_out;
            continue;
        }
        angles.push_back(angle_deg(n, m));
        report.errors.data()[i] = float(angles.back());
    }
    if (angles.empty())
        throw Error(Refusal::unsuitable,
                    report.other + ": has no pixel with a direction where " + report.file + " has one");
    report.angles = summarise(std::move(angles));
}

} // namespace

double angle_deg(const Vec3d& a, const Vec3d& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / pi;
}

NormalsReport compare_normals(const std::string& file, const std::string& other, const NormalsCompareOptions& options) {
    NormalsReport report{.file = file, .other = other, .space = options.space};
    over_limits(figures(report), options.limits); // names alone
    const Image<float> a = read_normals(file, options.space, report.values, report.findings);
    Image<float> b = read_normals(other, options.space, report.other_values, report.findings);
    require_one_size(a, file, b, other);
    report.width = a.width();
    report.height = a.height();
    if (options.space == NormalSpace::tangent) settle_green(a, b, report);
    measure(a, b, report);
    if (report.left_out > 0)
        report.findings.notes.push_back(counted(report.left_out, "pixel|without a direction") + ": left out");
    for (std::string& line : over_limits(figures(report), options.limits)) {
        report.findings.warnings.push_back(std::move(line));
        report.over_limit = true;
    }
    return report;
}

std::vector<Figure> figures(const NormalsReport& report) {
    std::vector<Figure> out;
    add_figures(out, "angle", report.angles);
    return out;
}

} // namespace bake
