#pragma once

#include <optional>
#include <vector>

#include "nav/geometry/mesh.h"
#include "tests/support/posterior_landmarks.h"
#include "tests/support/stroke_lanes.h"

namespace orthonav::test {

/// A place of the tip on the bone, in the vertebra's frame.
struct Touch {
  Vec3 tip_m;      ///< centre of the tip's ball
  Vec3 surface_m;  ///< where the ball rests on the bone
  Vec3 normal;     ///< of the bone there, outward
  Vec3 approach;   ///< unit, from the bone towards the pointer's handle
};

/// One unbroken movement of the tip over the bone, its places a fraction of a millimetre apart.
struct Walk {
  BoneRegion region = BoneRegion::kCrest;
  std::vector<Touch> touches;
  std::vector<double> arc_m;  ///< length from the start to each place

  [[nodiscard]] double length_m() const { return arc_m.empty() ? 0.0 : arc_m.back(); }
  /// The walk's own place nearest to the length `along_m`, so that it lies on the bone.
  [[nodiscard]] const Touch& at(double along_m) const;
  /// The part between two lengths.
  [[nodiscard]] Walk part(double from_m, double to_m) const;
};

struct Pointer {
  double tip_radius_m = 0.0;
  /// How far in front of the canal's back wall the tip goes beside the canal, as a share of the
  /// canal's depth: from 1 on it gets to the body's hind edge beside the isthmus.
  double deepest_aside = 1.1;
};

/// The bone as met by a straight pointer that approaches along a line, independently of what a
/// registration considers reachable.
class TouchableBone {
 public:
  TouchableBone(const nav::SurfaceIndex& surface, const PosteriorLandmarks& landmarks,
                const Pointer& pointer)
      : surface_(&surface), marks_(landmarks), pointer_(pointer) {}

  /// The strokes along a lane. They end where the tip would leave the region, fall off an edge or
  /// into the canal.
  [[nodiscard]] std::vector<Walk> walk(const Lane& lane) const;

 private:
  [[nodiscard]] bool belongs(BoneRegion region, const Touch& touch) const;
  /// The tip moved in along -approach until it rests on the bone.
  [[nodiscard]] std::optional<Touch> lower(Vec3 aim_m, Vec3 approach) const;

  const nav::SurfaceIndex* surface_;
  PosteriorLandmarks marks_;
  Pointer pointer_;
};

}  // namespace orthonav::test
