#pragma once

#include <pybind11/pybind11.h>

// Each adds its part to the module `orthonav`. Errors of the engine become orthonav.Error; lengths
// are metres, angles radians, matrices 4x4 for column vectors and named a_from_b.
namespace orthonav::python {

void bind_cases(
    pybind11::module_& module);  ///< levels, models and screws: the first, others use them
void bind_tools(pybind11::module_& module);
void bind_tracking(pybind11::module_& module);
void bind_registration(pybind11::module_& module);
void bind_guidance(pybind11::module_& module);
void bind_rendering(pybind11::module_& module);

}  // namespace orthonav::python
