// A headset whose cameras, poses or clock stand still or leap, as the stand-in does on request:
// what comes out of the headset's side.
#include <gmock/gmock.h>

#include "hal/api/as_headset.h"
#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::hl2ss::frozen_test {
namespace {

using orthonav::test::bare_room;
using orthonav::test::black_session;
using orthonav::test::next_pair;
using orthonav::test::paced;
using orthonav::test::ServedRoom;
using orthonav::test::wait_until;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::Not;

sim::SimOptions seen(int pairs) {
  sim::SimOptions sim;
  sim.seed = 5;
  sim.limit_s = (pairs + 0.5) / 30.0;
  return sim;
}

/// Of each pair: why it was not passed on.
using Outcome = std::vector<std::optional<Repeated>>;

Outcome outcome_of(const sim::SimOptions& sim, const Faults& faults, VideoProfile profile) {
  ServerOptions options = paced();
  options.faults = faults;
  ServedRoom room(sim, options);
  const auto headset = room.connect(profile);
  Outcome outcome;
  StereoFrame frame;
  EXPECT_TRUE(wait_until([&] {
    const auto next = headset->cameras()->next(frame);
    if (next && *next == Next::kEnd) {
      return true;
    }
    if (!next || *next == Next::kFrame) {
      EXPECT_TRUE(next.ok() || frame.repeats) << next.error().message;
      outcome.push_back(frame.repeats);
    }
    return false;
  }));
  return outcome;
}

constexpr std::nullopt_t kGood = std::nullopt;

/// The first pair of each is good, the one after the last is not trusted yet.
TEST(Frozen, PicturesOfEitherCameraAndPosesAreRefusedByName) {
  Faults faults;
  faults.freeze_left = 4;
  faults.freeze_right = 9;
  faults.freeze_poses = 14;
  faults.lasting = 4;
  using enum Repeated;
  const Outcome expected = {kGood,         kGood,         kGood,         kGood,         kGood,
                            kLeftPicture,  kLeftPicture,  kLeftPicture,  kLeftPicture,  kGood,
                            kRightPicture, kRightPicture, kRightPicture, kRightPicture, kGood,
                            kHeadPose,     kHeadPose,     kHeadPose,     kHeadPose,     kGood};
  EXPECT_THAT(outcome_of(seen(20), faults, VideoProfile::kRaw), ElementsAreArray(expected));
}

/// Coded again and again, a picture differs each time, most in the first frames and with each key
/// frame (here the 30th). Live pictures before and after are none of it.
TEST(Frozen, PicturesAreRefusedHoweverTheyAreCodedAnew) {
  Faults faults;
  faults.freeze_pictures = 8;
  faults.lasting = 26;
  Outcome expected(40, std::nullopt);
  std::fill(expected.begin() + 9, expected.begin() + 35, Repeated::kBothPictures);
  EXPECT_THAT(outcome_of(seen(40), faults, VideoProfile::kH264Base), ElementsAreArray(expected));
}

/// A perfect room at rest says of itself that it has no noise, also over the network.
TEST(Frozen, IsNothingThatAPerfectSimulationDoesByItself) {
  sim::SimOptions sim = seen(5);
  sim.error_model = sim::ErrorModel::perfect();
  sim.render = false;
  EXPECT_THAT(outcome_of(sim, {}, VideoProfile::kRaw), ElementsAreArray(Outcome(5, std::nullopt)));
  sim.error_model = {};
  EXPECT_THAT(outcome_of(sim, {.freeze_poses = 3}, VideoProfile::kRaw),
              ElementsAreArray(Outcome{kGood, kGood, kGood, kGood, Repeated::kHeadPose}))
      << "but its head is not perfect";
}

/// The fault that a tracker has to notice: left and right are of different moments.
TEST(OneCamerasStamps, ShiftedByAPairMakePairsOfTwoMoments) {
  ServerOptions options = paced();
  options.faults.shift_right = 4;
  const sim::SimOptions sim = seen(9);
  ServedRoom room(sim, options);
  const auto headset = room.connect();
  auto direct = *sim::SimHeadset::open(bare_room(), sim);
  StereoFrame frame;
  StereoFrame before;
  StereoFrame expected;
  int shifted = 0;
  while (next_pair(*headset, frame) == Next::kFrame) {
    while (expected.time < frame.time) {
      std::swap(before, expected);
      ASSERT_EQ(*direct->cameras()->next(expected), Next::kFrame);
    }
    EXPECT_TRUE(frame.left == expected.left);
    shifted += frame.right == before.right ? 1 : 0;
    EXPECT_TRUE(frame.right == (expected.sequence > 5 ? before.right : expected.right));
  }
  EXPECT_EQ(shifted, 4) << "the fifth pair repeats a right picture, and the last four are shifted";
}

/// At 60 pairs a second, so that the clock is believed after a third of a second.
struct AfterSetting {
  int pairs = 0;
  std::vector<std::string> told;
  Duration oldest{};  ///< age of a pair by the headset's clock when it was taken
  std::int64_t restarts = 0;
  std::int64_t map_epoch = 0;
  bool true_times = true;
};
AfterSetting set_back(Duration by) {
  sim::SimOptions sim = black_session(1.4);
  sim.frame_rate_hz = 60.0;
  sim.pace = sim::Pace::kRealtime;
  ServerOptions options;
  options.faults.clock_back = 20;
  options.faults.clock_back_by = by;
  ServedRoom room(sim, options);
  const auto headset = room.connect();
  AfterSetting after;
  if (!headset) {
    return after;
  }
  StereoFrame frame;
  EXPECT_TRUE(wait_until([&] {
    const auto next = headset->cameras()->next(frame);
    if (!next) {
      after.told.push_back(next.error().message);
      return false;
    }
    if (*next == Next::kFrame) {
      ++after.pairs;
      after.oldest = std::max(after.oldest, headset->clock().now() - frame.time);
      after.map_epoch = frame.map_epoch;
      const double number = seconds(frame.time.time_since_epoch()) * 60.0;
      after.true_times = after.true_times && std::abs(number - std::round(number)) < 1e-3;
    }
    return *next == Next::kEnd;
  }));
  after.restarts = headset->statistics().clock_restarts;
  return after;
}

TEST(AClockThatWasSet, IsToldAndPairsGoOnAtTheirTimes) {
  for (const bool back : {true, false}) {
    const AfterSetting after = set_back(milliseconds(back ? 503 : -503));
    EXPECT_GE(after.pairs, 25) << "of 84, of which 20 and a little more are doubted";
    ASSERT_EQ(after.told.size(), 1u);
    EXPECT_THAT(after.told[0], HasSubstr(std::string("the headset's clock was set ") +
                                         (back ? "back" : "forward") + " by 0.503 s"));
    // Our clock never goes back: after a leap forward it stands until time has caught up.
    EXPECT_LT(after.oldest, milliseconds(back ? 300 : 800)) << "not 0.503 s older than they are";
    EXPECT_EQ(after.restarts, 1);
    EXPECT_EQ(after.map_epoch, 0);
    EXPECT_TRUE(after.true_times);
  }
}

/// The twin within the limit for stamps: nothing to tell, and ages are off by no more.
TEST(AClockThatWasSet, ByLessThanStampsTrembleIsNothing) {
  const AfterSetting after = set_back(milliseconds(4));
  EXPECT_GE(after.pairs, 25);
  EXPECT_TRUE(after.told.empty());
  EXPECT_EQ(after.restarts, 0);
}

TEST(OneCameraAlone, IsNamedWhenOpening) {
  sim::SimOptions sim = black_session(60.0);
  sim.pace = sim::Pace::kRealtime;
  ServerOptions server;
  server.faults.only_left = 0;
  ServedRoom room(sim, server);
  Hl2ssOptions options = room.client_options();
  options.open_within = milliseconds(600);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(headset.error().message,
              AllOf(HasSubstr("no pair of images within 0.6"),
                    HasSubstr("right camera: connected, but sends no image"),
                    Not(HasSubstr("left camera"))));
}

}  // namespace
}  // namespace orthonav::hl2ss::frozen_test
