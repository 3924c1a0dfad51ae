#include "nav/registration/presses.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <map>
#include <utility>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Pose6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

// ---------------------------------------------------------------------------------------------
// Covariances of the heights of n places and, last, of the step of the pose.

/// How each depends on the step from the strokes' pose to the true one, as columns: a place that
/// the step raises lies that much lower at the strokes' pose.
Eigen::Matrix<double, 6, Eigen::Dynamic> moves_of(std::span<const PressedHeight> at,
                                                  Vec3 centre_m) {
  const auto n = static_cast<Index>(at.size());
  Eigen::Matrix<double, 6, Eigen::Dynamic> out(6, n + 6);
  for (Index i = 0; i < n; ++i) {
    const PressedHeight& one = at[static_cast<std::size_t>(i)];
    const Vec3 turned = (one.at_m - centre_m).cross(one.up);
    out.col(i) << -one.up.x, -one.up.y, -one.up.z, -turned.x, -turned.y, -turned.z;
  }
  out.rightCols<6>().setIdentity();
  return out;
}

MatrixXd correlations(std::span<const Vec3> a_m, std::span<const Vec3> b_m, double length_m) {
  MatrixXd out(a_m.size(), b_m.size());
  for (std::size_t i = 0; i < a_m.size(); ++i) {
    for (std::size_t k = 0; k < b_m.size(); ++k) {
      out(static_cast<Index>(i), static_cast<Index>(k)) =
          shared_error_m2({1.0, length_m}, a_m[i], b_m[k]);
    }
  }
  return out;
}

/// An error of the model of SD 1 m and one length.
class ModelField {
 public:
  /// Keeps a reference.
  ModelField(const ModelShare& strokes, double length_m)
      : strokes_(strokes), length_m_(length_m), share_(6, strokes.step.size()) {
    for (std::size_t i = 0; i < strokes.step.size(); ++i) {
      share_.col(static_cast<Index>(i)) = Eigen::Map<const Pose6>(strokes.step[i].data());
    }
    pose_ =
        share_ * correlations(strokes.places_m, strokes.places_m, length_m) * share_.transpose();
  }
  [[nodiscard]] MatrixXd covariance(std::span<const PressedHeight> at, Vec3 centre_m) const {
    const auto n = static_cast<Index>(at.size());
    std::vector<Vec3> places_m;
    for (const PressedHeight& one : at) {
      places_m.push_back(one.at_m);
    }
    const auto moves = moves_of(at, centre_m);
    // Of both with the error at each place.
    const MatrixXd shared =
        moves.transpose() * (share_ * correlations(strokes_.places_m, places_m, length_m_));
    MatrixXd out = moves.transpose() * pose_ * moves;
    out.leftCols(n) += shared;
    out.topRows(n) += shared.transpose();
    out.topLeftCorner(n, n) += correlations(places_m, places_m, length_m_);
    return out;
  }

 private:
  const ModelShare& strokes_;
  double length_m_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> share_;
  Covariance6 pose_;
};

/// The pose of the strokes.
struct StrokedPose {
  Transform<World, Vertebra> world_from_vertebra;
  Vec3 centre_m;
  Covariance6 covariance;  ///< without the model's error, with World's motion since
  ModelShare share;        ///< of the model's error
};

/// By everything but the model's error.
MatrixXd covariance_without_model(std::span<const PressedHeight> at, const StrokedPose& strokes,
                                  const PressModel& press) {
  // A second press over the same tissue has the same error as the first.
  constexpr double kSameTissue_m = 0.003;
  const auto moves = moves_of(at, strokes.centre_m);
  MatrixXd out = moves.transpose() * strokes.covariance * moves;
  const auto seen = [](const PressedHeight& h) { return h.ray.squared_norm() > 0.0; };
  for (std::size_t i = 0; i < at.size(); ++i) {
    const PressedHeight& a = at[i];
    for (std::size_t k = 0; k < at.size(); ++k) {
      const PressedHeight& b = at[k];
      double own_m2 = press.sd_m * press.sd_m * std::exp(-(a.at_m - b.at_m).norm() / kSameTissue_m);
      // What a camera is off along its rays in a view, all places of the view are off alike;
      // presses have a height in common.
      if (seen(a) && seen(b) && a.view == b.view) {
        own_m2 += press.ray_sd_m * press.ray_sd_m * a.ray.dot(a.up) * b.ray.dot(b.up);
      } else if (!seen(a) && !seen(b)) {
        own_m2 += press.common_sd_m * press.common_sd_m;
      }
      out(static_cast<Index>(i), static_cast<Index>(k)) += own_m2 + (i == k ? a.sd_m * a.sd_m : 0);
    }
  }
  return out;
}

