#pragma once

#include <span>
#include <string>
#include <vector>

#include "nav/calibration/body_sightings.h"
#include "nav/statistics/verdict.h"

namespace orthonav::nav {

struct TagBodyOptions {
  /// Two tags count as connected when both cameras saw them together in at least this many pairs.
  std::size_t min_pairs_together = 10;
  /// Pairs are thinned evenly to this many.
  std::size_t max_pairs = 600;
  /// Tags that move relative to each other make more corners misfit (a quarter of them, from a
  /// millimetre of motion), or leave a larger residual.
  double max_rms_px = 0.5;
  double max_outlier_fraction = 0.15;
  double max_sigma_m = 0.001;
  double max_size_deviation =
      0.05;  ///< of the triangulated edge from the size given, relative to it
  /// Limits beyond which a result gets a note.
  double note_sigma_m = 0.0002;
  double note_sigma_rad = 0.005;
  double note_size_deviation = 0.02;
  double note_outlier_fraction = 0.08;
  std::size_t note_pairs = 50;

  /// Every problem at once.
  [[nodiscard]] std::vector<std::string> check() const;
};

struct BodyTag {
  MarkerDefinition definition;
  Transform<Marker, Tag> marker_from_tag;
  std::size_t pairs = 0;  ///< seen together with another tag
  /// 3-D SDs: the larger of the one that the residuals predict and the one from a jackknife over
  /// tenths of the recording; 0 for the first tag.
  double sigma_m = 0.0;
  double sigma_rad = 0.0;
  double size_ratio = 0.0;  ///< median triangulated edge, relative to the size given
};

/// A rigid body of tags, the first of which is its marker.
struct TagBody {
  std::vector<BodyTag> tags;
  std::size_t pairs = 0;  ///< used: with two tags or more
  double rms_px = 0.0;    ///< of the corners, 2-D
  double outlier_fraction = 0.0;
  Judgement judgement;  ///< pass or note; what fails is refused
};

/// The tags' relative poses: averaged pair by pair (`first_layout`), then all corners of all pairs
/// adjusted at once (`adjust`). Pairs must be in the order of time. Refuses bad options, fewer than
/// two tags, tags not connected with the first one (by name), sizes that the images contradict, and
/// bodies that are not rigid, each with value and limit.
Result<TagBody> calibrate_tag_body(const StereoCalibration& calibration,
                                   std::span<const MarkerDefinition> tags,
                                   std::span<const PairSightings> pairs,
                                   const TagBodyOptions& options = {});

}  // namespace orthonav::nav
