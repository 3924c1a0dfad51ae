#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "nav/published/corner_filter.h"

namespace orthonav::nav::published {
namespace {

constexpr double kFrameS = 1.0 / 30.0;

Timestamp at_frame(int k) { return Timestamp(from_seconds(k * kFrameS)); }

// A 50 px tag whose first corner is at the given place.
CornerFilter::Corners tag_at(Vec2 place) {
  return {place, place + Vec2{50, 0}, place + Vec2{50, -50}, place + Vec2{0, -50}};
}

CornerFilter::Corners noisy(CornerFilter::Corners corners, double sd_px, Random& random) {
  for (Vec2& c : corners) {
    c = c + Vec2{random.normal(0, sd_px), random.normal(0, sd_px)};
  }
  return corners;
}

double rms_px(const CornerFilter::Corners& a, const CornerFilter::Corners& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += (a[i] - b[i]).dot(a[i] - b[i]);
  }
  return std::sqrt(sum / 8.0);
}

TEST(CornerFilter, QuietensATagThatIsStillAndKnowsHowMuch) {
  Random random(1);
  CornerFilter filter;
  const auto truth = tag_at({100, 200});
  double squared = 0.0;
  double claimed = 0.0;
  constexpr int kFrames = 3000;
  for (int k = 0; k < kFrames; ++k) {
    filter.update(noisy(truth, 0.1, random), at_frame(k));
    if (k < 20) {
      continue;
    }
    squared += std::pow(rms_px(filter.corners_px(), truth), 2);
    claimed += filter.variance_px2();
  }
  // The filter's claim covers what is left, and is no blanket figure.
  EXPECT_LT(std::sqrt(squared / kFrames), 0.1 * 0.94);
  EXPECT_LT(squared, claimed * 1.1);
  EXPECT_GT(squared, claimed * 0.8);
}

TEST(CornerFilter, DoesNotLagBehindConstantVelocity) {
  CornerFilter filter;
  for (int k = 0; k < 30; ++k) {
    const auto truth = tag_at({100 + 200.0 * k * kFrameS, 200 - 90.0 * k * kFrameS});
    filter.update(truth, at_frame(k));
    if (k <= 5) {
      continue;
    }
    EXPECT_LT(rms_px(filter.corners_px(), truth), 0.02) << "frame " << k;
  }
}

/// How far the filter lags behind strokes of 25 px once a second (up to 1000 px/s²).
double lag_px(const CornerFilterOptions& options) {
  CornerFilter filter(options);
  double worst = 0.0;
  for (int k = 0; k < 90; ++k) {
    const auto truth = tag_at({300 + 25 * std::sin(2 * 3.141592653589793 * k * kFrameS), 200});
    filter.update(truth, at_frame(k));
    if (k > 5) {
      worst = std::max(worst, rms_px(filter.corners_px(), truth));
    }
  }
  return worst;
}

TEST(CornerFilter, FollowsAStrokeWithinTheNoiseOfOneMeasurement) {
  const CornerFilterOptions options;
  EXPECT_LT(lag_px(options), options.noise_px);
  CornerFilterOptions slower;
  slower.acceleration_px2_per_s3 /= 5.0;
  EXPECT_GT(lag_px(slower), 2.0 * options.noise_px);
}

TEST(CornerFilter, PredictsAlongTheVelocityWithGrowingDoubt) {
  CornerFilter filter;
  for (int k = 0; k < 30; ++k) {
    filter.update(tag_at({100.0 + 3 * k, 200}), at_frame(k));
  }
  const auto next = filter.predicted(at_frame(30));
  EXPECT_LT(rms_px(next.corners_px, tag_at({190, 200})), 0.05);
  const auto later = filter.predicted(at_frame(33));
  EXPECT_LT(rms_px(later.corners_px, tag_at({199, 200})), 0.2);
  EXPECT_GT(later.sd_px, next.sd_px);
  EXPECT_GT(next.sd_px, 0.0);
}

TEST(CornerFilter, StartsAfreshAfterAJump) {
  CornerFilter filter;
  for (int k = 0; k < 10; ++k) {
    filter.update(tag_at({100, 200}), at_frame(k));
  }
  filter.update(tag_at({300, 220}), at_frame(10));
  EXPECT_EQ(rms_px(filter.corners_px(), tag_at({300, 220})), 0.0);
  // No velocity is made of the jump.
  EXPECT_LT(rms_px(filter.predicted(at_frame(11)).corners_px, tag_at({300, 220})), 1e-9);
}

TEST(CornerFilter, StartsAfreshWhenTimeStandsStillOrGoesBack) {
  for (const int k : {10, 5}) {
    CornerFilter filter;
    for (int i = 0; i <= 10; ++i) {
      filter.update(tag_at({100, 200}), at_frame(i));
    }
    filter.update(tag_at({105, 200}), at_frame(k));
    EXPECT_EQ(filter.time(), at_frame(k));
    EXPECT_EQ(rms_px(filter.corners_px(), tag_at({105, 200})), 0.0);
  }
}

TEST(CornerFilter, IsDeadUntilItSeesSomethingAndAfterStop) {
  CornerFilter filter;
  EXPECT_FALSE(filter.alive());
  filter.update(tag_at({100, 200}), at_frame(0));
  EXPECT_TRUE(filter.alive());
  filter.stop();
  EXPECT_FALSE(filter.alive());
}

}  // namespace
}  // namespace orthonav::nav::published
