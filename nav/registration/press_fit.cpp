#include "nav/registration/press_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

namespace orthonav::nav {
namespace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Nearer to the surface than this, the direction to it says nothing.
constexpr double kOnSurface_m = 1e-5;
/// Soft tissue under a pressed tip is alike over such a distance.
constexpr double kSameTissue_m = 0.003;
constexpr double kUsualModelSd_m = 0.0005;
/// By a step of the pose, the points moving in the model's frame about `centre`.
Pose6 slope(const PressedHeight& at, Vec3 centre_m) {
  const Vec3 by_rotation = (at.at_m - centre_m).cross(at.up);
  Pose6 j;
  j << at.up.x, at.up.y, at.up.z, by_rotation.x, by_rotation.y, by_rotation.z;
  return j;
}

/// Of the bone's pose at the time of a press, the random walk of World among it, with its height.
Pose6 shared_with_pose(const Covariance6& before, const PressedHeight& at, Vec3 centre_m,
                       const PressModel& press) {
  Pose6 shared = before * slope(at, centre_m);
  const double walk_m2 = press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * at.time_s;
  shared.head<3>() += walk_m2 * Eigen::Vector3d(at.up.x, at.up.y, at.up.z);
  return shared;
}

/// Of two heights, but for what each has alone, and for the model's error.
double shared_m2(const Covariance6& before, const PressedHeight& a, const PressedHeight& b,
                 Vec3 centre_m, const PressModel& press) {
  const double walk_m2 =
      press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * std::min(a.time_s, b.time_s);
  // Over the same tissue, a second press leaves what the first one left.
  const double tissue = std::exp(-(a.at_m - b.at_m).norm() / kSameTissue_m);
  return slope(a, centre_m).dot(before * slope(b, centre_m)) + walk_m2 * a.up.dot(b.up) +
         press.common_sd_m * press.common_sd_m + press.sd_m * press.sd_m * tissue;
}

/// The pose's covariance once World walked until the last press.
Covariance6 walked(Covariance6 before, std::span<const PressedPlace> places,
                   const PressModel& press) {
  double now_s = 0.0;
  for (const PressedPlace& place : places) {
    now_s = std::max(now_s, place.time_s);
  }
  before.topLeftCorner<3, 3>().diagonal().array() +=
      press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * now_s;
  return before;
}

/// The heights of places about a pose, what a press leaves taken off, as of the step 0.
struct Heights {
  std::vector<PressedHeight> at;
  Eigen::VectorXd above_m;
  Rows6 shared;             ///< with the pose now
  Eigen::MatrixXd rest_m2;  ///< covariance, but for the model's error
};

Heights heights_of(const VertebraModel& model, const Transform<Vertebra, World>& from_world,
                   std::span<const PressedPlace> places, const Pose6& step, Vec3 centre_m,
                   const Covariance6& before, const PressModel& press) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Heights out{{}, Eigen::VectorXd(n), Rows6(n, 6), Eigen::MatrixXd(n, n)};
  std::array<double, 6> here_step{};
  Eigen::Map<Pose6>(here_step.data()) = step;
  const auto here = moved_by(here_step, centre_m) * from_world;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedPlace& place = places[static_cast<std::size_t>(i)];
    const Vec3 p = (here * place.place).v;
    const auto nearest = model.reachable_surface().nearest(p);
    const double sign = model.surface().contains(p) ? -1.0 : 1.0;
    const bool apart = nearest && nearest->distance_m > kOnSurface_m;
    const Vec3 up = apart     ? (sign / nearest->distance_m) * (p - nearest->point_m)
                    : nearest ? nearest->normal
                              : Vec3{};
    out.at.push_back({p, up, place.time_s, place.sd_m});
    const double height_m =
        nearest ? sign * nearest->distance_m : std::numeric_limits<double>::quiet_NaN();
    out.above_m(i) =
        height_m - press.height_m - press.tip_radius_m - slope(out.at.back(), centre_m).dot(step);
    out.shared.row(i) = shared_with_pose(before, out.at.back(), centre_m, press).transpose();
    for (Eigen::Index k = 0; k <= i; ++k) {
      const PressedHeight& other = out.at[static_cast<std::size_t>(k)];
      out.rest_m2(i, k) = out.rest_m2(k, i) =
          shared_m2(before, out.at.back(), other, centre_m, press);
    }
    out.rest_m2(i, i) += place.sd_m * place.sd_m;
  }
  return out;
}

