#include "bench/other_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orthonav::bench {
namespace {

constexpr int kBlock = 8;
using Block = std::array<std::array<double, kBlock>, kBlock>;

/// Annex K of the JPEG standard, luminance.
constexpr std::array<int, 64> kSteps{16,  11,  10,  16,  24, 40, 51,  61,  12,  12,  14,  19,  26,
                                     58,  60,  55,  14,  13, 16, 24,  40,  57,  69,  56,  14,  17,
                                     22,  29,  51,  87,  80, 62, 18,  22,  37,  56,  68,  109, 103,
                                     77,  24,  35,  55,  64, 81, 104, 113, 92,  49,  64,  78,  87,
                                     103, 121, 120, 101, 72, 92, 95,  98,  112, 100, 103, 99};

const Block& cosines() {
  static const Block table = [] {
    Block t;
    for (std::size_t k = 0; k < kBlock; ++k) {
      for (std::size_t x = 0; x < kBlock; ++x) {
        t[k][x] = (k == 0 ? std::sqrt(0.125) : 0.5) *
                  std::cos((2.0 * static_cast<double>(x) + 1.0) * static_cast<double>(k) *
                           std::numbers::pi / 16.0);
      }
    }
    return t;
  }();
  return table;
}

/// a · b · aᵀ, or aᵀ · b · a.
Block sandwiched(const Block& a, const Block& b, bool transposed) {
  const auto at = [&](std::size_t r, std::size_t c) { return transposed ? a[c][r] : a[r][c]; };
  Block half{};
  Block out{};
  for (std::size_t r = 0; r < kBlock; ++r) {
    for (std::size_t c = 0; c < kBlock; ++c) {
      for (std::size_t k = 0; k < kBlock; ++k) {
        half[r][c] += at(r, k) * b[k][c];
      }
    }
  }
  for (std::size_t r = 0; r < kBlock; ++r) {
    for (std::size_t c = 0; c < kBlock; ++c) {
      for (std::size_t k = 0; k < kBlock; ++k) {
        out[r][c] += half[r][k] * at(c, k);
      }
    }
  }
  return out;
}

/// There and back; sides are multiples of eight.
void compress(int quality, GreyImage& image) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  for (int top = 0; top < image.height_px; top += kBlock) {
    for (int left = 0; left < image.width_px; left += kBlock) {
      Block block;
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          block[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
              image.at(left + x, top + y) - 128.0;
        }
      }
      Block waves = sandwiched(cosines(), block, false);
      for (std::size_t i = 0; i < kSteps.size(); ++i) {
        const double step = std::clamp((kSteps[i] * scale + 50) / 100, 1, 255);
        double& wave = waves[i / kBlock][i % kBlock];
        wave = step * std::round(wave / step);
      }
      block = sandwiched(cosines(), waves, true);
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          image.at(left + x, top + y) = static_cast<std::uint8_t>(std::clamp(
              block[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] + 128.5, 0.0, 255.0));
        }
      }
    }
  }
}

double gamma(double light, double power) {
  constexpr double kFoot = 0.01;
  if (light < kFoot) {
    return light / kFoot * std::pow(kFoot, 1.0 / power);
  }
  return std::pow(light, 1.0 / power);
}

}  // namespace

double Sensor::grey(double light) const {
  const double l = std::clamp(light, 0.0, 1.0);
  if (response == Response::kGamma) {
    return 255.0 * gamma(l, 2.2);
  }
  if (response == Response::kS) {
    const double g = gamma(l, 1.6);
    return 255.0 * (0.4 * g + 0.6 * g * g * (3.0 - 2.0 * g));
  }
  return 255.0 * l;
}

double Sensor::variance(double light) const {
  constexpr double kStep = 1e-4;
  const double slope = (grey(light + kStep) - grey(light - kStep)) / (2.0 * kStep);
  const double electrons = full_well_e * std::max(light, 0.0) + read_noise_e * read_noise_e;
  return slope * slope * electrons / (full_well_e * full_well_e) + 1.0 / 12.0;
}

void Sensor::expose(const LightImage& light, Random& random, GreyImage& image) const {
  image = GreyImage(light.width_px, light.height_px);
  for (std::size_t i = 0; i < light.light.size(); ++i) {
    const double l = static_cast<double>(light.light[i]);
    const double sd = std::sqrt(full_well_e * l + read_noise_e * read_noise_e) / full_well_e;
    image.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(grey(l + sd * random.normal()) + 0.5, 0.0, 255.0));
  }
  if (jpeg_quality > 0) {
    compress(jpeg_quality, image);
  }
}

}  // namespace orthonav::bench
