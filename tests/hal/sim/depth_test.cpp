#include <gmock/gmock.h>

#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/sim/sim_headset.h"
#include "tests/support/bare_room.h"

namespace orthonav::sim {
namespace {

SimOptions with_depth(DepthStream stream) {
  SimOptions options;
  options.seed = 5;
  options.error_model = ErrorModel::perfect();
  options.depth_errors = DepthErrors::none();
  options.render = false;
  options.limit_s = 1.0;
  options.depth = {stream};
  return options;
}

std::unique_ptr<SimHeadset> opened(const SimOptions& options) {
  auto headset = SimHeadset::open(orthonav::test::bare_room(), options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? std::move(*headset) : nullptr;
}

/// The first depth picture after so many pairs.
DepthFrame picture_after(SimHeadset& headset, int pairs) {
  StereoFrame pair;
  for (int i = 0; i < pairs; ++i) {
    EXPECT_EQ(*headset.cameras()->next(pair), Next::kFrame);
  }
  DepthFrame frame;
  EXPECT_EQ(*headset.depth_cameras().front()->next(frame), Next::kFrame);
  return frame;
}

/// By how much each measured point lies beyond the table's top, along its ray; points farther off
/// than `elsewhere_m` are of a tool, or of the floor.
std::vector<double> beyond_table_m(SimHeadset& headset, const DepthFrame& frame,
                                   double elsewhere_m = 0.03) {
  const DepthCalibration& camera = headset.depth_cameras().front()->calibration();
  const auto room_from_sensor = headset.world_from_room().inverse() * *frame.world_from_rig *
                                camera.sensor_from_rig.inverse();
  std::vector<double> beyond;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto point = camera.point_at(x, y, frame.range_mm.at(x, y));
      if (!point) {
        continue;
      }
      const Vec3 eye = room_from_sensor.translation();
      const Vec3 ray = (room_from_sensor * *point).v - eye;
      const double range_m = ray.norm();
      const double table_m = -eye.y / (ray.y / range_m);
      if (std::abs(range_m - table_m) < elsewhere_m) {
        beyond.push_back(range_m - table_m);
      }
    }
  }
  return beyond;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) {
    sum += v;
  }
  return sum / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double v : values) {
    squares += (v - mean) * (v - mean);
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST(SimDepth, WithoutErrorsLiesOnTheTableButForRounding) {
  // Half a millimetre, and single precision of the rays within a metre.
  constexpr double kRoundingM = 0.00052;
  for (const DepthStream stream : {DepthStream::kAhat, DepthStream::kLongThrow}) {
    const auto headset = opened(with_depth(stream));
    ASSERT_NE(headset, nullptr);
    const DepthFrame frame = picture_after(*headset, 10);
    ASSERT_TRUE(frame.world_from_rig.has_value());
    const auto beyond = beyond_table_m(*headset, frame, 0.004);
    EXPECT_GT(beyond.size(), frame.range_mm.pixels.size() / 4) << name_of(stream);
    std::size_t far_off = 0;
    for (const double off_m : beyond) {
      far_off += std::abs(off_m) > kRoundingM ? 1 : 0;
    }
    // The tools' ends come near the table, and so does the floor where the phase wraps.
    EXPECT_LT(far_off, beyond.size() / 100) << name_of(stream);
  }
}

/// Bias and noise as documented: 3 to 10 mm, more at oblique incidence, 1 to 3 mm.
TEST(SimDepth, ErrsAsATimeOfFlightCameraDoes) {
  SimOptions options = with_depth(DepthStream::kAhat);
  options.depth_errors = {};
  const auto ahat = opened(options);
  const auto near = beyond_table_m(*ahat, picture_after(*ahat, 10));
  EXPECT_GT(mean_of(near), 0.004);
  EXPECT_LT(mean_of(near), 0.010);
  EXPECT_GT(sd_of(near), 0.001);
  EXPECT_LT(sd_of(near), 0.005);
  options.depth = {DepthStream::kLongThrow};
  const auto long_throw = opened(options);
  const auto far = beyond_table_m(*long_throw, picture_after(*long_throw, 10));
  EXPECT_GT(mean_of(far), 1.3 * mean_of(near));
}

TEST(SimDepth, OfAhatWrapsAndOfLongThrowDoesNot) {
  std::uint16_t farthest[2] = {0, 0};
  for (const DepthStream stream : {DepthStream::kAhat, DepthStream::kLongThrow}) {
    const auto headset = opened(with_depth(stream));
    const DepthFrame frame = picture_after(*headset, 10);
    for (const std::uint16_t mm : frame.range_mm.pixels) {
      farthest[stream == DepthStream::kAhat ? 0 : 1] =
          std::max(farthest[stream == DepthStream::kAhat ? 0 : 1], mm);
    }
  }
  EXPECT_LE(farthest[0], 1055);
  EXPECT_GT(farthest[1], 1200) << "the floor";
}

TEST(SimDepth, IsTheSameForTheSameSeedAndAnotherForAnother) {
  SimOptions options = with_depth(DepthStream::kLongThrow);
  options.depth_errors = {};
  const auto first = opened(options);
  const auto second = opened(options);
  options.seed = 6;
  const auto third = opened(options);
  const DepthFrame a = picture_after(*first, 12);
  const DepthFrame b = picture_after(*second, 12);
  EXPECT_EQ(a.time, b.time);
  EXPECT_TRUE(a.range_mm == b.range_mm);
  EXPECT_TRUE(a.brightness == b.brightness);
  EXPECT_FALSE(a.range_mm == picture_after(*third, 12).range_mm);
}

/// All that a caller gets who asks after every so many pairs, until the stream ends.
std::vector<DepthFrame> pictures_of(SimHeadset& headset, int pairs_a_time = 1) {
  std::vector<DepthFrame> pictures;
  StereoFrame pair;
  DepthFrame frame;
  for (int pairs = 1; *headset.cameras()->next(pair) == Next::kFrame; ++pairs) {
    while (pairs % pairs_a_time == 0 &&
           *headset.depth_cameras().front()->next(frame) == Next::kFrame) {
      EXPECT_LE(frame.time, pair.time);
      pictures.push_back(frame);
    }
  }
  return pictures;
}

/// Its own clock ticks at 45 Hz, whatever the pairs' rate: 45 pictures in the second of 30 pairs.
TEST(SimDepth, OfAhatComesAtItsOwnRate) {
  const auto headset = opened(with_depth(DepthStream::kAhat));
  const auto pictures = pictures_of(*headset);
  ASSERT_EQ(pictures.size(), 45u);
  constexpr double kTickS = 1e-7;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    EXPECT_EQ(pictures[i].sequence, pictures[i - 1].sequence + 1);
    EXPECT_NEAR(seconds(pictures[i].time - pictures[i - 1].time), 1.0 / 45.0, kTickS);
  }
}

