#include "nav/calibration/body_adjustment.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <optional>
#include <utility>

#include "nav/calibration/body_residuals.h"
#include "nav/calibration/cauchy.h"
#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kMostSteps = 100;
// Number of initial steps in which the scale of the weights follows the residuals.
constexpr int kScaleSteps = 8;
// The weight at twice the residual at which it is one half.
constexpr double kOutlierWeight = 0.2;
constexpr double kFirstBodyDamping = 1e-4;
constexpr double kLeastDamping = 1e-12;
// A step that still fails with more damping than this will not succeed.
constexpr double kMaxBodyDamping = 1e4;
constexpr double kConverged = 1e-8;

template <class A, class B>
Transform<A, B> moved_by_step(const Transform<A, B>& pose, const Vector6& step) {
  return displaced(pose, {step[0], step[1], step[2]}, {step[3], step[4], step[5]});
}

/// The normal equations; each unknown is a block of six numbers.
class System {
 public:
  explicit System(const BodyProblem& problem) : problem_(problem), unknowns_(problem) {}

  [[nodiscard]] std::optional<std::vector<double>> lengths_px(const BodyState& at) const {
    return residual_lengths_px(problem_, unknowns_, at);
  }

  /// Normal equations at a state, with the poses of the body eliminated when solved.
  void build(const BodyState& at, double scale_px) {
    const int size = 6 * unknowns_.count;
    global_.setZero(size, size);
    global_right_.setZero(size);
    const std::size_t count = problem_.pairs.size();
    body_.assign(count, Matrix6::Zero());
    body_right_.assign(count, Vector6::Zero());
    cross_.assign(count, Eigen::MatrixXd::Zero(size, 6));
    for (std::size_t i = 0; i < count; ++i) {
      for (const auto& residual : residuals_of_pair(problem_, unknowns_, at, i, true)) {
        if (residual) {
          add(*residual, i, scale_px);
        }
      }
    }
  }

  /// The state after a damped step; nothing when it cannot be solved.
  [[nodiscard]] std::optional<BodyState> stepped(const BodyState& at, double damping) const {
    const int size = 6 * unknowns_.count;
    Eigen::MatrixXd reduced = global_;
    reduced.diagonal() *= 1.0 + damping;
    Eigen::VectorXd right = global_right_;
    std::vector<Eigen::LDLT<Matrix6>> inverses;
    for (std::size_t i = 0; i < body_.size(); ++i) {
      Matrix6 damped = body_[i];
      damped.diagonal() *= 1.0 + damping;
      inverses.emplace_back(damped);
      if (!is_sound(inverses.back())) {
        return std::nullopt;
      }
      reduced -= cross_[i] * inverses.back().solve(cross_[i].transpose());
      right -= cross_[i] * inverses.back().solve(body_right_[i]);
    }
    Eigen::VectorXd step = Eigen::VectorXd::Zero(size);
    if (size > 0) {
      const Eigen::LDLT<Eigen::MatrixXd> solver(reduced);
      if (!is_sound(solver)) {
        return std::nullopt;
      }
      step = solver.solve(right);
    }
    if (!step.allFinite()) {
      return std::nullopt;
    }
    BodyState next = at;
    move_global(step, next);
    for (std::size_t i = 0; i < body_.size(); ++i) {
      const Vector6 own = inverses[i].solve(body_right_[i] - cross_[i].transpose() * step);
      if (!own.allFinite()) {
        return std::nullopt;
      }
      next.rig_from_marker[i] = moved_by_step(next.rig_from_marker[i], own);
    }
    return next;
  }

