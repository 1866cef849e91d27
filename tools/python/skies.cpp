// Environments: cubes of six faces.
#include "bake/base/progress.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/environment/resample/resample.h"
#include "choice.h"
#include "image_array.h"
#include "module.h"
#include "wait.h"
#include <pybind11/stl.h>

namespace bake::python {
namespace {

using Faces = std::vector<FloatArray>;

/// Six square faces of one size, px nx py ny pz nz.
Cube sky_of(const Faces& faces) {
    if (faces.size() != 6) throw py::value_error("sky: six faces px nx py ny pz nz are expected");
    Cube cube;
    for (std::size_t i = 0; i < 6; ++i)
        cube.faces[i] = to_image(faces[i], std::string("sky: face ") + cube_face_names[i]);
    for (const Image<float>& face : cube.faces) {
        if (face.width() != face.height()) throw py::value_error("sky: a face is not square");
        if (face.width() != cube.size() || face.channels() != cube.channels())
            throw py::value_error("sky: the faces differ in size or channels");
    }
    if (cube.channels() > 4) throw py::value_error("sky: has more than four channels");
    return cube;
}

void require_finite(const Cube& cube) {
    for (const Image<float>& face : cube.faces)
        for (std::size_t i = 0; i < face.size(); ++i)
            if (!(std::abs(face.data()[i]) <= std::numeric_limits<float>::max()))
                throw Error(Refusal::unsuitable, "sky: has values that are NaN or infinite");
}

py::list to_list(Cube cube) {
    py::list out;
    for (Image<float>& face : cube.faces) out.append(to_numpy(std::move(face)));
    return out;
}

py::list irradiance_of(const Faces& faces, int size, const std::string& method, int bands, int threads,
                       const py::object& progress) {
    const IrradianceOptions options{
        .method = choice<IrradianceMethod>("method", method,
                                           {{"direct", IrradianceMethod::direct}, {"sh", IrradianceMethod::sh}}),
        .bands = bands,
        .size = size};
    const Cube sky = sky_of(faces);
    Cube result;
    wait_for_job(progress, threads, [&] {
        require_finite(sky);
        Progress steps;
        result = irradiance(sky, options, &steps);
    });
    return to_list(std::move(result));
}

py::list prefilter_of(const Faces& faces, const std::vector<double>& roughness, int size, const std::string& lobe,
                      int threads, const py::object& progress) {
    const PrefilterOptions options{
        .lobe = choice<SpecularLobe>("lobe", lobe, {{"ggx", SpecularLobe::ggx}, {"phong", SpecularLobe::phong}}),
        .roughness = roughness,
        .size = size};
    const Cube sky = sky_of(faces);
    std::vector<Cube> levels;
    wait_for_job(progress, threads, [&] {
        require_finite(sky);
        Progress steps;
        levels = prefilter(sky, options, &steps);
    });
    py::list out;
    for (Cube& level : levels) out.append(to_list(std::move(level)));
    return out;
}

py::list read_sky(const std::vector<std::string>& files, int size, int threads, const py::object& progress) {
    Cube cube;
    wait_for_job(progress, threads, [&] {
        Environment sky = read_environment(files);
        const bool as_it_is = sky.is_cube() && !sky.edge_samples && (size == 0 || size == sky.cube.size());
        Progress steps;
        cube = as_it_is ? std::move(sky.cube) : to_cube(sky, {.texels = size > 0 ? size : sky.face_edge()}, {}, &steps);
    });
    return to_list(std::move(cube));
}

using Directions = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::array_t<float> sample_sky(const Faces& faces, const Directions& directions, int threads) {
    if (directions.ndim() != 2 || directions.shape(1) != 3) throw py::value_error("directions: (n, 3) is expected");
    Environment sky;
    sky.cube = sky_of(faces);
    const int count = int(directions.shape(0));
    Image<float> values(sky.channels(), std::max(count, 1), 1);
    static_assert(sizeof(Vec3d) == 3 * sizeof(double));
    wait_for_job(py::none(), threads,
                 [&] { sample(sky, reinterpret_cast<const Vec3d*>(directions.data()), count, values.data()); });
    return to_numpy(std::move(values));
}

} // namespace

void add_skies(py::module_& m) {
    using py::arg;
    m.def("read_sky", &read_sky, arg("files"), py::kw_only(), arg("size") = 0, arg("threads") = 0,
          arg("progress") = py::none(),
          "Six faces px nx py ny pz nz of a sky: of a list of one picture, of six faces or of a pattern with %s. size: "
          "texels\n"
          "along an edge; 0: those of the faces, or as fine as the picture.");
    m.def("irradiance", &irradiance_of, arg("sky"), py::kw_only(), arg("size") = 32, arg("method") = "direct",
          arg("bands") = 3, arg("threads") = 0, arg("progress") = py::none(),
          "Irradiance of six faces, in radiance times steradian, as six faces. method: direct or sh.");
    m.def("prefilter", &prefilter_of, arg("sky"), arg("roughness"), py::kw_only(), arg("size") = 0, arg("lobe") = "ggx",
          arg("threads") = 0, arg("progress") = py::none(),
          "Six faces convolved with a lobe, one level per roughness: alpha of ggx, the exponent of phong.");
    m.def("sample_sky", &sample_sky, arg("sky"), arg("directions"), py::kw_only(), arg("threads") = 0,
          "The sky in directions (n, 3) of cube space: (n, channels).");
}

} // namespace bake::python
