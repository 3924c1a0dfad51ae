#include "nav/registration/height_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Core>

#include "nav/registration/height_answers.h"
#include "nav/statistics/whitened_system.h"

namespace orthonav::nav {

using Eigen::Index;

namespace {

/// The field's mean correlation between two units: between their halves or, where the units are far
/// apart compared with their lengths, between their middles.
double mean_correlation(const FieldHypothesis& field, const ResidualUnit& a,
                        const ResidualUnit& b) {
  constexpr double kFar = 4.0;
  const Vec3 along_a = a.halves_m[1] - a.halves_m[0];
  const Vec3 along_b = b.halves_m[1] - b.halves_m[0];
  const Vec3 apart = 0.5 * (a.halves_m[0] + a.halves_m[1] - b.halves_m[0] - b.halves_m[1]);
  if (apart.squared_norm() >
      kFar * kFar * std::max(along_a.squared_norm(), along_b.squared_norm())) {
    return field.correlation(apart.norm());
  }
  double sum = 0.0;
  for (const Vec3& p : a.halves_m) {
    for (const Vec3& q : b.halves_m) {
      sum += field.correlation((p - q).norm());
    }
  }
  return 0.25 * sum;
}

}  // namespace

class HeightModel::Matrices {
 public:
  Matrices(const SurfaceFit& fit, const ResidualUnits& units);
  [[nodiscard]] std::optional<Answers> solve(const FieldHypothesis& field,
                                             const StrokeNoise& noise);
  [[nodiscard]] std::vector<double> without_noise(const FieldHypothesis& field,
                                                  const StrokeNoise& noise);

 private:
  /// The covariance of the units from `first` to before `end`, with room for right-hand sides.
  void fill(std::size_t first, std::size_t end, const FieldHypothesis& field,
            const StrokeNoise& noise, std::size_t right_sides);
  /// Whitens these units and adds them to the sums. False where their covariance is not positive
  /// definite.
  [[nodiscard]] bool add_block(std::size_t first, std::size_t end, const FieldHypothesis& field,
                               const StrokeNoise& noise, WhitenedSums& sums);
  /// The covariance of two units of one stroke: its own height, and the wandering noise.
  [[nodiscard]] double along_stroke_m2(std::size_t a, std::size_t b, const FieldHypothesis& field,
                                       const StrokeNoise& noise) const;
  /// The field's correlation between units (lower triangle); that of the last length is kept.
  [[nodiscard]] const Eigen::MatrixXd& field_correlation(const FieldHypothesis& field);
  [[nodiscard]] double own_noise_m2(const ResidualUnit& unit, const StrokeNoise& noise) const;
  /// One past the last unit of the stroke to which `first` belongs.
  [[nodiscard]] std::size_t end_of_stroke(std::size_t first) const;

