#pragma once

#include <vector>

#include "base/random.h"
#include "hal/sim/room/bone_surface.h"

namespace orthonav::sim {

/// One unbroken line of the pointer's tip over a bone, in the vertebra's frame.
struct Stroke {
  std::vector<BoneSpot> spots;  ///< about half a millimetre apart
  std::vector<double> arc_m;    ///< length from the start to each spot
  /// Thickness of the soft tissue over each spot; empty if there is none.
  std::vector<double> tissue_m;

  [[nodiscard]] double length_m() const { return arc_m.empty() ? 0.0 : arc_m.back(); }
  /// The place at `along_m` from the start, clamped to the ends.
  [[nodiscard]] BoneSpot at(double along_m) const;
  [[nodiscard]] double tissue_at(double along_m) const;
  /// That place on soft tissue that is pressed to the fraction `left` of its thickness: 0 is on the
  /// bone, 1 on untouched tissue. The normal is the bone's.
  [[nodiscard]] BoneSpot on_tissue(double along_m, double left) const;
};

/// The strokes recorded before one "save": close together, with the button released between them.
struct StrokeRegion {
  std::vector<Stroke> strokes;

  [[nodiscard]] double length_m() const;
};

/// The strokes with which a surgeon covers the part of a vertebra that a pointer reaches from
/// behind: laminae, facets and the roots of the transverse processes, or the whole transverse
/// processes, in lines along the spine, and the two sides and the crest of the spinous process.
/// Empty when the mesh has no such surface.
[[nodiscard]] std::vector<StrokeRegion> plan_strokes(const RoomLevel& level,
                                                     Exposure exposure = Exposure::kLaminae);

/// Lays soft tissue over the strokes: `mean_m` thick on average, more in valleys than on ridges,
/// uneven over some centimetres, never negative.
void cover_with_tissue(std::vector<StrokeRegion>& regions, double mean_m, const Random& random);

}  // namespace orthonav::sim
