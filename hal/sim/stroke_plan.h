#pragma once

#include <vector>

#include "hal/sim/bone_surface.h"

namespace orthonav::sim {

/// One unbroken line of the pointer's tip over a bone, in the vertebra's frame.
struct Stroke {
  std::vector<BoneSpot> spots;  ///< about half a millimetre apart
  std::vector<double> arc_m;    ///< length from the start to each spot

  [[nodiscard]] double length_m() const { return arc_m.empty() ? 0.0 : arc_m.back(); }
  /// The place at `along_m` from the start, clamped to the ends.
  [[nodiscard]] BoneSpot at(double along_m) const;
};

/// What is recorded before one "save": strokes close together, with the button released between
/// them.
struct StrokeRegion {
  std::vector<Stroke> strokes;

  [[nodiscard]] double length_m() const;
};

/// The strokes by which a surgeon covers what a pointer reaches of a vertebra from behind: laminae,
/// facets and the roots of the transverse processes in lines along the spine, and the two sides and
/// the crest of the spinous process. Empty when the mesh has no such surface.
[[nodiscard]] std::vector<StrokeRegion> plan_strokes(const RoomLevel& level);

}  // namespace orthonav::sim