  /// The inverse of the reduced normal matrix, as last built; nothing when it has none.
  [[nodiscard]] std::optional<Eigen::MatrixXd> covariance() const {
    Eigen::MatrixXd reduced = global_;
    for (std::size_t i = 0; i < body_.size(); ++i) {
      const Eigen::LDLT<Matrix6> inverse(body_[i]);
      if (!is_sound(inverse)) {
        return std::nullopt;
      }
      reduced -= cross_[i] * inverse.solve(cross_[i].transpose());
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(reduced);
    if (!is_sound(solver)) {
      return std::nullopt;
    }
    const auto size = reduced.rows();
    return Eigen::MatrixXd(solver.solve(Eigen::MatrixXd::Identity(size, size)));
  }

  [[nodiscard]] int unknowns() const { return unknowns_.count; }

 private:
  /// Positive definite, by a margin above rounding.
  template <class Solver>
  static bool is_sound(const Solver& solver) {
    constexpr double kLeast = 1e-13;
    const auto& d = solver.vectorD();
    return solver.info() == Eigen::Success && d.minCoeff() > kLeast * d.maxCoeff() && d.allFinite();
  }

  void add(const BodyResidual& row, std::size_t pair, double scale_px) {
    const double weight = cauchy_weight(row.corner.off_px.norm(), scale_px);
    const Eigen::Vector2d off(weight * row.corner.off_px.x, weight * row.corner.off_px.y);
    const PixelByPose weighted = weight * row.corner.by_body;
    body_[pair] += row.corner.by_body.transpose() * weighted;
    body_right_[pair] -= row.corner.by_body.transpose() * off;
    const auto add_block = [&](int block, const PixelByPose& j) {
      if (block < 0) {
        return;
      }
      const PixelByPose own = weight * j;
      global_.block<6, 6>(6 * block, 6 * block) += j.transpose() * own;
      global_right_.segment<6>(6 * block) -= j.transpose() * off;
      cross_[pair].middleRows<6>(6 * block) += j.transpose() * weighted;
    };
    add_block(row.tag, row.corner.by_tag);
    add_block(row.camera, row.corner.by_camera);
    if (row.tag < 0 || row.camera < 0) {
      return;
    }
    const PixelByPose camera = weight * row.corner.by_camera;
    const Matrix6 between = row.corner.by_tag.transpose() * camera;
    global_.block<6, 6>(6 * row.tag, 6 * row.camera) += between;
    global_.block<6, 6>(6 * row.camera, 6 * row.tag) += between.transpose();
  }

  void move_global(const Eigen::VectorXd& step, BodyState& next) const {
    if (unknowns_.camera >= 0) {
      next.right_from_rig =
          moved_by_step(next.right_from_rig, step.segment<6>(6 * unknowns_.camera));
    }
    for (std::size_t i = 0; i < unknowns_.tags.size(); ++i) {
      if (unknowns_.tags[i] >= 0) {
        next.marker_from_tag[i] =
            moved_by_step(next.marker_from_tag[i], step.segment<6>(6 * unknowns_.tags[i]));
      }
    }
  }

  const BodyProblem& problem_;
  BodyUnknowns unknowns_;
  Eigen::MatrixXd global_;
  Eigen::VectorXd global_right_;
  std::vector<Matrix6> body_;
  std::vector<Vector6> body_right_;
  std::vector<Eigen::MatrixXd> cross_;
};

void summarize(const std::vector<double>& lengths_px, double scale_px, BodyFit& fit) {
  double squared = 0.0;
  double counted = 0.0;
  for (const double length : lengths_px) {
    const double weight = cauchy_weight(length, scale_px);
    if (weight < kOutlierWeight) {
      ++fit.outliers;
      continue;
    }
    squared += length * length;
    counted += 1.0;
  }
  fit.corners = lengths_px.size();
  fit.rms_px = std::sqrt(squared / std::max(counted, 1.0));
}

/// The blocks on the diagonal, times the variance of one coordinate of a corner.
std::vector<PoseCovariance> blocks_of(const Eigen::MatrixXd& inverse, double variance_px2) {
  std::vector<PoseCovariance> blocks(static_cast<std::size_t>(inverse.rows() / 6));
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    const auto at = static_cast<Eigen::Index>(6 * block);
    blocks[block] = rows_of<36>(Matrix6(variance_px2 * inverse.block<6, 6>(at, at)));
  }
  return blocks;
}

/// Levenberg's and Marquardt's steps to the least cost. In and out: the state and the residuals
/// there; returns the scale of the weights.
double descend(System& system, BodyState& state, std::vector<double>& lengths_px) {
  double scale_px = cauchy_scale(lengths_px);
  double damping = kFirstBodyDamping;
  bool is_new = true;
  for (int step = 0; step < kMostSteps && damping < kMaxBodyDamping; ++step) {
    if (is_new && step < kScaleSteps) {
      scale_px = cauchy_scale(lengths_px);
    }
    if (is_new) {
      system.build(state, scale_px);
    }
    is_new = false;
    const double before = cauchy_cost(lengths_px, scale_px);
    auto next = system.stepped(state, damping);
    auto next_px = next ? system.lengths_px(*next) : std::nullopt;
    const double after = next_px ? cauchy_cost(*next_px, scale_px) : before;
    if (!next_px || !(after < before)) {
      damping *= 10.0;
      continue;
    }
    state = std::move(*next);
    lengths_px = std::move(*next_px);
    is_new = true;
    damping = std::max(kLeastDamping, damping * 0.1);
    if (before - after < kConverged * before) {
      break;
    }
  }
  return scale_px;
}

}  // namespace

Result<BodyFit> adjust(const BodyProblem& problem, BodyState& state) {
  System system(problem);
  auto lengths_px = system.lengths_px(state);
  if (!lengths_px) {
    return Error{"a tag's corner does not project where the adjustment starts"};
  }
  if (lengths_px->empty()) {
    return Error{"no tag is seen"};
  }
  const double scale_px = descend(system, state, *lengths_px);
  BodyFit fit;
  summarize(*lengths_px, scale_px, fit);
  if (system.unknowns() == 0) {
    return fit;
  }
  system.build(state, scale_px);
  const auto covariance = system.covariance();
  if (!covariance) {
    return Error{"the corners seen do not determine what is to be found"};
  }
  const double numbers = 2.0 * static_cast<double>(fit.corners);
  const double unknowns =
      6.0 * static_cast<double>(problem.pairs.size() + static_cast<std::size_t>(system.unknowns()));
  // The unknowns fitted have absorbed part of the noise.
  fit.covariances =
      blocks_of(*covariance, scale_px * scale_px * numbers / std::max(1.0, numbers - unknowns));
  return fit;
}

}  // namespace orthonav::nav
