#pragma once

#include <string_view>

namespace orthonav::engine {

/// What a camera image of the simulated room lets a tracker know of a tag, in numbers instead of
/// pixels. Fitted to runs on pixels (bench/tracking_errors_bench.cpp; docs/cohorts.md holds the
/// figures and the test that both agree).
struct MeasurementModel {
  /// SD of a corner's coordinate that is new in every image.
  double white_px = 0.006;
  /// SD of its part that lasts, and for how long: where the tag lies on the grid of pixels, how the
  /// light falls.
  double lasting_px = 0.018;
  double lasts_s = 0.3;
  /// SD along the motion that blur adds, of the way that a corner moves during the exposure.
  double of_blur = 0.0;
  /// A tag is not seen where its face is turned away by more than this cosine, where its shorter
  /// diagonal is below `least_px`, or where it moves farther than `most_blur_px` in an exposure.
  double least_facing = 0.17;
  double least_px = 16.0;
  double most_blur_px = 12.0;
  /// A tag is not seen where what it mirrors of the lamp exceeds this fraction of a white one's
  /// light: black is then almost as bright as the camera can tell. Estimate, as the two below: not
  /// fitted, and more than a tag of the documented room mirrors (`tag_gloss`).
  double most_glare = 0.85;
  /// Whether a drop of blood on one of its corners keeps a tag from being found, and else by how
  /// much the errors of its corners grow.
  bool drop_hides = false;
  double drop_factor = 2.0;
  /// SD that the tracker believes of a corner.
  double believed_px = 0.009;

  /// Of the method of that name, `paper` or `best`.
  static MeasurementModel of(std::string_view method);
};

}  // namespace orthonav::engine
