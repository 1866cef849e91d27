// Pictures, and maps of heights.
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/picture_name.h"
#include "bake/relief/map/normal_map.h"
#include "bake/verdict/metric/flip.h"
#include "choice.h"
#include "image_array.h"
#include "mesh_class.h"
#include "module.h"
#include "wait.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace bake::python {
namespace {

using Path = std::filesystem::path;

Filter filter_of(const std::string& word) {
    if (word == "auto") return Filter::automatic;
    for (const Filter filter : all_filters)
        if (name(filter) == word) return filter;
    throw Error(Refusal::usage, "filter: " + word + " is none of auto, central, sobel, scharr, order4, order6, c2");
}

Wrap wrap_of(const std::string& word) {
    return choice<Wrap>("wrap", word, {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}});
}

NormalMethod method_of(const std::string& word) {
    for (const NormalMethod method : all_normal_methods)
        if (name(method) == word) return method;
    throw Error(Refusal::usage, "method: " + word + " is none of exact, blinn, surface-gradient, constant-scale");
}

/// A height in an array. Its number of levels is not counted: it is taken for one of more than 256.
HeightTexture height_of(const FloatArray& array) {
    HeightTexture height;
    height.values = to_image(array, "height");
    if (height.values.channels() != 1) throw py::value_error("height: has several channels; one is expected");
    height.levels = 257;
    height.info.type = SampleType::float32;
    height.info.width = height.values.width(), height.info.height = height.values.height();
    height.info.channels = {"Y"};
    return height;
}

/// As picture_height() refuses files: slopes of larger values could leave the range of float.
void refuse_bad_values(const Image<float>& values) {
    for_rows(values.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < values.width(); ++x)
                if (!(std::abs(values.at(x, y)) <= 1e12f))
                    throw Error(Refusal::unsuitable, "height: has values that are NaN, infinite or beyond 1e12");
    });
}

struct MapRequest {
    NormalMapOptions options;
    std::optional<Vec2d> extent;
};

Image<float> bake_map(const HeightTexture& height, const Mesh* mesh, MapRequest request) {
    refuse_bad_values(height.values);
    NormalMapOptions& options = request.options;
    if (options.width == 0) options.width = height.values.width(), options.height = height.values.height();
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    Progress progress;
    progress.start("bake", options.height);
    if (!mesh) {
        const Vec2d extent =
            request.extent.value_or(resolve_extent(0, 0, height.values.width(), height.values.height()));
        return normal_map(field, extent, options, &progress);
    }
    const BakeTarget target = make_bake_target(*mesh, "mesh", options.width, options.height, options.tile);
    NormalMapReport report;
    return normal_map(field, target, options, report, &progress);
}

using Pair = std::pair<double, double>;
using Size = std::pair<int, int>;

py::array_t<float> normal_map_of(const FloatArray& array, double amplitude, const MeshHandle& mesh, double midlevel,
                                 const std::optional<Pair>& extent, const std::string& wrap, const std::string& filter,
                                 const std::string& method, const std::string& space, bool directx,
                                 const std::optional<Size>& size, int padding, int threads,
                                 const py::object& progress) {
    MapRequest request;
    NormalMapOptions& options = request.options;
    options.height_options = {
        .amplitude = amplitude, .midlevel = midlevel, .wrap_u = wrap_of(wrap), .wrap_v = wrap_of(wrap)};
    options.filter = filter_of(filter);
    options.method = method_of(method);
    options.space = choice<Space>("space", space, {{"tangent", Space::tangent}, {"object", Space::object}});
    options.directx = directx, options.padding = padding;
    if (extent) request.extent = Vec2d(extent->first, extent->second);
    if (extent && !(extent->first > 0 && extent->second > 0)) throw py::value_error("extent: is not positive");
    if (size) options.width = size->first, options.height = size->second;
    if (size && (options.width < 1 || options.height < 1)) throw py::value_error("size: is less than 1");
    const HeightTexture height = height_of(array);
    Image<float> map;
    wait_for_job(progress, threads, [&] { map = bake_map(height, mesh.get(), request); });
    return to_numpy(std::move(map));
}

