#pragma once

#include <vector>

#include "base/random.h"
#include "engine/case/case.h"
#include "tests/support/voxelised_body.h"

namespace orthonav::test {

/// The errors of an operation.
struct OperationSettings {
  double entry_sd_m = 0.0015;  ///< across the planned axis, each way
  double angle_sd_rad = 0.05;
  double depth_sd_m = 0.002;
  double far_fraction = 0.25;  ///< of screws with 2.5 times these errors, for the grades B to E
  bool wires = false;          ///< of 1.6 to 2 mm instead of screws with heads
  double bow_m = 0.0;          ///< of each wire, from its chord
  bool rods = false;           ///< join the heads of each side
  double missing = 0.0;        ///< share of planned screws that are not there
  double rotation_rad = 0.3;   ///< at most, of the patient in the scanner
  double translation_m = 0.03;
  double level_rotation_rad = 0.06;  ///< at most, of each vertebra by itself
  double level_translation_m = 0.003;
};

/// The true place of a screw, in the model's frame.
struct TrueScrew {
  std::size_t level = 0;
  std::size_t screw = 0;  ///< of the plan
  bool placed = true;
  Vec3 entry_m;  ///< where the axis meets the bone from behind
  Vec3 tip_m;
  double radius_m = 0.0;
};

struct OperatedSpine {
  std::vector<BodyBone> bones;
  std::vector<MetalPiece> metal;
  std::vector<TrueScrew> screws;
};

/// An operation on all levels with this seed. A screw that would miss the bone is placed as
/// planned.
[[nodiscard]] OperatedSpine operated(const engine::Case& subject, const OperationSettings& settings,
                                     Random random);

}  // namespace orthonav::test