std::optional<StrokedPose> pose_of(const Registration& strokes, const PressModel& press) {
  if (!strokes.uncertainty) {
    return std::nullopt;
  }
  StrokedPose out{
      strokes.world_from_vertebra, strokes.uncertainty->centre_m(), Covariance6::Zero(), {}};
  if (press.model_in_limits && !strokes.model_share.places_m.empty()) {
    out.share = strokes.model_share;
    out.covariance = matrix_as<Covariance6>(out.share.rest);
  } else {
    out.covariance =
        matrix_as<Covariance6>(without_common(*strokes.uncertainty, strokes.common).covariance());
  }
  out.covariance.diagonal().head<3>().array() += press.moved_sd_m * press.moved_sd_m;
  return out;
}

// ---------------------------------------------------------------------------------------------
// What the heights say of the pose.

/// A step of the points about `centre_m`, from the registered vertebra to the true one.
Transform<Vertebra, Vertebra> moved_by(const Pose6& step, Vec3 centre_m) {
  const Mat3 rotation = orthonormalized(rotation_from_vector({step(3), step(4), step(5)}));
  return {rotation, centre_m + Vec3{step(0), step(1), step(2)} - rotation * centre_m};
}

/// The places at a step of the pose; and their heights above the bone without it, less the mean
/// height of a press, if they change with the pose as they do here.
std::pair<std::vector<PressedHeight>, VectorXd> heights_at(const Pose6& step,
                                                           const VertebraModel& model,
                                                           const StrokedPose& strokes,
                                                           std::span<const PressedPlace> places,
                                                           const PressModel& press) {
  // Nearer to the surface than this, the direction to it is meaningless.
  constexpr double kOnSurface_m = 1e-5;
  const auto here = moved_by(step, strokes.centre_m) * strokes.world_from_vertebra.inverse();
  std::vector<PressedHeight> at;
  VectorXd above_m(places.size());
  for (const PressedPlace& place : places) {
    const Vec3 p = (here * place.place).v;
    const auto nearest = model.reachable_surface().nearest(p);
    const double sign = model.surface().contains(p) ? -1.0 : 1.0;
    const bool apart = nearest && nearest->distance_m > kOnSurface_m;
    const Vec3 up = apart     ? (sign / nearest->distance_m) * (p - nearest->point_m)
                    : nearest ? nearest->normal
                              : Vec3{};
    above_m(static_cast<Index>(at.size())) = nearest ? sign * nearest->distance_m - press.height_m
                                                     : std::numeric_limits<double>::quiet_NaN();
    at.push_back({p, up, here.rotation() * place.ray, place.view, place.sd_m});
  }
  above_m += moves_of(at, strokes.centre_m).leftCols(above_m.size()).transpose() * step;
  return {std::move(at), std::move(above_m)};
}

/// The result with one error of the model.
struct Answer {
  ModelError model;
  double log_weight = 0.0;  ///< prior and evidence, up to a constant
  Pose6 step;
  Covariance6 covariance;
  /// Of each place, against all others: how far off, and the variance of that.
  VectorXd off_m;
  VectorXd off_variance_m2;
};

std::optional<Answer> answer(const VectorXd& above_m, const MatrixXd& covariance,
                             const ModelErrorHypothesis& by) {
  const Index n = above_m.size();
  const Eigen::LLT<MatrixXd> llt(covariance.topLeftCorner(n, n));
  if (llt.info() != Eigen::Success || !above_m.allFinite()) {
    return std::nullopt;
  }
  const MatrixXd inverse = llt.solve(MatrixXd::Identity(n, n));
  const VectorXd weighed = inverse * above_m;
  const MatrixXd shared = covariance.bottomLeftCorner(6, n);
  Answer out;
  out.model = by.error;
  out.step = shared * weighed;
  out.covariance = covariance.bottomRightCorner<6, 6>() - shared * inverse * shared.transpose();
  out.log_weight = by.log_probability - 0.5 * above_m.dot(weighed) -
                   llt.matrixLLT().diagonal().array().log().sum();
  out.off_variance_m2 = inverse.diagonal().cwiseInverse();
  out.off_m = weighed.cwiseProduct(out.off_variance_m2);
  return out.step.allFinite() ? std::optional(std::move(out)) : std::nullopt;
}

/// Weights that sum to 1 from logarithms.
Eigen::ArrayXd normalized(const Eigen::ArrayXd& logs) {
  const Eigen::ArrayXd weights = (logs - logs.maxCoeff()).exp();
  return weights / weights.sum();
}

