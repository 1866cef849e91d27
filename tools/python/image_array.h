// Images of the library as numpy arrays of shape (height, width), or (height, width, channels).
#pragma once
#include "bake/picture/image.h"
#include <pybind11/numpy.h>
#include <string>

namespace bake::python {
namespace py = pybind11;

/// An array as the functions of the module take it: others than float32 in rows without gaps are converted.
using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// A copy of the array, as images own their values. Throws py::value_error, which begins with `name`, for an array of
/// another shape and for an empty one.
Image<float> to_image(const FloatArray& array, const std::string& name);

/// An array that owns the image, whose values are not copied. It has two dimensions if the image has one channel.
py::array_t<float> to_numpy(Image<float> image);

} // namespace bake::python
