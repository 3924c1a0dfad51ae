#include "nav/guidance/executed_trajectory.h"

#include <cmath>
#include <Eigen/Core>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

/// cos(60°): a tool at a larger angle to the plan is left out.
constexpr double kAlongPlan = 0.5;

using ByRows = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

void add_product(std::array<double, 9>& sums, Vec3 v) {
  const auto e = vector_as<Eigen::Vector3d>(v);
  ByRows(sums.data()) += e * e.transpose();
}

/// Adds to a covariance that of the mean of `n` scattered values, from their sums.
void add_of_mean(std::array<double, 9>& covariance, std::array<double, 9> squares, Vec3 sum,
                 double n) {
  if (n >= 2.0) {
    const auto e = vector_as<Eigen::Vector3d>(sum);
    ByRows(covariance.data()) += (ByRows(squares.data()) - e * e.transpose() / n) / (n - 1.0) / n;
  }
}

}  // namespace

void TrajectoryAtDepth::add(const ScrewPlan& plan, const Axis<Vertebra>& tool,
                            const PoseUncertainty* uncertainty) {
  const Vec3 inward = (plan.target - plan.entry).normalized();
  const double along = tool.direction.dot(inward);
  if (!(along >= kAlongPlan) || !tool.point.v.is_finite()) {
    return;
  }
  const double depth_m = (tool.point - plan.entry).dot(inward);
  if (pairs_ > 0 && depth_m < first_depth_m_ - kAtDepth_m) {
    return;  // drawn back
  }
  if (pairs_ > 0 && depth_m > first_depth_m_ + kAtDepth_m) {
    forget();
  }
  const Vec3 point_m = tool.point.v - (depth_m / along) * tool.direction;
  if (pairs_ == 0) {
    first_depth_m_ = depth_m;
    first_point_m_ = point_m;
    first_direction_ = tool.direction;
  }
  ++pairs_;
  depths_m_ += depth_m;
  points_m_ += point_m - first_point_m_;
  directions_ += tool.direction - first_direction_;
  add_product(point_squares_, point_m - first_point_m_);
  // A small turn w moves a direction d by w × d; across d, w is d × that.
  add_product(direction_squares_, first_direction_.cross(tool.direction));
  uncertainty_ = uncertainty ? std::optional(*uncertainty) : std::nullopt;
}

std::optional<ExecutedTrajectory> TrajectoryAtDepth::mean() const {
  if (pairs_ == 0) {
    return std::nullopt;
  }
  const auto n = static_cast<double>(pairs_);
  ExecutedTrajectory out;
  out.axis.point = {first_point_m_ + points_m_ / n};
  out.axis.direction = (first_direction_ + directions_ / n).normalized();
  out.depth_m = depths_m_ / n;
  out.pairs = pairs_;
  if (uncertainty_) {
    auto point = uncertainty_->covariance_at(out.axis.point);
    add_of_mean(point, point_squares_, points_m_, n);
    out.point_covariance_m2 = point;
    auto rotation_rad2 = uncertainty_->rotation_covariance();
    add_of_mean(rotation_rad2, direction_squares_, first_direction_.cross(directions_), n);
    out.direction_covariance_rad2 = rotation_rad2;
  }
  return out;
}

}  // namespace orthonav::nav