/// Where the head was between two pairs, and what was seen from there.
TEST(SimDepth, BetweenTwoPairsIsPosedAsTheHeadMoves) {
  SimOptions options = with_depth(DepthStream::kAhat);
  options.limit_s = 0.2;
  options.error_model.head_sway_m = 0.012;
  options.error_model.head_sway_rad = 0.03;
  const auto headset = opened(options);
  std::map<Timestamp, Transform<World, Rig>> pairs;
  StereoFrame pair;
  DepthFrame frame;
  int between = 0;
  while (*headset->cameras()->next(pair) == Next::kFrame) {
    pairs[pair.time] = *pair.world_from_rig;
    while (*headset->depth_cameras().front()->next(frame) == Next::kFrame) {
      const auto after = pairs.lower_bound(frame.time);
      if (after == pairs.begin()) {
        continue;
      }
      const auto before = std::prev(after);
      const double part =
          seconds(frame.time - before->first) / seconds(after->first - before->first);
      const auto expected = interpolated(before->second, after->second, part);
      EXPECT_LT((frame.world_from_rig->translation() - expected.translation()).norm(), 1e-9);
      EXPECT_NE(frame.world_from_rig->translation(), before->second.translation());
      const auto beyond = beyond_table_m(*headset, frame, 0.004);
      ASSERT_GT(beyond.size(), frame.range_mm.pixels.size() / 4);
      EXPECT_NEAR(mean_of(beyond), 0.0, 0.0002);
      between += part < 1.0 ? 1 : 0;
    }
  }
  EXPECT_EQ(between, 5) << "of nine: one is before the first pair, three fall on pairs";
}

TEST(SimDepth, WaitsForACallerForTwoPairsAtMost) {
  const auto headset = opened(with_depth(DepthStream::kAhat));
  const auto pictures = pictures_of(*headset, 10);
  std::vector<std::int64_t> numbers;
  for (const DepthFrame& picture : pictures) {
    numbers.push_back(picture.sequence);
  }
  EXPECT_THAT(numbers, ::testing::ElementsAre(13, 14, 15, 28, 29, 30, 43, 44, 45));
}

TEST(SimDepth, EndsWithThePairs) {
  const auto headset = opened(with_depth(DepthStream::kLongThrow));
  DepthCamera& camera = *headset->depth_cameras().front();
  StereoFrame pair;
  DepthFrame frame;
  EXPECT_EQ(*camera.next(frame), Next::kNone) << "before the first pair";
  int pictures = 0;
  while (*headset->cameras()->next(pair) == Next::kFrame) {
    const auto next = camera.next(frame);
    ASSERT_TRUE(next.ok()) << next.error().message;
    if (*next == Next::kFrame) {
      ++pictures;
      EXPECT_LE(frame.time, pair.time);
    }
  }
  EXPECT_EQ(pictures, 5);
  EXPECT_EQ(*camera.next(frame), Next::kEnd);
}

TEST(SimDepth, OfAKindThatItHasNotIsRefused) {
  SimOptions options = with_depth(DepthStream::kShortThrow);
  EXPECT_FALSE(SimHeadset::open(orthonav::test::bare_room(), options).ok());
  options.depth = {DepthStream::kAhat, DepthStream::kAhat};
  EXPECT_FALSE(SimHeadset::open(orthonav::test::bare_room(), options).ok());
}

}  // namespace
}  // namespace orthonav::sim
