#include "hal/open/open.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orthonav {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(const std::string& uri) {
  const auto headset = open_headset(uri);
  return headset.ok() ? "accepted" : headset.error().message;
}

/// A moment of simulated time is enough here.
OpenOptions brief() {
  OpenOptions options;
  options.sim.surgeon = false;
  options.sim.limit_s = 0.2;
  return options;
}

GreyImage first_image(const std::string& uri) {
  auto headset = open_headset(uri, brief());
  EXPECT_TRUE(headset.ok()) << uri << ": " << headset.error().message;
  StereoFrame frame;
  if (!headset) return {};
  const auto answer = (*headset)->cameras().next(frame);
  EXPECT_TRUE(answer.ok() && *answer == Next::kFrame);
  return frame.left;
}

TEST(OpenHeadset, NamesWhatItKnowsWhenItKnowsNothingOfAUri) {
  for (const char* uri : {"kinect:", "sim", "", "Sim:", "http://host/"})
    EXPECT_THAT(refusal(uri), AllOf(HasSubstr("known are sim:, replay:PATH and hl2ss://HOST"),
                                    HasSubstr(uri), Not(HasSubstr("\n"))));
}

TEST(OpenHeadset, NamesTheKnownKeys) {
  EXPECT_THAT(refusal("sim:?sead=3"),
              AllOf(HasSubstr("\"sead\""), HasSubstr("seed=N, perfect and realtime")));
  EXPECT_THAT(refusal("sim:seed=3"), HasSubstr("?key=value"));
  EXPECT_THAT(refusal("sim:?perfect=1"), HasSubstr("takes no value"));
  EXPECT_THAT(refusal("sim:?seed=1&seed=2"), HasSubstr("twice"));
  EXPECT_THAT(refusal("sim:?&"), HasSubstr("unknown key \"\""));
}

TEST(OpenHeadset, TakesWholeSeedsOnly) {
  for (const char* seed : {"", "-1", "1.5", "0x10", "three", "18446744073709551616", " 1", "1 "})
    EXPECT_THAT(refusal(std::string("sim:?seed=") + seed), HasSubstr("not a whole number")) << seed;
}

TEST(OpenHeadset, SaysWhatIsNotSupportedYet) {
  EXPECT_THAT(refusal("openxr:"), HasSubstr("openxr: is not supported yet"));
}

TEST(OpenHeadset, PassesOnWhyARecordingCannotBeOpened) {
  EXPECT_THAT(refusal("replay:/nowhere/at/all"), HasSubstr("/nowhere/at/all"));
  EXPECT_THAT(refusal("replay:"), HasSubstr("names no folder"));
}

TEST(OpenHeadset, SeedsTheSimulation) {
  const GreyImage three = first_image("sim:?seed=3");
  EXPECT_TRUE(first_image("sim:?seed=3") == three);
  EXPECT_FALSE(first_image("sim:?seed=4") == three);
  EXPECT_FALSE(first_image("sim:?seed=3&perfect") == three);
}

}  // namespace
}  // namespace orthonav
