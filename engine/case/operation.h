#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// Another vertebra of the patient, whose strokes must not be taken for strokes of the operated
/// one.
struct NeighbouringLevel {
  std::string label;
  std::shared_ptr<const nav::VertebraModel> model;
};

/// A level to be operated: its preoperative model, prepared, and its screws in the order in which
/// they are guided.
struct OperatedLevel {
  std::string label;
  std::shared_ptr<const nav::VertebraModel> model;
  std::vector<nav::ScrewPlan> screws;
  std::vector<NeighbouringLevel> neighbours;  ///< every other one of the case
};

/// A vertebra of the case, operated or not.
struct SpineLevel {
  std::string label;
  double height_m = 0.0;  ///< position of its middle along the spine, towards the head
};

/// The planned operation, with its levels in the order in which they are operated.
struct Operation {
  std::string case_name;
  std::vector<OperatedLevel> levels;
  std::vector<SpineLevel> spine;  ///< all of the case, from the lowest
  /// The screws are in already: nothing is registered, and rods alone are bent. Has no levels.
  bool rods_alone = false;

  /// Every problem at once: no level, or one in an operation of rods alone; a level without model,
  /// label or screw; labels twice. Empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
