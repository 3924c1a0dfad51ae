#include <pybind11/stl.h>

#include "base/how_many.h"
#include "base/printed.h"
#include "engine/case/case_file.h"
#include "engine/case/operation_plan.h"
#include "engine/case/screw_place.h"
#include "engine/io/mesh_file.h"
#include "engine/phantom/phantom.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/values.h"

namespace orthonav::python {
namespace {

nav::ScrewPlan screw_from(const std::string& side, const py::object& entry,
                          const py::object& target, double radius_m) {
  if (side != name_of(Side::kLeft) && side != name_of(Side::kRight)) {
    throw Refused("side: is \"" + side + "\", must be \"left\" or \"right\"");
  }
  nav::ScrewPlan screw{side == name_of(Side::kLeft) ? Side::kLeft : Side::kRight,
                       {vec3_from(entry, "entry")},
                       {vec3_from(target, "target")},
                       number_from(radius_m, "radius_m")};
  if (const auto problem = engine::ill_sized(screw.entry, screw.target, screw.radius_m)) {
    throw Refused("screw: " + *problem);
  }
  return screw;
}

Model prepare(const py::object& vertices, const py::object& triangles) {
  nav::TriangleMesh mesh{vec3s_from(vertices, "vertices"), triangles_from(triangles, "triangles")};
  const py::gil_scoped_release others_run;
  return {value_of(nav::VertebraModel::prepare(std::move(mesh)))};
}

std::vector<engine::CaseLevel> phantom(const std::vector<std::string>& labels) {
  for (const std::string& label : labels) {
    succeed(engine::check_level(engine::phantom(), label));
  }
  return engine::phantom(labels).levels;
}

std::vector<engine::CaseLevel> load_case(const std::string& folder) {
  return value_of(engine::load_case(folder)).levels;
}

py::tuple load_mesh(const std::string& path, double metres_per_unit) {
  if (!(number_from(metres_per_unit, "metres_per_unit") > 0.0)) {
    throw Refused("metres_per_unit: must be greater than 0");
  }
  return arrays_of(value_of(engine::load_mesh(path, metres_per_unit)));
}

void bind_screw(py::module_& module) {
  py::class_<nav::ScrewPlan>(module, "Screw", "A planned pedicle screw, in the model's axes.")
      .def(py::init(&screw_from), py::arg("side"), py::arg("entry"), py::arg("target"),
           py::arg("radius_m") = 0.0,
           "side: \"left\" or \"right\" of the patient; radius_m 0: not stated; how\n"
           "far the screw stays inside the bone is then unknown.")
      .def_property_readonly("side", [](const nav::ScrewPlan& s) { return name_of(s.side); })
      .def_property_readonly("entry", [](const nav::ScrewPlan& s) { return array_of(s.entry.v); })
      .def_property_readonly("target", [](const nav::ScrewPlan& s) { return array_of(s.target.v); })
      .def_readonly("radius_m", &nav::ScrewPlan::radius_m)
      .def("__repr__", [](const nav::ScrewPlan& s) {
        return printed("<Screw %s, %.1f x %.1f mm>", name_of(s.side), 2e3 * s.radius_m,
                       1e3 * (s.target - s.entry).norm());
      });
}

}  // namespace

void check_screw(const nav::VertebraModel& model, const nav::ScrewPlan& screw) {
  const auto problem =
      engine::misplaced(model.surface(), screw.entry, screw.target, screw.radius_m);
  if (problem) {
    throw Refused(std::string(name_of(screw.side)) + " screw: " + *problem);
  }
}

void bind_cases(py::module_& module) {
  bind_screw(module);
  py::class_<engine::CaseLevel>(module, "Level",
                                "A vertebra of a case: its surface and its screws.")
      .def_readonly("label", &engine::CaseLevel::label)
      .def_property_readonly("vertices",
                             [](const engine::CaseLevel& l) { return array_of(l.mesh.vertices_m); })
      .def_property_readonly("triangles",
                             [](const engine::CaseLevel& l) { return array_of(l.mesh.triangles); })
      .def_readonly("screws", &engine::CaseLevel::screws)
      .def("__repr__", [](const engine::CaseLevel& l) {
        return "<Level " + l.label + ": " + how_many(l.mesh.triangles.size(), "triangle") + ", " +
               how_many(l.screws.size(), "screw") + ">";
      });
  py::class_<Model>(module, "VertebraModel", "A vertebra, prepared for registration and guidance.")
      .def(py::init(&prepare), py::arg("vertices"), py::arg("triangles"),
           "vertices: Nx3, metres, in the patient's axes (LPS); triangles: Mx3 indices. Takes a\n"
           "second. Refuses a surface that is not closed, or no larger than a vertebra's.")
      .def_property_readonly(
          "mesh", [](const Model& m) { return arrays_of(m.prepared->mesh()); },
          "(vertices, triangles)")
      .def_property_readonly(
          "reachable", [](const Model& m) { return arrays_of(m.prepared->reachable()); },
          "(vertices, triangles) of what a pointer can reach from behind")
      .def("__repr__", [](const Model& m) {
        return "<VertebraModel: " + how_many(m.prepared->mesh().triangles.size(), "triangle") + ">";
      });
  module.def("phantom", &phantom, py::arg("labels") = std::vector<std::string>{},
             "The levels of the built-in spine, L1 to L5, or those named.");
  module.def("load_case", &load_case, py::arg("folder"), "The levels of a case folder.");
  module.def("load_mesh", &load_mesh, py::arg("path"), py::arg("metres_per_unit") = 1e-3,
             "(vertices, triangles) of an STL, PLY or OBJ file, in metres and LPS.");
}

}  // namespace orthonav::python