py::array_t<float> bump_table_of(const FloatArray& array, double amplitude, const std::string& units,
                                 const std::optional<Pair>& extent, const std::string& wrap, const std::string& filter,
                                 int threads, const py::object& progress) {
    BumpTableOptions options{.filter = filter_of(filter), .wrap_u = wrap_of(wrap), .wrap_v = wrap_of(wrap)};
    options.units = choice<SlopeUnits>("units", units,
                                       {{"uv", SlopeUnits::uv},
                                        {"texel", SlopeUnits::texel},
                                        {"world", SlopeUnits::world},
                                        {"difference", SlopeUnits::difference}});
    options.amplitude = amplitude;
    if (extent) options.extent_u = extent->first, options.extent_v = extent->second;
    const HeightTexture height = height_of(array);
    Image<float> table;
    wait_for_job(progress, threads, [&] {
        refuse_bad_values(height.values);
        table = bump_table(height, options);
    });
    return to_numpy(std::move(table));
}

py::array_t<float> flip_of(const FloatArray& reference, const FloatArray& test, double pixels_per_degree, int threads) {
    const Image<float> a = to_image(reference, "reference"), b = to_image(test, "test");
    if (a.channels() != 3 || b.channels() != 3) throw py::value_error("flip: both pictures have three channels");
    if (a.width() != b.width() || a.height() != b.height()) throw py::value_error("flip: the pictures differ in size");
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
        throw py::value_error("pixels_per_degree: is not in 1 to 1000");
    Image<float> errors;
    wait_for_job(py::none(), threads, [&] { errors = flip(a, b, {.pixels_per_degree = pixels_per_degree}); });
    return to_numpy(std::move(errors));
}

py::array_t<float> read_picture(const Path& path, int threads) {
    Image<float> image;
    wait_for_job(py::none(), threads, [&] { image = read_image(path.string()); });
    return to_numpy(std::move(image));
}

void write_picture(const Path& path, const FloatArray& array, const std::string& depth, int threads) {
    WriteOptions options;
    options.depth = choice<Depth>("depth", depth,
                                  {{"auto", Depth::automatic},
                                   {"8", Depth::u8},
                                   {"16", Depth::u16},
                                   {"half", Depth::half},
                                   {"float", Depth::float32}});
    const Image<float> image = to_image(array, "image");
    // As bake cubemap does: an .exr is of half floats unless these would be infinite.
    constexpr float largest_half = 65504;
    if (options.depth == Depth::automatic && picture_format(path.string()) == PictureFormat::exr &&
        std::any_of(image.data(), image.data() + image.size(), [](float v) { return std::abs(v) > largest_half; }))
        options.depth = Depth::float32;
    wait_for_job(py::none(), threads, [&] { write_image(path.string(), image, options); });
}

} // namespace

void add_pictures(py::module_& m) {
    using py::arg;
    m.def("read_image", &read_picture, arg("path"), py::kw_only(), arg("threads") = 0,
          "The values of a picture as they are stored: integers divided by their largest value, sRGB not decoded.");
    m.def(
        "write_image", &write_picture, arg("path"), arg("image"), py::kw_only(), arg("depth") = "auto",
        arg("threads") = 0,
        "Writes .png, .exr or .tif. depth: auto, 8, 16, half or float; auto of .exr is half, or float for values above "
        "65504.");
    m.def("normal_map", &normal_map_of, arg("height"), arg("amplitude") = 1.0, arg("mesh") = MeshHandle(),
          py::kw_only(), arg("midlevel") = 0.0, arg("extent") = py::none(), arg("wrap") = "repeat",
          arg("filter") = "auto", arg("method") = "exact", arg("space") = "tangent", arg("directx") = false,
          arg("size") = py::none(), arg("padding") = 16, arg("threads") = 0, arg("progress") = py::none(),
          "The normal map of a height, amplitude * (value - midlevel) object units, on a flat rectangle of extent\n"
          "(1, height / width) or on a mesh with uvs: (height, width, 3), encoded as (n + 1) / 2. size: (width, "
          "height).");
    m.def("bump_table", &bump_table_of, arg("height"), arg("amplitude") = 1.0, py::kw_only(), arg("units") = "uv",
          arg("extent") = py::none(), arg("wrap") = "repeat", arg("filter") = "auto", arg("threads") = 0,
          arg("progress") = py::none(), "The slopes (b_u, b_v) of a height: (height, width, 2), v up.");
    m.def("flip", &flip_of, arg("reference"), arg("test"), py::kw_only(),
          arg("pixels_per_degree") = flip_pixels_per_degree, arg("threads") = 0,
          "The FLIP error of each pixel of two pictures of linear RGB, in [0, 1].");
}

} // namespace bake::python
