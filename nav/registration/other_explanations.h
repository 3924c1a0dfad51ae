#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nav/registration/certain_fit.h"

namespace orthonav::nav {

/// What else than the best pose of this model could explain the points: another pose, another level
/// of the patient, the model's mirror image. Compared by the truncated cost of the points, in units
/// by which independent ones tell; where that comes near, by the evidence. Keeps references.
class OtherExplanations {
 public:
  OtherExplanations(const VertebraModel& model, const Cloud& cloud, const CertainFit& best,
                    double width_m, std::span<const Point<Vertebra>> targets,
                    const PoseSearchRegistrationOptions& options, const Registration& r);

  /// Notes the pose that explains the points best of the others; returns its place in `found`. One
  /// that explains them nearly as well is fitted to all points first, which may lead it to the best
  /// pose: then it is none.
  std::size_t compare_poses(std::span<const Candidate> found, Registration& r) const;
  /// The level that explains the points nearly as well as this one or better; kSeveralLevels
  /// where several do so alike; empty where none does.
  [[nodiscard]] std::string better_level() const;
  /// How much better the mirror image explains the points; negative where it does so worse.
  [[nodiscard]] double mirror_log_likelihood() const;

 private:
  struct Rival {
    CentredPose pose;
    double rmse_m = 0.0;
    double log_likelihood_ratio = 0.0;
  };
  /// For the best fit, by units of the points that it has on the bone.
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
  /// How much worse a fit of all points, to whatever model, explains those that the best one has
  /// on the bone: by the evidence for each, a field over the bone marginalised in both.
  [[nodiscard]] double log_likelihood_ratio(const SurfaceFit& other) const;
  [[nodiscard]] bool is_another(const CentredPose& pose) const;

  const VertebraModel& model_;
  const Cloud& cloud_;
  const CertainFit& best_;
  double width_m_;
  std::span<const Point<Vertebra>> targets_;
  const PoseSearchRegistrationOptions& options_;
  Transform<World, Vertebra> world_from_vertebra_;
  double best_cost_m2_;
  double unit_m2_ = 0.0;                      ///< of costs, that is one of the log-likelihood
  double clamp_m_ = 0.0;                      ///< a residual counts as no more than this
  mutable std::optional<Evidence> evidence_;  ///< computed on first use
  SurfaceFitOptions fine_;
};

}  // namespace orthonav::nav
