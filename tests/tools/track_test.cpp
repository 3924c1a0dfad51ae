#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/transform.h"
#include "tests/support/hololens1_folder.h"
#include "tests/support/tag_scene.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::track_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kSample = "recordings/streamrecorder-sample";
// Corners good to 0.04 px: 0.2 mm in depth, 1.2° of tilt for a single pose at 0.5 m.
constexpr double kWorstPositionM = 0.0006;
constexpr double kWorstRotationRad = 0.05;

using Key = std::pair<long long, int>;

struct Row {
  Vec3 position;
  Quaternion rotation;
  std::vector<std::string> fields;
};

std::map<Key, Row> rows_of(const std::string& csv) {
  std::map<Key, Row> rows;
  std::istringstream text(csv);
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    Row row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
      row.fields.push_back(field);
    }
    const auto number = [&row](std::size_t i) { return std::stod(row.fields.at(i)); };
    row.position = {number(2), number(3), number(4)};
    row.rotation = {number(5), number(6), number(7), number(8)};
    const Key key{std::stoll(row.fields[0]), std::stoi(row.fields[1])};
    EXPECT_EQ(rows.count(key), 0u) << "twice: " << line;
    rows[key] = row;
  }
  return rows;
}

std::size_t digits(const std::string& number) {
  std::size_t count = 0;
  bool started = false;
  for (const char c : number) {
    if (c == 'e') {
      break;
    }
    if (c >= '1' && c <= '9') {
      started = true;
    }
    if (started && c >= '0' && c <= '9') {
      ++count;
    }
  }
  return count;
}

class TrackCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    sample_ = shared(kSample);
    if (sample_.empty()) {
      GTEST_SKIP() << "needs shared/recordings/streamrecorder-sample";
    }
  }
  /// The sample was rendered at its stamps.
  Called track(std::vector<std::string> more) const {
    std::vector<std::string> all = {"track",         sample_,
                                    "--tools",       sample_ + "/tools.json",
                                    "--csv",         folder_.file("poses.csv"),
                                    "--exact-stamps"};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }
  std::string sample_;
  ScratchFolder folder_;
};

/// A recording of our own: three pairs are enough to test refusals.
class TrackBadInput : public TrackCommand {
 protected:
  static void SetUpTestSuite() {
    made_ = std::make_unique<ScratchFolder>();
    const ScratchFolder results;
    const Called made = orthonav({"run", "--levels", "L5", "--frames", "3", "--record",
                                  made_->file("recording"), "--out", results.file("out")});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { made_.reset(); }
  void SetUp() override { sample_ = made_->file("recording"); }

  static inline std::unique_ptr<ScratchFolder> made_;
};

TEST_F(TrackBadInput, IsRefusedOnOtherwiseGoodRecordings) {
  const Called called = track({});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("3 stereo pairs"));
}

/// A HoloLens 1's recording of a tag with known poses, which depends on every convention of that
/// format.
TEST(TrackHololens1, FindsATagWhereItWas) {
  const StereoCalibration calibration = test_calibration();
  PlacedTag tag;
  tag.rig_from_marker = facing({0.02, -0.01, 0.03}, {0.3, -0.2, 0.4});
  std::vector<StereoFrame> frames;
  for (int i = 0; i < 3; ++i) {
    StereoFrame frame =
        stereo_frame(calibration, {tag}, Timestamp(std::chrono::milliseconds(33 * i)));
    frame.world_from_rig =
        Transform<World, Rig>(rotation_from_vector({0.4, 0.01 * i, -1.0}), {0.3, 1.5, 0.002 * i});
    // A sensor's noise: pictures that are the same to the bit are old ones.
    frame.left.pixels[0] = frame.right.pixels[0] = static_cast<std::uint8_t>(i);
    frames.push_back(frame);
  }
  const orthonav::test::Hololens1Folder recording(calibration, frames);
  const ScratchFolder folder;
  const std::string tools =
      folder.with("tools.json",
                  R"({"tools": [{"name": "pointer", "role": "pointer", "tip_mm": [0, -150, 0],
          "axis": [0, -1, 0], "marker": {"family": "tag36h11", "id": 3, "size_mm": 50}}]})");
  const Called called = orthonav(
      {"track", recording.path().string(), "--tools", tools, "--csv", folder.file("poses.csv")});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto rows = rows_of(content_of(folder.file("poses.csv")));
  ASSERT_EQ(rows.size(), frames.size());
  std::size_t i = 0;
  for (const auto& [key, row] : rows) {
    const auto expected = *frames[i].world_from_rig * tag.rig_from_marker;
    EXPECT_EQ(key.first, orthonav::test::Hololens1Folder::kStart + ticks_100ns(frames[i++].time));
    EXPECT_LT((row.position - expected.translation()).norm(), kWorstPositionM);
    EXPECT_LT(rotation_angle_rad(rotation_from_quaternion(row.rotation), expected.rotation()),
              kWorstRotationRad);
  }
}

