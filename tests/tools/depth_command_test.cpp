#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/io/image_file.h"
#include "tests/support/depth_scene.h"
#include "tests/support/scripted_session.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::depth_command_test {
namespace {

using orthonav::test::DepthScene;
using orthonav::test::Hololens1Folder;
using orthonav::test::StreamRecorderFolder;
using orthonav::test::write_text;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kFrame = 333'333;
// Half a millimetre of rounding, and single precision within metres.
constexpr double kQuantisationM = 0.00051;

DepthScene scene() {
  DepthScene made;
  made.pictures = {
      {0, std::nullopt}, {500'000, DepthScene::pose(1)}, {900'000, DepthScene::pose(2)}};
  return made;
}

/// The points after the header of a binary PLY, read according to the format's specification.
std::vector<Vec3> points_of(const std::string& ply) {
  constexpr const char* kEnd = "end_header\n";
  EXPECT_THAT(ply, HasSubstr("format binary_little_endian 1.0\n"));
  const std::size_t start = ply.find(kEnd) + std::strlen(kEnd);
  EXPECT_EQ((ply.size() - start) % 12, 0u);
  EXPECT_THAT(ply, HasSubstr("element vertex " + std::to_string((ply.size() - start) / 12) + "\n"));
  std::vector<Vec3> points;
  for (std::size_t at = start; at + 12 <= ply.size(); at += 12) {
    std::array<float, 3> single{};
    std::memcpy(single.data(), ply.data() + at, sizeof(single));
    points.push_back({single[0], single[1], single[2]});
  }
  return points;
}

double farthest_from_plane_m(const std::vector<Vec3>& points) {
  double worst = 0.0;
  for (const Vec3 p : points) {
    worst = std::max(worst, std::abs(scene().normal.dot(p) - scene().offset_m));
  }
  return worst;
}

/// A HoloLens 2's recording of one or two depth streams.
class DepthCommand : public ::testing::Test {
 protected:
  void SetUp() override { scene().write_stream_recorder(recording_.path(), "Depth Long Throw"); }
  Called depth(std::vector<std::string> more) const {
    more.insert(more.begin(), {"depth", recording_.path().string()});
    return orthonav(more);
  }
  void expect_refused(const std::vector<std::string>& more, const std::string& says) const {
    const Called called = depth(more);
    EXPECT_EQ(called.code, 2);
    EXPECT_THAT(called.err, HasSubstr(says));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(out_.names(), IsEmpty());
  }
  StreamRecorderFolder recording_{{0, kFrame}, {0, kFrame}};
  ScratchFolder out_;
};

TEST_F(DepthCommand, ListsTheStreams) {
  const Called words = depth({});
  EXPECT_EQ(words.code, 0) << words.err;
  EXPECT_EQ(words.out, "long-throw: 44x36 px, 3 frames in 0.1 s, 1 without a pose\n");
  recording_.write("Depth AHaT.tar", "nothing");
  const Called called = depth({"--json"});
  EXPECT_EQ(called.code, 0);
  const auto streams = nlohmann::json::parse(called.out)["streams"];
  ASSERT_EQ(streams.size(), 2u);
  EXPECT_EQ(streams[0]["stream"], "long-throw");
  EXPECT_EQ(streams[0]["frames"], 3);
  EXPECT_EQ(streams[0]["first_100ns"], StreamRecorderFolder::kStart);
  EXPECT_EQ(streams[0]["last_100ns"], StreamRecorderFolder::kStart + 900'000);
  EXPECT_EQ(streams[1]["stream"], "ahat");
  EXPECT_THAT(streams[1]["trouble"].get<std::string>(), HasSubstr("Depth AHaT.tar"));
}

TEST_F(DepthCommand, WritesThePointsWhereTheyLieInTheWorld) {
  const std::string file = out_.file("points.ply");
  const Called called = depth({"--out", file});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto points = points_of(content_of(file));
  EXPECT_GT(points.size(), 1000u);
  EXPECT_LT(farthest_from_plane_m(points), kQuantisationM);
  EXPECT_THAT(called.out, HasSubstr(std::to_string(points.size()) +
                                    " points of long-throw; frames: 1 used, 0 without a pose"));
  // The first frame with a pose is the second; the scene's own point is among them.
  const Vec3 expected = scene().hit(scene().pictures[1], 20, 17).v;
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [&](Vec3 p) { return (p - expected).norm() < kQuantisationM; }));
  EXPECT_THAT(out_.names(), ElementsAre("points.ply"));
}

TEST_F(DepthCommand, WritesThePointsOfAHololens1) {
  const Hololens1Folder hololens1(orthonav::test::scripted_calibration(),
                                  {orthonav::test::scripted_frame(0)});
  scene().write_hololens1(hololens1.path(), "short_throw_depth");
  const Called called =
      orthonav({"depth", hololens1.path().string(), "--out", out_.file("points.ply")});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto points = points_of(content_of(out_.file("points.ply")));
  EXPECT_GT(points.size(), 1000u);
  EXPECT_LT(farthest_from_plane_m(points), kQuantisationM);
}

