// Meshes as arrays, and the surfaces of meshes, cages and shapes.
#include "bake/base/progress.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/weld.h"
#include "bake/surface/patch/surface_mesh.h"
#include "choice.h"
#include "image_array.h"
#include "mesh_class.h"
#include "module.h"
#include "wait.h"
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <variant>

namespace bake::python {
namespace {

using Path = std::filesystem::path;
using IndexArray = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

/// A view of numbers that the mesh owns: (count, columns), or (count) for one column. It cannot be written to.
template <class T> py::array_t<T> view(const MeshHandle& mesh, const void* values, std::size_t count, int columns) {
    std::vector<py::ssize_t> shape = {py::ssize_t(count)};
    if (columns > 1) shape.push_back(columns);
    py::array_t<T> array(shape, static_cast<const T*>(values), py::cast(mesh));
    array.attr("flags").attr("writeable") = false;
    return array;
}

template <class V> std::vector<V> vectors(const FloatArray& array, const char* name) {
    constexpr int columns = V::length();
    if (array.ndim() != 2 || array.shape(1) != columns)
        throw py::value_error(std::string(name) + ": (n, " + std::to_string(columns) + ") is expected");
    std::vector<V> out(std::size_t(array.shape(0)));
    std::copy_n(array.data(), array.size(), reinterpret_cast<float*>(out.data()));
    return out;
}

std::vector<std::uint32_t> corners(const IndexArray& array, std::size_t count, std::size_t limit, const char* name) {
    if (std::size_t(array.size()) != count)
        throw py::value_error(std::string(name) + ": one index per corner is expected");
    std::vector<std::uint32_t> out(array.data(), array.data() + array.size());
    for (const std::uint32_t index : out)
        if (index >= limit)
            throw py::value_error(std::string(name) + ": index " + std::to_string(index) + " is out of range");
    return out;
}

void require_finite(const FloatArray& array, const char* name) {
    for (py::ssize_t i = 0; i < array.size(); ++i)
        if (!(std::abs(array.data()[i]) <= std::numeric_limits<float>::max()))
            throw py::value_error(std::string(name) + ": has values that are NaN or infinite");
}

/// Faces of equal numbers of corners. uvs and normals are per position, or per corner if their indices are given.
MeshHandle make_mesh(const FloatArray& positions, const IndexArray& faces, const std::optional<FloatArray>& uvs,
                     const std::optional<IndexArray>& corner_uv, const std::optional<FloatArray>& normals,
                     const std::optional<IndexArray>& corner_normal) {
    if (faces.ndim() != 2 || faces.shape(1) < 3) throw py::value_error("faces: (n, corners of a face) is expected");
    const auto mesh = std::make_shared<Mesh>();
    const std::size_t count = std::size_t(faces.size());
    require_finite(positions, "positions");
    mesh->positions = vectors<Vec3f>(positions, "positions");
    mesh->corner_position = corners(faces, count, mesh->positions.size(), "faces");
    for (py::ssize_t face = 1; face <= faces.shape(0); ++face)
        mesh->face_begin.push_back(std::uint32_t(face * faces.shape(1)));
    if (uvs) {
        require_finite(*uvs, "uvs");
        mesh->uvs = vectors<Vec2f>(*uvs, "uvs");
        mesh->corner_uv = corners(corner_uv.value_or(faces), count, mesh->uvs.size(), "corner_uv");
    }
    if (normals) {
        require_finite(*normals, "normals");
        mesh->normals = vectors<Vec3f>(*normals, "normals");
        mesh->corner_normal = corners(corner_normal.value_or(faces), count, mesh->normals.size(), "corner_normal");
    }
    return mesh;
}

py::dict attributes(const MeshHandle& mesh) {
    py::dict out;
    for (const Attribute& attribute : mesh->attributes)
        out[py::str(attribute.name)] =
            view<float>(mesh, attribute.values.data(), mesh->corners(), attribute.components);
    return out;
}

MeshHandle read(const Path& path, int threads) {
    const auto mesh = std::make_shared<Mesh>();
    wait_for_job(py::none(), threads, [&] { *mesh = read_mesh(path.string()); });
    return mesh;
}

void write(const Path& path, const MeshHandle& mesh, int threads) {
    wait_for_job(py::none(), threads, [&] { write_mesh(path.string(), *mesh); });
}

BaseSurface surface_of(const std::variant<MeshHandle, std::string>& what, const std::optional<Scheme>& scheme,
                       std::pair<int, int> cells) {
    if (const auto* text = std::get_if<std::string>(&what)) {
        const ParametricSurface shape(*text);
        if (cells.first == 0) cells = shape.default_resolution();
        return BaseSurface(shape, cells.first, cells.second);
    }
    Mesh mesh = *std::get<MeshHandle>(what);
    if (!scheme) return BaseSurface(std::move(mesh));
    check_cage(mesh, *scheme, "mesh");
    return BaseSurface(std::move(mesh), SubdivisionOptions{.scheme = *scheme}, "mesh");
}

MeshHandle surface(const std::variant<MeshHandle, std::string>& what, const std::optional<std::string>& subdivide,
                   const std::pair<int, int>& cells, int rate, int threads, const py::object& progress) {
    const bool shape = std::holds_alternative<std::string>(what);
    std::optional<Scheme> scheme;
    if (subdivide && shape) throw py::value_error("subdivide: a shape is smooth already");
    if (subdivide)
        scheme = choice<Scheme>("subdivide", *subdivide, {{"catmark", Scheme::catmark}, {"loop", Scheme::loop}});
    if (cells.first < 0 || cells.second < 0 || (cells.first == 0) != (cells.second == 0) || rate < 1)
        throw py::value_error("surface: cells and rate are positive");
    const SurfaceKind kind = shape ? SurfaceKind::shape : scheme ? SurfaceKind::limit : SurfaceKind::mesh;
    const auto mesh = std::make_shared<Mesh>();
    wait_for_job(progress, threads, [&] {
        Progress steps;
        *mesh = surface_mesh(surface_of(what, scheme, cells), kind, rate, &steps).mesh;
    });
    return mesh;
}

void add_class(py::module_& m) {
    using py::arg;
    py::class_<Mesh, MeshHandle>(m, "Mesh",
                                 "A polygon mesh. Its arrays are views of the mesh and cannot be written to.")
        .def(py::init(&make_mesh), arg("positions"), arg("faces"), py::kw_only(), arg("uvs") = py::none(),
             arg("corner_uv") = py::none(), arg("normals") = py::none(), arg("corner_normal") = py::none(),
             "Copies the arrays: positions (n, 3), faces (f, corners of a face), uvs (m, 2), normals (k, 3). Without "
             "corner_uv\n"
             "and corner_normal a corner has the uv and the normal of its position's number.")
        .def_property_readonly(
            "positions",
            [](const MeshHandle& mesh) { return view<float>(mesh, mesh->positions.data(), mesh->positions.size(), 3); })
        .def_property_readonly(
            "normals",
            [](const MeshHandle& mesh) { return view<float>(mesh, mesh->normals.data(), mesh->normals.size(), 3); })
        .def_property_readonly(
            "uvs", [](const MeshHandle& mesh) { return view<float>(mesh, mesh->uvs.data(), mesh->uvs.size(), 2); })
        .def_property_readonly(
            "tangents",
            [](const MeshHandle& mesh) { return view<float>(mesh, mesh->tangents.data(), mesh->tangents.size(), 4); })
        .def_property_readonly("face_begin",
                               [](const MeshHandle& mesh) {
                                   return view<std::uint32_t>(mesh, mesh->face_begin.data(), mesh->face_begin.size(),
                                                              1);
                               })
        .def_property_readonly("corner_position",
                               [](const MeshHandle& mesh) {
                                   return view<std::uint32_t>(mesh, mesh->corner_position.data(),
                                                              mesh->corner_position.size(), 1);
                               })
        .def_property_readonly("corner_normal",
                               [](const MeshHandle& mesh) {
                                   return view<std::uint32_t>(mesh, mesh->corner_normal.data(),
                                                              mesh->corner_normal.size(), 1);
                               })
        .def_property_readonly("corner_uv",
                               [](const MeshHandle& mesh) {
                                   return view<std::uint32_t>(mesh, mesh->corner_uv.data(), mesh->corner_uv.size(), 1);
                               })
        .def_property_readonly(
            "origin",
            [](const MeshHandle& mesh) { return py::make_tuple(mesh->origin.x, mesh->origin.y, mesh->origin.z); })
        .def_property_readonly("attributes", &attributes, "Further values per corner, by name.")
        .def("__repr__", [](const Mesh& mesh) {
            return "<bake.arrays.Mesh of " + std::to_string(mesh.positions.size()) + " positions and " +
                   std::to_string(mesh.faces()) + " faces>";
        });
}

} // namespace

void add_meshes(py::module_& m) {
    using py::arg;
    add_class(m);
    m.def("read_mesh", &read, arg("path"), py::kw_only(), arg("threads") = 0, "Reads .obj, .ply, .gltf or .glb.");
    m.def("write_mesh", &write, arg("path"), arg("mesh"), py::kw_only(), arg("threads") = 0,
          "Writes .obj, .ply, .gltf or .glb.");
    m.def("surface", &surface, arg("surface"), py::kw_only(), arg("subdivide") = py::none(),
          arg("cells") = std::pair(0, 0), arg("rate") = 1, arg("threads") = 0, arg("progress") = py::none(),
          "A mesh, the limit surface of a cage (subdivide: catmark or loop) or a shape such as \"torus:R=2,r=0.7\", as "
          "a mesh\n"
          "with normals, tangents and the attributes mean_curvature and gauss_curvature. cells: (columns, rows) of a "
          "shape;\n"
          "rate: segments of each edge of a cage.");
}

} // namespace bake::python
