#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/reason.h"
#include "engine/session/text/messages.h"
#include "engine/session/workflow/commands.h"
#include "nav/guidance/rod.h"
#include "nav/registration/registration.h"

namespace orthonav::test {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Every value of an enum from 0 to its last.
template <class Enum>
std::vector<Enum> each_up_to(Enum last) {
  std::vector<Enum> all;
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    all.push_back(static_cast<Enum>(i));
  }
  return all;
}

inline std::vector<nav::BonePlace> every_place() {
  std::vector<nav::BonePlace> places;
  for (const auto part : each_up_to(nav::BonePlace::Part::kFacet)) {
    for (const auto height : each_up_to(nav::BonePlace::Height::kLower)) {
      places.push_back({part, {}, height});
      places.push_back({part, Side::kLeft, height});
      places.push_back({part, Side::kRight, height});
    }
  }
  return places;
}

inline std::vector<nav::RefusalReason> every_reason() {
  std::vector<nav::RefusalReason> reasons;
  for (const auto kind : each_up_to(nav::RefusalReason::Kind::kMirrored)) {
    reasons.push_back({kind, 0.02, 0.01, {}, "L3", {}});
    reasons.push_back({kind, 0.01 + 1e-12, 0.01, {}, std::string(nav::kSeveralLevels), {}});
    for (const auto motion : each_up_to(nav::UncertainMotion::Kind::kAxialRotation)) {
      reasons.push_back({kind, 0.02, 0.01, nav::UncertainMotion{motion, 0.001}, "L3", {}});
    }
    for (const nav::BonePlace& place : every_place()) {
      reasons.push_back({kind, 0.02, 0.01, {}, "L3", place});
    }
  }
  return reasons;
}

inline std::vector<nav::CheckAdvice> every_advice() {
  std::vector<nav::CheckAdvice> advice;
  for (const auto kind : each_up_to(nav::CheckAdvice::Kind::kUncertain)) {
    for (const std::size_t number : {1, 2, 3}) {
      advice.push_back({kind, number, 0.003, 0.002});
    }
  }
  return advice;
}

/// What the functions of navigation say where they can't do what an operation asks of them.
inline std::vector<Error> every_rod_error() {
  std::vector<Error> errors;
  const auto add = [&](const std::vector<Vec3>& heads_m, double diameter_m = 0.0055) {
    if (const auto rod = nav::rod_template(heads_m, diameter_m); !rod) {
      errors.push_back(rod.error());
    }
  };
  add({{0, 0, 0}});
  add({{0, 0, 0}, {0, 0, 0.03}}, 0.02);
  add({{0, 0, kInfinite}, {0, 0, 0.03}});
  add({{0, 0, 0}, {0, 0, 0.0049999}});
  add({{0, 0, 0}, {0, 0, 0.005 - 1e-12}});
  add({{0, 0, 0}, {0, 0, 0.2}});
  add({{0, 0, 0}, {0, 0, 0.03}, {0, 0.03, 0.04}});
  add({{0, 0, 0}, {0, 0.025, 0.030}, {0, -0.020, 0.035}, {0, 0, 0.070}});
  add({{0, 0, 0}, {0, 0, 0.14}, {0, 0, 0.28}, {0, 0, 0.42}, {0, 0, 0.56}, {0, 0, 0.70}});
  return errors;
}

inline std::vector<Error> every_registration_error() {
  std::vector<Error> errors;
  const auto add = [&](const std::vector<Point<World>>& points) {
    if (const Status checked = nav::validate_points(points, 3); !checked) {
      errors.push_back(checked.error());
    }
  };
  add({});
  add({{{0, 0, 0}}, {{kInfinite, 0, 0}}, {{0, 1, 0}}});
  add({{{0, 0, 0}}, {{9, 0, 0}}, {{0, 9, 0}}, {{0, 0, 9}}});
  add({{{0, 0, 0}}, {{0.01, 0, 0}}, {{0.02, 0, 0}}});
  errors.push_back(refused({"registration finds no pose: the strokes fit no part of the model"}));
  return errors;
}

/// Of phrases that are understood in part. In their texts the phrases themselves stay English.
inline std::vector<Error> every_unclear_phrase() {
  std::vector<Error> errors;
  for (const char* phrase :
       {"move", "move cranial", "move cranial one two", "move cranial zero", "screw six",
        "screw six forty five six", "length", "diameter six six", "undo it"}) {
    if (const auto replan = engine::replan_from(phrase); replan && !*replan) {
      errors.push_back(replan->error());
    }
  }
  return errors;
}

}  // namespace orthonav::test
