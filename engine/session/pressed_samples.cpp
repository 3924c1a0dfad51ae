#include "engine/session/pressed_samples.h"

#include <cmath>

namespace orthonav::engine {

double sd_of_mean(double sample_sd, double squares, double axes, double count) {
  constexpr double kPriorSamples = 3.0;
  const double variance =
      (kPriorSamples * sample_sd * sample_sd + squares / axes) / (kPriorSamples + count);
  return std::sqrt(variance / count);
}

}  // namespace orthonav::engine
