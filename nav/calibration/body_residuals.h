#pragma once

#include <optional>
#include <vector>

#include "nav/calibration/body_adjustment.h"
#include "nav/calibration/corner_residual.h"

namespace orthonav::nav {

/// Which poses are to be found besides those of the body, numbered from 0: the right camera, then
/// the tags; -1 for a known pose.
struct BodyUnknowns {
  int camera = -1;
  std::vector<int> tags;
  int count = 0;

  explicit BodyUnknowns(const BodyProblem& problem);
};

/// A corner's residual, and the unknowns it depends on besides the body's pose.
struct BodyResidual {
  CornerResidual corner;
  int tag = -1;
  int camera = -1;
};

/// The residuals of the corners in one pair, tag by tag, left image before right; empty for a
/// corner that does not project.
[[nodiscard]] std::vector<std::optional<BodyResidual>> residuals_of_pair(
    const BodyProblem& problem, const BodyUnknowns& unknowns, const BodyState& at, std::size_t pair,
    bool derivatives);

/// The residual lengths of all corners, pair by pair; empty if any corner does not project.
[[nodiscard]] std::optional<std::vector<double>> residual_lengths_px(const BodyProblem& problem,
                                                                     const BodyUnknowns& unknowns,
                                                                     const BodyState& at);

}  // namespace orthonav::nav
