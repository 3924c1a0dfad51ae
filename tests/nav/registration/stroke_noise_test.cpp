#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "engine/case/case_file.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/test_data.h"

namespace orthonav::test {
namespace {

class StrokeNoise : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto source = engine::load_case(test_data("anatomy/visible-human").string());
    ASSERT_TRUE(source.ok()) << source.error().message;
    mesh_ = source->find("L3")->mesh;
    surface_ = std::make_unique<nav::SurfaceIndex>(mesh_);
  }
  DigitizedStrokes strokes(StrokeVariant variant, std::uint64_t seed) const {
    return digitize_strokes(mesh_, variant, seed).value();
  }
  nav::TriangleMesh mesh_;
  std::unique_ptr<nav::SurfaceIndex> surface_;
};

/// Moments of the tracking error along an axis and between samples so many apart in a stroke.
struct Moments {
  double sd_m[3] = {};
  double correlation = 0.0;  ///< the mean over the axes
  double between_axes = 0.0;
};

Moments moments(const std::vector<DigitizedStrokes>& many, std::size_t apart) {
  double sum[3] = {}, lagged[3] = {}, crossed = 0.0, count = 0.0, pairs = 0.0;
  for (const DigitizedStrokes& d : many) {
    const auto error = [&](std::size_t i) {
      return (d.world_from_vertebra.inverse() * d.samples[i].tip) - d.samples[i].true_tip;
    };
    for (std::size_t i = 0; i < d.samples.size(); ++i) {
      const Vec3 e = error(i);
      for (int k = 0; k < 3; ++k) {
        sum[k] += e[k] * e[k];
      }
      crossed += e.x * e.y;
      ++count;
      if (i < apart || d.samples[i].stroke != d.samples[i - apart].stroke) {
        continue;
      }
      const Vec3 before = error(i - apart);
      for (int k = 0; k < 3; ++k) {
        lagged[k] += e[k] * before[k];
      }
      ++pairs;
    }
  }
  Moments m;
  for (int k = 0; k < 3; ++k) {
    m.sd_m[k] = std::sqrt(sum[k] / count);
    m.correlation += lagged[k] / pairs / (sum[k] / count) / 3.0;
  }
  m.between_axes = crossed / std::sqrt(sum[0] * sum[1]);
  return m;
}

TEST_F(StrokeNoise, IsWhiteUnlessItIsToWander) {
  std::vector<DigitizedStrokes> many;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    many.push_back(strokes(StrokeVariant::kFull, seed));
  }
  const Moments m = moments(many, 1);
  // 8,000 samples: the standard deviation is known to 0.8 %, a correlation to 0.01.
  for (const double sd_m : m.sd_m) {
    EXPECT_NEAR(sd_m, 0.0003, 0.00001);
  }
  EXPECT_NEAR(m.correlation, 0.0, 0.03);
}

TEST_F(StrokeNoise, WandersAlongAStroke) {
  std::vector<DigitizedStrokes> many;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    many.push_back(strokes(StrokeVariant::kNoisy, seed));
  }
  // 20,000 samples, about one in twenty of which is news.
  const Moments next = moments(many, 1);
  for (const double sd_m : next.sd_m) {
    EXPECT_NEAR(sd_m, 0.0009, 0.00006);
  }
  EXPECT_NEAR(next.correlation, std::exp(-1.0 / 9.0), 0.02);
  EXPECT_NEAR(next.between_axes, 0.0, 0.12);
  EXPECT_NEAR(moments(many, 9).correlation, std::exp(-1.0), 0.10);
}

TEST_F(StrokeNoise, StartsAfreshWithEveryStroke) {
  double lagged = 0.0, sum = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto d = strokes(StrokeVariant::kNoisy, seed);
    for (std::size_t i = 1; i < d.samples.size(); ++i) {
      if (d.samples[i].stroke == d.samples[i - 1].stroke) {
        continue;
      }
      const auto back = d.world_from_vertebra.inverse();
      const Vec3 e = back * d.samples[i].tip - d.samples[i].true_tip;
      const Vec3 before = back * d.samples[i - 1].tip - d.samples[i - 1].true_tip;
      lagged += e.dot(before);
      sum += e.squared_norm();
    }
  }
  EXPECT_NEAR(lagged / sum, 0.0, 0.12);  // 600 pairs of three axes: 0.024
}

TEST_F(StrokeNoise, TakesTwelvePercentOffTheBone) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto d = strokes(StrokeVariant::kOutliers, seed);
    std::size_t off = 0;
    for (const DigitizedSample& s : d.samples) {
      const double distance_m = surface_->nearest(s.true_tip.v)->distance_m;
      if (!s.off_bone) {
        ASSERT_LT(distance_m, 0.00005);
        continue;
      }
      ++off;
      ASSERT_GE(distance_m, 0.00099);
      ASSERT_LE(distance_m, 0.01001);
      ASSERT_FALSE(surface_->contains(s.true_tip.v));
    }
    EXPECT_EQ(off,
              static_cast<std::size_t>(std::lround(0.12 * static_cast<double>(d.samples.size()))));
  }
}

TEST_F(StrokeNoise, TakesThemOffInBurstsAndOneByOne) {
  double in_bursts = 0.0, all = 0.0, farther = 0.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto d = strokes(StrokeVariant::kOutliers, seed);
    for (std::size_t i = 0; i < d.samples.size();) {
      std::size_t end = i;
      while (end < d.samples.size() && d.samples[end].off_bone &&
             d.samples[end].stroke == d.samples[i].stroke) {
        farther += surface_->nearest(d.samples[end++].true_tip.v)->distance_m > 0.005 ? 1.0 : 0.0;
      }
      all += static_cast<double>(end - i);
      if (end - i >= 5) {
        in_bursts += static_cast<double>(end - i);
      }
      i = std::max(end, i + 1);
    }
  }
  EXPECT_GT(in_bursts / all, 0.55);
  EXPECT_LT(in_bursts / all, 0.80);
  EXPECT_GT(farther / all, 0.2);
}

TEST_F(StrokeNoise, LeavesTheOthersOnTheBone) {
  for (const StrokeVariant variant : {StrokeVariant::kFull, StrokeVariant::kPartial,
                                      StrokeVariant::kNoisy, StrokeVariant::kSparse}) {
    for (const DigitizedSample& s : strokes(variant, 2).samples) {
      ASSERT_FALSE(s.off_bone);
    }
  }
}

}  // namespace
}  // namespace orthonav::test
