#include <pybind11/stl.h>
#include <optional>

#include "base/joined.h"
#include "base/length_text.h"
#include "engine/session/method.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/predicted_error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/values.h"

namespace orthonav::python {
namespace {

RegisteredBone register_points(const Model& model, const py::object& points,
                               std::vector<nav::ScrewPlan> screws, const std::string& method) {
  std::vector<Point<World>> points_in_world;
  for (const Vec3& point : vec3s_from(points, "points")) {
    points_in_world.push_back({point});
  }
  for (const nav::ScrewPlan& screw : screws) {
    check_screw(*model.prepared, screw);
  }
  const engine::Registrar registrar = value_of(engine::registrar_named(method));
  const py::gil_scoped_release others_run;
  auto registration = value_of(registrar({*model.prepared, points_in_world, screws, {}}));
  return {std::move(registration), std::move(screws)};
}

std::vector<std::string> reasons_of(const RegisteredBone& bone) {
  std::vector<std::string> reasons;
  for (const nav::RefusalReason& reason : bone.registration.reasons) {
    reasons.push_back(engine::text_of(reason));
  }
  return reasons;
}

std::optional<std::string> stroke_next(const RegisteredBone& bone) {
  const auto& place = bone.registration.stroke_next;
  return place ? std::optional(engine::text_of(*place)) : std::nullopt;
}

py::object covariance_of(const RegisteredBone& bone) {
  const auto& uncertainty = bone.registration.uncertainty;
  return uncertainty ? py::object(array_of(uncertainty->covariance())) : py::none();
}

py::object centre_of(const RegisteredBone& bone) {
  const auto& uncertainty = bone.registration.uncertainty;
  return uncertainty ? py::object(array_of(uncertainty->centre_m())) : py::none();
}

/// A member of a registration as a property.
template <class T>
auto result(T nav::Registration::*member) {
  return [member](const RegisteredBone& bone) { return bone.registration.*member; };
}

void bind_result(py::module_& module) {
  using nav::Registration;
  py::class_<RegisteredBone>(module, "Registration",
                             "Where the bone is, and whether anything may be guided on it.")
      .def("__repr__",
           [](const RegisteredBone& b) {
             return b.registration.accepted
                        ? "<Registration: accepted, RMSE " + in_mm(b.registration.rmse_m, 2) + ">"
                        : "<Registration: not accepted: " + joined(reasons_of(b)) + ">";
           })
      .def_property_readonly("accepted", result(&Registration::accepted))
      .def_property_readonly("reasons", &reasons_of, "why it is not accepted, a line each")
      .def_property_readonly("stroke_next", &stroke_next,
                             "the part of the bone whose strokes would tell most, or None")
      .def_property_readonly(
          "world_from_vertebra",
          [](const RegisteredBone& b) { return array_of(b.registration.world_from_vertebra); })
      .def_property_readonly("rmse_m", result(&Registration::rmse_m))
      .def_property_readonly(
          "predicted_error_m", result(&Registration::predicted_tre_m),
          "root mean square error to expect at the worst screw, of the registration alone; "
          "infinite\n"
          "where the points leave a motion open, and with \"paper\", which predicts none")
      .def_property_readonly("error_99_m", result(&Registration::tre_99_m),
                             "what 99 % of errors are below at the worst screw; 0 with \"paper\"")
      .def_property_readonly(
          "screw_errors",
          [](const RegisteredBone& b) { return nav::predicted_errors(b.registration, b.screws); })
      .def_property_readonly(
          "covariance", &covariance_of,
          "6x6, of the bone's (translation m, rotation vector rad) about\n"
          "`covariance_centre`, in the model's axes; None where a motion is open")
      .def_property_readonly("covariance_centre", &centre_of);
}

}  // namespace

void bind_registration(py::module_& module) {
  py::class_<nav::PredictedScrewError>(module, "ScrewError", "Errors to expect at a screw, RMS.")
      .def_property_readonly("side",
                             [](const nav::PredictedScrewError& e) { return name_of(e.side); })
      .def_readonly("entry_m", &nav::PredictedScrewError::entry_m)
      .def_readonly("target_m", &nav::PredictedScrewError::target_m)
      .def("__repr__", [](const nav::PredictedScrewError& e) {
        return std::string("<ScrewError ") + name_of(e.side) + ": entry " + in_mm(e.entry_m, 2) +
               ", target " + in_mm(e.target_m, 2) + ">";
      });
  bind_result(module);
  module.def(
      "register", &register_points, py::arg("model"), py::arg("points"),
      py::arg("screws") = std::vector<nav::ScrewPlan>{}, py::arg("method") = "best",
      "Registers points on the bone (Nx3, metres, any frame, in the order of time) to its\n"
      "model. screws: where the pose must be sure. An Error where they can't be registered;\n"
      "a registration that must not be relied on is returned, not accepted, with reasons.");
}

}  // namespace orthonav::python
