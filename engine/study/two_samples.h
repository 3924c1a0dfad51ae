#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orthonav::engine {

/// A mean with its standard error and the degrees of freedom of that.
struct KnownMean {
  double mean = 0.0;
  double standard_error = 0.0;
  double freedom = 0.0;
};

/// Probability of a difference at least as large if both means were the same: two-sided, Welch's t
/// with the degrees of freedom of Welch and Satterthwaite. 1 if neither has an error.
[[nodiscard]] double welch_p(const KnownMean& a, const KnownMean& b);

/// Two-sided probability of Student's t beyond `t`: by the regularized incomplete beta function
/// (DLMF 8.17.22, continued fraction). `freedom` > 0.
[[nodiscard]] double student_p(double t, double freedom);

/// Two one-sided t tests (Schuirmann 1987): the probability of paired differences at least as near
/// to zero if their true mean were off by `margin` or more. Below 0.05 both are equivalent within
/// the margin. 1 for fewer than three.
[[nodiscard]] double equivalence_p(std::span<const double> differences, double margin);

/// Twice the probability that the SD of `n` values lies at least as far to one side as `sd`, if
/// they are drawn from `groups` group by group, like the screws of operations. No distribution is
/// assumed: errors are far from normal, so an F test would reject too often. Groups are drawn with
/// replacement, the last one in part.
[[nodiscard]] double resampled_sd_p(std::span<const std::vector<double>> groups, std::size_t n,
                                    double sd, std::uint64_t seed = 1);

}  // namespace orthonav::engine
