#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::engine {

/// An optical see-through display in a lit room. The eye sees the world through the combiner, and
/// the display's light on top of it.
struct OpticalModel {
  double display_cd_m2 = 500.0;     ///< of full white, at the eye
  double ambient_lux = 1000.0;      ///< on the background; an operating field has 10,000 and more
  double combiner_fraction = 0.40;  ///< of the world's light that passes

  /// Luminance behind the combiner of a white, matte surface.
  [[nodiscard]] double white_sheet_cd_m2() const;
  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// The contrast of a hologram: luminance with it divided by luminance without it, over the pixels
/// of its label; 1 is invisible.
struct HologramContrast {
  render::Label label = 0;
  int pixels = 0;
  double median = 1.0;
  double faint = 1.0;  ///< of the tenth of its pixels that stand out least
};

/// Text and lines below this are hard to make out (WCAG 2.1, 1.4.11: graphical objects).
inline constexpr double kLegibleContrast = 3.0;

/// The contrasts of the holograms drawn additively on black (`light`) over a background whose
/// linear grey is its reflectance; all three images have one size. In the order of labels.
[[nodiscard]] std::vector<HologramContrast> contrasts(const RgbaImage& light,
                                                      const LabelImage& labels,
                                                      const RgbaImage& background,
                                                      const OpticalModel& model);

/// The world seen through the combiner, exposed so that the display's full white over a white sheet
/// is white. Pictures for people use it as their background: at its own brightness, light on top of
/// it would not stand out as it does in the display.
class WorldBehindCombiner {
 public:
  explicit WorldBehindCombiner(const OpticalModel& model = {});
  void dim(RgbaImage& world) const;

 private:
  std::array<std::uint8_t, 256> seen_{};
};

/// The image seen by the eye, exposed so that the brightest sum of display and background is white.
[[nodiscard]] RgbaImage through_combiner(const RgbaImage& light, const RgbaImage& background,
                                         const OpticalModel& model);

}  // namespace orthonav::engine
