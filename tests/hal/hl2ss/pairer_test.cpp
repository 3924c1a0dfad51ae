#include "hal/hl2ss/pairer.h"

#include <gtest/gtest.h>

namespace orthonav::hl2ss::pairer_test {
namespace {

using std::chrono::milliseconds;

CameraImage image_of(std::uint64_t sensor_ticks) {
  CameraImage image;
  image.sensor_ticks = sensor_ticks;
  return image;
}

/// Adds an image of `ticks`; the ticks of the pair that it makes, or 0.
std::uint64_t add(Pairer& pairer, CameraSide side, std::uint64_t ticks) {
  CameraImage image = image_of(ticks);
  const auto pair = pairer.add(side, image);
  return pair ? pair->left.sensor_ticks : 0;
}

TEST(Pairer, PairsBySensorTicksWhicheverComesFirst) {
  Pairer pairer;
  EXPECT_EQ(add(pairer, CameraSide::kLeft, 10'000'000), 0u);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 43'333'333), 0u);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 10'000'000), 10'000'000u) << "out of order on its side";
  EXPECT_EQ(add(pairer, CameraSide::kLeft, 43'333'333), 43'333'333u);
  EXPECT_EQ(pairer.unpaired(), 0);
}

TEST(Pairer, NeverGoesBackAndNeverMixesMoments) {
  Pairer pairer;
  add(pairer, CameraSide::kLeft, 100'000'000);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 101'000'001), 0u) << "1 ms apart and a little";
  add(pairer, CameraSide::kLeft, 133'333'333);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 133'333'333), 133'333'333u);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 100'000'000), 0u) << "its moment is over";
  EXPECT_EQ(pairer.unpaired(), 3);
}

TEST(Pairer, HoldsNoMoreThanAFew) {
  Pairer pairer;
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    add(pairer, CameraSide::kLeft, i * 33'333'333);
  }
  EXPECT_EQ(pairer.unpaired(), 996);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 1000 * 33'333'333ull), 1000 * 33'333'333ull);
}

TEST(Pairer, IsNotBlockedByTicksFromNowhere) {
  Pairer pairer;
  for (std::uint64_t i = 0; i < 10; ++i) {
    add(pairer, CameraSide::kLeft, (1ull << 63) + i * 33'333'333);
  }
  add(pairer, CameraSide::kLeft, 50'000'000);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 50'000'000), 50'000'000u);
}

TEST(Pairer, TakesTheFewNanosecondsBetweenRealCameras) {
  Pairer pairer;
  add(pairer, CameraSide::kLeft, 100'000'000);
  EXPECT_EQ(add(pairer, CameraSide::kRight, 100'900'000), 100'000'000u) << "within 1 ms";
}

/// Where ticks are of 100 ns, 1,000,000 of them are three frames.
TEST(Pairer, NeverMixesMomentsOfAServerWithCoarserTicks) {
  Pairer pairer;
  CameraImage left = image_of(100'000);
  CameraImage right = image_of(433'333);
  right.time = Timestamp(milliseconds(33));
  EXPECT_FALSE(pairer.add(CameraSide::kLeft, left));
  EXPECT_FALSE(pairer.add(CameraSide::kRight, right));
  CameraImage same = image_of(433'333);
  same.time = Timestamp(milliseconds(32));
  EXPECT_TRUE(pairer.add(CameraSide::kLeft, same)) << "the twin";
}

}  // namespace
}  // namespace orthonav::hl2ss::pairer_test