TEST_F(TrackCommand, WarnsOfATagThatIsNotOfTheStatedSize) {
  std::string tools = content_of(sample_ + "/tools.json");
  EXPECT_THAT(track({}).err, Not(HasSubstr("warning"))) << "the twin";
  auto json = nlohmann::json::parse(tools);
  for (auto& tool : json["tools"]) {
    tool["marker"]["size_mm"] = 41.2;
  }
  const std::string wrong = folder_.file("tools.json");
  std::ofstream(wrong) << json.dump();
  const Called called =
      orthonav({"track", sample_, "--tools", wrong, "--csv", folder_.file("poses.csv"), "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.err, ContainsRegex("is stated to measure 41.20 mm but measures (39.9|40.0)"));
  EXPECT_TRUE(nlohmann::json::parse(called.out)["tools"][0]["tag_size"]["disagrees"]);
}

TEST_F(TrackCommand, SaysWhichTagsWereSeenWhereOneNeverWas) {
  auto json = nlohmann::json::parse(content_of(sample_ + "/tools.json"));
  json["tools"][0]["marker"]["id"] = 7;
  const std::string wrong = folder_.with("tools.json", json.dump());
  for (const char* method : {"best", "paper"}) {
    const Called called = orthonav({"track", sample_, "--tools", wrong, "--method", method, "--csv",
                                    folder_.file("poses.csv")});
    EXPECT_EQ(called.code, 0);
    EXPECT_THAT(called.err, HasSubstr("warning: tag tag36h11 id 7 of 'pointer' was never seen, "
                                      "only tag36h11 id "));
    EXPECT_THAT(called.err, Not(HasSubstr("id 17 of")));
  }
}

TEST_F(TrackCommand, WritesARowForEveryVisibleTagAndNoOther) {
  const Called called = track({});
  ASSERT_EQ(called.code, 0) << called.err;
  const std::string csv = content_of(folder_.file("poses.csv"));
  EXPECT_THAT(csv, StartsWith("timestamp_100ns,id,px,py,pz,qx,qy,qz,qw,"));
  const auto rows = rows_of(csv);
  const auto truth = rows_of(content_of(sample_ + "/truth.csv"));
  std::size_t visible = 0;
  for (const auto& [key, expected] : truth) {
    if (expected.fields.at(9) != "1") {
      continue;
    }
    ++visible;
    ASSERT_EQ(rows.count(key), 1u) << "missing: " << key.first << " id " << key.second;
    const Row& row = rows.at(key);
    EXPECT_LT((row.position - expected.position).norm(), kWorstPositionM);
    EXPECT_LT(rotation_angle_rad(rotation_from_quaternion(row.rotation),
                                 rotation_from_quaternion(expected.rotation)),
              kWorstRotationRad);
    EXPECT_EQ(row.fields.at(9), "measured");
    EXPECT_GT(std::stod(row.fields.at(10)), 0.0);
    EXPECT_LT(std::stod(row.fields.at(10)), 2.0);
  }
  EXPECT_EQ(rows.size(), visible) << "no ghosts";
  EXPECT_THAT(folder_.names(), ElementsAre("poses.csv"));
}

TEST_F(TrackCommand, WritesUnitQuaternionsInFullDigits) {
  ASSERT_EQ(track({}).code, 0);
  double longest = 0.0;
  for (const auto& [key, row] : rows_of(content_of(folder_.file("poses.csv")))) {
    const Quaternion q = row.rotation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-11);
    EXPECT_GE(q.w, 0.0);
    longest = std::max(longest, static_cast<double>(digits(row.fields[2])));
  }
  EXPECT_GE(longest, 10);
}

TEST_F(TrackCommand, SaysWhatItDidAndSaysItInJsonToo) {
  const Called plain = track({});
  EXPECT_THAT(plain.out, HasSubstr("30 stereo pairs"));
  EXPECT_THAT(plain.out, HasSubstr("pointer (id 3): measured in 30"));
  EXPECT_THAT(plain.err, HasSubstr("30 of 30 stereo pairs"));
  const Called called = track({"--json", "--full-search-every", "10"});
  ASSERT_EQ(called.code, 0);
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["pairs"], 30);
  EXPECT_EQ(json["tools"][1]["id"], 17);
  EXPECT_EQ(json["tools"][1]["measured_pairs"], 30);
}

