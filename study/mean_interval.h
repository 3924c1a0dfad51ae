#pragma once

#include <cstddef>
#include <span>

namespace orthonav::engine {

/// A mean and its 95 % interval by Student's t.
struct MeanInterval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// For independent values. Without an interval (both NaN) for fewer than three.
[[nodiscard]] MeanInterval mean_interval(std::span<const double> values);

/// The same for a mean of `count` values, or groups of values, with a known standard error.
[[nodiscard]] MeanInterval mean_interval(double mean, double standard_error, std::size_t count);

/// The 97.5 % quantile of Student's t: exact for two degrees of freedom, from the normal one
/// (Abramowitz & Stegun 26.7.5) for three and more, to 0.03.
[[nodiscard]] double student_t_975(double freedom);

}  // namespace orthonav::engine
