#include "hal/api/map_watch.h"

#include <gmock/gmock.h>

#include <cmath>

namespace orthonav {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Timestamp pair_time(int n) { return Timestamp(Duration(33'333'333) * n); }

/// A head that moves: metres and radians a second.
Transform<World, Rig> head_at(int n, double m_s = 0.5, double rad_s = 1.2) {
  const double t = n / 30.0;
  return {rotation_from_vector({0.0, rad_s * t, 0.2}), {m_s * t, 1.6, 0.1}};
}

TEST(MapWatch, LetsAHeadMove) {
  MapWatch watch;
  for (int n = 0; n < 300; ++n) {
    if (n % 17 == 5) {
      continue;  // gaps
    }
    EXPECT_FALSE(watch.moved(pair_time(n), head_at(n))) << n;
  }
}

TEST(MapWatch, LetsAHeadStartAndStopAsFastAsHeadsDo) {
  MapWatch watch;
  double speed = 0.0;
  double place = 0.0;
  for (int n = 0; n < 60; ++n) {
    speed += n % 20 < 5 ? 20.0 / 30.0 : (n % 20 >= 15 ? -20.0 / 30.0 : 0.0);
    if (std::abs(speed) > 1.5) {
      speed = std::copysign(1.5, speed);
    }
    place += speed / 30.0;
    EXPECT_FALSE(watch.moved(pair_time(n), {Mat3::identity(), {place, 0, 0}})) << n;
  }
}

TEST(MapWatch, FindsAJumpOnceAndGoesOn) {
  const Transform<World, World> moved(rotation_from_vector({0, 0.3, 0}), {0.06, 0, 0});
  MapWatch watch;
  int moves = 0;
  for (int n = 0; n < 60; ++n) {
    moves += watch.moved(pair_time(n), n < 30 ? head_at(n) : moved * head_at(n)) ? 1 : 0;
  }
  EXPECT_EQ(moves, 1);
}

TEST(MapWatch, FindsAShiftOfSixCentimetres) {
  for (const double translation_m : {0.06, 0.02}) {
    MapWatch watch;
    int moves = 0;
    for (int n = 0; n < 20; ++n) {
      moves += watch.moved(pair_time(n), {Mat3::identity(), {n < 10 ? 0.0 : translation_m, 0, 0}});
    }
    EXPECT_EQ(moves, translation_m > 0.05 ? 1 : 0) << "the smaller one may be a head's start";
  }
}

/// A head that moves on steadily while stamps leap: the poses show that the map stayed.
TEST(MapWatch, IsNotMovedByAStamp) {
  MapWatch watch;
  for (int n = 0; n < 300; ++n) {
    const bool back = n % 7 == 6;
    EXPECT_FALSE(watch.moved(pair_time(n) - milliseconds(back ? 100 : 0), head_at(n))) << n;
  }
}

TEST(MapWatch, VouchesForNothingAfterALongSilence) {
  for (const int silence_s : {9, 11}) {
    MapWatch watch;
    EXPECT_FALSE(watch.moved(pair_time(0), head_at(0)));
    EXPECT_EQ(watch.moved(pair_time(0) + seconds(silence_s), head_at(0)), silence_s > 10);
  }
}

/// A server repeats every fifth stamp with the next picture, or stamps a picture as if it were the
/// one after it, and then repeats that.
TEST(MapWatch, IsNotMovedByStampsThatRepeat) {
  const auto moves = [](int early_by, bool jumps) {
    MapWatch watch;
    int count = 0;
    for (int n = 0; n < 100; ++n) {
      const int stamp = n % 5 == 3 ? n - 1 : (n % 5 == 2 ? n - 1 + early_by : n);
      const Transform<World, World> map(Mat3::identity(), {jumps && n >= 53 ? 0.423 : 0.0, 0, 0});
      count += watch.moved(pair_time(stamp), map * head_at(n, 1.5, 1.2)) ? 1 : 0;
    }
    return count;
  };
  for (const int early_by : {0, 1}) {
    EXPECT_EQ(moves(early_by, false), 0) << early_by;
    EXPECT_EQ(moves(early_by, true), 1) << "the twin: " << early_by;
  }
}

/// Two pictures of a head in brisk motion, stamped almost alike, show no speed of a head.
TEST(MapWatch, IsNotMovedByStampsThatAreAlmostAlike) {
  for (const auto apart : {Duration(100), Duration(milliseconds(1)), Duration(milliseconds(13))}) {
    MapWatch watch;
    for (int n = 0; n < 100; ++n) {
      const Timestamp stamp = n % 5 == 3 ? pair_time(n - 1) + apart : pair_time(n);
      EXPECT_FALSE(watch.moved(stamp, head_at(n, 1.0, 1.2))) << n << ", " << apart.count();
    }
  }
}

}  // namespace
}  // namespace orthonav
