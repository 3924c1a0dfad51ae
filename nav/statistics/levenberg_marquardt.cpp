#include "nav/statistics/levenberg_marquardt.h"

#include <cmath>
#include <Eigen/Dense>
#include <numeric>

namespace orthonav::nav {
namespace {

constexpr double kDifference = 1e-6;
constexpr double kFirstDamping = 1e-3;
constexpr double kMaxDamping = 1e10;
/// Steps that gain less than this fraction of the sum count as rounding.
constexpr double kLeastGain = 1e-10;
/// Added to the normal matrix's diagonal, so that undetermined parameters have a finite step.
constexpr double kLeastCurvature = 1e-6;

double squares_of(const std::vector<double>& residuals) {
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};

NormalEquations normal_equations(std::vector<double> at, const std::vector<double>& residuals,
                                 const ResidualsOf& of) {
  const auto rows = static_cast<Eigen::Index>(residuals.size());
  const auto columns = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd jacobian(rows, columns);
  std::vector<double> above;
  std::vector<double> below;
  for (Eigen::Index c = 0; c < columns; ++c) {
    double& parameter = at[static_cast<std::size_t>(c)];
    const double middle = parameter;
    parameter = middle + kDifference;
    of(at, above);
    parameter = middle - kDifference;
    of(at, below);
    parameter = middle;
    for (Eigen::Index r = 0; r < rows; ++r) {
      const auto i = static_cast<std::size_t>(r);
      jacobian(r, c) = (above[i] - below[i]) / (2.0 * kDifference);
    }
  }
  NormalEquations equations;
  equations.matrix = jacobian.transpose() * jacobian;
  equations.gradient =
      jacobian.transpose() * Eigen::Map<const Eigen::VectorXd>(residuals.data(), rows);
  return equations;
}

/// Increases the damping until a step improves the sum. False if none does: this is the minimum.
bool step_down(const NormalEquations& equations, const ResidualsOf& of, double& damping,
               LeastSquares& fit) {
  const auto count = static_cast<Eigen::Index>(fit.parameters.size());
  std::vector<double> tried(fit.parameters.size());
  std::vector<double> residuals;
  for (; damping < kMaxDamping; damping *= 10.0) {
    Eigen::MatrixXd damped = equations.matrix;
    damped.diagonal() += damping * equations.matrix.diagonal();
    damped.diagonal().array() += kLeastCurvature;
    const Eigen::VectorXd step = damped.ldlt().solve(equations.gradient);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      tried[k] = fit.parameters[k] - step(i);
    }
    of(tried, residuals);
    const double squares = squares_of(residuals);
    if (std::isfinite(squares) && squares < fit.sum_of_squares) {
      const bool goes_on = fit.sum_of_squares - squares > kLeastGain * fit.sum_of_squares;
      fit.parameters = tried;
      fit.residuals = residuals;
      fit.sum_of_squares = squares;
      damping = std::max(1e-9, 0.1 * damping);
      return goes_on;
    }
  }
  return false;
}

}  // namespace

Result<LeastSquares> levenberg_marquardt(std::span<const double> start, const ResidualsOf& of,
                                         int most_iterations) {
  LeastSquares fit;
  fit.parameters.assign(start.begin(), start.end());
  of(fit.parameters, fit.residuals);
  fit.sum_of_squares = squares_of(fit.residuals);
  if (!std::isfinite(fit.sum_of_squares)) {
    return Error{"initial residuals are not finite"};
  }
  double damping = kFirstDamping;
  NormalEquations equations = normal_equations(fit.parameters, fit.residuals, of);
  for (int i = 0; i < most_iterations && step_down(equations, of, damping, fit); ++i) {
    equations = normal_equations(fit.parameters, fit.residuals, of);
  }
  Eigen::MatrixXd matrix = equations.matrix;
  matrix.diagonal().array() += kLeastCurvature;
  const Eigen::MatrixXd inverse =
      matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
  fit.covariance.assign(inverse.data(), inverse.data() + inverse.size());
  return fit;
}

}  // namespace orthonav::nav
