#include "base/time.h"

#include <gtest/gtest.h>

#include <chrono>
#include <type_traits>

#include "base/tracked.h"

namespace orthonav {
namespace {

// Device time never mixes with wall time.
static_assert(!std::is_convertible_v<std::chrono::system_clock::time_point, Timestamp>);
static_assert(!std::is_convertible_v<std::chrono::steady_clock::time_point, Timestamp>);
template <class T>
concept SubtractsFromTimestamp = requires(Timestamp t, T other) {
  t - other;
};
static_assert(SubtractsFromTimestamp<Timestamp>);
static_assert(!SubtractsFromTimestamp<std::chrono::steady_clock::time_point>);

TEST(Ticks, CountHundredsOfNanosecondsRoundedDown) {
  EXPECT_EQ(ticks_100ns(Timestamp(Duration(1234))), 12);
  EXPECT_EQ(ticks_100ns(Timestamp(Duration(1200))), 12);
  EXPECT_EQ(ticks_100ns(Timestamp(Duration(-1))), -1);
  EXPECT_EQ(ticks_100ns(Timestamp(Duration(-100))), -1);
  EXPECT_EQ(ticks_100ns(Timestamp(Duration(-101))), -2);
  EXPECT_EQ(from_ticks_100ns(12), Timestamp(Duration(1200)));
}

TEST(Ticks, GoThroughFilesAndBack) {
  for (const std::int64_t ticks :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{15555264000333333}, std::int64_t{-7}}) {
    EXPECT_EQ(ticks_100ns(from_ticks_100ns(ticks)), ticks);
  }
}

TEST(Seconds, RoundToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(1.0 / 30.0), Duration(33'333'333));
  EXPECT_EQ(from_seconds(-1.5e-9), Duration(-2));
  EXPECT_EQ(from_seconds(0.4e-9), Duration(0));
  EXPECT_DOUBLE_EQ(seconds(Duration(2'500'000'000)), 2.5);
}

TEST(Tracked, HasAnAgeAndIsLostUnlessSaidOtherwise) {
  Tracked<int> value;
  EXPECT_EQ(value.status, PoseStatus::kLost);
  value.time = Timestamp(Duration(100));
  EXPECT_EQ(value.age(Timestamp(Duration(350))), Duration(250));
}

}  // namespace
}  // namespace orthonav
