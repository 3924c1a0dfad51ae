#pragma once

#include <algorithm>
#include <bit>

namespace orthonav::nav {

/// The blur ends at this many SDs, so that a cell's grey depends on its neighbours only: 3e-5 of it
/// would lie beyond.
inline constexpr float kReachSd = 4.0F;

/// e to the x for x in [-8, 0], with a relative error of 3e-6: a polynomial of 2 to the fractional
/// part, the whole part put into the exponent. The library's function would not be vectorized.
inline float exponential(float x) {
  const float y = x * 1.44269504F;
  const int whole = static_cast<int>(y - 0.5F);
  const float f = y - static_cast<float>(whole);
  const float power =
      1.0F +
      f * (0.693147182F +
           f * (0.240226507F + f * (0.0555041087F + f * (0.00961812911F + f * 0.00133335581F))));
  return power * std::bit_cast<float>((whole + 127) << 23);
}

/// The fraction of a blur's footprint that lies beyond an edge at distance `f`, and its
/// derivatives. The profile is a Gaussian with excess kurtosis (the Gram-Charlier series to the
/// fourth moment), its tail after Abramowitz & Stegun 1964, 7.1.26.
struct Beyond {
  float fraction;
  float slope;
  float by_blur;
  float by_kurtosis;
  float gaussian;
};
inline Beyond beyond(float f, float inverse_sd, float excess_kurtosis) {
  const float t = std::min(f * inverse_sd, kReachSd);
  const float reached = t < kReachSd ? 1.0F : 0.0F;
  const float s = t * t;
  const float e = reached * exponential(-0.5F * s);
  const float gaussian = 0.398942280F * e;
  const float u = 1.0F / (1.0F + 0.3275911F * 0.707106781F * t);
  const float tail =
      u * (0.254829592F +
           u * (-0.284496736F + u * (1.421413741F + u * (-1.453152027F + u * 1.061405429F))));
  const float by_kurtosis = (1.0F / 24.0F) * gaussian * t * (s - 3.0F);
  const float density =
      gaussian * (1.0F + excess_kurtosis * (1.0F / 24.0F) * (3.0F + s * (s - 6.0F)));
  return {0.5F * tail * e + excess_kurtosis * by_kurtosis, density * inverse_sd, density * t,
          by_kurtosis, gaussian};
}

}  // namespace orthonav::nav
