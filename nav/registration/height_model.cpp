#include "nav/registration/height_model.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <numbers>

namespace orthonav::nav {
namespace {

using Eigen::Index;
using UnknownsVector = Eigen::Matrix<double, kHeightUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kHeightUnknowns, kHeightUnknowns>;
using UnknownsRows = Eigen::Matrix<double, kHeightUnknowns, kHeightUnknowns, Eigen::RowMajor>;

struct UnknownsAnswer {
  double log_evidence = 0.0;
  UnknownsVector unknowns = UnknownsVector::Zero();
  UnknownsMatrix covariance = UnknownsMatrix::Zero();
};

constexpr Index kStandoff = kStandoffUnknown;
constexpr Index kSize = kSizeUnknown;
/// Before anything was stroked: a mean height of this SD, a size of this SD.
constexpr double kStandoffPrior_m = 0.002;
constexpr double kSizePrior = 0.05;
/// Rotations are compared with translations at this lever arm, the size likewise.
constexpr double kHeightLever_m = 0.03;
/// The least visible motion may be this much less visible than the most visible one.
constexpr double kLeastVisible = 1e-6;

UnknownsVector scales() {
  UnknownsVector s;
  s << 1, 1, 1, 1 / kHeightLever_m, 1 / kHeightLever_m, 1 / kHeightLever_m, 1, 1 / kHeightLever_m;
  return s;
}

/// The standoff is not negative: the rest of the normal distribution is left out (mean and variance
/// of a truncated normal distribution; the others follow by regression on it).
void leave_out_negative(UnknownsAnswer& a) {
  const double sd = std::sqrt(a.covariance(kStandoff, kStandoff));
  const double t = a.unknowns(kStandoff) / sd;
  const double kept = std::max(0.5 * std::erfc(-t / std::numbers::sqrt2), 1e-12);
  const double density = std::exp(-0.5 * t * t) / std::sqrt(2.0 * std::numbers::pi);
  const double ratio = t < -6.0 ? -t : density / kept;
  const double mean = sd * std::max(t + ratio, 0.0);
  const double variance = sd * sd * std::clamp(1.0 - ratio * (ratio + t), 0.02, 1.0);
  const UnknownsVector slope = a.covariance.col(kStandoff) / (sd * sd);
  a.unknowns += slope * (mean - a.unknowns(kStandoff));
  a.covariance -= (sd * sd - variance) * slope * slope.transpose();
  a.log_evidence += std::log(kept);
}

/// The first `count` unknowns alone, the others being zero.
template <int Count>
std::optional<UnknownsAnswer> answer(const UnknownsMatrix& information, const UnknownsVector& right,
                                     double squares, double log_determinant, double log_prior) {
  using Small = Eigen::Matrix<double, Count, Count>;
  const Small small = information.topLeftCorner<Count, Count>();
  const Eigen::LLT<Small> llt(small);
  if (llt.info() != Eigen::Success) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, Count, 1> x = llt.solve(right.head<Count>());
  const double log_small = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  UnknownsAnswer out;
  out.log_evidence =
      -0.5 * (log_determinant + log_small + squares - right.head<Count>().dot(x)) + log_prior;
  out.unknowns.head<Count>() = x;
  out.covariance.topLeftCorner<Count, Count>() = llt.solve(Small::Identity());
  if (!out.unknowns.allFinite() || !std::isfinite(out.log_evidence)) {
    return std::nullopt;
  }
  leave_out_negative(out);
  const UnknownsVector scale = scales();
  out.unknowns = scale.asDiagonal() * out.unknowns;
  out.covariance = (scale.asDiagonal() * out.covariance * scale.asDiagonal()).eval();
  return out;
}

bool determines_pose(const UnknownsMatrix& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
      Eigen::Matrix<double, 6, 6>(information.topLeftCorner<6, 6>()), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] > kLeastVisible * solver.eigenvalues()[5];
}

HeightModel::Answer plain(const UnknownsAnswer& a) {
  HeightModel::Answer out;
  out.log_evidence = a.log_evidence;
  Eigen::Map<UnknownsVector>(out.unknowns.data()) = a.unknowns;
  Eigen::Map<UnknownsRows>(out.covariance.data()) = a.covariance;
  return out;
}

}  // namespace

