#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "hal/sim/cameras/room_renderer_sensor.h"
#include "tests/support/camera_scene.h"

namespace orthonav::sim {
namespace {

/// 10,000 samples a bin give the SD to 1 %; quantiles in 4096 steps lose another 0.3 %.
constexpr double kSdRatio = 0.04;

ErrorModel only(double shot, double read) {
  ErrorModel m;
  m.blur_sigma_px = 0.0;
  m.vignetting = 0.0;
  m.shot_noise = shot;
  m.read_noise_grey = read;
  return m;
}

GreyImage view(const ErrorModel& error_model, std::uint64_t seed) {
  static const RoomDescription room = scene::operating_room(8);
  static const StereoCalibration calibration = hololens2_calibration();
  GreyImage image;
  RoomRenderer::create(room, error_model)
      ->render(std::vector<RoomState>{scene::operating_state(room)}, calibration.left,
               calibration.left_from_rig, seed, image);
  return image;
}

/// The worst relative deviation, over grey levels, of the noise's SD from a formula.
template <class Formula>
double worst_sd_ratio(const ErrorModel& error_model, const Formula& sd_of) {
  const GreyImage clean = view(only(0, 0), 0);
  std::array<double, 256> squares{};
  std::array<double, 256> counts{};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const GreyImage a = view(error_model, 2 * seed);
    const GreyImage b = view(error_model, 2 * seed + 1);
    for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
      const double difference = a.pixels[i] - b.pixels[i];
      squares[clean.pixels[i]] += difference * difference / 2.0;
      counts[clean.pixels[i]] += 1.0;
    }
  }
  double worst = 0.0;
  int bins = 0;
  for (int grey = 20; grey < 230; ++grey) {
    const auto i = static_cast<std::size_t>(grey);
    if (counts[i] < 10000) {
      continue;
    }
    ++bins;
    worst = std::max(worst, std::abs(std::sqrt(squares[i] / counts[i]) / sd_of(grey) - 1.0));
  }
  EXPECT_GT(bins, 20);
  return worst;
}

TEST(Sensor, NoiseHasItsDocumentedSize) {
  const auto formula = [](double grey) {
    return std::sqrt(0.1 * grey + 1.0 + 1.0 / 12.0);  // shot, read, rounding to 8 bits
  };
  EXPECT_LT(worst_sd_ratio(only(0.1, 1.0), formula), kSdRatio);
}

TEST(Sensor, NoiseOfAnotherSizeIsCaught) {
  const auto ten_per_cent_more = [](double grey) {
    return 1.1 * std::sqrt(0.1 * grey + 1.0 + 1.0 / 12.0);
  };
  const auto no_shot = [](double) { return std::sqrt(1.0 + 1.0 / 12.0); };
  EXPECT_GT(worst_sd_ratio(only(0.1, 1.0), ten_per_cent_more), kSdRatio);
  EXPECT_GT(worst_sd_ratio(only(0.1, 1.0), no_shot), kSdRatio);
}

TEST(Sensor, NoiseHasNoMeanAndNoNeighbour) {
  const GreyImage clean = view(only(0, 0), 0);
  const GreyImage noisy = view(only(0.1, 1.0), 77);
  double sum = 0.0;
  double squares = 0.0;
  double beside = 0.0;
  double below = 0.0;
  const std::size_t n = clean.pixels.size();
  const auto at = [&](std::size_t i) {
    return static_cast<double>(noisy.pixels[i]) - clean.pixels[i];
  };
  for (std::size_t i = 0; i + 640 < n; ++i) {
    sum += at(i);
    squares += at(i) * at(i);
    beside += at(i) * at(i + 1);
    below += at(i) * at(i + 640);
  }
  const double count = static_cast<double>(n);
  // The noise-free image is rounded too: neighbours share up to half a grey of that.
  EXPECT_NEAR(sum / count, 0.0, 0.03);
  EXPECT_NEAR(beside / squares, 0.0, 0.02);
  EXPECT_NEAR(below / squares, 0.0, 0.02);
}

TEST(Sensor, AnotherSeedIsAnotherNoise) {
  EXPECT_NE(view(only(0.1, 1.0), 5), view(only(0.1, 1.0), 6));
  EXPECT_EQ(view(only(0, 0), 5), view(only(0, 0), 6));
}

TEST(Sensor, VignettingTakesItsShareInTheCorner) {
  ErrorModel dim = only(0, 0);
  dim.vignetting = 0.4;
  const GreyImage full = view(only(0, 0), 0);
  const GreyImage vignetted = view(dim, 0);
  const auto mean = [](const GreyImage& image, int x0, int y0) {
    double sum = 0.0;
    for (int y = y0; y < y0 + 8; ++y) {
      for (int x = x0; x < x0 + 8; ++x) {
        sum += image.at(x, y);
      }
    }
    return sum / 64;
  };
  EXPECT_NEAR(mean(vignetted, 316, 236) / mean(full, 316, 236), 1.0, 0.01);
  for (const int x : {0, 632}) {
    for (const int y : {0, 472}) {
      EXPECT_NEAR(mean(vignetted, x, y) / mean(full, x, y), 0.6, 0.02) << x << " " << y;
    }
  }
  // Half way to the corner a quarter of the loss.
  EXPECT_NEAR(mean(vignetted, 156, 116) / mean(full, 156, 116), 0.9, 0.02);
}

TEST(Sensor, BlurKernelHasItsVariance) {
  for (const double sigma : {0.1, 0.3, 0.7, 1.5}) {
    const std::vector<float> kernel = discrete_gaussian(sigma);
    double sum = static_cast<double>(kernel[0]);
    double variance = 0.0;
    for (std::size_t n = 1; n < kernel.size(); ++n) {
      sum += 2.0 * static_cast<double>(kernel[n]);
      variance += 2.0 * static_cast<double>(kernel[n]) * static_cast<double>(n * n);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_NEAR(std::sqrt(variance), sigma, 0.002 * sigma + 1e-3) << sigma;
  }
  EXPECT_EQ(discrete_gaussian(0.0).size(), 1u);
}

}  // namespace
}  // namespace orthonav::sim
