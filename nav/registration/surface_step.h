#pragma once

#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/geometry/distance_field.h"

namespace orthonav::nav {

/// Vertebra from points about their centre: the position of the centre, and the rotation.
struct CentredPose {
  Mat3 rotation = Mat3::identity();
  Vec3 centre_m;
};

/// The pose of the vertebra in the frame of the points, whose centre is given.
[[nodiscard]] Transform<World, Vertebra> world_from(const CentredPose& pose, Vec3 points_centre_m);
[[nodiscard]] CentredPose centred(const Transform<World, Vertebra>& pose, Vec3 points_centre_m);

/// Robust Gauss-Newton steps of a pose in a distance field (weights by Tukey's biweight).
class FieldStep {
 public:
  FieldStep(const DistanceField& field, double tip_radius_m)
      : field_(&field), tip_radius_m_(tip_radius_m) {}
  /// False when the points within `width_m` leave the pose undetermined.
  bool improve(std::span<const Vec3> centred_m, double width_m, CentredPose& pose) const;
  /// Mean of the squared distances, truncated at `width_m`.
  [[nodiscard]] double cost_m2(std::span<const Vec3> centred_m, double width_m,
                               const CentredPose& pose) const;

 private:
  const DistanceField* field_;
  double tip_radius_m_;
};

}  // namespace orthonav::nav
