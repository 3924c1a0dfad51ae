#pragma once

#include "base/image.h"
#include "base/random.h"
#include "bench/other_renderer.h"

namespace orthonav::bench {

enum class Response {
  kLinear,
  kGamma,  ///< a power of 1/2.2 above a linear segment, as in sRGB
  kS       ///< a mild gamma, then more contrast in the middle: what a phone does
};

/// How light becomes grey values.
struct Sensor {
  Response response = Response::kLinear;
  double full_well_e = 8000.0;  ///< photoelectrons that saturate
  double read_noise_e = 12.0;
  int jpeg_quality = 0;  ///< 0: not compressed; otherwise libjpeg's quality, in grey

  /// Expected grey value, 0 to 255, without noise.
  [[nodiscard]] double grey(double light) const;
  /// Variance of the grey value, with quantization to 8 bits but without compression.
  [[nodiscard]] double variance(double light) const;
  void expose(const LightImage& light, Random& random, GreyImage& image) const;
};

}  // namespace orthonav::bench
