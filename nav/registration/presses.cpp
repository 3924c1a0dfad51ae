#include "nav/registration/presses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <utility>

namespace orthonav::nav {

// ---------------------------------------------------------------------------------------------
// What the heights of the places say of the pose.

namespace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Nearer to the surface than this, the direction to it is meaningless.
constexpr double kOnSurface_m = 1e-5;

Pose6 pose_of(const std::array<double, 6>& step) { return Eigen::Map<const Pose6>(step.data()); }

/// Correlation length of soft tissue under a pressed tip.
constexpr double kSameTissue_m = 0.003;

Pose6 slope_about(Vec3 centre_m, const PressedHeight& at) {
  const Vec3 by_rotation = (at.at_m - centre_m).cross(at.up);
  Pose6 j;
  j << at.up.x, at.up.y, at.up.z, by_rotation.x, by_rotation.y, by_rotation.z;
  return j;
}

/// The covariance of the heights of pressed places with the pose and with each other, without the
/// part that each has alone and without the model's error.
struct PressCovariance {
  Covariance6 before;  ///< of the pose of the strokes, without the model's
  Vec3 centre_m;       ///< of a step of the pose, in the model's frame
  PressModel press;

  /// The derivative of a height by a step of the pose: the points move in the model's frame about
  /// the centre.
  [[nodiscard]] Pose6 slope(const PressedHeight& at) const { return slope_about(centre_m, at); }
  /// The variance along each axis of World's walk over this time.
  [[nodiscard]] double walk_m2(double time_s) const {
    return press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * time_s;
  }
  /// The covariance of a height and the pose at the time of its press, including World's walk.
  [[nodiscard]] Pose6 with_pose(const PressedHeight& at) const {
    Pose6 shared = before * slope(at);
    shared.head<3>() += walk_m2(at.time_s) * Eigen::Vector3d(at.up.x, at.up.y, at.up.z);
    return shared;
  }
  /// The covariance of two heights.
  [[nodiscard]] double between_m2(const PressedHeight& a, const PressedHeight& b) const {
    // A second press over the same tissue has the same error as the first.
    const double tissue = std::exp(-(a.at_m - b.at_m).norm() / kSameTissue_m);
    // What a camera is off along its rays in a view, all places of the view are off alike; presses
    // have a height in common.
    const auto seen = [](const PressedHeight& h) { return h.ray.squared_norm() > 0.0; };
    double common_m2 = 0.0;
    if (seen(a) && seen(b) && a.view == b.view) {
      common_m2 = press.ray_sd_m * press.ray_sd_m * a.ray.dot(a.up) * b.ray.dot(b.up);
    } else if (!seen(a) && !seen(b)) {
      common_m2 = press.common_sd_m * press.common_sd_m;
    }
    return slope(a).dot(before * slope(b)) +
           walk_m2(std::min(a.time_s, b.time_s)) * a.up.dot(b.up) + common_m2 +
           press.sd_m * press.sd_m * tissue;
  }
  /// The covariance of the pose after World has drifted for this long.
  [[nodiscard]] Covariance6 walked(double time_s) const {
    Covariance6 out = before;
    out.topLeftCorner<3, 3>().diagonal().array() += walk_m2(time_s);
    return out;
  }
};

/// What a model's error of SD 1 and of one length does to heights and pose.
struct ByField {
  double length_m = 0.0;
  Rows6 shared;             ///< of the heights with the pose
  Eigen::MatrixXd heights;  ///< their covariance
  Covariance6 pose;         ///< of the strokes
};

/// The heights of places at a pose (step 0), minus the mean height of a press.
struct Heights {
  std::vector<PressedHeight> at;
  Eigen::VectorXd above_m;
  Rows6 shared;             ///< with the pose now
  Eigen::MatrixXd rest_m2;  ///< covariance without the model's error
  std::vector<ByField> fields;
};

/// The problem that every round solves.
struct PressProblem {
  const VertebraModel& model;
  Transform<Vertebra, World> from_world;
  std::span<const PressedPlace> places;
  PressCovariance prior;
  Covariance6 now;  ///< of the pose, with World's drift until the last press, without the model's
  std::vector<std::pair<double, FieldCovariance>> fields;  ///< by length
};

Heights heights_of(const PressProblem& problem, const Pose6& step) {
  const auto n = static_cast<Eigen::Index>(problem.places.size());
  const PressCovariance& prior = problem.prior;
  Heights out{{}, Eigen::VectorXd(n), Rows6(n, 6), Eigen::MatrixXd(n, n)};
  std::array<double, 6> here_step{};
  Eigen::Map<Pose6>(here_step.data()) = step;
  const auto here = moved_by(here_step, prior.centre_m) * problem.from_world;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedPlace& place = problem.places[static_cast<std::size_t>(i)];
    const Vec3 p = (here * place.place).v;
    const auto nearest = problem.model.reachable_surface().nearest(p);
    const double sign = problem.model.surface().contains(p) ? -1.0 : 1.0;
    const bool apart = nearest && nearest->distance_m > kOnSurface_m;
    const Vec3 up = apart     ? (sign / nearest->distance_m) * (p - nearest->point_m)
                    : nearest ? nearest->normal
                              : Vec3{};
    out.at.push_back({p, up, here.rotation() * place.ray, place.view, place.time_s, place.sd_m});
    const double height_m =
        nearest ? sign * nearest->distance_m : std::numeric_limits<double>::quiet_NaN();
    out.above_m(i) = height_m - prior.press.height_m - prior.press.tip_radius_m -
                     prior.slope(out.at.back()).dot(step);
    out.shared.row(i) = prior.with_pose(out.at.back()).transpose();
    for (Eigen::Index k = 0; k <= i; ++k) {
      const PressedHeight& other = out.at[static_cast<std::size_t>(k)];
      out.rest_m2(i, k) = out.rest_m2(k, i) = prior.between_m2(out.at.back(), other);
    }
    out.rest_m2(i, i) += place.sd_m * place.sd_m;
  }
  for (const auto& [length_m, field] : problem.fields) {
    ByField& by =
        out.fields.emplace_back(ByField{length_m, Rows6(n, 6), Eigen::MatrixXd(n, n),
                                        Eigen::Map<const Covariance6>(field.pose().data())});
    std::vector<std::array<double, 6>> places;
    for (Eigen::Index i = 0; i < n; ++i) {
      const PressedHeight& one = out.at[static_cast<std::size_t>(i)];
      places.push_back(field.with_place(one.at_m));
      by.shared.row(i) = pose_of(field.with_pose(one, places.back())).transpose();
      for (Eigen::Index k = 0; k <= i; ++k) {
        const auto other = static_cast<std::size_t>(k);
        by.heights(i, k) = by.heights(k, i) =
            field.between(one, places.back(), out.at[other], places[other]);
      }
    }
  }
  return out;
}

