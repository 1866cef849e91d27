// The parts of the module.
#pragma once
#include <pybind11/pybind11.h>

namespace bake::python {
namespace py = pybind11;

void add_verbs(py::module_& m);
void add_pictures(py::module_& m);
void add_meshes(py::module_& m);
void add_skies(py::module_& m);

} // namespace bake::python
