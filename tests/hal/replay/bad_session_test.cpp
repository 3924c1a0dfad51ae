// The files that our own recorder adds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/replay/frame_files.h"
#include "hal/replay/layout.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay {
namespace {

using orthonav::test::play;
using orthonav::test::scripted_session;
using orthonav::test::TemporaryFolder;
using orthonav::test::write_text;
using ::testing::HasSubstr;

/// A recording of two pairs whose file `name` holds `text`, as it is refused.
std::string refusal(const char* name, const std::string& text) {
  const TemporaryFolder folder;
  {
    fake::FakeHeadset inner(scripted_session(2));
    auto recorder = RecordingHeadset::around(inner, folder / "session");
    EXPECT_TRUE(recorder.ok());
    play(**recorder);
    EXPECT_TRUE((*recorder)->close().ok());
  }
  write_text(folder / "session" / name, text);
  const auto headset = ReplayHeadset::open(folder / "session");
  return headset.ok() ? "accepted" : headset.error().message;
}

std::string with_event(const std::string& time_ns, const std::string& available_ns) {
  return std::string(kEventsHeader) + "\nclicker,press,," + time_ns + "," + available_ns + ",\n";
}

TEST(BadSession, NeedsEventsOfTimesThatADeviceCanHave) {
  EXPECT_EQ(refusal(kEventsFile, with_event("1000000100", "1000000100")), "accepted");
  for (const char* far : {"9000000000000000001", "9223372036854775807"}) {
    EXPECT_THAT(refusal(kEventsFile, with_event("1000000100", far)), HasSubstr("within 9e18"));
    EXPECT_THAT(refusal(kEventsFile, with_event(far, far)), HasSubstr("within 9e18"));
  }
  EXPECT_THAT(refusal(kEventsFile, with_event("-9223372036854775808", "0")),
              HasSubstr("within 9e18"));
}

TEST(BadSession, NeedsTicksThatAreNotNegative) {
  EXPECT_THAT(refusal(kFramesFile, std::string(kFramesHeader) + "\n0,1000000007,-1,1000000007\n"),
              HasSubstr("ticks_100ns must not be negative"));
}

TEST(BadSession, NeedsAnEpochThatItsTimesFit) {
  for (const char* epoch : {"-9000000000000000000", "9000000000000000000"}) {
    EXPECT_NE(
        refusal(kDeviceFile, std::string(kDeviceHeader) + "\nepoch_ticks_100ns," + epoch + "\n"),
        "accepted");
  }
}

TEST(DeviceTime, IsWithinReachOrNothing) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t ticks : {kLeast, std::int64_t{-1}, kMost}) {
    for (const std::int64_t epoch : {kLeast, -kMaxNs, std::int64_t{0}, kMaxNs}) {
      EXPECT_FALSE(device_time(ticks, epoch).has_value()) << ticks << " from " << epoch;
    }
  }
  EXPECT_EQ(device_time(kMaxTicks, 0), Timestamp(Duration(kMaxNs)));
  EXPECT_FALSE(device_time(kMaxTicks + 1, 0).has_value());
  EXPECT_EQ(device_time(0, kMaxTicks), Timestamp(Duration(-kMaxNs)));
  EXPECT_EQ(device_time(5, -7), Timestamp(Duration(1200)));
}

}  // namespace
}  // namespace orthonav::replay
