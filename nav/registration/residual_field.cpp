#include "nav/registration/residual_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "nav/registration/height_model.h"
#include "nav/registration/tissue_prior.h"

namespace orthonav::nav {
namespace {

using UnknownsMean = Eigen::Matrix<double, kHeightUnknowns, 1>;
using UnknownsSpread = Eigen::Matrix<double, kHeightUnknowns, kHeightUnknowns, Eigen::RowMajor>;

Eigen::Map<const UnknownsMean> unknowns_of(const HeightModel::Answer& a) {
  return Eigen::Map<const UnknownsMean>(a.unknowns.data());
}
Eigen::Map<const UnknownsSpread> spread_of(const HeightModel::Answer& a) {
  return Eigen::Map<const UnknownsSpread>(a.covariance.data());
}

constexpr std::size_t kFewestUnits = 12;
constexpr std::array<double, 3> kLengths_m = {0.008, 0.020, 0.050};
constexpr std::array<double, 6> kSds_m = {0.00007, 0.00015, 0.0003, 0.0006, 0.0011, 0.002};
constexpr std::array<double, 5> kStrokeSds_m = {0.00015, 0.0003, 0.0006, 0.0011, 0.002};
/// In a single set of strokes, the correlation time of a hand's wandering varies by chance: if it
/// were assumed known, a slow hand over bare bone would look like tissue.
constexpr std::array<double, 3> kNoiseTimes = {0.6, 1.0, 1.7};
constexpr double kFields = kLengths_m.size() * kSds_m.size();
constexpr double kStrokes = kStrokeSds_m.size();
/// Prior probabilities: the bone is bare and the hand even; there is a field; each stroke has its
/// own height; or both. Hypotheses of the same kind are equally likely.
constexpr double kBareProbability = 0.5;
constexpr double kFieldProbability = 0.25;
constexpr double kStrokesProbability = 0.125;
constexpr double kBothProbability = 0.125;
/// Strokes' heights are tried with this many fields: those that explain most without them.
constexpr std::size_t kFieldsBesideStrokes = 2;
/// A field with more than this many times the variance of the heights is not tried.
constexpr double kMaxVariance = 4.0;
/// Larger SDs are not tried once the evidence has fallen by this from its maximum.
constexpr double kEvidenceLost = 8.0;
constexpr double kLeastProbability = 0.003;
/// Factors on the variance for effects that this model of the heights neglects, measured on strokes
/// over soft tissue (bench_registration --tissue-mm).
constexpr double kUnseen = 1.15;
constexpr double kUnseenWithField = 1.7;

struct Tried {
  FieldHypothesis field;
  HeightModel::Answers answers;
  double log_prior = 0.0;
};

/// The least SD of a field that is tried and no smaller than this; the largest of all else.
double next_sd_m(double sd_m) {
  const auto* next = std::lower_bound(kSds_m.begin(), kSds_m.end(), sd_m);
  return next != kSds_m.end() ? *next : kSds_m.back();
}

/// Tries hypotheses and keeps what each says about the unknowns.
class Trial {
 public:
  Trial(const SurfaceFit& fit, const ResidualUnits& units, double least_sd_m)
      : model_(fit, units),
        seen_(along_strokes(fit, units)),
        with_strokes_(units.along_strokes),
        least_sd_m_(least_sd_m) {}

  [[nodiscard]] bool has_noise() const { return !seen_.covariance_m2.empty(); }

  /// Variance of the heights of single points.
  [[nodiscard]] double variance_m2() const { return seen_.covariance_m2[0]; }

  std::vector<Tried> all() {
    for (const double noise_time : kNoiseTimes) {
      FieldHypothesis bare;
      bare.noise_time = noise_time;
      consider(bare);
    }
    for (const double length_m : kLengths_m) {
      FieldHypothesis field;
      field.length_m = length_m;
      consider_growing(kSds_m, field, &FieldHypothesis::sd_m);
    }
    if (with_strokes_) {
      const std::vector<FieldHypothesis> fields = likeliest_fields();
      consider_growing(kStrokeSds_m, {}, &FieldHypothesis::stroke_sd_m);
      for (const FieldHypothesis& field : fields) {
        consider_growing(kStrokeSds_m, field, &FieldHypothesis::stroke_sd_m);
      }
    }
    return std::move(tried_);
  }