/// Sums over errors of the model.
void put(const std::vector<Answer>& answers, PressFit& out) {
  const auto count = static_cast<Index>(answers.size());
  Eigen::ArrayXd logs(count);
  std::transform(answers.begin(), answers.end(), logs.begin(),
                 [](const Answer& a) { return a.log_weight; });
  out.likeliest =
      std::max_element(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
        return a.log_weight < b.log_weight;
      })->model;
  const Eigen::ArrayXd weights = normalized(logs);
  Pose6 mean = Pose6::Zero();
  for (Index k = 0; k < count; ++k) {
    mean += weights(k) * answers[static_cast<std::size_t>(k)].step;
  }
  Covariance6 covariance = Covariance6::Zero();
  double sd_m2 = 0.0;
  for (Index k = 0; k < count; ++k) {
    const Answer& a = answers[static_cast<std::size_t>(k)];
    covariance += weights(k) * (a.covariance + (a.step - mean) * (a.step - mean).transpose());
    sd_m2 += weights(k) * a.model.sd_m * a.model.sd_m;
  }
  out.model_sd_m = std::sqrt(sd_m2);
  Eigen::Map<Pose6>(out.step.data()) = mean;
  Eigen::Map<Covariance6>(out.covariance.data()) = 0.5 * (covariance + covariance.transpose());
  // Each place against the prediction from all others, with the model's error estimated from those
  // alone; otherwise a press that slipped would look like a bad model.
  out.off_m.clear();
  out.off_sd_m.clear();
  for (Index i = 0; i < answers.front().off_m.size(); ++i) {
    Eigen::ArrayXd without(count), off_m(count), variance_m2(count);
    for (Index k = 0; k < count; ++k) {
      const Answer& a = answers[static_cast<std::size_t>(k)];
      off_m(k) = a.off_m(i);
      variance_m2(k) = a.off_variance_m2(i);
      without(k) =
          logs(k) + 0.5 * off_m(k) * off_m(k) / variance_m2(k) + 0.5 * std::log(variance_m2(k));
    }
    const Eigen::ArrayXd weight = normalized(without);
    const double mean_m = (weight * off_m).sum();
    out.off_m.push_back(mean_m);
    out.off_sd_m.push_back(std::sqrt((weight * (variance_m2 + (off_m - mean_m).square())).sum()));
  }
}

/// The covariances with the likeliest error of the model, of the fitted places and more.
MatrixXd likeliest_covariance(const PressFit& fit, const StrokedPose& strokes,
                              const PressModel& press, std::span<const PressedHeight> at) {
  return covariance_without_model(at, strokes, press) +
         fit.likeliest.sd_m * fit.likeliest.sd_m *
             ModelField(strokes.share, fit.likeliest.length_m).covariance(at, fit.centre_m);
}

/// What an error of the model that the fit did not know of adds to the pose's covariance.
Covariance6 by_unknown_model(const PressFit& fit, const StrokedPose& strokes,
                             const PressModel& press) {
  const auto n = static_cast<Index>(fit.heights.size());
  const MatrixXd all = likeliest_covariance(fit, strokes, press, fit.heights);
  MatrixXd error(6, n + 6);  // of the fitted pose, by heights and pose
  error << -all.topLeftCorner(n, n).llt().solve(all.topRightCorner(n, 6)).transpose(),
      Covariance6::Identity();
  const ModelShare none;
  const ModelError usual{kUsualModelError_m};
  return usual.sd_m * usual.sd_m * error *
         ModelField(none, usual.length_m).covariance(fit.heights, fit.centre_m) * error.transpose();
}

}  // namespace

Transform<World, Vertebra> PressFit::moved(
    const Transform<World, Vertebra>& world_from_vertebra) const {
  return world_from_vertebra * moved_by(Eigen::Map<const Pose6>(step.data()), centre_m).inverse();
}