/// The result for one field.
struct Answer {
  ModelError model;
  double log_weight = 0.0;  ///< prior and evidence, up to a constant
  Pose6 step = Pose6::Zero();
  Covariance6 covariance = Covariance6::Zero();
  Rows6 shared;
  Eigen::MatrixXd inverse;
  Eigen::VectorXd off_m;
  Eigen::VectorXd off_variance_m2;
};

std::optional<Answer> answer(const Heights& heights, const ModelErrorHypothesis& by,
                             const Covariance6& now) {
  const Eigen::Index n = heights.above_m.size();
  const auto field =
      std::find_if(heights.fields.begin(), heights.fields.end(),
                   [&](const ByField& of) { return of.length_m == by.error.length_m; });
  const double model_m2 = by.error.sd_m * by.error.sd_m;
  const Eigen::MatrixXd spread = heights.rest_m2 + model_m2 * field->heights;
  const Eigen::LLT<Eigen::MatrixXd> llt(spread);
  if (llt.info() != Eigen::Success || !heights.above_m.allFinite()) {
    return std::nullopt;
  }
  Answer out;
  out.model = by.error;
  out.inverse = llt.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd weighed = out.inverse * heights.above_m;
  // The step that brings the heights to the mean height of a press.
  out.shared = heights.shared + model_m2 * field->shared;
  out.step = -out.shared.transpose() * weighed;
  out.covariance = now + model_m2 * field->pose - out.shared.transpose() * out.inverse * out.shared;
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

/// Compares each place with the prediction from all others, with the model error estimated from
/// those alone; otherwise a press that slipped would look like a bad model.
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

/// The heights at a step of the pose, and the resulting answers.
struct Round {
  std::vector<Answer> answers;
  Heights heights;
  Pose6 mean;
};

/// Nothing if a number is not finite.
std::optional<Round> round_at(const PressProblem& problem, const Pose6& step,
                              std::span<const ModelErrorHypothesis> by) {
  Heights heights = heights_of(problem, step);
  std::vector<Answer> answers = answers_of(heights, by, problem.now);
  if (answers.empty()) {
    return std::nullopt;
  }
  const Pose6 mean = mean_of(answers);
  return mean.allFinite() ? std::optional(Round{std::move(answers), std::move(heights), mean})
                          : std::nullopt;
}

std::vector<ModelErrorHypothesis> hypotheses_of(const PressModel& press) {
  return press.model ? std::vector<ModelErrorHypothesis>{{*press.model, 0.0}}
                     : model_error_hypotheses();
}

/// Repeats rounds until the pose hardly moves; returns the last one.
std::optional<Round> last_round(const PressProblem& problem) {
  constexpr int kRounds = 6;
  constexpr int kRoundsByAll = 2;
  constexpr double kStands_m = 1e-6;
  constexpr double kLever_m = 0.03;
  const std::optional<ModelError>& known = problem.prior.press.model;
  // The directions to the bone do not depend on the model error: a typical one is used to find
  // them, and all of them are used for the result.
  const std::vector<ModelErrorHypothesis> usual = {
      {known.value_or(ModelError{kUsualModelError_m}), 0.0}};
  Pose6 at = Pose6::Zero();
  std::optional<Round> round;
  double moved_m = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRounds && moved_m > kStands_m; ++k) {
    round = round_at(problem, at, usual);
    if (!round) {
      return std::nullopt;
    }
    moved_m = (round->mean - at).head<3>().norm() + kLever_m * (round->mean - at).tail<3>().norm();
    at = round->mean;
  }
  const auto all = hypotheses_of(problem.prior.press);
  for (int k = 0; k < kRoundsByAll && round; ++k) {
    round = round_at(problem, round->mean, all);
  }
  return round;
}

