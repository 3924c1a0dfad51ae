#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "hal/sim/cameras/room_renderer_layers.h"
#include "hal/sim/error_model.h"

namespace orthonav::sim {

/// The background of a frame at half the resolution: value (i, j) stands at pixel (2i+1, 2j+1).
struct HalfImage {
  int width = 0;
  int height = 0;
  std::vector<float> grey;

  void reset(int half_width, int half_height);
  [[nodiscard]] const float* row(int y) const {
    return grey.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
};

/// From light to bytes: blur, vignetting, shot and read noise, 8 bits. One pass over the rows.
class Sensor {
 public:
  explicit Sensor(const ErrorModel& error_model);
  /// `light`: of the lamp, as a fraction of its mean.
  void expose(const HalfImage& background, const Foreground& foreground, std::uint64_t noise_seed,
              float light, GreyImage& image);

 private:
  void resize(int width, int height);
  void compose_row(const HalfImage& background, const Foreground& foreground, int y);
  void blur_along(int y, CoverageWindow::Span span);
  [[nodiscard]] const float* blur_across(int y, CoverageWindow::Span span);
  void draw_noise(int y, std::uint64_t noise_seed);
  void finish_row(const float* light, int y, std::uint64_t noise_seed, std::uint8_t* out);
  float lamp_ = 1.0F;  ///< of the image at hand
  [[nodiscard]] float* ring_row(int y);
  [[nodiscard]] CoverageWindow::Span widened(const Foreground& foreground, int low_row,
                                             int high_row) const;

  static constexpr std::size_t kDraws = 4096;
  float shot_variance_per_grey_;
  float read_variance_;
  float vignetting_;
  int radius_ = 0;
  std::vector<float> kernel_;  ///< from the centre outwards, radius_ + 1 weights
  std::array<float, kDraws> normal_{};
  int width_ = 0;
  int height_ = 0;
  std::vector<float> ring_;  ///< the last 2 radius_ + 1 rows
  std::vector<float> line_;  ///< one row with margins of radius_
  std::vector<float> across_;
  std::vector<float> noise_;
  std::vector<float> loss_x_;
};

/// Weights of the discrete Gaussian (Lindeberg 1990: e^-t I_n(t) with t = sigma²), whose variance
/// is sigma² exactly however small; from the centre outwards.
[[nodiscard]] std::vector<float> discrete_gaussian(double sigma_px);

}  // namespace orthonav::sim
