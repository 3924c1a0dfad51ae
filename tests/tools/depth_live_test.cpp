#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::depth_live_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(DepthLive, ListsWhatTheSimulatedRoomSends) {
  const Called called =
      orthonav({"depth", "sim:?perfect", "--stream", "long-throw", "--frames", "2", "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto stream = nlohmann::json::parse(called.out)["streams"][0];
  EXPECT_EQ(stream["stream"], "long-throw");
  EXPECT_EQ(stream["width_px"], 320);
  EXPECT_EQ(stream["frames"], 2);
  EXPECT_EQ(stream["frames_without_pose"], 0);
}

TEST(DepthLive, OfAStandInBecomesPointsAndPictures) {
  StartedCommand server({"serve-hl2ss", "--port", "27540", "--levels", "L5"});
  ASSERT_TRUE(wait_until([&] { return server.err_so_far().find("serving") != std::string::npos; }));
  const ScratchFolder out;
  const std::string ply = out.file("site.ply");
  const Called points = orthonav({"depth", "hl2ss://127.0.0.1?port=27540&depth=ahat-h264",
                                  "--stream", "ahat", "--out", ply, "--json"});
  ASSERT_EQ(points.code, 0) << points.err;
  const auto json = nlohmann::json::parse(points.out);
  EXPECT_EQ(json["frames_used"], 1);
  EXPECT_GT(json["points"], 50'000);
  EXPECT_THAT(content_of(ply), StartsWith("ply\n"));
  const Called picture = orthonav({"depth", "hl2ss://127.0.0.1?port=27540", "--stream",
                                   "long-throw", "--out", out.file("site.png")});
  EXPECT_EQ(picture.code, 0) << picture.err;
  EXPECT_THAT(picture.out, HasSubstr("frame 0 of long-throw, white "));
  const Called listing = orthonav({"depth", "hl2ss://127.0.0.1?port=27540", "--frames", "2"});
  EXPECT_THAT(listing.out, HasSubstr("ahat: 512x512 px, 2 frames in 0."));
  EXPECT_THAT(listing.out, HasSubstr(", wraps at 1.055 m\n"));
}

void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
  const Called called = orthonav(arguments);
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr(says));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

TEST(DepthLive, SaysWhatIsWrong) {
  expect_refused({"depth", "hl2ss://127.0.0.1?port=27560"},
                 "hl2ss: 127.0.0.1: port 27560: Connection refused");
  expect_refused({"depth", "hl2ss://127.0.0.1?depth=zdepth"},
                 "depth \"zdepth\" must be ahat, ahat-h264, long-throw or long-throw-png");
  expect_refused({"depth", "hl2ss://127.0.0.1?port=27560", "--stream", "short-throw"},
                 "--stream: a HoloLens 2 has ahat and long-throw");
  expect_refused({"depth", "sim:"}, "--stream: must be named, the headset has ahat and long-throw");
  expect_refused({"depth", "nothing:"}, "unknown scheme \"nothing\"");
  const ScratchFolder folder;
  expect_refused({"depth", folder.file("."), "--frames", "3"}, "--frames: is for a headset");
  const std::string far = folder.file("far.png");
  expect_refused(
      {"depth", "sim:", "--stream", "ahat", "--frames", "2", "--frame", "2", "--out", far},
      "--frame: is 2, must be less than --frames, 2");
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace orthonav::test::depth_live_test