void put(Round round, PressFit& out) {
  const std::vector<Answer>& answers = round.answers;
  const Eigen::ArrayXd weights = weights_of(answers);
  Covariance6 covariance = Covariance6::Zero();
  double sd_m2 = 0.0;
  Eigen::Index most = 0;
  weights.maxCoeff(&most);
  out.model.length_m = 0.0;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const Pose6 off = answers[k].step - round.mean;
    const double weight = weights(static_cast<Eigen::Index>(k));
    covariance += weight * (answers[k].covariance + off * off.transpose());
    sd_m2 += weight * answers[k].model.sd_m * answers[k].model.sd_m;
    out.model.length_m += weight * answers[k].model.length_m;
  }
  out.model.sd_m = std::sqrt(sd_m2);
  Eigen::Map<Pose6>(out.step.data()) = round.mean;
  Eigen::Map<Covariance6>(out.covariance.data()) = covariance;
  const Answer& likeliest = answers[static_cast<std::size_t>(most)];
  out.likeliest = likeliest.model;
  Eigen::Map<Covariance6>(out.likeliest_covariance.data()) = likeliest.covariance;
  out.inverse_1_m2.assign(likeliest.inverse.data(),
                          likeliest.inverse.data() + likeliest.inverse.size());
  out.heights = std::move(round.heights.at);
  out.shared.resize(out.heights.size());
  for (std::size_t i = 0; i < out.shared.size(); ++i) {
    Eigen::Map<Pose6>(out.shared[i].data()) =
        likeliest.shared.row(static_cast<Eigen::Index>(i)).transpose();
  }
  leave_one_out(answers, out);
}

}  // namespace

