#pragma once

#include <optional>

#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::nav {

/// A screw as used for clearances: a cylinder with a flat tip. Whenever one is returned, it is
/// finite with a length and a radius above 0.
struct ScrewCylinder {
  Point<Vertebra> entry;  ///< on the axis, where the length begins
  Vec3 direction;         ///< unit, into the bone
  double length_m = 0.0;  ///< from the entry to the tip
  double radius_m = 0.0;
};

/// Empty if the plan states no radius.
[[nodiscard]] std::optional<ScrewCylinder> cylinder_of(const ScrewPlan& plan);

/// The planned screw if it were driven along another axis, given by any point on it and its
/// direction into the bone: it enters where the axis meets the bone from behind, no farther than 25
/// mm, along the axis, from the planned entry. Empty if the axis misses the bone there or the plan
/// states no radius.
[[nodiscard]] std::optional<ScrewCylinder> cylinder_along(const Axis<Vertebra>& axis,
                                                          const ScrewPlan& plan,
                                                          const SurfaceIndex& bone);

/// The part of the screw's surface whose depth counts, unrolled: the side from 6 mm past the entry
/// on, then the flat tip from its rim to its middle. Nearer to the entry the screw necessarily
/// leaves the bone.
class CylinderSurface {
 public:
  static constexpr double kFrom_m = 0.006;

  /// Empty for a screw that is no longer than that.
  static std::optional<CylinderSurface> of(const ScrewCylinder& screw);

  /// `along_m` in [0, length_m()], `around_rad` any.
  [[nodiscard]] Point<Vertebra> at(double along_m, double around_rad) const {
    return {middle(along_m) + radius_at(along_m) * outward(around_rad)};
  }
  /// The middle of the cross section there; the same for the whole tip.
  [[nodiscard]] Vec3 middle(double along_m) const {
    return screw_.entry.v + arc_length_m(along_m) * screw_.direction;
  }
  /// Unit, from the axis.
  [[nodiscard]] Vec3 outward(double around_rad) const;
  /// The angle at which a vector points outward.
  [[nodiscard]] double around_rad(Vec3 v) const;
  /// How a point moves per metre along the unrolled surface, and per metre around it.
  [[nodiscard]] Vec3 along(double along_m, double around_rad) const {
    return on_tip(along_m) ? -outward(around_rad) : screw_.direction;
  }
  [[nodiscard]] Vec3 round(double around_rad) const {
    return screw_.direction.cross(outward(around_rad));
  }
  [[nodiscard]] bool on_tip(double along_m) const { return along_m > side_m_; }
  /// Along the axis from the entry.
  [[nodiscard]] double arc_length_m(double along_m) const {
    return kFrom_m + (along_m < side_m_ ? along_m : side_m_);
  }
  [[nodiscard]] double side_m() const { return side_m_; }
  [[nodiscard]] double length_m() const { return side_m_ + screw_.radius_m; }
  [[nodiscard]] double radius_m() const { return screw_.radius_m; }

 private:
  explicit CylinderSurface(const ScrewCylinder& screw);
  [[nodiscard]] double radius_at(double along_m) const {
    return along_m < side_m_ ? screw_.radius_m : screw_.radius_m - (along_m - side_m_);
  }

  ScrewCylinder screw_;
  double side_m_ = 0.0;
  Vec3 across_;  ///< unit, at right angles to the axis and to each other
  Vec3 athwart_;
};

}  // namespace orthonav::nav