  const SurfaceFit& fit_;
  const ResidualUnits& units_;
  /// Scaled; one column per unit.
  Eigen::Matrix<double, kHeightUnknowns, Eigen::Dynamic> derivatives_;
  Eigen::VectorXd heights_m_;
  double last_length_m_ = 0.0;
  Eigen::MatrixXd last_correlation_;
  WhitenedSystem system_;
};

HeightModel::Matrices::Matrices(const SurfaceFit& fit, const ResidualUnits& units)
    : fit_(fit), units_(units) {
  const auto m = static_cast<Index>(units.all.size());
  derivatives_.resize(kHeightUnknowns, m);
  heights_m_.resize(m);
  const auto scale = unknowns_scale();
  for (Index a = 0; a < m; ++a) {
    const ResidualUnit& unit = units.all[static_cast<std::size_t>(a)];
    for (Index k = 0; k < derivatives_.rows(); ++k) {
      derivatives_(k, a) =
          -scale[static_cast<std::size_t>(k)] * unit.derivative[static_cast<std::size_t>(k)];
    }
    heights_m_(a) = unit.height_m;
  }
}

const Eigen::MatrixXd& HeightModel::Matrices::field_correlation(const FieldHypothesis& field) {
  if (field.length_m == last_length_m_) {
    return last_correlation_;
  }
  last_length_m_ = field.length_m;
  const Index m = heights_m_.size();
  last_correlation_.resize(m, m);
  for (Index b = 0; b < m; ++b) {
    const ResidualUnit& unit = units_.all[static_cast<std::size_t>(b)];
    for (Index a = b; a < m; ++a) {
      last_correlation_(a, b) =
          mean_correlation(field, unit, units_.all[static_cast<std::size_t>(a)]);
    }
  }
  return last_correlation_;
}

double HeightModel::Matrices::along_stroke_m2(std::size_t a, std::size_t b,
                                              const FieldHypothesis& field,
                                              const StrokeNoise& noise) const {
  const ResidualUnit& unit = units_.all[a];
  const double stroke_m2 = field.stroke_sd_m * field.stroke_sd_m;
  if (a == b) {
    return own_noise_m2(unit, noise) + stroke_m2;
  }
  if (noise.wandering_m2 == 0.0) {
    return stroke_m2;
  }
  const ResidualUnit& other = units_.all[b];
  const double lag = 0.5 * std::abs(static_cast<double>(unit.first + unit.end) -
                                    static_cast<double>(other.first + other.end));
  return stroke_m2 + noise.wandering_m2 * std::pow(noise.kept, lag);
}

std::size_t HeightModel::Matrices::end_of_stroke(std::size_t first) const {
  std::size_t end = first + 1;
  while (end < units_.all.size() && units_.all[end].stroke == units_.all[first].stroke) {
    ++end;
  }
  return end;
}

double HeightModel::Matrices::own_noise_m2(const ResidualUnit& unit,
                                           const StrokeNoise& noise) const {
  const auto points = units_.points_of(unit);
  double white = 0.0;
  double wandering = 0.0;
  double before = 0.0;  // decayed sum over earlier points of the unit
  for (const std::uint32_t i : points) {
    const double weight = fit_.points[i].inlier_precision() / unit.weight;
    white += weight * weight;
    wandering += weight * weight + 2.0 * weight * before * noise.kept;
    before = before * noise.kept + weight;
  }
  // For unordered points, errors within a cell are fully correlated.
  return units_.along_strokes ? noise.white_m2 * white + noise.wandering_m2 * wandering
                              : noise.white_m2 + noise.wandering_m2;
}

void HeightModel::Matrices::fill(std::size_t first, std::size_t end, const FieldHypothesis& field,
                                 const StrokeNoise& noise, std::size_t right_sides) {
  system_.reset(end - first, right_sides);
  for (std::size_t b = first; b < end; ++b) {
    double* const column = system_.column_of(b - first);
    const std::size_t stroke_end = end_of_stroke(b);
    for (std::size_t a = b; a < stroke_end; ++a) {
      column[a - first] = along_stroke_m2(a, b, field, noise);
    }
  }
  if (!(field.sd_m > 0.0)) {
    return;
  }
  const Eigen::MatrixXd& correlation = field_correlation(field);
  for (std::size_t b = first; b < end; ++b) {
    const double* const of_field = correlation.col(static_cast<Index>(b)).data();
    double* const column = system_.column_of(b - first);
    for (std::size_t a = b; a < end; ++a) {
      column[a - first] += field.sd_m * field.sd_m * of_field[a];
    }
  }
}

bool HeightModel::Matrices::add_block(std::size_t first, std::size_t end,
                                      const FieldHypothesis& field, const StrokeNoise& noise,
                                      WhitenedSums& sums) {
  fill(first, end, field, noise, kHeightUnknowns + 1);
  for (std::size_t b = first; b < end; ++b) {
    const auto column = static_cast<Index>(b);
    for (std::size_t k = 0; k < kHeightUnknowns; ++k) {
      system_.right_side(b - first, k) = derivatives_(static_cast<Index>(k), column);
    }
    system_.right_side(b - first, kHeightUnknowns) = heights_m_(column);
  }
  if (!system_.whiten()) {
    return false;
  }
  sums.add(system_);
  return true;
}

std::optional<HeightModel::Answers> HeightModel::Matrices::solve(const FieldHypothesis& field,
                                                                 const StrokeNoise& noise) {
  WhitenedSums sums;
  const std::size_t count = units_.all.size();
  for (std::size_t first = 0; first < count;) {
    // Without a field, strokes are uncorrelated.
    const std::size_t end = field.sd_m > 0.0 ? count : end_of_stroke(first);
    if (!add_block(first, end, field, noise, sums)) {
      return std::nullopt;
    }
    first = end;
  }
  return answers_of(sums);
}

std::vector<double> HeightModel::Matrices::without_noise(const FieldHypothesis& field,
                                                         const StrokeNoise& noise) {
  const auto answers = solve(field, noise);
  if (!answers) {
    return {};
  }
  // shared · covariance⁻¹ · rest, both sides whitened.
  const std::size_t m = units_.all.size();
  const FieldHypothesis none;
  fill(0, m, field, noise, m + 1);
  std::array<double, kHeightUnknowns> scaled = answers->fixed_size.unknowns;
  for (std::size_t k = 0; k < kHeightUnknowns; ++k) {
    scaled[k] /= unknowns_scale()[k];
  }
  const Eigen::Map<const Eigen::Matrix<double, kHeightUnknowns, 1>> step(scaled.data());
  for (std::size_t b = 0; b < m; ++b) {
    for (std::size_t a = b; a < m; ++a) {
      const bool beside = units_.all[a].stroke == units_.all[b].stroke;
      const double shared_m2 =
          system_.covariance(a, b) - (beside ? along_stroke_m2(a, b, none, noise) : 0.0);
      system_.right_side(a, b) = system_.right_side(b, a) = shared_m2;
    }
    const auto column = static_cast<Index>(b);
    system_.right_side(b, m) = heights_m_(column) - derivatives_.col(column).dot(step);
  }
  if (!system_.whiten()) {
    return {};
  }
  std::vector<double> mean(m, answers->fixed_size.unknowns[kStandoffUnknown]);
  for (std::size_t k = 0; k < m; ++k) {
    const double* const row = system_.right_sides(k);
    for (std::size_t a = 0; a < m; ++a) {
      mean[a] += row[a] * row[m];
    }
  }
  return mean;
}

HeightModel::HeightModel(const SurfaceFit& fit, const ResidualUnits& units)
    : matrices_(std::make_unique<Matrices>(fit, units)) {}
HeightModel::~HeightModel() = default;

std::optional<HeightModel::Answers> HeightModel::solve(const FieldHypothesis& field,
                                                       const StrokeNoise& noise) {
  return matrices_->solve(field, noise);
}

std::vector<double> HeightModel::heights_without_noise(const FieldHypothesis& field,
                                                       const StrokeNoise& noise) {
  return matrices_->without_noise(field, noise);
}

}  // namespace orthonav::nav
