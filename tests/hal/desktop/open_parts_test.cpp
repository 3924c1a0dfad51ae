#include "hal/open/open_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/fake/scripted.h"

namespace orthonav {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string clicker_refusal(const std::string& uri) {
  const fake::ManualClock clock;
  const auto clicker = open_clicker(uri, clock);
  return clicker.ok() ? "accepted" : clicker.error().message;
}

std::string voice_refusal(const std::string& uri) {
  const fake::ManualClock clock;
  const auto voice = open_voice(uri, {"save"}, clock);
  return voice.ok() ? "accepted" : voice.error().message;
}

TEST(OpenClicker, NamesWhatItKnows) {
  for (const char* uri : {"bluetooth:", "", "Evdev:"}) {
    EXPECT_THAT(clicker_refusal(uri), AllOf(HasSubstr("known are headset, none, evdev:"),
                                            HasSubstr(uri), Not(HasSubstr("\n"))));
  }
  EXPECT_THAT(clicker_refusal("evdev:x?colour=red"),
              AllOf(HasSubstr("\"colour\""), HasSubstr("double_ms=N")));
  EXPECT_THAT(clicker_refusal("evdev:x?keys=hyper7"), HasSubstr("\"hyper7\" is unknown"));
  EXPECT_THAT(clicker_refusal("evdev:x?double_ms=fast"), HasSubstr("whole number"));
  EXPECT_THAT(clicker_refusal("evdev:x?double_ms=0"), HasSubstr("(0, 2000] ms"));
  EXPECT_THAT(clicker_refusal("evdev:x?share&share"), HasSubstr("twice"));
}

TEST(OpenVoice, SaysThatAHeadsetHasNoMicrophone) {
  EXPECT_THAT(voice_refusal("headset-mic:"), HasSubstr("no microphone to listen to"));
  fake::FakeHeadset headset({});
  const auto voice = open_voice("headset-mic:", {"save"}, headset.clock(), &headset);
  ASSERT_FALSE(voice.ok());
  EXPECT_THAT(voice.error().message, HasSubstr("no microphone to listen to"));
}

TEST(OpenClicker, GivesNoneForTheHeadsetsOwn) {
  const fake::ManualClock clock;
  EXPECT_EQ(*open_clicker("headset", clock), nullptr);
  const auto none = open_clicker("none", clock);
  ASSERT_TRUE(none.ok());
  std::vector<ClickerEvent> events;
  EXPECT_TRUE((*none)->poll(clock.now(), events).ok());
  EXPECT_TRUE(events.empty());
}

TEST(OpenVoice, NamesWhatItKnows) {
  for (const char* uri : {"alexa:", "", "Mic:"}) {
    EXPECT_THAT(voice_refusal(uri),
                AllOf(HasSubstr("known are headset, none, mic:"), HasSubstr(uri)));
  }
  EXPECT_THAT(voice_refusal("wav:x.wav?loud"), HasSubstr("unknown key \"loud\""));
  EXPECT_THAT(voice_refusal("wav:x.wav?wake=never"), HasSubstr("unknown key \"wake\""));
  EXPECT_THAT(voice_refusal("wav:/nowhere/x.wav"), HasSubstr("/nowhere/x.wav"));
  EXPECT_THAT(voice_refusal("mic:no such microphone"), HasSubstr("no such microphone"));
  const fake::ManualClock clock;
  EXPECT_EQ(open_voice("wav:/nowhere/x.wav", {"save"}, clock).error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace orthonav
