#include "engine/live/heartbeats.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "engine/live/frame_loop.h"
#include "hal/fake/scripted.h"

namespace orthonav::engine {
namespace {

TEST(Heartbeats, NameAPartOnceItIsAtOneThingForLongerThanTheLimit) {
  fake::ManualClock clock;
  Heartbeats beats(clock, kStallAfter);
  clock.advance(std::chrono::hours(1));
  EXPECT_EQ(beats.tracking_stalled(), std::nullopt) << "who rests does not hang";
  beats.begins(Part::kCamera);
  clock.advance(kStallAfter);
  EXPECT_EQ(beats.tracking_stalled(), std::nullopt);
  clock.advance(Duration(1));
  EXPECT_EQ(beats.tracking_stalled(), Part::kCamera);
  EXPECT_FALSE(beats.drawing_stalled());
  beats.ends(Part::kCamera);
  EXPECT_EQ(beats.tracking_stalled(), std::nullopt);
  beats.begins(Part::kRenderer);
  clock.advance(kStallAfter + Duration(1));
  EXPECT_TRUE(beats.drawing_stalled());
  EXPECT_EQ(beats.tracking_stalled(), std::nullopt);
}

TEST(Heartbeats, NameWhoIsWaitedForRatherThanWhoWaits) {
  fake::ManualClock clock;
  Heartbeats beats(clock, kStallAfter);
  const Working tracker(&beats, Part::kTracker);
  clock.advance(kStallAfter);
  {
    const Working coach(&beats, Part::kCoach);
    clock.advance(Duration(1));
    EXPECT_EQ(beats.tracking_stalled(), Part::kCoach);
  }
  EXPECT_EQ(beats.tracking_stalled(), Part::kTracker);
}

TEST(Heartbeats, NameATaskBesideTheTrackerWithoutNamingTheTracker) {
  fake::ManualClock clock;
  Heartbeats beats(clock, kStallAfter);
  beats.begins_beside(Part::kCoach);
  clock.advance(kTaskStallsAfter);
  EXPECT_EQ(beats.stalled_beside(), std::nullopt);
  clock.advance(Duration(1));
  EXPECT_EQ(beats.stalled_beside(), Part::kCoach);
  EXPECT_EQ(beats.tracking_stalled(), std::nullopt);
  EXPECT_EQ(beats.tracking(), std::nullopt) << "an exception now is not the coach's";
  beats.ends_beside(Part::kCoach);
  EXPECT_EQ(beats.stalled_beside(), std::nullopt);
}

TEST(Heartbeats, KeepWhatAnExceptionLeft) {
  fake::ManualClock clock;
  Heartbeats beats(clock, kStallAfter);
  try {
    const Working tracker(&beats, Part::kTracker);
    const Working voice(&beats, Part::kVoice);
    throw std::runtime_error("x");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(beats.tracking(), Part::kVoice);
}

}  // namespace
}  // namespace orthonav::engine
