#include "nav/tracking/photometric_reduced.h"

#include <algorithm>
#include <Eigen/Dense>

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr int kLight = static_cast<int>(kLightColumns);
using LightMatrix = Eigen::Matrix<double, kLight, kLight>;
using LightVector = Eigen::Matrix<double, kLight, 1>;
using CrossMatrix = Eigen::Matrix<double, 6, kLight>;

/// The scatter of clean noise after robust weighting, where without weights it would be 1: 0.72
/// from the biweight's moments (E[psi^2] E[w] / E[psi']^2), the rest as measured.
constexpr double kCleanScatter = 0.82;

struct Split {
  Matrix6 pose;
  LightMatrix light;
  CrossMatrix cross;
  Vector6 pose_right;
  LightVector light_right;
};

Split split(const ViewEquations& e) {
  Split s;
  const auto at = [&](std::size_t r, std::size_t c) {
    return e.sum(std::min(r, c), std::max(r, c));
  };
  for (std::size_t r = 0; r < kColumns; ++r) {
    for (std::size_t c = 0; c < kColumns; ++c) {
      const auto row = static_cast<Eigen::Index>(r);
      const auto column = static_cast<Eigen::Index>(c);
      if (r < 6 && c < 6) {
        s.pose(row, column) = at(r, c);
      }
      if (r < 6 && c >= 6) {
        s.cross(row, column - 6) = at(r, c);
      }
      if (r >= 6 && c >= 6) {
        s.light(row - 6, column - 6) = at(r, c);
      }
    }
  }
  for (std::size_t r = 0; r < 6; ++r) {
    s.pose_right(static_cast<Eigen::Index>(r)) = at(r, kColumns);
  }
  for (std::size_t r = 0; r < kLightColumns; ++r) {
    s.light_right(static_cast<Eigen::Index>(r)) = at(6 + r, kColumns);
  }
  return s;
}

void add_prior(Split& s, const Photometry& light) {
  const LightPrior prior = light_prior(light);
  for (int i = 0; i < kLight; ++i) {
    const auto k = static_cast<std::size_t>(i);
    s.light(i, i) += prior.weight[k];
    s.light_right(i) += prior.right[k];
  }
}

/// The pose's equations without the light, and how the light changes with a small motion of the
/// tag.
struct Eliminated {
  Split split;
  Eigen::LLT<LightMatrix> light;
  Eigen::Matrix<double, kLight, 6> gain;
  Matrix6 normal;

  Eliminated(const ViewEquations& e, const Photometry& known) : split(orthonav::nav::split(e)) {
    add_prior(split, known);
    light.compute(split.light);
    gain = light.solve(split.cross.transpose());
    normal = split.pose - split.cross * gain;
  }
};

}  // namespace

ReducedView reduced(const ViewEquations& equations, const Photometry& known) {
  const Eliminated e(equations, known);
  const double trust = 1.0 / std::max(known.sandwich_factor, 1.0);
  ReducedView view;
  Eigen::Map<Matrix6>(view.normal.data()) = trust * e.normal;
  Eigen::Map<Vector6>(view.right.data()) =
      trust * (e.split.pose_right - e.split.cross * e.light.solve(e.split.light_right));
  return view;
}

LightStep light_step(const ViewEquations& equations, const Photometry& known,
                     const std::array<double, 6>& of_tag) {
  Split s = split(equations);
  add_prior(s, known);
  LightStep step;
  Eigen::Map<LightVector>(step.data()) = s.light.llt().solve(
      s.light_right - s.cross.transpose() * Eigen::Map<const Vector6>(of_tag.data()));
  return step;
}

double sandwich_factor(const ViewEquations& equations, const Photometry& known,
                       std::span<const float> scores) {
  const Eliminated e(equations, known);
  const Eigen::LLT<Matrix6> pose(e.normal);
  if (pose.info() != Eigen::Success) {
    return 1.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i + kColumns <= scores.size(); i += kColumns) {
    const Eigen::Map<const Eigen::Matrix<float, 6, 1>> of_pose(scores.data() + i);
    const Eigen::Map<const Eigen::Matrix<float, kLight, 1>> of_light(scores.data() + i +
                                                                     kPoseColumns);
    const Vector6 pull = of_pose.cast<double>() - e.gain.transpose() * of_light.cast<double>();
    sum += pose.matrixL().solve(pull).squaredNorm();
  }
  return sum / (6.0 * kCleanScatter);
}

}  // namespace orthonav::nav
