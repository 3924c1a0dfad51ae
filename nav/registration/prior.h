#pragma once

#include <array>
#include <cstddef>

namespace orthonav::nav::posterior {

/// What is known before a bone is touched: each constant with its unit and, where they are known,
/// its source and what changes when it doubles.
struct Prior {
  // Soft tissue, or a light hand: the mean height s of the tip, and how uneven it is.

  /// s is half-normal, of a scale between bare bone's and thick tissue's, evenly in its logarithm.
  /// Guesses: on bare bone it is no less than under a press, facets carry up to 2 mm of tissue.
  /// Either doubled: nothing over clean strokes, which tell s themselves.
  double bare_m = 0.0002;
  double tissue_m = 0.002;
  /// SD of tissue's thickness over the bone, of its mean: median, and SD of its logarithm. Tissue
  /// is never even. A guess. Median doubled: even tissue loses half a unit of log evidence.
  double unevenness = 0.5;
  double unevenness_log_sd = 1.0;
  /// Lengths over which its thickness changes, equally likely, m. A facet to a vertebra.
  std::array<double, 3> tissue_lengths_m{0.008, 0.020, 0.050};
  /// Share of registrations in which acts of the hand have heights of their own (`Act`); how
  /// different, as for tissue. A guess.
  double uneven_hand_share = 0.5;
  /// Time over which the correlation of heights falls to 1/e where the hand's pressure changes
  /// slowly, as it does from one attempt to the next, s. A guess. Doubled: nothing.
  double while_s = 30.0;

  // The model is not the bone.

  /// SD over the bone: below `exact_m` with this probability, evenly; above it evenly in its
  /// logarithm up to `worst_m`. Segmentations of vertebrae in CT are off by 0.3 to 0.8 mm
  /// (nav/registration/model_error.h); models made of the bone itself are exact.
  double exact_share = 0.4;
  double exact_m = 0.0001;
  double worst_m = 0.001;
  /// Known to be off by this much at least, where strokes of such bones were measured.
  double least_off_m = 0.0;
  double model_length_m = 0.007;  ///< over which its covariance falls to 1/e: 5 to 10 mm

  // The hand and the tracker.

  /// SD of a point about the bone: median, and SD of its logarithm. Clean strokes scatter by 0.3,
  /// unsteady ones by 0.9 mm. The prior predictive check is about it: doubled, the scatter that is
  /// refused doubles.
  double noise_m = 0.00035;
  double noise_log_sd = 0.55;
  /// Of the noise's variance, this share at least is white, and this one at least is not, evenly in
  /// the log odds; or all of it is.
  double white_share_least = 0.01;
  double shortest_s = 0.05;  ///< correlation time of what is not, evenly in its logarithm
  double longest_s = 2.0;

  /// A point that has nothing to do with the bone, under every hypothesis: its share, and the range
  /// over which its height is even. Lifted pointers reach 10 mm.
  double outlier_share = 0.05;
  double outlier_range_m = 0.020;

  /// Probability that the shaft of one row seems to go through bone at the true pose: the pose is a
  /// little off, or the shaft bends. A guess. Doubled: a pose at which a fifth of all shafts go
  /// through bone is worse by 125 units of log evidence instead of 147.
  double shaft_in_bone = 0.01;

  // Rivals.

  double mirror_odds = 2e-4;  ///< that left and right are swapped somewhere: a guess
  /// That the model has another size, with this SD. Guesses: a spacing that was misread. Share
  /// doubled: strokes that leave the size open are refused for its prior odds alone.
  double size_share = 0.01;
  double size_sd = 0.05;
};

[[nodiscard]] double normal_cdf(double z);

/// Log density (1/m) of the mean height.
[[nodiscard]] double log_density_of_standoff(const Prior& prior, double s_m);
/// Probability that tissue of this mean height, or the heights of an uneven hand's strokes on it,
/// vary by less than `sd_m`.
[[nodiscard]] double varies_by_less(const Prior& prior, double sd_m, double s_m);
/// Probability that the model is off by less than `sd_m`.
[[nodiscard]] double model_off_by_less(const Prior& prior, double sd_m);
/// Log density of the noise's SD, by its logarithm.
[[nodiscard]] double log_density_of_noise(const Prior& prior, double noise_m);
/// What heights scatter by more than with this probability (4096 draws, always the same).
[[nodiscard]] double scatter_exceeded_m(const Prior& prior, double probability);

}  // namespace orthonav::nav::posterior