std::optional<PressFit> fit_presses(const VertebraModel& model, const Registration& strokes,
                                    std::span<const PressedPlace> places, const PressModel& press) {
  constexpr int kMostRounds = 8;
  constexpr double kStands_m = 1e-6;
  constexpr double kLever_m = 0.03;
  const auto stroked = pose_of(strokes, press);
  if (!stroked) {
    return std::nullopt;
  }
  PressFit out;
  out.centre_m = stroked->centre_m;
  const std::vector<ModelErrorHypothesis> hypotheses =
      press.model_in_limits ? model_error_hypotheses() : std::vector<ModelErrorHypothesis>(1);
  std::map<double, ModelField> fields;
  for (const ModelErrorHypothesis& by : hypotheses) {
    fields.try_emplace(by.error.length_m, stroked->share, by.error.length_m);
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const Pose6 before = Eigen::Map<const Pose6>(out.step.data());
    auto [at, above_m] = heights_at(before, model, *stroked, places, press);
    const MatrixXd rest = covariance_without_model(at, *stroked, press);
    std::map<double, MatrixXd> by_model;
    for (const auto& [length_m, field] : fields) {
      by_model.emplace(length_m, field.covariance(at, out.centre_m));
    }
    std::vector<Answer> answers;
    for (const ModelErrorHypothesis& by : hypotheses) {
      const auto [sd_m, length_m] = by.error;
      auto found = answer(above_m, rest + sd_m * sd_m * by_model.at(length_m), by);
      if (!found) {
        return std::nullopt;
      }
      answers.push_back(std::move(*found));
    }
    put(answers, out);
    out.heights = std::move(at);
    const Pose6 moved = Eigen::Map<const Pose6>(out.step.data()) - before;
    if (moved.head<3>().norm() + kLever_m * moved.tail<3>().norm() <= kStands_m) {
      break;
    }
  }
  out.in_limits = out.covariance;
  if (!press.model_in_limits && !places.empty()) {
    Eigen::Map<Covariance6>(out.covariance.data()) += by_unknown_model(out, *stroked, press);
  }
  return out;
}

// ---------------------------------------------------------------------------------------------
// The registration with them, and the next one.

namespace {

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

}  // namespace

Registration with_places(const VertebraModel& model, const Registration& strokes,
                         const PressFit& fit, const PressModel& press,
                         const PoseSearchRegistrationOptions& options) {
  Registration r = strokes;
  r.world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = press.since_sd_m;
  put_errors(model, {fit.centre_m, fit.in_limits}, common, targets_of(model, options), r);
  r.uncertainty = with_common({fit.centre_m, fit.covariance}, common);
  judge(options, r);
  return r;
}

std::optional<NextPlace> place_to_press(const VertebraModel& model, const Registration& strokes,
                                        std::span<const Point<World>> stroked,
                                        std::span<const PressedPlace> pressed, const PressFit& fit,
                                        const PressModel& press,
                                        const PoseSearchRegistrationOptions& options,
                                        double apart_m) {
  constexpr std::size_t kMaxTried = 250;
  constexpr double kOnBone_m = 0.003;
  constexpr double kUsualSd_m = 0.0002;  // what averaging a tip at rest for a second leaves
  const auto pose = pose_of(strokes, press);
  if (!pose) {
    return std::nullopt;
  }
  const auto world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  const auto from_world = world_from_vertebra.inverse();
  std::vector<PressedHeight> all = fit.heights;
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMaxTried);
  for (std::size_t i = 0; i < stroked.size(); i += step) {
    const auto nearest = model.reachable_surface().nearest((from_world * stroked[i]).v, kOnBone_m);
    if (!nearest) {
      continue;
    }
    const Point<World> place = world_from_vertebra * Point<Vertebra>{nearest->point_m};
    if (std::none_of(pressed.begin(), pressed.end(),
                     [&](const PressedPlace& p) { return (p.place - place).norm() < apart_m; })) {
      all.push_back({nearest->point_m, nearest->normal, {}, 0, kUsualSd_m});
    }
  }
  // What the pressed ones leave of the others and of the pose.
  const MatrixXd before = likeliest_covariance(fit, *pose, press, all);
  const auto n = static_cast<Index>(fit.heights.size());
  const auto rest = static_cast<Index>(all.size()) - n;
  const MatrixXd left =
      before.bottomRightCorner(rest + 6, rest + 6) -
      before.bottomLeftCorner(rest + 6, n) *
          before.topLeftCorner(n, n).llt().solve(before.topRightCorner(n, rest + 6));
  const Covariance6 covariance = left.bottomRightCorner<6, 6>();
  const auto targets = targets_of(model, options);
  const auto tre_m = [&](const Covariance6& c) {
    return worst_tre_m({fit.centre_m, rows_of<36>(c)}, targets);
  };
  NextPlace best{{}, tre_m(covariance), std::numeric_limits<double>::infinity()};
  for (Index i = 0; i < rest; ++i) {
    const Pose6 shared = left.col(i).tail<6>();
    const Covariance6 then = covariance - shared * shared.transpose() / left(i, i);
    const double then_m = tre_m(then);
    if (then_m < best.tre_then_m) {
      best.tre_then_m = then_m;
      best.place = world_from_vertebra * Point<Vertebra>{all[static_cast<std::size_t>(n + i)].at_m};
    }
  }
  return std::isfinite(best.tre_then_m) ? std::optional(best) : std::nullopt;
}

}  // namespace orthonav::nav