FieldCovariance::FieldCovariance(const ModelShare& strokes, double length_m, Vec3 centre_m)
    : strokes_(strokes), length_m_(length_m), centre_m_(centre_m) {
  Covariance6 sum = Covariance6::Zero();
  for (std::size_t i = 0; i < strokes.places_m.size(); ++i) {
    const std::array<double, 6> with = with_place(strokes.places_m[i]);
    sum += Eigen::Map<const Pose6>(with.data()) *
           Eigen::Map<const Pose6>(strokes.step[i].data()).transpose();
  }
  Eigen::Map<Covariance6>(pose_.data()) = 0.5 * (sum + sum.transpose());
}

std::array<double, 6> FieldCovariance::with_place(Vec3 at_m) const {
  const ModelError unit{1.0, length_m_};
  std::array<double, 6> out{};
  Eigen::Map<Pose6> sum(out.data());
  for (std::size_t i = 0; i < strokes_.places_m.size(); ++i) {
    sum += shared_error_m2(unit, strokes_.places_m[i], at_m) *
           Eigen::Map<const Pose6>(strokes_.step[i].data());
  }
  return out;
}

std::array<double, 6> FieldCovariance::with_pose(const PressedHeight& at,
                                                 const std::array<double, 6>& place) const {
  std::array<double, 6> out{};
  Eigen::Map<Pose6>(out.data()) =
      Eigen::Map<const Covariance6>(pose_.data()) * slope_about(centre_m_, at) -
      Eigen::Map<const Pose6>(place.data());
  return out;
}

double FieldCovariance::between(const PressedHeight& a, const std::array<double, 6>& place_a,
                                const PressedHeight& b,
                                const std::array<double, 6>& place_b) const {
  const Pose6 slope_a = slope_about(centre_m_, a);
  const Pose6 slope_b = slope_about(centre_m_, b);
  return slope_a.dot(Eigen::Map<const Covariance6>(pose_.data()) * slope_b) -
         slope_a.dot(Eigen::Map<const Pose6>(place_b.data())) -
         slope_b.dot(Eigen::Map<const Pose6>(place_a.data())) +
         shared_error_m2({1.0, length_m_}, a.at_m, b.at_m);
}

std::optional<PressFit> fit_presses(const VertebraModel& model, const Registration& strokes,
                                    std::span<const PressedPlace> places, const PressModel& press) {
  if (!strokes.uncertainty) {
    return std::nullopt;
  }
  PressFit out;
  out.centre_m = strokes.uncertainty->centre_m();
  for (const PressedPlace& place : places) {
    out.now_s = std::max(out.now_s, place.time_s);
  }
  // A model's error that is given applies to the presses alone.
  if (!press.model && !strokes.model_share.places_m.empty()) {
    out.strokes = strokes.model_share;
    out.before = out.strokes.rest;
  } else {
    out.before = without_common(*strokes.uncertainty, strokes.common).covariance();
  }
  Eigen::Map<Covariance6>(out.before.data()).topLeftCorner<3, 3>().diagonal().array() +=
      press.moved_sd_m * press.moved_sd_m;
  const PressCovariance prior{Eigen::Map<const Covariance6>(out.before.data()), out.centre_m,
                              press};
  PressProblem problem{
      model, strokes.world_from_vertebra.inverse(), places, prior, prior.walked(out.now_s), {}};
  for (const ModelErrorHypothesis& by : hypotheses_of(press)) {
    const double length_m = by.error.length_m;
    if (std::none_of(problem.fields.begin(), problem.fields.end(),
                     [&](const auto& of) { return of.first == length_m; })) {
      problem.fields.emplace_back(length_m, FieldCovariance(out.strokes, length_m, out.centre_m));
    }
  }
  auto round = last_round(problem);
  if (!round) {
    return std::nullopt;
  }
  put(std::move(*round), out);
  return out;
}