/// By one field.
struct Answer {
  ModelError model;
  double log_weight = 0.0;  ///< prior and evidence, up to a constant
  Pose6 step = Pose6::Zero();
  Covariance6 covariance = Covariance6::Zero();
  Eigen::MatrixXd inverse;
  Eigen::VectorXd off_m;
  Eigen::VectorXd off_variance_m2;
};

std::optional<Answer> answer(const Heights& heights, const ModelErrorHypothesis& by,
                             const Covariance6& now) {
  const Eigen::Index n = heights.above_m.size();
  Eigen::MatrixXd spread = heights.rest_m2;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      spread(i, k) += shared_error_m2(by.error, heights.at[static_cast<std::size_t>(i)].at_m,
                                      heights.at[static_cast<std::size_t>(k)].at_m);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(spread);
  if (llt.info() != Eigen::Success || !heights.above_m.allFinite()) {
    return std::nullopt;
  }
  Answer out;
  out.model = by.error;
  out.inverse = llt.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd weighed = out.inverse * heights.above_m;
  // The heights are to become what a press leaves.
  out.step = -heights.shared.transpose() * weighed;
  out.covariance = now - heights.shared.transpose() * out.inverse * heights.shared;
  out.covariance = 0.5 * (out.covariance + out.covariance.transpose()).eval();
  const Eigen::MatrixXd lower = llt.matrixL();
  out.log_weight = by.log_probability - 0.5 * heights.above_m.dot(weighed) -
                   lower.diagonal().array().log().sum();
  out.off_variance_m2 = out.inverse.diagonal().cwiseInverse();
  out.off_m = weighed.cwiseProduct(out.off_variance_m2);
  return out;
}

/// Weights that sum to 1 from logarithms.
Eigen::ArrayXd normalized(const Eigen::ArrayXd& logs) {
  const Eigen::ArrayXd weights = (logs - logs.maxCoeff()).exp();
  return weights / weights.sum();
}

/// Each place against all others: they say what the field is like, the place itself does not, or
/// one that slipped would pass for a bad model.
void leave_one_out(const std::vector<Answer>& answers, PressFit& out) {
  const auto fields = static_cast<Eigen::Index>(answers.size());
  for (Eigen::Index i = 0; i < answers.front().off_m.size(); ++i) {
    Eigen::ArrayXd logs(fields);
    Eigen::ArrayXd off_m(fields);
    Eigen::ArrayXd variance_m2(fields);
    for (Eigen::Index k = 0; k < fields; ++k) {
      const Answer& a = answers[static_cast<std::size_t>(k)];
      off_m(k) = a.off_m(i);
      variance_m2(k) = a.off_variance_m2(i);
      logs(k) = a.log_weight + 0.5 * off_m(k) * off_m(k) / variance_m2(k) +
                0.5 * std::log(variance_m2(k));
    }
    const Eigen::ArrayXd weights = normalized(logs);
    const double mean_m = (weights * off_m).sum();
    out.off_m.push_back(mean_m);
    out.off_sd_m.push_back(std::sqrt((weights * (variance_m2 + (off_m - mean_m).square())).sum()));
  }
}

std::vector<Answer> answers_of(const Heights& heights,
                               std::span<const ModelErrorHypothesis> hypotheses,
                               const Covariance6& now) {
  std::vector<Answer> answers;
  for (const ModelErrorHypothesis& by : hypotheses) {
    auto found = answer(heights, by, now);
    if (!found || !found->step.allFinite()) {
      return {};
    }
    answers.push_back(std::move(*found));
  }
  return answers;
}

Eigen::ArrayXd weights_of(const std::vector<Answer>& answers) {
  Eigen::ArrayXd logs(static_cast<Eigen::Index>(answers.size()));
  std::transform(answers.begin(), answers.end(), logs.begin(),
                 [](const Answer& a) { return a.log_weight; });
  return normalized(logs);
}

Pose6 mean_of(const std::vector<Answer>& answers) {
  const Eigen::ArrayXd weights = weights_of(answers);
  Pose6 mean = Pose6::Zero();
  for (std::size_t k = 0; k < answers.size(); ++k) {
    mean += weights(static_cast<Eigen::Index>(k)) * answers[k].step;
  }
  return mean;
}