TEST_F(DepthCommand, ThinsOutThePointsOfAllFrames) {
  const auto points = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--all", "--json", "--out", out_.file("all.ply")});
    const Called called = depth(more);
    EXPECT_EQ(called.code, 0) << called.err;
    const auto json = nlohmann::json::parse(called.out);
    EXPECT_EQ(json["frames_without_pose"], 1);
    EXPECT_EQ(json["points"], points_of(content_of(out_.file("all.ply"))).size());
    return json;
  };
  const auto every = points({"--cell-mm", "0"});
  EXPECT_EQ(every["frames_used"], 2);
  const auto thinned = points({});
  EXPECT_EQ(thinned["cell_mm"], 5.0);
  EXPECT_LT(thinned["points"], every["points"]);
  const auto cubes = points({"--cell-mm", "100"});
  EXPECT_LT(cubes["points"], 400);
  EXPECT_GT(cubes["points"], 20);
  EXPECT_LT(points({"--cell-mm", "0", "--max-mm", "900"})["points"], every["points"]);
}

TEST_F(DepthCommand, NeverMixesMaps) {
  recording_.write("Depth Long Throw_map.csv", "sequence,map_epoch\n2,1\n");
  const Called called = depth({"--all", "--json", "--out", out_.file("all.ply")});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["frames_used"], 1);
  EXPECT_EQ(json["frames_in_other_maps"], 2);
}

TEST_F(DepthCommand, DrawsAPicture) {
  const std::string file = out_.file("frame.png");
  const Called called = depth({"--out", file, "--frame", "2"});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, AllOf(HasSubstr("frame 2 of long-throw"), HasSubstr("white")));
  const auto picture = engine::read_png(file);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  ASSERT_EQ(picture->width_px, 44);
  const DepthScene seen = scene();
  const auto grey = [&](int x, int y) {
    return picture->pixels[static_cast<std::size_t>(4 * (y * 44 + x))];
  };
  const auto range = [&](int x, int y) { return seen.range_mm(seen.pictures[2], x, y, 0); };
  int compared = 0;
  for (int x = 1; x < 44; ++x) {
    if (range(x, 20) == 0) {
      EXPECT_EQ(grey(x, 20), 0) << "black: not measured";
    } else if (range(x - 1, 20) != 0 && range(x, 20) > range(x - 1, 20)) {
      EXPECT_LE(grey(x, 20), grey(x - 1, 20)) << "darker: farther";
      ++compared;
    }
  }
  EXPECT_GT(compared, 10);
}

TEST_F(DepthCommand, IsRefusedInOneLine) {
  const std::string ply = out_.file("points.ply");
  expect_refused({"--out", out_.file("points.xyz")}, "must end in .ply or .png");
  expect_refused({"--out", out_.file("all.png"), "--all"}, "--all: a picture shows one frame");
  expect_refused({"--out", ply, "--frame", "3"}, "--frame: is 3, must be 0 to 2");
  expect_refused({"--out", ply, "--frame", "0"}, "frame 0 has no pose");
  expect_refused({"--out", ply, "--frame", "0", "--all"}, "--all");
  expect_refused({"--out", ply, "--frame", "-1"}, "--frame");
  expect_refused({"--out", ply, "--stream", "ahat"},
                 "the recording has no ahat, it has long-throw");
  expect_refused({"--out", ply, "--stream", "sonar"}, "--stream");
  expect_refused({"--out", ply, "--cell-mm", "-1"}, "--cell-mm");
  expect_refused({"--out", ply, "--max-mm", "70000"}, "--max-mm");
  expect_refused({"--out", out_.file("no/points.ply")}, "points.ply");
  scene().write_stream_recorder(recording_.path(), "Depth AHaT");
  expect_refused({"--out", ply}, "must be named, the recording has ahat and long-throw");
  recording_.write("Depth AHaT_extrinsics.txt", "1,2,3");
  expect_refused({"--out", ply, "--stream", "ahat"}, "camera_from_rig holds 3 numbers");
}

TEST_F(DepthCommand, RefusesWhatIsNoRecordingOfDepth) {
  const Called nowhere = orthonav({"depth", out_.file("nowhere")});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("no such folder"));
  const StreamRecorderFolder without({0, kFrame}, {0, kFrame});
  const Called none = orthonav({"depth", without.path().string()});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("holds no depth stream"));
}

TEST_F(DepthCommand, AnswersNoWhereNothingWasMeasured) {
  const Called called = depth({"--out", out_.file("points.ply"), "--max-mm", "1"});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(points_of(content_of(out_.file("points.ply"))), IsEmpty());
}

TEST_F(DepthCommand, IsListedByTheDoctor) {
  recording_.write("Depth AHaT.tar", "nothing");
  const Called called =
      orthonav({"doctor", "--headset", "replay:" + recording_.path().string() + "?pace=fast"});
  EXPECT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("2 pairs, 0 without a pose, from 0.0 s to 0.0 s"));
  EXPECT_THAT(called.out, HasSubstr("Recording: depth long-throw"));
  EXPECT_THAT(called.out, HasSubstr("44x36 px, 3 frames in 0.1 s, 1 without a pose, from 0.0 s"));
  EXPECT_THAT(called.out, HasSubstr("can't be read: "));
  const Called nowhere = orthonav({"doctor", "--headset", "replay:" + out_.file("nowhere")});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("no such recording"));
}

TEST_F(DepthCommand, FindsItAgainInARecordingOfTheReplay) {
  const Called run =
      orthonav({"run", "--headset", "replay:" + recording_.path().string(), "--levels", "L5",
                "--record", out_.file("again"), "--out", out_.file("out")});
  ASSERT_NE(run.code, 2) << run.err;
  const Called listed = orthonav({"depth", out_.file("again")});
  EXPECT_EQ(listed.out, "long-throw: 44x36 px, 3 frames in 0.1 s, 1 without a pose\n");
}

}  // namespace
}  // namespace orthonav::test::depth_command_test
