#pragma once

#include <string>
#include <vector>

#include "hal/api/result.h"
#include "hal/api/transform.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// One vertebra of a case: its surface and its screws, metres, LPS.
struct CaseLevel {
  std::string label;
  nav::TriangleMesh mesh;
  std::vector<nav::ScrewPlan> screws;
  Transform<Spine, Vertebra> spine_from_vertebra;

  /// The middle of the box around the surface. Levels of one scan all lie in one frame and have the
  /// same `spine_from_vertebra`: only this says which of them is the higher one.
  [[nodiscard]] Point<Spine> centre_in_spine() const;
};

/// What is operated on: the preoperative models and the plan.
struct Case {
  std::string name;
  std::string folder;  ///< empty for the built-in phantom
  std::vector<CaseLevel> levels;

  [[nodiscard]] const CaseLevel* find(const std::string& label) const;
  /// Every problem at once, a line each: no levels, labels that are empty or repeat, levels without
  /// screws, levels that lie in one another, and screws that tell of a plan in another frame, of
  /// another level or with its sides swapped: an entry more than 10 mm off the bone, in front of
  /// its target, or on the other side of the bone's middle than its name; a target outside the
  /// bone. Empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Reads a case folder: `case.json` with `{"name", "units"?, "levels": [{"label", "model", "plan",
/// "spine_from_model"?}]}`, and the models and plans that it names. A model is read in the unit and
/// frame that its plan declares, unless the model's file declares its own axes. `spine_from_model`
/// (4×4 by rows, mm unless `units` says m) is in the same axes as the model. Where no level has
/// one, models that lie apart are taken as they are (one scan), and models that lie in one another
/// are stacked in the order of the file, the first on top.
Result<Case> load_case(const std::string& folder);

}  // namespace orthonav::engine