  std::vector<Tried> of(std::span<const FieldHypothesis> among) {
    for (const FieldHypothesis& field : among) {
      consider(field);
    }
    return std::move(tried_);
  }

 private:
  /// Tries growing SDs until they are far too large.
  void consider_growing(std::span<const double> sds_m, FieldHypothesis field,
                        double FieldHypothesis::*sd) {
    double most = -std::numeric_limits<double>::infinity();
    for (const double sd_m : sds_m) {
      if (sd_m * sd_m > kMaxVariance * variance_m2() && sd_m > least_sd_m_) {
        return;
      }
      field.*sd = sd_m;
      const double evidence = consider(field);
      most = std::max(most, evidence);
      if (evidence < most - kEvidenceLost) {
        return;
      }
    }
  }

  double consider(const FieldHypothesis& field) {
    if (field.sd_m < least_sd_m_) {
      return -std::numeric_limits<double>::infinity();
    }
    const auto answers = model_.solve(field, noise_beside_field(seen_, field));
    if (!answers) {
      return -std::numeric_limits<double>::infinity();
    }
    const double standoff_m = answers->fixed_size.unknowns[kStandoffUnknown];
    const double evenness = log_prior_of_evenness(field, standoff_m);
    tried_.push_back({field, *answers, log_prior(field) + evenness});
    return answers->fixed_size.log_evidence;
  }

  static double log_prior(const FieldHypothesis& field) {
    const bool strokes = field.stroke_sd_m > 0.0;
    if (field.sd_m > 0.0) {
      return std::log(strokes ? kBothProbability / (kFields * kStrokes)
                              : kFieldProbability / kFields);
    }
    return std::log(strokes ? kStrokesProbability / kStrokes
                            : kBareProbability / kNoiseTimes.size());
  }

  [[nodiscard]] std::vector<FieldHypothesis> likeliest_fields() const {
    std::vector<const Tried*> fields;
    for (const Tried& t : tried_) {
      if (t.field.sd_m > 0.0) {
        fields.push_back(&t);
      }
    }
    std::stable_sort(fields.begin(), fields.end(), [](const Tried* a, const Tried* b) {
      return a->answers.fixed_size.log_evidence > b->answers.fixed_size.log_evidence;
    });
    std::vector<FieldHypothesis> out;
    for (std::size_t i = 0; i < std::min(kFieldsBesideStrokes, fields.size()); ++i) {
      out.push_back(fields[i]->field);
    }
    return out;
  }

  HeightModel model_;
  AlongStrokes seen_;
  bool with_strokes_;
  double least_sd_m_;
  std::vector<Tried> tried_;
};

/// The logarithm of the summed evidence; `of` gives one hypothesis's own.
template <class Of>
double sum_evidence(const std::vector<Tried>& tried, const Of& of) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Tried& t : tried) {
    most = std::max(most, t.log_prior + of(t));
  }
  double sum = 0.0;
  for (const Tried& t : tried) {
    sum += std::exp(t.log_prior + of(t) - most);
  }
  return most + std::log(sum);
}

void find_size(const std::vector<Tried>& tried, double log_evidence, ResidualField& out) {
  const auto evidence = [](const Tried& t) { return t.answers.free_size.log_evidence; };
  const double free = sum_evidence(tried, evidence);
  out.size_log_evidence = free - log_evidence;
  double mean = 0.0;
  double square = 0.0;
  for (const Tried& t : tried) {
    const double probability = std::exp(t.log_prior + evidence(t) - free);
    const HeightModel::Answer& a = t.answers.free_size;
    mean += probability * a.unknowns[kSizeUnknown];
    square += probability * (a.covariance[kHeightUnknowns * kSizeUnknown + kSizeUnknown] +
                             a.unknowns[kSizeUnknown] * a.unknowns[kSizeUnknown]);
  }
  out.size = std::exp(mean);
  out.size_sd = std::sqrt(std::max(0.0, square - mean * mean));
}