std::vector<std::array<double, 36>> PressFit::with(std::span<const PressedHeight> next,
                                                   const PressModel& press) const {
  const PressCovariance prior{Eigen::Map<const Covariance6>(before.data()), centre_m, press};
  const FieldCovariance field(strokes, likeliest.length_m, centre_m);
  const double model_m2 = likeliest.sd_m * likeliest.sd_m;
  const auto n = static_cast<Eigen::Index>(heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_1_m2.data(), n, n);
  std::vector<std::array<double, 6>> places;
  for (const PressedHeight& other : heights) {
    places.push_back(field.with_place(other.at_m));
  }
  std::vector<std::array<double, 36>> out;
  for (const PressedHeight& one : next) {
    const std::array<double, 6> place = field.with_place(one.at_m);
    Pose6 gain = prior.with_pose(one) + model_m2 * pose_of(field.with_pose(one, place));
    double variance_m2 = prior.between_m2(one, one) + one.sd_m * one.sd_m +
                         model_m2 * field.between(one, place, one, place);
    if (n > 0) {
      Eigen::VectorXd with_others(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        with_others(i) = prior.between_m2(one, heights[k]) +
                         model_m2 * field.between(one, place, heights[k], places[k]);
      }
      const Eigen::VectorXd weighed = inverse * with_others;
      gain -= Eigen::Map<const Rows6>(shared.front().data(), n, 6).transpose() * weighed;
      variance_m2 -= with_others.dot(weighed);
    }
    Eigen::Map<Covariance6>(out.emplace_back().data()) =
        Eigen::Map<const Covariance6>(likeliest_covariance.data()) -
        gain * gain.transpose() / variance_m2;
  }
  return out;
}

Transform<World, Vertebra> PressFit::moved(
    const Transform<World, Vertebra>& world_from_vertebra) const {
  return world_from_vertebra * moved_by(step, centre_m).inverse();
}

// ---------------------------------------------------------------------------------------------
// The registration with them, and the next one.

namespace {

/// The SD that averaging a tip at rest for a second leaves.
constexpr double kUsualSd_m = 0.0002;

/// Judges the registration again; touched places can't remove the other reasons for which the
/// strokes were refused.
void judge(const PoseSearchRegistrationOptions& options, Registration& r) {
  using Kind = RefusalReason::Kind;
  std::erase_if(r.reasons, [](const RefusalReason& reason) {
    return reason.kind == Kind::kTre99AtScrews || reason.kind == Kind::kSoftTissue;
  });
  if (!(r.tre_99_m <= options.max_tre_99_m)) {
    r.reasons.push_back({Kind::kTre99AtScrews, r.tre_99_m, options.max_tre_99_m, r.weakest});
  }
  r.accepted = r.reasons.empty();
  r.provisional = is_provisional(r);
}

/// What a unit of each height moves the pose by, with the likeliest field.
Eigen::MatrixXd gain_of(const PressFit& fit) {
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(fit.inverse_1_m2.data(), n, n);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> shared(
      fit.shared.front().data(), n, 6);
  return shared.transpose() * inverse;
}

/// What an error of the model that the fit did not know of adds to the pose's covariance.
Covariance6 model_left(const PressFit& fit, const ModelError& error) {
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  Eigen::MatrixXd off_m2(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      off_m2(i, k) = shared_error_m2(error, fit.heights[static_cast<std::size_t>(i)].at_m,
                                     fit.heights[static_cast<std::size_t>(k)].at_m);
    }
  }
  const Eigen::MatrixXd gain = gain_of(fit);
  return gain * off_m2 * gain.transpose();
}

/// The part of the pose's covariance after all presses that comes from World's drift, by the gain
/// of the likeliest field.
Covariance6 walk_left(const PressFit& fit, const PressModel& press) {
  const double walk_m2 = press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s;
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  Eigen::MatrixXd with_now = Eigen::MatrixXd::Zero(n, 6);
  Eigen::MatrixXd walk(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedHeight& a = fit.heights[static_cast<std::size_t>(i)];
    with_now.row(i).head<3>() << a.time_s * a.up.x, a.time_s * a.up.y, a.time_s * a.up.z;
    for (Eigen::Index k = 0; k < n; ++k) {
      const PressedHeight& b = fit.heights[static_cast<std::size_t>(k)];
      walk(i, k) = std::min(a.time_s, b.time_s) * a.up.dot(b.up);
    }
  }
  const Eigen::MatrixXd gain = gain_of(fit);
  const Covariance6 taken = gain * with_now;
  Covariance6 left = gain * walk * gain.transpose() - taken - taken.transpose();
  left.topLeftCorner<3, 3>().diagonal().array() += fit.now_s;
  return walk_m2 * left;
}

