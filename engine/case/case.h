#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
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

/// What a case is wanted for.
enum class CaseUse : std::uint8_t {
  kOperation,  ///< at least one level has screws
  kPlanning,   ///< screws may be missing everywhere: they are yet to be planned
};

/// What is operated on: the preoperative models and the plan. A level without screws is a neighbour
/// of those that are operated.
struct Case {
  std::string name;
  std::string folder;  ///< empty for the built-in phantom
  std::vector<CaseLevel> levels;

  [[nodiscard]] const CaseLevel* find(const std::string& label) const;
  /// The level before this one, in the order of the case, that lies in the same place; nullptr when
  /// there is none.
  [[nodiscard]] const CaseLevel* overlapped_by(std::size_t index) const;
  /// Every problem at once, a line each: no levels, labels that are empty or repeat, no screws on
  /// any level (for an operation), levels that lie in one another, and screws that tell of a plan
  /// in another frame, of another level or with its sides swapped: an entry more than 10 mm off the
  /// bone, in front of its target, or on the other side than its own (`OffMidline::side`); a target
  /// outside the bone. Empty when all is well.
  [[nodiscard]] std::vector<std::string> check(CaseUse use = CaseUse::kOperation) const;
};

}  // namespace orthonav::engine
