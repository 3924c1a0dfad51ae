#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nav/registration/marginalized_fit.h"

namespace orthonav::nav {

/// Other explanations of the points than the best pose of this model: another pose, another level
/// of the patient, the model's mirror image. They are compared by the truncated cost of the points,
/// in units of log-likelihood for independent points, and close cases by the evidence. Keeps
/// references.
class OtherExplanations {
 public:
  OtherExplanations(const VertebraModel& model, const Cloud& cloud, const MarginalizedFit& best,
                    double width_m, std::span<const Point<Vertebra>> targets,
                    const PoseSearchRegistrationOptions& options, const Registration& r);

  /// Records the best of the other poses; returns its place in `found`. A pose that explains the
  /// points nearly as well is first fitted to all of them; if that leads to the best pose, it does
  /// not count as another one.
  std::size_t compare_poses(std::span<const Candidate> found, Registration& r) const;
  /// The level that explains the points better than this one or nearly as well; kSeveralLevels if
  /// several do so equally; empty if none does.
  [[nodiscard]] std::string better_level() const;
  /// How much better the mirror image explains the points; negative: worse.
  [[nodiscard]] double mirror_log_likelihood() const;

 private:
  struct Rival {
    CentredPose pose;
    double rmse_m = 0.0;
    double log_likelihood_ratio = 0.0;
  };
  /// The evidence for the best fit, from units of the points that lie on the bone in it.
  struct Evidence {
    ResidualUnits units;
    double log_evidence = 0.0;
  };
  [[nodiscard]] const Evidence& evidence() const;
  [[nodiscard]] std::optional<Candidate> best_mirrored_fit(std::span<const Vec3> points_m) const;
  [[nodiscard]] std::optional<Candidate> mirrored_fit(std::span<const Vec3> points_m,
                                                      const CentredPose& start,
                                                      int iterations) const;
  [[nodiscard]] std::optional<Rival> judged(const Candidate& candidate,
                                            const Candidate& first) const;
  /// How much worse another fit of all points, to any model, explains those points that lie on the
  /// bone in the best fit: by the evidence for each, with a field over the bone marginalised in
  /// both.
  [[nodiscard]] double log_likelihood_ratio(const SurfaceFit& other) const;
  [[nodiscard]] bool is_another(const CentredPose& pose) const;

  const VertebraModel& model_;
  const Cloud& cloud_;
  const MarginalizedFit& best_;
  double width_m_;
  std::span<const Point<Vertebra>> targets_;
  const PoseSearchRegistrationOptions& options_;
  Transform<World, Vertebra> world_from_vertebra_;
  double best_cost_m2_;
  double unit_m2_ = 0.0;                      ///< the cost that equals one unit of log-likelihood
  double clamp_m_ = 0.0;                      ///< a residual counts as no more than this
  mutable std::optional<Evidence> evidence_;  ///< computed on first use
  SurfaceFitOptions fine_;
};

}  // namespace orthonav::nav
