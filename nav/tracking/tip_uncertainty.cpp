#include "nav/tracking/tip_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

constexpr double kEighth = 8.0;
constexpr int kTimes = 8;
constexpr std::array kWhiteShares = {0.0, 0.1, 0.25, 0.5, 0.75};

// Of one pose: its equations for tip and pivot, and what they leave.
using Rows = Eigen::Matrix<double, 3, 7>;
using Gram = Eigen::Matrix<double, 7, 7>;

/// Correlation of the errors of two poses n apart: (1 - white) exp(-n / time), and 1 for n = 0.
struct Noise {
  double time = 0.0;
  double white = 1.0;

  [[nodiscard]] double decay(double apart) const {
    return time > 0.0 ? std::exp(-apart / time) : 0.0;
  }
};

struct Equations {
  std::vector<Rows> rows;
  std::vector<double> apart;  ///< from the pose before
};

Equations equations_of(std::span<const Transform<World, Marker>> poses,
                       std::span<const std::size_t> chosen, const PivotFit& fit) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const std::size_t i : chosen) {
    mean += matrix_as<Eigen::Matrix3d>(poses[i].rotation());
  }
  mean /= static_cast<double>(chosen.size());
  Equations out;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto& pose = poses[chosen[k]];
    const Vec3 left = pose * fit.tip_in_marker - fit.pivot_in_world;
    Rows rows;
    rows << matrix_as<Eigen::Matrix3d>(pose.rotation()) - mean, -Eigen::Matrix3d::Identity(),
        vector_as<Eigen::Vector3d>(left);
    out.rows.push_back(rows);
    out.apart.push_back(k > 0 ? static_cast<double>(chosen[k] - chosen[k - 1]) : 0.0);
  }
  return out;
}

/// Logarithm of the restricted likelihood, but for a constant. A Kalman filter of the correlated
/// part whitens the equations.
double likelihood(const Equations& equations, const Noise& noise) {
  Rows predicted = Rows::Zero();
  double variance = 1.0 - noise.white;
  double log_variances = 0.0;
  Gram gram = Gram::Zero();
  for (std::size_t i = 0; i < equations.rows.size(); ++i) {
    if (i > 0) {
      const double decay = noise.decay(equations.apart[i]);
      predicted *= decay;
      variance = decay * decay * variance + (1.0 - decay * decay) * (1.0 - noise.white);
    }
    const double total = variance + noise.white;
    const Rows surprise = equations.rows[i] - predicted;
    gram += surprise.transpose() * surprise / total;
    log_variances += 3.0 * std::log(total);
    predicted += variance / total * surprise;
    variance *= noise.white / total;
  }
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> normal(gram.topLeftCorner<6, 6>());
  const Eigen::Matrix<double, 6, 1> right = gram.topRightCorner<6, 1>();
  const double squares =
      std::max(gram(6, 6) - right.dot(normal.solve(right)), std::numeric_limits<double>::min());
  const double freedom = 3.0 * static_cast<double>(equations.rows.size()) - 6.0;
  const double log_normal = 2.0 * normal.matrixLLT().diagonal().array().log().sum();
  return -0.5 * (freedom * std::log(squares) + log_variances + log_normal);
}

Noise likeliest(const Equations& equations) {
  Noise best;
  double highest = likelihood(equations, best);
  const double longest = static_cast<double>(equations.rows.size()) / kEighth;
  for (int step = 0; step < kTimes && longest > 1.0; ++step) {
    for (const double white : kWhiteShares) {
      const Noise noise{std::pow(longest, step / (kTimes - 1.0)), white};
      if (const double now = likelihood(equations, noise); now > highest) {
        highest = now;
        best = noise;
      }
    }
  }
  return best;
}

}  // namespace

double TipUncertainty::sigma_m() const {
  return std::sqrt(covariance_m2[0][0] + covariance_m2[1][1] + covariance_m2[2][2]);
}

TipUncertainty tip_uncertainty(std::span<const Transform<World, Marker>> poses,
                               std::span<const std::size_t> chosen, const PivotFit& fit) {
  const Equations equations = equations_of(poses, chosen, fit);
  const Noise noise = likeliest(equations);
  // Sums over all pairs of poses, each with its correlation.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d before = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  double pair_sum = 0.0;
  double before_sum = 0.0;
  for (std::size_t i = 0; i < equations.rows.size(); ++i) {
    const Eigen::Matrix3d deviation = equations.rows[i].leftCols<3>();
    const double decay = i > 0 ? noise.decay(equations.apart[i]) : 0.0;
    before *= decay;
    before_sum *= decay;
    const Eigen::Matrix3d own = deviation.transpose() * deviation;
    const Eigen::Matrix3d shared = (1.0 - noise.white) * deviation.transpose() * before;
    normal += own;
    pairs += own + shared + shared.transpose();
    pair_sum += 1.0 + 2.0 * (1.0 - noise.white) * before_sum;
    before += deviation;
    before_sum += 1.0;
    squares += equations.rows[i].col(6).squaredNorm();
  }
  const auto count = static_cast<double>(equations.rows.size());
  const Eigen::Matrix3d inverse = normal.inverse();
  // The fit takes some of the noise out of the residuals, and the more the more it is correlated.
  const double freedom = 3.0 * count - 3.0 * pair_sum / count - (inverse * pairs).trace();
  const Eigen::Matrix3d covariance = squares / freedom * inverse * pairs * inverse;
  TipUncertainty out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      out.covariance_m2[r][c] = covariance(r, c);
    }
  }
  out.independent_poses = count * count / pair_sum;
  return out;
}

}  // namespace orthonav::nav