/// The number of points, reduced by how much more the pose varies than if all were independent.
double effective_points(const ResidualUnits& units, double variance_m2,
                        const UnknownsSpread& covariance) {
  using Pose = Eigen::Matrix<double, 6, 6>;
  using Free = Eigen::Matrix<double, 7, 7>;
  Free all = Free::Zero();
  double points = 0.0;
  for (const ResidualUnit& unit : units.all) {
    const Eigen::Map<const Eigen::Matrix<double, 7, 1>> j(unit.derivative.data());
    all += unit.weight / variance_m2 * j * j.transpose();
    points += unit.weight;
  }
  // Information about the pose, with the standoff unknown.
  const Pose information = all.topLeftCorner<6, 6>() -
                           all.topRightCorner<6, 1>() * all.bottomLeftCorner<1, 6>() / all(6, 6);
  const double repeated = (covariance.topLeftCorner<6, 6>() * information).trace() / 6.0;
  return points / std::max(1.0, repeated);
}

double fixed_evidence(const Tried& t) { return t.answers.fixed_size.log_evidence; }

/// The hypotheses by their probability; returns the mean of the unknowns over them.
UnknownsMean average(const std::vector<Tried>& tried, ResidualField& out) {
  UnknownsMean mean = UnknownsMean::Zero();
  double field_m2 = 0.0;
  for (const Tried& t : tried) {
    FieldHypothesis field = t.field;
    field.probability = std::exp(t.log_prior + fixed_evidence(t) - out.log_evidence);
    mean += field.probability * unknowns_of(t.answers.fixed_size);
    field_m2 +=
        field.probability * (field.sd_m * field.sd_m + field.stroke_sd_m * field.stroke_sd_m);
    if (field.probability > out.likeliest.probability) {
      out.likeliest = field;
    }
    if (field.probability > kLeastProbability) {
      out.hypotheses.push_back(field);
    }
  }
  out.field_sd_m = std::sqrt(field_m2);
  return mean;
}

/// The covariance within each hypothesis, and between them.
UnknownsSpread total_covariance(const std::vector<Tried>& tried, const UnknownsMean& mean,
                                double log_evidence) {
  UnknownsSpread covariance = UnknownsSpread::Zero();
  for (const Tried& t : tried) {
    const double probability = std::exp(t.log_prior + fixed_evidence(t) - log_evidence);
    const UnknownsMean off = unknowns_of(t.answers.fixed_size) - mean;
    const bool bare = t.field.sd_m == 0.0 && t.field.stroke_sd_m == 0.0;
    covariance +=
        probability * ((bare ? kUnseen : kUnseenWithField) * spread_of(t.answers.fixed_size) +
                       off * off.transpose());
  }
  return covariance;
}

}  // namespace

std::optional<ResidualField> residual_field(const SurfaceFit& fit, const ResidualUnits& units,
                                            std::span<const FieldHypothesis> among,
                                            double least_sd_m) {
  if (units.all.size() < kFewestUnits) {
    return std::nullopt;
  }
  Trial trial(fit, units, least_sd_m > 0.0 ? next_sd_m(least_sd_m) : 0.0);
  if (!trial.has_noise()) {
    return std::nullopt;
  }
  const std::vector<Tried> tried = among.empty() ? trial.all() : trial.of(among);
  if (tried.empty()) {
    return std::nullopt;
  }
  ResidualField out;
  out.log_evidence = sum_evidence(tried, fixed_evidence);
  const UnknownsMean mean = average(tried, out);
  const UnknownsSpread covariance = total_covariance(tried, mean, out.log_evidence);
  out.standoff_m = mean(kStandoffUnknown);
  out.standoff_sd_m = std::sqrt(covariance(kStandoffUnknown, kStandoffUnknown));
  for (Eigen::Index k = 0; k < 6; ++k) {
    out.step[static_cast<std::size_t>(k)] = mean(k);
    for (Eigen::Index l = 0; l < 6; ++l) {
      out.covariance[static_cast<std::size_t>(6 * k + l)] = covariance(k, l);
    }
  }
  out.effective_points = effective_points(units, trial.variance_m2(), covariance);
  find_size(tried, out.log_evidence, out);
  return out;
}

}  // namespace orthonav::nav
