#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "render/renderer.h"

namespace orthonav::render {

// Compares frames. No more pixels may differ than processors differ in: a whole-frame budget would
// miss thin holograms and single digits.

/// The allowed difference of 8-bit colours on the pinned software rasterizer: rounding of the last
/// blend.
inline constexpr int kColourTolerance = 2;
/// Pixels that may lie beyond it: where an edge passes a sample, another kind of processor may
/// round to its other side (measured: two; docs/decisions/0027-pictures-to-the-bit.md). A digit
/// that changes, or a hologram that moves by a pixel, is dozens.
inline constexpr std::size_t kEdgePixels = 3;

struct ColourDifference {
  bool same_size = true;
  int worst = 0;  ///< largest difference of a channel, 0 to 255
  int worst_x_px = 0;
  int worst_y_px = 0;
  std::size_t outside = 0;  ///< pixels with a channel beyond the tolerance
  [[nodiscard]] bool alike() const { return same_size && outside <= kEdgePixels; }
  /// `alike`, or one line with the count and the worst pixel.
  [[nodiscard]] std::string text() const;
};
[[nodiscard]] ColourDifference compare_colour(const RgbaImage& expected, const RgbaImage& actual);

struct LabelDifference {
  bool same_size = true;
  std::size_t outside = 0;  ///< pixels whose label differs
  int first_x_px = 0;
  int first_y_px = 0;
  Label expected = 0;  ///< at the first differing pixel
  Label actual = 0;
  [[nodiscard]] bool alike() const { return same_size && outside == 0; }
  [[nodiscard]] std::string text() const;
};
/// Labels are integers: any difference counts.
[[nodiscard]] LabelDifference compare_labels(const LabelImage& expected, const LabelImage& actual);

/// Differences of the channels times 16, for people to look at. Empty if the sizes differ.
[[nodiscard]] RgbaImage difference_image(const RgbaImage& expected, const RgbaImage& actual);

/// Where the pixels of a label lie.
struct LabelExtent {
  double centre_x_px = 0;  ///< mean of the pixels' centres
  double centre_y_px = 0;
  int left_px = 0;  ///< first and one past the last column and row
  int right_px = 0;
  int top_px = 0;
  int bottom_px = 0;
  std::size_t pixels = 0;
};
/// Empty if no pixel has the label.
[[nodiscard]] std::optional<LabelExtent> extent_of(const LabelImage& image, Label label);

}  // namespace orthonav::render
