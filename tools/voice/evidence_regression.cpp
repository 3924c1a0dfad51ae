#include "tools/voice/evidence_regression.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>
#include <functional>
#include <numeric>

namespace orthonav::bench {

using namespace orthonav::voice;

std::vector<double> inputs_of(const CommandEvidence& evidence,
                              const std::vector<std::string>& commands) {
  std::vector<double> inputs;
  for (const std::string& command : commands) {
    inputs.push_back(evidence.command == command ? 1.0 : 0.0);
  }
  const EvidenceFeatures features = features_of(evidence);
  inputs.insert(inputs.end(), features.begin(), features.end());
  return inputs;
}

Weights fit(const std::vector<Row>& rows, std::size_t constant) {
  constexpr double kPrior = 0.5;
  const auto at = static_cast<Eigen::Index>(constant);
  const auto count = static_cast<Eigen::Index>(constant + kEvidenceFeatures);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  for (int step = 0; step < 50; ++step) {
    Eigen::VectorXd gradient = kPrior * weights;
    Eigen::MatrixXd hessian = kPrior * Eigen::MatrixXd::Identity(count, count);
    gradient[at] = 0.0;
    hessian(at, at) = 1e-9;
    for (const Row& row : rows) {
      const Eigen::Map<const Eigen::VectorXd> x(row.inputs.data(), count);
      const double p = 1.0 / (1.0 + std::exp(-weights.dot(x)));
      gradient += row.weight * (p - (row.command ? 1.0 : 0.0)) * x;
      hessian += row.weight * p * (1.0 - p) * x * x.transpose();
    }
    const Eigen::VectorXd change = hessian.ldlt().solve(gradient);
    weights -= change;
    if (change.norm() < 1e-9) {
      break;
    }
  }
  return {weights.begin(), weights.end()};
}

void draw_line(const std::vector<Row>& rows, std::size_t allowed, std::size_t constant,
               Weights& weights) {
  std::vector<double> odds;
  std::vector<double> others;
  for (const Row& row : rows) {
    odds.push_back(std::inner_product(weights.begin(), weights.end(), row.inputs.begin(), 0.0));
    if (!row.command && row.weight == 1.0) {
      others.push_back(odds.back());
    }
  }
  std::sort(others.begin(), others.end(), std::greater<>());
  const double line = others.size() > allowed ? std::max(others[allowed], 0.0) : 0.0;
  int heard = 0, near_sayings = 0, near_passed = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool passes = odds[i] > line;
    heard += rows[i].command && passes ? 1 : 0;
    near_sayings += rows[i].weight == 1.0 ? 0 : 1;
    near_passed += rows[i].weight != 1.0 && passes ? 1 : 0;
  }
  weights[constant] -= line;
  std::printf("  line at %.2f: %zu other sayings pass, %d of %d near ones, %d commands\n", line,
              allowed, near_passed, near_sayings, heard);
}

}  // namespace orthonav::bench