class HeightModel::Matrices {
 public:
  Matrices(const SurfaceFit& fit, const ResidualUnits& units);
  [[nodiscard]] Eigen::MatrixXd covariance(const FieldHypothesis& field, const StrokeNoise& noise);
  [[nodiscard]] std::optional<Answers> solve(const Eigen::MatrixXd& covariance) const;
  /// `shared`: of the covariance, what is no noise.
  [[nodiscard]] std::vector<double> without_noise(const Eigen::MatrixXd& covariance,
                                                  const Eigen::MatrixXd& shared) const;

 private:
  [[nodiscard]] Eigen::MatrixXd noise_covariance(const StrokeNoise& noise, double stroke_m2) const;
  /// Of a field, between units; that of the last length is kept.
  [[nodiscard]] const Eigen::MatrixXd& field_correlation(const FieldHypothesis& field);
  [[nodiscard]] double own_noise_m2(const ResidualUnit& unit, const StrokeNoise& noise) const;

  const SurfaceFit& fit_;
  const ResidualUnits& units_;
  Eigen::Matrix<double, Eigen::Dynamic, kHeightUnknowns> derivatives_;  ///< scaled
  Eigen::VectorXd heights_m_;
  double last_length_m_ = 0.0;
  Eigen::MatrixXd last_correlation_;
};

HeightModel::Matrices::Matrices(const SurfaceFit& fit, const ResidualUnits& units)
    : fit_(fit), units_(units) {
  const auto m = static_cast<Index>(units.all.size());
  derivatives_.resize(m, kHeightUnknowns);
  heights_m_.resize(m);
  const UnknownsVector scale = scales();
  for (Index a = 0; a < m; ++a) {
    const ResidualUnit& unit = units.all[static_cast<std::size_t>(a)];
    for (Index k = 0; k < derivatives_.cols(); ++k) {
      derivatives_(a, k) = -scale(k) * unit.derivative[static_cast<std::size_t>(k)];
    }
    heights_m_(a) = unit.height_m;
  }
}

Eigen::MatrixXd HeightModel::Matrices::covariance(const FieldHypothesis& field,
                                                  const StrokeNoise& noise) {
  Eigen::MatrixXd out = noise_covariance(noise, field.stroke_sd_m * field.stroke_sd_m);
  const double variance_m2 = field.sd_m * field.sd_m;
  if (variance_m2 > 0.0) {
    out += variance_m2 * field_correlation(field);
  }
  return out;
}

const Eigen::MatrixXd& HeightModel::Matrices::field_correlation(const FieldHypothesis& field) {
  if (field.length_m == last_length_m_) {
    return last_correlation_;
  }
  last_length_m_ = field.length_m;
  const Index m = heights_m_.size();
  last_correlation_.resize(m, m);
  for (Index a = 0; a < m; ++a) {
    for (Index b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (const Vec3& p : units_.all[static_cast<std::size_t>(a)].halves_m) {
        for (const Vec3& q : units_.all[static_cast<std::size_t>(b)].halves_m) {
          sum += field.correlation((p - q).norm());
        }
      }
      last_correlation_(a, b) = last_correlation_(b, a) = 0.25 * sum;
    }
  }
  return last_correlation_;
}

Eigen::MatrixXd HeightModel::Matrices::noise_covariance(const StrokeNoise& noise,
                                                        double stroke_m2) const {
  const Index m = heights_m_.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(m, m);
  for (Index a = 0; a < m; ++a) {
    const ResidualUnit& unit = units_.all[static_cast<std::size_t>(a)];
    out(a, a) = own_noise_m2(unit, noise) + stroke_m2;
    for (Index b = a - 1; b >= 0 && noise.wandering_m2 + stroke_m2 > 0.0; --b) {
      const ResidualUnit& other = units_.all[static_cast<std::size_t>(b)];
      if (other.stroke != unit.stroke) {
        break;
      }
      const double lag = 0.5 * (static_cast<double>(unit.first + unit.end) -
                                static_cast<double>(other.first + other.end));
      out(a, b) = out(b, a) = stroke_m2 + noise.wandering_m2 * std::pow(noise.kept, lag);
    }
  }
  return out;
}

