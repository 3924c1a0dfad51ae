#pragma once

#include <array>
#include <cstddef>

namespace orthonav::nav::posterior {

/// What is known before a bone is touched. Each constant with its unit, its source, and what
/// changes when it doubles.
struct Prior {
  // Soft tissue, or a light hand: the mean height s of the tip, and how uneven it is.

  /// Share of registrations over bare bone, whose s is of the size of `bare_m`. A guess. Doubled:
  /// nothing over clean strokes, which tell it themselves.
  double bare_share = 0.5;
  double bare_m = 0.0001;  ///< scale of s over bare bone (half-normal). A guess; doubled: nothing
  double tissue_m =
      0.002;  ///< scale of s over tissue (half-normal): facets to 2 mm, valleys to more
  /// SD of tissue's thickness over the bone, of its mean: median, and SD of its logarithm. Tissue
  /// is never even. A guess. Median doubled: even tissue loses half a unit of log evidence.
  double unevenness = 0.5;
  double unevenness_log_sd = 1.0;
  /// Lengths over which its thickness changes, equally likely, m. A facet to a vertebra.
  std::array<double, 3> tissue_lengths_m{0.008, 0.020, 0.050};
  /// Share of registrations in which each stroke has a height of its own; how different, as for
  /// tissue. A guess.
  double uneven_hand_share = 0.5;

  // The model is not the bone.

  /// SD over the bone: below `exact_m` with this probability, evenly; above it evenly in its
  /// logarithm up to `worst_m`. Segmentations of vertebrae in CT are off by 0.3 to 0.8 mm
  /// (error-model); models made of the bone itself are exact.
  double exact_share = 0.4;
  double exact_m = 0.0001;
  double worst_m = 0.001;
  double model_length_m = 0.007;  ///< over which its covariance falls to 1/e: 5 to 10 mm

  // The hand and the tracker.

  /// SD of a point about the bone: median, and SD of its logarithm. Clean strokes scatter by 0.3,
  /// unsteady ones by 0.9 mm. The prior predictive check is about it: doubled, the scatter that is
  /// refused doubles.
  double noise_m = 0.00035;
  double noise_log_sd = 0.55;
  double white_share_least =
      0.01;                  ///< of the variance, from point to point: evenly in its log odds
  double shortest_s = 0.05;  ///< correlation time of the rest, evenly in its logarithm
  double longest_s = 2.0;

  /// What a point's deviation within its block counts for, of an independent one. The noise is not
  /// quite white and wandering: how it goes at once must not decide how it goes on. A debt: chosen
  /// on strokes of our own (noisy ones, seeds 1 and 2); at 1 and at 0.1 the pose is a tenth less
  /// exact there.
  double point_counts = 0.3;

  /// A point that has nothing to do with the bone, under every hypothesis: its share, and the range
  /// over which its height is even. Lifted pointers reach 10 mm.
  double outlier_share = 0.05;
  double outlier_range_m = 0.020;

  // Rivals.

  double mirror_odds = 2e-4;  ///< that left and right are swapped somewhere: a guess
  double size_share = 0.02;   ///< that the model has another size, with this SD: a guess
  double size_sd = 0.05;

  // Pressed places: the gap beneath a pressed tip, estimates for soft tissue under pressure.

  double press_gap_m = 0.0002;
  double press_common_sd_m = 0.0002;
  double press_sd_m = 0.0003;
};

}  // namespace orthonav::nav::posterior
