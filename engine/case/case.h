#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "engine/io/bit_hash.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// One vertebra of a case: its surface and its screws, metres, LPS.
struct CaseLevel {
  std::string label;
  nav::TriangleMesh mesh;
  std::vector<nav::ScrewPlan> screws;
  Transform<Spine, Vertebra> spine_from_vertebra;

  /// The middle of the box around the surface. Levels of one scan share a frame and have the same
  /// `spine_from_vertebra`, so only this says which of them is higher.
  [[nodiscard]] Point<Spine> centre_in_spine() const;
};

/// The purpose for which a case is loaded.
enum class CaseUse : std::uint8_t {
  kOperation,  ///< at least one level has screws
  kPlanning,   ///< screws may be missing everywhere, since they are still to be planned
  kRods,       ///< rods alone: levels may be missing too, since nothing is registered
};

/// The subject of an operation: the preoperative models and the plan. A level without screws is a
/// neighbour of the operated ones.
struct Case {
  std::string name;
  std::string folder;  ///< empty for the built-in phantom
  std::vector<CaseLevel> levels;
  std::string unusual;  ///< what is unusual about the spine, as `case make` noted it; else empty
  std::vector<std::string> notes;  ///< of reading it: what was left out, a line each

  [[nodiscard]] const CaseLevel* find(const std::string& label) const;
  /// An earlier level, in the order of the case, that lies in the same place; nullptr if there is
  /// none.
  [[nodiscard]] const CaseLevel* overlapped_by(std::size_t index) const;
  /// Every problem at once, a line each: no levels, labels that are empty or repeat, no screws on
  /// any level (for an operation), levels that overlap, and screws that indicate a plan in another
  /// frame, for another level or with its sides swapped: an entry more than 10 mm off the bone, in
  /// front of its target, or on the other side than its own (`OffMidline::side`); a target outside
  /// the bone. Empty when all is well.
  [[nodiscard]] std::vector<std::string> check(CaseUse use = CaseUse::kOperation) const;
};

/// Adds every number of a mesh.
void add(BitHash& hash, const nav::TriangleMesh& mesh);

}  // namespace orthonav::engine
