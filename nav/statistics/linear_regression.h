#pragma once

#include <span>
#include <vector>

namespace orthonav::nav {

/// What a linear regression finds for each column.
struct LinearRegression {
  std::vector<double> slopes;
  /// Consistent where the scatter differs from row to row: White (1980), with n / (n - k) as in
  /// MacKinnon & White (1985), HC1.
  std::vector<double> standard_errors;
};

/// Least squares of `y`, n values, over `x`: n rows of k columns, row after row. An intercept needs
/// a column of ones. Nothing found (no slopes) unless n > k and the columns are independent.
[[nodiscard]] LinearRegression linear_regression(std::span<const double> x,
                                                 std::span<const double> y);

}  // namespace orthonav::nav
