#include <pybind11/stl.h>
#include <optional>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "engine/session/steps/guiding.h"
#include "nav/guidance/anatomical_deviation.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/values.h"

namespace orthonav::python {
namespace {

/// A tool against a screw, as in the session.
struct GuidedTool {
  nav::ScrewGuidance against_plan;
  std::optional<nav::AnatomicalDeviation> deviation;
  std::optional<nav::ScrewClearance> clearance;
};

/// A registration, or a pose that stands for one without uncertainty.
nav::Registration registration_from(const py::object& registration) {
  if (py::isinstance<RegisteredBone>(registration)) {
    const auto& bone = registration.cast<const RegisteredBone&>();
    if (!bone.registration.accepted) {
      throw Refused("registration: was refused, and nothing may be guided on it");
    }
    return bone.registration;
  }
  nav::Registration known;
  known.accepted = true;
  known.world_from_vertebra = transform_from<World, Vertebra>(registration, "registration");
  return known;
}

/// A tool as tracked, or its pose, which then counts as exact.
nav::TrackedPose pose_from(const py::object& pose) {
  if (py::isinstance<TrackedTool>(pose)) {
    const auto& tracked = pose.cast<const TrackedTool&>();
    if (tracked.pose().status != PoseStatus::kMeasured) {
      throw Refused("pose: " + tracked.tool + " is not measured, and nothing may be read off it");
    }
    return tracked.pose();
  }
  return {transform_from<World, Marker>(pose, "pose"), {}, PoseStatus::kMeasured, {}};
}

/// Poses in millimetres that lie near the origin of World pass for metres, but not both of them for
/// a tool at its screw.
void check_distance(Point<World> tip, Point<World> entry) {
  constexpr double kFarthestFromScrew_m = 3.0;
  const double distance_m = (tip - entry).norm();
  if (!(distance_m <= kFarthestFromScrew_m)) {
    throw Refused(
        printed("pose: puts the tip %.6g m from the screw's entry, limit %g m (are pose and "
                "registration in metres?)",
                distance_m, kFarthestFromScrew_m));
  }
}

GuidedTool guide(const Model& model, const nav::ScrewPlan& screw, const py::object& registration,
                 const nav::ToolGeometry& tool, const py::object& pose) {
  check_screw(*model.prepared, screw);
  engine::LevelState level;
  level.plan = {"", model.prepared, {screw}, {}};
  level.registration = registration_from(registration);
  const nav::TrackedPose measured = pose_from(pose);
  check_distance(measured.value * tool.tip_in_marker,
                 level.registration->world_from_vertebra * screw.entry);
  const engine::ToolInVertebra there = engine::in_vertebra(*level.registration, measured, tool, {});
  return {nav::guide(level.registration->world_from_vertebra, screw,
                     measured.value * tool.tip_in_marker, (measured.value * tool.axis_in_marker).v),
          nav::anatomical_deviation(screw, there.axis,
                                    there.uncertainty ? &*there.uncertainty : nullptr),
          engine::Guiding().clearance_along(level, measured, tool, {})};
}

/// Members of the session's value, as properties.
auto against_plan(double nav::ScrewGuidance::*member) {
  return [member](const GuidedTool& g) { return g.against_plan.*member; };
}
/// (value, SD), the SD infinite if unknown.
auto deviation(nav::NumberWithSd nav::AnatomicalDeviation::*member) {
  return [member](const GuidedTool& g) {
    return g.deviation ? std::optional(std::pair((g.deviation.value().*member).value,
                                                 (g.deviation.value().*member).sd))
                       : std::nullopt;
  };
}

std::optional<double> lower_95_m(const GuidedTool& g) {
  return g.clearance && g.clearance->spread ? std::optional(g.clearance->spread->lower_95_m)
                                            : std::nullopt;
}

void bind_clearance(py::class_<GuidedTool>& guidance) {
  guidance
      .def_property_readonly(
          "clearance_m",
          [](const GuidedTool& g) {
            return g.clearance ? std::optional(g.clearance->least.clearance_m) : std::nullopt;
          },
          "the bone around the screw if it were driven along the tool, < 0: it breaks through.\n"
          "None for a screw without radius and a tool that is not held near the plan (15 mm, 30\n"
          "degrees)")
      .def_property_readonly("clearance_95_m", &lower_95_m,
                             "with 95 % probability it is above that; None if unknown")
      .def_property_readonly(
          "grade",
          [](const GuidedTool& g) {
            return g.clearance ? std::optional(std::string(
                                     nav::name_of(nav::grade_of(g.clearance->least.clearance_m))))
                               : std::nullopt;
          },
          "Gertzbein-Robbins, revised: \"A\" to \"E\"");
}

}  // namespace

template <>
inline constexpr bool kIsBound<GuidedTool> = true;

void bind_guidance(py::module_& module) {
  using nav::AnatomicalDeviation;
  using nav::ScrewGuidance;
  py::class_<GuidedTool> guidance(module, "Guidance", "A tool against a planned screw.");
  guidance
      .def("__repr__",
           [](const GuidedTool& g) {
             return printed("<Guidance: %.1f deg, ", g.against_plan.angle_rad * kDegreesPerRadian) +
                    in_mm(g.against_plan.to_target_m) + " to target, tip " +
                    in_mm(g.against_plan.tip_off_axis_m) + " off the axis>";
           })
      .def_property_readonly("angle_rad", against_plan(&ScrewGuidance::angle_rad),
                             "between the tool's axis and the planned one")
      .def_property_readonly("depth_m", against_plan(&ScrewGuidance::depth_m),
                             "of the tip past the entry along the planned axis; < 0: before it")
      .def_property_readonly("to_target_m", against_plan(&ScrewGuidance::to_target_m))
      .def_property_readonly("tip_to_entry_m", against_plan(&ScrewGuidance::tip_to_entry_m))
      .def_property_readonly("tip_off_axis_m", against_plan(&ScrewGuidance::tip_off_axis_m))
      .def_property_readonly(
          "tip_offset", [](const GuidedTool& g) { return array_of(g.against_plan.tip_offset_m); },
          "of the tip from the planned axis, in World")
      .def_property_readonly("tip_cranial_m", deviation(&AnatomicalDeviation::tip_cranial_m),
                             "(value, SD) of the tip beside the planned axis, > 0: cranial; None\n"
                             "where the screw has no such directions")
      .def_property_readonly("tip_medial_m", deviation(&AnatomicalDeviation::tip_medial_m))
      .def_property_readonly("aim_cranial_rad", deviation(&AnatomicalDeviation::aim_cranial_rad))
      .def_property_readonly("aim_medial_rad", deviation(&AnatomicalDeviation::aim_medial_rad));
  bind_clearance(guidance);
  module.def(
      "guide", &guide, py::arg("model"), py::arg("screw"), py::arg("registration"), py::arg("tool"),
      py::arg("pose"),
      "What the surgeon is told of a tool at a screw. registration: as `register` returns\n"
      "it, or world_from_vertebra (4x4); pose: as a Tracker returns it, or world_from_marker.\n"
      "Matrices count as exact. Refuses a registration that was not accepted, and a tool that\n"
      "was not measured.");
}

}  // namespace orthonav::python
