#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/hl2ss/socket.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::serve_hl2ss_test {
namespace {

using ::testing::HasSubstr;

TEST(ServeHl2ss, RefusesWhatItDoesNotKnow) {
  const Called faults = orthonav({"serve-hl2ss", "--faults", "gaps=0.1"});
  EXPECT_EQ(faults.code, 2);
  EXPECT_THAT(faults.err,
              HasSubstr("--faults: faults: \"gaps=0.1\" is not understood; known are gap"));
  const Called host = orthonav({"serve-hl2ss", "--host", "no.such.host.invalid"});
  EXPECT_EQ(host.code, 2);
  EXPECT_THAT(host.err, HasSubstr("no.such.host.invalid"));
}

TEST(ServeHl2ss, SaysWhichPortIsTaken) {
  const auto host = hl2ss::resolve("127.0.0.1");
  ASSERT_TRUE(host.ok());
  constexpr int kPort = 47312;
  const auto taken = hl2ss::listen_at(*host, kPort);
  ASSERT_TRUE(taken.ok()) << taken.error().message;
  const Called called =
      orthonav({"serve-hl2ss", "--port", std::to_string(kPort), "--levels", "L5"});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("port 47312: Address already in use"));
}

TEST(Doctor, LooksAtTheHeadsetsPorts) {
  const Called closed = orthonav({"doctor", "--headset", "hl2ss://127.0.0.1?port=47400"});
  EXPECT_THAT(closed.out, HasSubstr("HoloLens 2: left camera"));
  EXPECT_THAT(closed.out, HasSubstr("127.0.0.1, port 47400: Connection refused"));
  const Called other = orthonav({"doctor", "--headset", "sim:"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("known are hl2ss://HOST and replay:PATH"));
}

TEST(RunWithAHeadset, SaysWhichPortDoesNotAnswer) {
  const Called called = orthonav({"run", "--headset", "hl2ss://127.0.0.1?port=47400"});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("hl2ss: 127.0.0.1: port 47400: Connection refused"));
}

}  // namespace
}  // namespace orthonav::test::serve_hl2ss_test
