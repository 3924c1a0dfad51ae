#pragma once

#include <string_view>

namespace orthonav::engine {

/// The information that a camera image of the simulated room gives a tracker about a tag, as
/// numbers instead of pixels. Fitted to runs on pixels (bench/tracking_errors_bench.cpp;
/// docs/cohorts.md has the figures and the test that both agree).
struct MeasurementModel {
  /// SD of the part of a corner's error that is new in every image, per coordinate.
  double white_px = 0.006;
  /// SD of the lasting part, and for how long it lasts: it depends on the tag's position on the
  /// pixel grid and on the light.
  double lasting_px = 0.018;
  double lasts_s = 0.3;
  /// Additional SD along the motion from blur, as a fraction of the distance that a corner moves
  /// during the exposure.
  double of_blur = 0.0;
  /// A tag is not seen if the cosine of its face's angle to the camera is below this, if its
  /// shorter diagonal is below `least_px`, or if it moves farther than `most_blur_px` in an
  /// exposure.
  double least_facing = 0.17;
  double least_px = 16.0;
  double most_blur_px = 12.0;
  /// A tag is not seen if it mirrors more of the lamp than this fraction of a white one's light:
  /// black is then almost as bright as the camera can resolve. Estimate, as the two below: not
  /// fitted, and more than a tag of the documented room mirrors (`tag_gloss`).
  double most_glare = 0.85;
  /// Whether a drop of blood on one of its corners prevents a tag from being found; if not, by how
  /// much the errors of its corners grow.
  bool drop_hides = false;
  double drop_factor = 2.0;
  /// SD of a corner that the tracker assumes.
  double believed_px = 0.009;

  /// For the method of that name, `paper` or `best`.
  static MeasurementModel of(std::string_view method);
};

}  // namespace orthonav::engine
