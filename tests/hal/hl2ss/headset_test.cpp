#include <gmock/gmock.h>

#include <thread>

#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::hl2ss {
namespace {

using orthonav::test::next_pair;
using orthonav::test::paced;
using orthonav::test::ServedRoom;

sim::SimOptions short_session(double limit_s) {
  sim::SimOptions sim;
  sim.seed = 5;
  sim.limit_s = limit_s;
  return sim;
}

/// Every pair of a direct run comes over the wire with the same pixels, times and poses.
TEST(Headset, RawImagesComeAsTheyWere) {
  // A pose goes as 16 single-precision numbers: 2^-24 of up to 2 m.
  constexpr double kSingle = 2e-7;
  const sim::SimOptions sim = short_session(0.5);
  ServedRoom room(sim, paced());
  const auto headset = room.connect();
  ASSERT_NE(headset, nullptr);
  auto direct = sim::SimHeadset::open(orthonav::test::bare_room(), sim);
  ASSERT_TRUE(direct.ok());
  StereoFrame frame;
  StereoFrame expected;
  int pairs = 0;
  for (; next_pair(*headset, frame) == Next::kFrame; ++pairs) {
    ASSERT_EQ(*(*direct)->cameras()->next(expected), Next::kFrame);
    EXPECT_EQ(frame.time, expected.time);
    EXPECT_TRUE(frame.left == expected.left);
    EXPECT_TRUE(frame.right == expected.right);
    ASSERT_TRUE(frame.world_from_rig.has_value());
    EXPECT_LT((frame.world_from_rig->translation() - expected.world_from_rig->translation()).norm(),
              kSingle);
    EXPECT_LT(
        rotation_angle_rad(frame.world_from_rig->rotation(), expected.world_from_rig->rotation()),
        kSingle);
    EXPECT_EQ(headset->clock().now(), (*direct)->clock().now());
  }
  EXPECT_EQ(pairs, 15);
}

TEST(Headset, H264ImagesComeWithinTheCodecsNoise) {
  const sim::SimOptions sim = short_session(0.5);
  ServedRoom room(sim, paced());
  const auto headset = room.connect(VideoProfile::kH264Base);
  ASSERT_NE(headset, nullptr);
  auto direct = sim::SimHeadset::open(orthonav::test::bare_room(), sim);
  ASSERT_TRUE(direct.ok());
  StereoFrame frame;
  StereoFrame expected;
  int pairs = 0;
  for (; next_pair(*headset, frame) == Next::kFrame; ++pairs) {
    ASSERT_EQ(*(*direct)->cameras()->next(expected), Next::kFrame);
    EXPECT_EQ(frame.time, expected.time);
    double squares = 0.0;
    for (std::size_t i = 0; i < frame.left.pixels.size(); ++i) {
      const double off = double(frame.left.pixels[i]) - double(expected.left.pixels[i]);
      squares += off * off;
    }
    // 12 Mbit/s for 30 pictures a second; another picture than the right one is 20 and more off.
    EXPECT_LT(std::sqrt(squares / double(frame.left.pixels.size())), 6.0) << pairs;
  }
  EXPECT_EQ(pairs, 15);
}

}  // namespace
}  // namespace orthonav::hl2ss
