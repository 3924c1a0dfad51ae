#include "python/arrays.h"
#include "python/bindings.h"

PYBIND11_MODULE(orthonav, module) {
  namespace python = orthonav::python;
  module.doc() =
      "Navigation for orthopaedic surgery: track, register, guide, render.\n\n"
      "Lengths are metres, angles radians, images and results NumPy arrays that are copies. A "
      "pose\n"
      "is a 4x4 matrix for column vectors, named a_from_b. Models are in the patient's axes "
      "(LPS).\n"
      "What can't be used is refused by orthonav.Error, a ValueError that names it.\n"
      "Not certified for use on patients.";
  module.attr("__version__") = ORTHONAV_VERSION;
  pybind11::register_exception<python::Refused>(module, "Error", PyExc_ValueError);
  python::bind_cases(module);
  python::bind_tools(module);
  python::bind_tracking(module);
  python::bind_registration(module);
  python::bind_guidance(module);
  python::bind_rendering(module);
}
