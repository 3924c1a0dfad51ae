#include "nav/registration/decision.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "base/random.h"
#include "base/reason.h"
#include "base/translation.h"
#include "nav/registration/search.h"

namespace orthonav::nav::posterior {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
/// Explanations that are less probable than the best by more than this are not looked at closely.
constexpr double kFarWorse = 25.0;
constexpr std::size_t kDraws = 4096;
/// Poses whose targets are this near to each other count as one.
constexpr double kSame_m = 0.0005;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Rows6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

std::vector<Point<World>> tips_of(const Observations& observations) {
  std::vector<Point<World>> tips;
  for (const StrokePoint& p : observations.strokes) {
    tips.push_back(p.tip);
  }
  return tips;
}

/// The first millimetres of the shaft are left out: they may graze the bone that the tip touches.
constexpr double kShaftFrom_m = 0.006;
constexpr double kShaftTo_m = 0.060;
constexpr double kShaftStep_m = 0.003;
/// Shafts have a width, and poses and fields have errors: only depths beyond this count.
constexpr double kShaftInside_m = 0.002;
constexpr std::size_t kShaftsChecked = 300;

bool goes_through(const DistanceField& field, Vec3 tip, Vec3 shaft) {
  DistanceField::Value value;
  for (double along = kShaftFrom_m; along < kShaftTo_m; along += kShaftStep_m) {
    if (field.at(tip + along * shaft, value) && value.distance_m < -kShaftInside_m) {
      return true;
    }
  }
  return false;
}

/// A hypothesis with its posterior.
struct Tried {
  Explanation::Kind kind = Explanation::Kind::kAnswer;
  std::string level;
  double log_odds = 0.0;
  const VertebraModel* model = nullptr;
  Transform<World, Vertebra> start;
  std::optional<Posterior> found;
  double shaft_collisions = 0.0;  ///< share, at the pose that was found
  double log_shafts = 0.0;

  [[nodiscard]] double log_evidence() const {
    return found ? found->log_evidence + log_shafts : kImpossible;
  }
  [[nodiscard]] double log_weight() const { return log_odds + log_evidence(); }
  void look(Averaged& averaged, Effort effort, bool tells_hand, double least_weight = kImpossible) {
    found = posterior_of(averaged, BoneSurface(*model, kind == Explanation::Kind::kMirror),
                         found ? found->world_from_vertebra : start, effort, tells_hand,
                         least_weight - log_odds);
    if (found) {
      shaft_collisions =
          shaft_collision_fraction(averaged.observations(), *model, found->world_from_vertebra,
                                   kind == Explanation::Kind::kMirror);
      log_shafts =
          averaged.rows() * shaft_collisions *
          std::log(averaged.prior().shaft_in_bone / (1.0 - averaged.prior().shaft_in_bone));
    }
  }
};

/// The largest error at any target, ascending, of draws from a posterior, held against a pose.
std::vector<double> errors_m(const Posterior& posterior, const Transform<World, Vertebra>& answer,
                             std::span<const Point<Vertebra>> targets) {
  // Of the answer from this posterior's mean, at each target, in the model's frame. A drawn pose is
  // off the mean by the opposite of the step of the points.
  std::vector<Vec3> off_m;
  std::vector<Vec3> arm_m;
  const auto moved = posterior.world_from_vertebra.inverse() * answer;
  for (const Point<Vertebra>& target : targets) {
    off_m.push_back(moved * target - target);
    arm_m.push_back(target.v - posterior.centre_m);
  }
  std::vector<double> out;
  out.reserve(kDraws);
  Random random(20261129);
  std::size_t part = 0;
  double through = posterior.parts[0].weight;
  Eigen::LLT<Matrix6> root;
  std::size_t root_of = posterior.parts.size();
  for (std::size_t k = 0; k < kDraws; ++k) {
    while (part + 1 < posterior.parts.size() && (static_cast<double>(k) + 0.5) / kDraws > through) {
      through += posterior.parts[++part].weight;
    }
    const Part& of = posterior.parts[part];
    if (root_of != part) {
      root.compute(Eigen::Map<const Rows6>(of.covariance.data()));
      root_of = part;
    }
    Vector6 normal;
    for (double& n : normal) {
      n = random.normal();
    }
    const Vector6 step = Eigen::Map<const Vector6>(of.step.data()) + root.matrixL() * normal;
    double most_m2 = 0.0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Vec3 error = Vec3{step(0), step(1), step(2)} +
                         Vec3{step(3), step(4), step(5)}.cross(arm_m[i]) + off_m[i];
      most_m2 = std::max(most_m2, error.squared_norm());
    }
    out.push_back(std::sqrt(most_m2));
  }
  std::sort(out.begin(), out.end());
  return out;
}

