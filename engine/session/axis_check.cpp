#include "engine/session/axis_check.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double sd_of_each_rad(const nav::SpinCalibration& measured, double least_sd_rad) {
  return std::max(measured.axis_sigma_rad / std::sqrt(2.0), least_sd_rad);
}

void AxisCheck::take(const nav::SpinCalibration& measured, Direction<Marker> in_use) {
  const double sd_rad = sd_of_each_rad(measured, rules_.least_sd_rad);
  const double known = sd_rad_ * sd_rad_ / (sd_rad_ * sd_rad_ + sd_rad * sd_rad);
  AxisDifference found;
  found.off_rad = angle_between_rad(in_use.v, measured.axis_in_marker.v);
  found.sd_rad = sd_rad;
  found.by_rad = known * found.off_rad;
  const Vec3 about = in_use.v.cross(measured.axis_in_marker.v);
  better_ =
      about.norm() > 0.0
          ? Direction<Marker>{rotation_from_vector(found.by_rad * about.normalized()) * in_use.v}
          : in_use;
  last_ = found;
}

Direction<Marker> AxisCheck::correct() {
  last_->corrected = true;
  sd_rad_ = sd_rad_ * last_->sd_rad / std::hypot(sd_rad_, last_->sd_rad);
  return better_;
}

}  // namespace orthonav::engine
