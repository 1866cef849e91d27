// The module bake._bake: what the package bake is made of.
#include "module.h"
#include "bake/base/error.h"
#include "bake/base/version.h"
#include "version_text.h"

PYBIND11_MODULE(_bake, m) {
    using namespace bake;
    namespace py = pybind11;
    m.attr("__version__") = version();
    m.attr("commit") = source_commit;
    // The class is one of Python, see bake/error.py.
    static const py::object error_class = py::module_::import("bake.error").attr("Error");
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            const py::object raised = error_class(error.what(), int(error.refusal));
            PyErr_SetObject(error_class.ptr(), raised.ptr());
        }
    });
    python::add_verbs(m);
    python::add_meshes(m); // first, as its class is in the signatures of others
    python::add_pictures(m);
    python::add_skies(m);
}
