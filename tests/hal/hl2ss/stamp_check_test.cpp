#include "hal/hl2ss/stamp_check.h"

#include <gmock/gmock.h>

namespace orthonav::hl2ss::stamp_check_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// Frame `n` of a camera with ticks of this many nanoseconds, stamped too late by this amount.
Status check(StampCheck& stamps, int n, Duration off = {}, std::int64_t tick_ns = 1) {
  const Duration at = Duration(33'333'333) * n;
  return stamps.check(Timestamp(seconds(500)) + at + off,
                      static_cast<std::uint64_t>((seconds(7) + at).count() / tick_ns));
}

TEST(StampCheck, BelievesStampsThatTremble) {
  for (const std::int64_t tick_ns : {1, 100}) {
    StampCheck stamps;
    for (int n = 0; n < 100; ++n) {
      if (n % 7 == 3) {
        continue;  // gaps
      }
      EXPECT_TRUE(check(stamps, n, milliseconds(n % 3 * 2), tick_ns)) << n;
    }
    EXPECT_TRUE(check(stamps, 98, {}, tick_ns)) << "out of order, and right";
  }
}

TEST(StampCheck, RefusesALeapAloneAndSaysWhere) {
  for (const std::int64_t tick_ns : {1, 100}) {
    StampCheck stamps;
    int refused = 0;
    for (int n = 0; n < 300; ++n) {
      const Duration off =
          n % 7 == 6 ? (n % 2 == 0 ? milliseconds(-100) : milliseconds(1000)) : milliseconds(0);
      refused += check(stamps, n, off, tick_ns) ? 0 : 1;
    }
    EXPECT_EQ(refused, 42);
  }
  StampCheck stamps;
  EXPECT_TRUE(check(stamps, 0));
  const Status early = check(stamps, 1, milliseconds(-100));
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().message,
            "stamp 100.0 ms before where the sensor's clock puts it, limit 10.0 ms");
  const Status late = check(stamps, 2, milliseconds(1000));
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, HasSubstr("1000.0 ms after"));
  EXPECT_FALSE(check(stamps, 3, milliseconds(11)));
  EXPECT_TRUE(check(stamps, 3, milliseconds(9))) << "the twin";
}

TEST(StampCheck, BelievesAClockThatWasSet) {
  StampCheck stamps;
  ASSERT_TRUE(check(stamps, 0));
  int refused = 0;
  for (int n = 1; n <= 30; ++n) {
    refused += check(stamps, n, seconds(2)) ? 0 : 1;
  }
  EXPECT_EQ(refused, 19);
}

/// Nothing shows at first that the very first image is wrong, and other wrong ones follow.
TEST(StampCheck, FindsItsWayFromAWrongBeginning) {
  StampCheck stamps;
  EXPECT_TRUE(check(stamps, 0, seconds(-3)));
  int refused = 0;
  for (int n = 1; n <= 100; ++n) {
    refused += check(stamps, n, n % 3 == 0 ? milliseconds(100 + n) : milliseconds(0)) ? 0 : 1;
  }
  EXPECT_LT(refused, 60 + 40 / 3 + 2) << "two seconds of all, then every third";
  EXPECT_TRUE(check(stamps, 101));
}

TEST(StampCheck, SurvivesTicksFromNowhere) {
  StampCheck stamps;
  ASSERT_TRUE(check(stamps, 0));
  EXPECT_FALSE(stamps.check(Timestamp(seconds(500)), ~0ull >> 1U));
  EXPECT_TRUE(check(stamps, 1));
}

}  // namespace
}  // namespace orthonav::hl2ss::stamp_check_test
