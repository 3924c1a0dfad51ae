#include "hal/voice/resampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace orthonav::voice::voice_test {
namespace {

TEST(Resampler, KeepsATonesPitchAndLevel) {
  auto resampler = Resampler::create(48000, 16000);
  ASSERT_TRUE(resampler.ok());
  std::vector<std::int16_t> in;
  for (int i = 0; i < 48000; ++i) {
    in.push_back(
        static_cast<std::int16_t>(10000.0 * std::sin(2.0 * 3.14159265 * 440.0 * i / 48000)));
  }
  std::vector<std::int16_t> out;
  ASSERT_TRUE(resampler->push(in, out).ok());
  ASSERT_NEAR(static_cast<double>(out.size()), 16000.0, 100.0);
  int crossings = 0;
  for (std::size_t i = 1000; i < 15000; ++i) {
    crossings += out[i - 1] < 0 && out[i] >= 0 ? 1 : 0;
  }
  EXPECT_NEAR(crossings, 440.0 * 14000 / 16000, 2.0);
  EXPECT_NEAR(*std::max_element(out.begin() + 1000, out.end()), 10000, 200);
  EXPECT_FALSE(Resampler::create(100, 16000).ok());
}

}  // namespace
}  // namespace orthonav::voice::voice_test
