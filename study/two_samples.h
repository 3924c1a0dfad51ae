#pragma once

#include <span>

namespace orthonav::engine {

/// Two-sided probability of Student's t beyond `t`: by the regularized incomplete beta function
/// (DLMF 8.17.22, continued fraction). `freedom` > 0.
[[nodiscard]] double student_p(double t, double freedom);

/// Two one-sided t tests (Schuirmann 1987): the probability of paired differences at least as near
/// to zero if their true mean were off by `margin` or more. Below 0.05 both are equivalent within
/// the margin. 1 for fewer than three.
[[nodiscard]] double equivalence_p(std::span<const double> differences, double margin);

}  // namespace orthonav::engine
