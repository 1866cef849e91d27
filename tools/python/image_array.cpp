#include "image_array.h"
#include <algorithm>
#include <climits>

namespace bake::python {

Image<float> to_image(const FloatArray& array, const std::string& name) {
    if (array.ndim() != 2 && array.ndim() != 3)
        throw py::value_error(name + ": has " + std::to_string(array.ndim()) +
                              " dimensions; (height, width) or (height, width, channels) is expected");
    const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
    if (array.size() == 0) throw py::value_error(name + ": is empty");
    if (array.shape(0) > INT_MAX || array.shape(1) > INT_MAX || channels > INT_MAX)
        throw py::value_error(name + ": is too large");
    Image<float> image(int(array.shape(1)), int(array.shape(0)), int(channels));
    std::copy_n(array.data(), image.size(), image.data());
    return image;
}

py::array_t<float> to_numpy(Image<float> image) {
    const auto owner = new Image<float>(std::move(image));
    const py::capsule base(owner, [](void* pointer) { delete static_cast<Image<float>*>(pointer); });
    std::vector<py::ssize_t> shape = {owner->height(), owner->width()};
    if (owner->channels() > 1) shape.push_back(owner->channels());
    return py::array_t<float>(shape, owner->data(), base);
}

} // namespace bake::python