double HeightModel::Matrices::own_noise_m2(const ResidualUnit& unit,
                                           const StrokeNoise& noise) const {
  const auto points = units_.points_of(unit);
  double white = 0.0;
  double wandering = 0.0;
  double before = 0.0;  // sum of what earlier points of the unit still say
  for (const std::uint32_t i : points) {
    const double weight = fit_.points[i].inlier_precision() / unit.weight;
    white += weight * weight;
    wandering += weight * weight + 2.0 * weight * before * noise.kept;
    before = before * noise.kept + weight;
  }
  // Points in no order err alike within a cell.
  return units_.along_strokes ? noise.white_m2 * white + noise.wandering_m2 * wandering
                              : noise.white_m2 + noise.wandering_m2;
}

std::optional<HeightModel::Answers> HeightModel::Matrices::solve(
    const Eigen::MatrixXd& covariance) const {
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  if (llt.info() != Eigen::Success) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, Eigen::Dynamic, kHeightUnknowns> A =
      llt.matrixL().solve(derivatives_);
  const Eigen::VectorXd z = llt.matrixL().solve(heights_m_);
  UnknownsMatrix information = A.transpose() * A;
  if (!information.allFinite() || !determines_pose(information)) {
    return std::nullopt;
  }
  const double size_precision = std::pow(kSizePrior * kHeightLever_m, -2.0);
  information(kStandoff, kStandoff) += 1.0 / (kStandoffPrior_m * kStandoffPrior_m);
  information(kSize, kSize) += size_precision;
  const UnknownsVector right = A.transpose() * z;
  const double log_determinant = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  const auto fixed =
      answer<kSizeUnknown>(information, right, z.squaredNorm(), log_determinant, 0.0);
  const auto free = answer<kHeightUnknowns>(information, right, z.squaredNorm(), log_determinant,
                                            0.5 * std::log(size_precision));
  if (!fixed || !free) {
    return std::nullopt;
  }
  return Answers{plain(*fixed), plain(*free)};
}

std::vector<double> HeightModel::Matrices::without_noise(const Eigen::MatrixXd& covariance,
                                                         const Eigen::MatrixXd& shared) const {
  const auto answers = solve(covariance);
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  if (!answers || llt.info() != Eigen::Success) {
    return {};
  }
  const UnknownsVector scaled =
      Eigen::Map<const UnknownsVector>(answers->fixed_size.unknowns.data()).cwiseQuotient(scales());
  const Eigen::VectorXd rest = heights_m_ - derivatives_ * scaled;
  Eigen::VectorXd mean = shared * llt.solve(rest);
  mean.array() += answers->fixed_size.unknowns[kStandoffUnknown];
  return {mean.data(), mean.data() + mean.size()};
}

HeightModel::HeightModel(const SurfaceFit& fit, const ResidualUnits& units)
    : matrices_(std::make_unique<Matrices>(fit, units)) {}
HeightModel::~HeightModel() = default;

std::optional<HeightModel::Answers> HeightModel::solve(const FieldHypothesis& field,
                                                       const StrokeNoise& noise) {
  return matrices_->solve(matrices_->covariance(field, noise));
}

std::vector<double> HeightModel::heights_without_noise(const FieldHypothesis& field,
                                                       const StrokeNoise& noise) {
  const Eigen::MatrixXd all = matrices_->covariance(field, noise);
  FieldHypothesis none;
  const Eigen::MatrixXd shared = all - matrices_->covariance(none, noise);
  return matrices_->without_noise(all, shared);
}

}  // namespace orthonav::nav
