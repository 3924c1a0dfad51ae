#pragma once

#include "base/image.h"
#include "base/random.h"
#include "bench/other_renderer.h"

namespace orthonav::bench {

enum class Response {
  kLinear,
  kGamma,  ///< power of 1/2.2 above a linear foot, as in sRGB
  kS       ///< a mild gamma, then more contrast in the middle: what a phone does
};

/// From light to grey values.
struct Sensor {
  Response response = Response::kLinear;
  double full_well_e = 8000.0;  ///< photoelectrons that saturate
  double read_noise_e = 12.0;
  int jpeg_quality = 0;  ///< 0: kept as it is; else as in libjpeg, grey

  /// Expected grey value, 0 to 255, without noise.
  [[nodiscard]] double grey(double light) const;
  /// Variance of it, quantization to 8 bits included, compression not.
  [[nodiscard]] double variance(double light) const;
  void expose(const LightImage& light, Random& random, GreyImage& image) const;
};

}  // namespace orthonav::bench
