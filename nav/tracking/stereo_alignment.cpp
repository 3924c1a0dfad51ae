#include "nav/tracking/stereo_alignment.h"

#include <cmath>
#include <Eigen/Dense>

namespace orthonav::nav {

void AlignmentEstimator::add(const AlignmentEquations& pair) {
  for (std::size_t i = 0; i < 9; ++i) {
    information_[i] += options_.independent_fraction * pair.information[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    right_[i] += options_.independent_fraction * pair.right[i];
  }
  ++pairs_;
}

void AlignmentEstimator::restart() {
  information_ = {};
  right_ = {};
  pairs_ = 0;
}

std::optional<StereoAlignment> AlignmentEstimator::estimate() const {
  if (pairs_ == 0) {
    return std::nullopt;
  }
  const Eigen::Map<const Eigen::Matrix3d> information(information_.data());
  const Eigen::Map<const Eigen::Vector3d> right(right_.data());
  const Eigen::LDLT<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d rotation = solver.solve(right);
  const Eigen::Matrix3d covariance = solver.solve(Eigen::Matrix3d::Identity());
  if (solver.info() != Eigen::Success || !rotation.allFinite() || !covariance.allFinite() ||
      !(covariance.diagonal().minCoeff() > 0.0)) {
    return std::nullopt;
  }
  StereoAlignment out;
  out.rotation_rad = {rotation.x(), rotation.y(), rotation.z()};
  out.sd_rad = {std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)),
                std::sqrt(covariance(2, 2))};
  out.pairs = pairs_;
  out.within_bounds = out.rotation_rad.norm() <= options_.max_rotation_rad;
  out.significant = pairs_ >= options_.min_pairs &&
                    rotation.dot(information * rotation) > options_.significance &&
                    out.rotation_rad.norm() > options_.min_rotation_rad;
  return out;
}

std::optional<Vec3> take_correction(AlignmentEstimator& aligning,
                                    std::optional<StereoAlignment>& applied) {
  const auto found = aligning.estimate();
  if (!found || !found->significant || !found->within_bounds) {
    return std::nullopt;
  }
  const Vec3 before_rad = applied ? applied->rotation_rad : Vec3{};
  applied = *found;
  applied->rotation_rad = before_rad + found->rotation_rad;
  applied->applied = true;
  aligning.restart();
  return found->rotation_rad;
}

void turn_right_camera(StereoCalibration& calibration, Vec3 rotation_rad) {
  const Transform<RightCamera, RightCamera> correction(rotation_from_vector(rotation_rad), {});
  calibration.right_from_rig = correction * calibration.right_from_rig;
}

}  // namespace orthonav::nav
