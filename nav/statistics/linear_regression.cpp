#include "nav/statistics/linear_regression.h"

#include <cmath>

#include "nav/statistics/whitened_system.h"

namespace orthonav::nav {
namespace {

/// k × k, row after row.
using SquareMatrix = std::vector<double>;

/// Σ wᵢ·xᵢ·xᵢᵀ over the rows of `x`, whose weights are w.
SquareMatrix weighted_normal(std::span<const double> x, std::span<const double> w) {
  const std::size_t k = x.size() / w.size();
  SquareMatrix out(k * k);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const auto row = x.subspan(i * k, k);
    for (std::size_t r = 0; r < k; ++r) {
      for (std::size_t c = 0; c < k; ++c) {
        out[r * k + c] += w[i] * row[r] * row[c];
      }
    }
  }
  return out;
}

/// Of a symmetric positive definite matrix; empty if it is not.
SquareMatrix inverse(const SquareMatrix& matrix, std::size_t k) {
  WhitenedSystem system;
  system.reset(k, k);
  for (std::size_t r = 0; r < k; ++r) {
    system.right_side(r, r) = 1.0;
    for (std::size_t c = 0; c <= r; ++c) {
      system.covariance(r, c) = matrix[r * k + c];
    }
  }
  if (!system.whiten()) {
    return {};
  }
  SquareMatrix out(k * k);
  for (std::size_t i = 0; i < k; ++i) {
    const double* whitened = system.right_sides(i);
    for (std::size_t r = 0; r < k; ++r) {
      for (std::size_t c = 0; c < k; ++c) {
        out[r * k + c] += whitened[r] * whitened[c];
      }
    }
  }
  return out;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

std::vector<double> times(const SquareMatrix& matrix, std::span<const double> v) {
  std::vector<double> out;
  for (std::size_t r = 0; r < v.size(); ++r) {
    out.push_back(dot(std::span(matrix).subspan(r * v.size(), v.size()), v));
  }
  return out;
}

}  // namespace

LinearRegression linear_regression(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = y.size();
  const std::size_t k = n > 0 ? x.size() / n : 0;
  if (k == 0 || n <= k) {
    return {};
  }
  const SquareMatrix inverted = inverse(weighted_normal(x, std::vector<double>(n, 1.0)), k);
  if (inverted.empty()) {
    return {};
  }
  std::vector<double> xy(k);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < k; ++c) {
      xy[c] += x[i * k + c] * y[i];
    }
  }
  LinearRegression out;
  out.slopes = times(inverted, xy);
  std::vector<double> squared(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double residual = y[i] - dot(x.subspan(i * k, k), out.slopes);
    squared[i] = residual * residual;
  }
  const SquareMatrix scatter = weighted_normal(x, squared);
  const double small = static_cast<double>(n) / static_cast<double>(n - k);
  for (std::size_t c = 0; c < k; ++c) {
    const auto row = std::span(inverted).subspan(c * k, k);
    out.standard_errors.push_back(std::sqrt(small * dot(row, times(scatter, row))));
  }
  return out;
}

}  // namespace orthonav::nav