double share_above(const std::vector<double>& ascending, double limit) {
  const auto above = ascending.end() - std::upper_bound(ascending.begin(), ascending.end(), limit);
  return static_cast<double>(above) / static_cast<double>(ascending.size());
}

/// Where the mirror image lies best: as the bone does, or shifted or turned to a side, since a
/// crooked bone's mirror image lies askew.
Transform<World, Vertebra> mirrored_start(const VertebraModel& model,
                                          const Observations& observations,
                                          const Transform<World, Vertebra>& pose) {
  const auto swapped = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
  // The points are mirrored where they lie on the bone, about its midline, and then fitted to it.
  const Vec3 across{2.0 * model.reachable_axes().centre_m.x, 0.0, 0.0};
  const auto from_world = pose.inverse();
  std::vector<Point<World>> mirrored;
  Vec3 centre_m;
  for (const StrokePoint& p : observations.strokes) {
    mirrored.push_back({swapped((from_world * p.tip).v) + across});
    centre_m += mirrored.back().v / static_cast<double>(observations.strokes.size());
  }
  const FoundPose best = refined_pose(model.search_field(), mirrored, poses_beside(centre_m),
                                      observations.tip_radius_m);
  // Swapped back on both sides, it is a rotation of the points onto the mirrored bone.
  const auto onto_bone = best.world_from_vertebra.inverse();
  Mat3 swap = Mat3::identity();
  swap.m[0][0] = -1.0;
  const Transform<Vertebra, Vertebra> onto_image(
      orthonormalized(swap * onto_bone.rotation() * swap),
      swapped((onto_bone * Point<World>{across}).v));
  return (onto_image * from_world).inverse();
}

}  // namespace

double apart_m(const Transform<World, Vertebra>& a, const Transform<World, Vertebra>& b,
               std::span<const Point<Vertebra>> targets) {
  double most = 0.0;
  for (const Point<Vertebra>& target : targets) {
    most = std::max(most, (a * target - b * target).norm());
  }
  return most;
}

double shaft_collision_fraction(const Observations& observations, const VertebraModel& model,
                                const Transform<World, Vertebra>& world_from_vertebra,
                                bool mirrored) {
  const DistanceField& field = model.search_field().field();
  const auto from_world = world_from_vertebra.inverse();
  // To mirror the points in the model's frame is the same as to mirror the bone.
  const auto seen = [&](Vec3 v) { return mirrored ? Vec3{-v.x, v.y, v.z} : v; };
  const std::vector<StrokePoint>& all = observations.strokes;
  const std::size_t step = std::max<std::size_t>(1, all.size() / kShaftsChecked);
  double looked_at = 0.0;
  double through = 0.0;
  for (std::size_t i = 0; i < all.size(); i += step) {
    if (!(all[i].shaft.squared_norm() > 0.5)) {
      continue;
    }
    looked_at += 1.0;
    if (goes_through(field, seen((from_world * all[i].tip).v),
                     seen(from_world.rotation() * all[i].shaft))) {
      through += 1.0;
    }
  }
  return looked_at > 0.0 ? through / looked_at : 0.0;
}

