#pragma once

#include <pybind11/pybind11.h>
#include <memory>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "hal/api/devices.h"
#include "nav/guidance/predicted_error.h"
#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool_tracker.h"

// Values that one part of the module creates and another uses.
namespace orthonav::python {

/// A prepared vertebra.
struct Model {
  std::shared_ptr<const nav::VertebraModel> prepared;
};

struct RegisteredBone {
  nav::Registration registration;
  std::vector<nav::ScrewPlan> screws;
};

struct TrackedTool {
  std::string tool;
  nav::ToolState state;

  [[nodiscard]] const nav::TrackedPose& pose() const { return state.world_from_marker; }
  [[nodiscard]] bool lost() const { return pose().status == PoseStatus::kLost; }
};

/// Refuses a screw that does not belong to this bone.
void check_screw(const nav::VertebraModel& model, const nav::ScrewPlan& screw);

/// The classes of the module. Python can make an object without initializing it
/// (`Tracker.__new__(Tracker)`), for which pybind11 allocates memory that nobody fills; of these,
/// such an object is refused instead.
template <class T>
inline constexpr bool kIsBound = false;
template <>
inline constexpr bool kIsBound<nav::ScrewPlan> = true;
template <>
inline constexpr bool kIsBound<engine::CaseLevel> = true;
template <>
inline constexpr bool kIsBound<Model> = true;
template <>
inline constexpr bool kIsBound<nav::ToolGeometry> = true;
template <>
inline constexpr bool kIsBound<CameraModel> = true;
template <>
inline constexpr bool kIsBound<StereoCalibration> = true;
template <>
inline constexpr bool kIsBound<StereoFrame> = true;
template <>
inline constexpr bool kIsBound<TrackedTool> = true;
template <>
inline constexpr bool kIsBound<RegisteredBone> = true;
template <>
inline constexpr bool kIsBound<nav::PredictedScrewError> = true;

}  // namespace orthonav::python

namespace pybind11::detail {

template <class T>
class type_caster<T, enable_if_t<orthonav::python::kIsBound<T>>> : public type_caster_base<T> {
 public:
  bool load(handle source, bool convert) {
    if (source && this->typeinfo && PyType_IsSubtype(Py_TYPE(source.ptr()), this->typeinfo->type)) {
      for (auto&& part : values_and_holders(reinterpret_cast<instance*>(source.ptr()))) {
        if (!part.value_ptr()) {
          throw type_error(std::string(Py_TYPE(source.ptr())->tp_name) +
                           ": was never initialized; a subclass must call super().__init__");
        }
      }
    }
    return type_caster_base<T>::load(source, convert);
  }
};

}  // namespace pybind11::detail