void put(const std::vector<Answer>& answers, const Pose6& mean, Heights heights, PressFit& out) {
  const Eigen::ArrayXd weights = weights_of(answers);
  Covariance6 covariance = Covariance6::Zero();
  double sd_m2 = 0.0;
  Eigen::Index most = 0;
  weights.maxCoeff(&most);
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const Pose6 off = answers[k].step - mean;
    const double weight = weights(static_cast<Eigen::Index>(k));
    covariance += weight * (answers[k].covariance + off * off.transpose());
    sd_m2 += weight * answers[k].model.sd_m * answers[k].model.sd_m;
    out.model.length_m += weight * answers[k].model.length_m;
  }
  out.model.sd_m = std::sqrt(sd_m2);
  Eigen::Map<Pose6>(out.step.data()) = mean;
  Eigen::Map<Covariance6>(out.covariance.data()) = covariance;
  const Answer& likeliest = answers[static_cast<std::size_t>(most)];
  out.likeliest = likeliest.model;
  Eigen::Map<Covariance6>(out.likeliest_covariance.data()) = likeliest.covariance;
  out.inverse_1_m2.assign(likeliest.inverse.data(),
                          likeliest.inverse.data() + likeliest.inverse.size());
  out.heights = std::move(heights.at);
  out.shared.resize(out.heights.size());
  for (std::size_t i = 0; i < out.shared.size(); ++i) {
    Eigen::Map<Pose6>(out.shared[i].data()) =
        heights.shared.row(static_cast<Eigen::Index>(i)).transpose();
  }
  leave_one_out(answers, out);
}

}  // namespace

std::optional<PressFit> fit_presses(const VertebraModel& model, const Registration& strokes,
                                    std::span<const PressedPlace> places, const PressModel& press) {
  constexpr int kRounds = 6;
  constexpr int kRoundsByAll = 2;
  constexpr double kStands_m = 1e-6;
  PressFit out;
  out.centre_m = strokes.uncertainty->centre_m();
  const PoseUncertainty own = without_common(*strokes.uncertainty, strokes.common);
  Covariance6 before = Eigen::Map<const Covariance6>(own.covariance().data());
  before.topLeftCorner<3, 3>().diagonal().array() += press.moved_sd_m * press.moved_sd_m;
  Eigen::Map<Covariance6>(out.before.data()) = before;
  const Covariance6 now = walked(before, places, press);
  const auto from_world = strokes.world_from_vertebra.inverse();
  const std::vector<ModelErrorHypothesis> usual = {
      {press.model.value_or(ModelError{kUsualModelSd_m}), 0.0}};
  // The directions to the bone stand for any model; what they stand for is told by all of them.
  Pose6 at = Pose6::Zero();
  const auto round = [&](std::span<const ModelErrorHypothesis> by, bool last) {
    Heights heights = heights_of(model, from_world, places, at, out.centre_m, before, press);
    const std::vector<Answer> answers = answers_of(heights, by, now);
    if (answers.empty()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const Pose6 mean = mean_of(answers);
    const double moved_m = (mean - at).head<3>().norm();
    at = mean;
    if (last) {
      put(answers, mean, std::move(heights), out);
    }
    return moved_m;
  };
  for (int k = 0; k < kRounds && round(usual, false) > kStands_m; ++k) {
  }
  const auto all = press.model ? usual : model_error_hypotheses();
  for (int k = 1; k <= kRoundsByAll; ++k) {
    if (std::isnan(round(all, k == kRoundsByAll))) {
      return std::nullopt;
    }
  }
  return out;
}

std::array<double, 36> PressFit::with(const PressedHeight& next, const PressModel& press) const {
  const Eigen::Map<const Covariance6> prior(before.data());
  const auto n = static_cast<Eigen::Index>(heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_1_m2.data(), n, n);
  Pose6 gain = shared_with_pose(prior, next, centre_m, press);
  double variance_m2 = shared_m2(prior, next, next, centre_m, press) + next.sd_m * next.sd_m +
                       likeliest.sd_m * likeliest.sd_m;
  if (n > 0) {
    Eigen::VectorXd with_others(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const PressedHeight& other = heights[static_cast<std::size_t>(i)];
      with_others(i) = shared_m2(prior, next, other, centre_m, press) +
                       shared_error_m2(likeliest, next.at_m, other.at_m);
    }
    const Eigen::VectorXd weighed = inverse * with_others;
    gain -= Eigen::Map<const Rows6>(shared.front().data(), n, 6).transpose() * weighed;
    variance_m2 -= with_others.dot(weighed);
  }
  std::array<double, 36> after{};
  Eigen::Map<Covariance6>(after.data()) =
      Eigen::Map<const Covariance6>(likeliest_covariance.data()) -
      gain * gain.transpose() / variance_m2;
  return after;
}

}  // namespace orthonav::nav