TEST_F(TrackCommand, GivesTheSameBytesAgain) {
  ASSERT_EQ(track({}).code, 0);
  const std::string first = content_of(folder_.file("poses.csv"));
  ASSERT_EQ(track({"--method", "best"}).code, 0);
  EXPECT_EQ(content_of(folder_.file("poses.csv")), first);
  ASSERT_EQ(track({"--method", "paper"}).code, 0);
  EXPECT_NE(content_of(folder_.file("poses.csv")), first);
}

TEST_F(TrackBadInput, RefusesAMethodThatIsNotThere) {
  const Called called = track({"--method", "nearest"});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("nearest: unknown (available: best, paper)"));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1);
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST_F(TrackBadInput, RefusesBadInputInOneLineAndWritesNothing) {
  const std::string csv = folder_.file("poses.csv");
  const std::string tools = sample_ + "/tools.json";
  const std::string twice = folder_.with("twice.json", R"({"tools": [
    {"name": "a", "role": "pointer", "marker": {"family": "tag36h11", "id": 3, "size_mm": 40},
     "tip_mm": [0, -150, 0]},
    {"name": "b", "role": "guide", "marker": {"family": "tag36h11", "id": 3, "size_mm": 40},
     "tip_mm": [0, -150, 0]}]})");
  const std::string family = folder_.with("family.json", R"({"tools": [
    {"name": "a", "role": "pointer", "marker": {"family": "tag99h1", "id": 3, "size_mm": 40},
     "tip_mm": [0, -150, 0]}]})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"track", folder_.file("none"), "--tools", tools, "--csv", csv}, "none"},
      {{"track", sample_, "--tools", folder_.file("none.json"), "--csv", csv}, "none.json"},
      {{"track", sample_, "--tools", twice, "--csv", csv}, "id 3"},
      {{"track", sample_, "--tools", family, "--csv", csv}, "tag99h1"},
      {{"track", sample_, "--tools", tools, "--csv", folder_.file("no/where.csv")}, "no"}};
  for (const auto& [arguments, what] : cases) {
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2) << what;
    EXPECT_THAT(called.err, HasSubstr(what));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
  }
  EXPECT_EQ(orthonav({"track", sample_, "--tools", tools}).code, 2) << "no --csv";
  EXPECT_EQ(track({"--full-search-every", "0"}).code, 2);
  EXPECT_THAT(folder_.names(), ElementsAre("family.json", "twice.json"));
}

TEST_F(TrackBadInput, IsReadToItsLastWholePairAndLeavesNoCsvWhereThereIsNone) {
  const std::string copy = folder_.file("copy");
  std::filesystem::copy(sample_, copy, std::filesystem::copy_options::recursive);
  const std::string tar = copy + "/VLC RF.tar";
  std::filesystem::permissions(copy, std::filesystem::perms::owner_all);
  std::filesystem::permissions(tar, std::filesystem::perms::owner_all);
  const auto track_cut_at = [&](std::uint64_t bytes) {
    std::filesystem::resize_file(tar, bytes);
    return orthonav(
        {"track", copy, "--tools", copy + "/tools.json", "--csv", folder_.file("poses.csv")});
  };
  const Called cut = track_cut_at(std::filesystem::file_size(tar) / 2 + 1000);
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("read to its last whole pair, 1 in all (VLC RF.tar is cut off"));
  EXPECT_THAT(cut.out, HasSubstr("1 stereo pair,"));
  std::filesystem::remove(folder_.file("poses.csv"));
  const Called none = track_cut_at(1000);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("VLC RF.tar: holds no whole image"));
  EXPECT_THAT(folder_.names(), ElementsAre("copy"));
}

}  // namespace
}  // namespace orthonav::test::track_test