Result<Decision> decided(const VertebraModel& model, const Observations& observations,
                         const Question& question) {
  const Prior& prior = question.prior;
  const std::vector<Point<World>> tips = tips_of(observations);
  if (const Status s = validate_points(tips, kFewestPoints, model.bone()); !s) {
    return s.error();
  }
  const Error no_pose =
      refused({translatable("registration finds no pose: the strokes fit no part of the model")});
  std::vector<Tried> tried;
  const auto add_poses = [&](Explanation::Kind kind, const std::string& level,
                             const VertebraModel& of, std::size_t most) {
    const auto found = search_poses(of.search_field(), tips, observations.tip_radius_m, most);
    for (std::size_t i = 0; i < found.size(); ++i) {
      // The runner-up is always tried. A later pose that fits far worse in the field, which is
      // right to tenths of a millimetre, is no rival.
      constexpr double kFarWorseCost = 3.0;
      constexpr double kField_m = 0.0005;
      if (i > 1 &&
          found[i].cost_m2 > kFarWorseCost * std::max(found[0].cost_m2, kField_m * kField_m)) {
        break;
      }
      Tried t;
      t.kind = kind;
      t.level = level;
      t.model = &of;
      t.start = found[i].world_from_vertebra;
      tried.push_back(t);
    }
  };
  add_poses(Explanation::Kind::kAnswer, {}, model, 8);
  if (tried.empty()) {
    return no_pose;
  }
  // All under the hand of the first, which is told anew when another pose of the bone, the one that
  // is returned, is better. The end where the first has no posterior.
  Averaged averaged(observations, prior);
  const auto look_at_all = [&](Effort effort, double far_worse) {
    tried[0].look(averaged, effort, true);
    if (!tried[0].found) {
      return tried.end();
    }
    auto best = tried.begin();
    for (auto t = tried.begin() + 1; t != tried.end(); ++t) {
      t->look(averaged, effort, false, tried[0].log_weight() - far_worse);
      if (t->kind == Explanation::Kind::kAnswer && t->log_weight() > best->log_weight()) {
        best = t;
      }
    }
    return best;
  };
  for (int swaps = 0; swaps < 3 && !tried.empty();) {
    const auto best = look_at_all(Effort::kRough, kFarWorse);
    if (best == tried.begin()) {
      break;
    }
    if (best == tried.end()) {
      tried.erase(tried.begin());
    } else {
      std::iter_swap(tried.begin(), best);
      ++swaps;
    }
  }
  if (tried.empty() || !tried[0].found) {
    return no_pose;
  }
  const std::size_t own_poses = tried.size();
  for (const NeighbourLevel& level : question.neighbours) {
    add_poses(Explanation::Kind::kLevel, level.label, *level.model, 2);
  }
  Tried mirror;
  mirror.kind = Explanation::Kind::kMirror;
  mirror.log_odds = std::log(prior.mirror_odds);
  mirror.model = &model;
  mirror.start = mirrored_start(model, observations, tried[0].found->world_from_vertebra);
  tried.push_back(mirror);
  for (std::size_t i = own_poses; i < tried.size(); ++i) {
    tried[i].look(averaged, Effort::kRough, false, tried[0].log_weight() - kFarWorse);
  }
  // Explanations that are far worse are not looked at closely.
  const double own = tried[0].log_weight();
  const double own_evidence = tried[0].log_evidence();
  const auto is_close = [&](const Tried& t) { return t.log_weight() >= own - kFarWorse; };
  // Of those that end at the same pose, one is enough.
  for (auto t = tried.begin() + 1; t != tried.end();) {
    const bool same = t->found && std::any_of(tried.begin(), t, [&](const Tried& other) {
                        return other.kind == t->kind && other.model == t->model && other.found &&
                               apart_m(other.found->world_from_vertebra,
                                       t->found->world_from_vertebra, question.targets) < kSame_m;
                      });
    t = same ? tried.erase(t) : t + 1;
  }
  const auto far = std::stable_partition(tried.begin() + 1, tried.end(), is_close);
  // They take e^-25 of the probability at most: how far off they are is not measured.
  std::vector<Explanation> far_worse;
  for (auto t = far; t != tried.end(); ++t) {
    if (t->found) {
      far_worse.push_back({t->kind, t->level, std::exp(t->log_weight() - own), 1.0,
                           t->log_evidence() - own_evidence, t->found->world_from_vertebra});
    }
  }
  tried.erase(far, tried.end());
  // Rough looks may have ranked two poses wrongly.
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto best = look_at_all(Effort::kFull, kNone);
  if (best != tried.begin() && best != tried.end()) {
    std::iter_swap(tried.begin(), best);
    look_at_all(Effort::kFull, kNone);
  }
  if (!tried[0].found) {
    return no_pose;
  }
  Decision out;
  out.answer = *tried[0].found;
  const Transform<World, Vertebra>& answer = out.answer.world_from_vertebra;
  out.shaft_collision_fraction = tried[0].shaft_collisions;

  // The same bone of another size is an explanation of its own.
  const auto odds = [](double log_odds) { return std::exp(std::min(log_odds, 300.0)); };
  const auto errors = errors_m(out.answer, answer, question.targets);
  // Of all poses of the bone: an error, and its weight.
  std::vector<std::pair<double, double>> own_errors;
  const auto add_errors = [&](const std::vector<double>& all_m, double weight) {
    for (const double error_m : all_m) {
      own_errors.emplace_back(error_m, weight);
    }
  };
  add_errors(errors, 1.0 - prior.size_share);
  out.explanations.push_back({Explanation::Kind::kAnswer,
                              {},
                              1.0 - prior.size_share,
                              share_above(errors, question.most_m),
                              0.0,
                              answer});
  const auto size_below = [&](double size) {
    return normal_cdf(std::log(size / out.answer.size) / std::max(1e-9, out.answer.size_sd));
  };
  out.explanations.push_back({Explanation::Kind::kSize,
                              {},
                              prior.size_share * odds(out.answer.size_log_evidence),
                              1.0 - (size_below(1.0 + kMaxSizeOff) - size_below(1.0 - kMaxSizeOff)),
                              out.answer.size_log_evidence,
                              answer});
  for (std::size_t i = 1; i < tried.size(); ++i) {
    const Tried& t = tried[i];
    if (!t.found) {
      continue;
    }
    const bool other_pose = t.kind == Explanation::Kind::kAnswer;
    if (other_pose && apart_m(t.found->world_from_vertebra, answer, question.targets) < kSame_m) {
      continue;
    }
    const double weight = odds(t.log_weight() - tried[0].log_weight());
    double wrong = 1.0;
    if (other_pose) {
      const auto other_errors = errors_m(*t.found, answer, question.targets);
      wrong = share_above(other_errors, question.most_m);
      add_errors(other_errors, weight);
    }
    out.explanations.push_back({other_pose ? Explanation::Kind::kOtherPose : t.kind, t.level,
                                weight, wrong, t.log_evidence() - tried[0].log_evidence(),
                                t.found->world_from_vertebra});
  }
  for (Explanation& e : far_worse) {
    e.kind = e.kind == Explanation::Kind::kAnswer ? Explanation::Kind::kOtherPose : e.kind;
    out.explanations.push_back(e);
  }
  double sum = 0.0;
  for (const Explanation& e : out.explanations) {
    sum += e.probability;
  }
  out.wrong = 0.0;
  for (Explanation& e : out.explanations) {
    e.probability /= sum;
    out.wrong += e.probability * e.wrong;
  }
  out.inlier_fraction = out.answer.hand.inliers / static_cast<double>(tips.size());
  const RegistrationLimits limits = registration_limits();
  out.accepted =
      out.wrong <= kMayBeWrong && out.shaft_collision_fraction <= limits.shaft_collision_fraction &&
      out.answer.hand.spread_m <= limits.noise_m && out.inlier_fraction >= limits.inlier_fraction;
  double squares_m2 = 0.0;
  for (const double e : errors) {
    squares_m2 += e * e / static_cast<double>(errors.size());
  }
  out.rms_m = std::sqrt(squares_m2);
  std::sort(own_errors.begin(), own_errors.end());
  double all = 0.0;
  for (const auto& [error_m, weight] : own_errors) {
    all += weight;
  }
  double below = 0.0;
  for (const auto& [error_m, weight] : own_errors) {
    out.within_95_m = below <= 0.95 * all ? error_m : out.within_95_m;
    out.within_99_m = below <= 0.99 * all ? error_m : out.within_99_m;
    below += weight;
  }
  return out;
}

}  // namespace orthonav::nav::posterior