/// The pose's covariance without World's walk. The gain of one field does not quite match the
/// covariance of all of them: if the difference is not a covariance, the drift is kept.
std::array<double, 36> without_walk(const PressFit& fit, const PressModel& press) {
  std::array<double, 36> own = fit.covariance;
  Eigen::Map<Covariance6> left(own.data());
  left -= walk_left(fit, press);
  return Eigen::LLT<Covariance6>(left).info() == Eigen::Success ? own : fit.covariance;
}

double worst_tre_m(const std::array<double, 36>& covariance, Vec3 centre_m,
                   std::span<const Point<Vertebra>> targets) {
  const PoseUncertainty uncertainty(centre_m, covariance);
  double worst_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    worst_m = std::max(worst_m, uncertainty.predicted_tre_m(target));
  }
  return worst_m;
}

}  // namespace

std::optional<JoinedPlaces> join_places(const VertebraModel& model, const Registration& strokes,
                                        const PressFit& fit, const PressModel& press,
                                        const PoseSearchRegistrationOptions& options) {
  if (fit.heights.empty()) {
    return std::nullopt;
  }
  JoinedPlaces out;
  out.off_m = fit.off_m;
  out.off_sd_m = fit.off_sd_m;
  out.model = fit.model;
  Registration& r = out.registration;
  r = strokes;
  r.world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = press.since_sd_m;
  std::array<double, 36> covariance = fit.covariance;
  if (press.left_out) {
    Eigen::Map<Covariance6>(covariance.data()) += model_left(fit, *press.left_out);
  }
  const PoseUncertainty whole(fit.centre_m, covariance);
  // Limits judge the registration alone, without World's drift, which no press can reduce. The
  // drift stays in the uncertainty.
  put_errors(model, {fit.centre_m, without_walk(fit, press)}, common, targets_of(model, options),
             r);
  r.uncertainty = with_common(whole, common);
  judge(options, r);
  return out;
}

std::optional<NextPlace> place_to_press(const VertebraModel& model, const Registration& strokes,
                                        std::span<const Point<World>> stroked,
                                        std::span<const PressedPlace> pressed, const PressFit& fit,
                                        const PressModel& press,
                                        const PoseSearchRegistrationOptions& options,
                                        double apart_m) {
  constexpr std::size_t kMaxTried = 250;
  constexpr double kOnBone_m = 0.003;
  const auto targets = targets_of(model, options);
  const auto world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  const auto from_world = world_from_vertebra.inverse();
  NextPlace best;
  std::vector<Point<World>> places;
  std::vector<PressedHeight> next;
  best.tre_m = worst_tre_m(fit.likeliest_covariance, fit.centre_m, targets);
  best.tre_then_m = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMaxTried);
  for (std::size_t i = 0; i < stroked.size(); i += step) {
    const auto nearest = model.reachable_surface().nearest((from_world * stroked[i]).v, kOnBone_m);
    if (!nearest) {
      continue;
    }
    const Point<World> place = world_from_vertebra * Point<Vertebra>{nearest->point_m};
    if (std::any_of(pressed.begin(), pressed.end(),
                    [&](const PressedPlace& p) { return (p.place - place).norm() < apart_m; })) {
      continue;
    }
    places.push_back(place);
    next.push_back({nearest->point_m, nearest->normal, {}, 0, fit.now_s, kUsualSd_m});
  }
  const auto then = fit.with(next, press);
  for (std::size_t i = 0; i < then.size(); ++i) {
    const double then_m = worst_tre_m(then[i], fit.centre_m, targets);
    if (then_m < best.tre_then_m) {
      best.tre_then_m = then_m;
      best.place = places[i];
    }
  }
  return std::isfinite(best.tre_then_m) ? std::optional(best) : std::nullopt;
}

}  // namespace orthonav::nav
