#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "engine/print/board_file.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::calibrate_stereo_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CalibrateStereo : public ::testing::Test {
 protected:
  void SetUp() override {
    boards_ = shared("recordings/opencv-stereo-chessboard");
    if (boards_.empty()) {
      GTEST_SKIP() << "needs shared/recordings/opencv-stereo-chessboard";
    }
  }
  Called stereo(const std::string& left, const std::string& right,
                std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"calibrate", "stereo", "--chessboard", "9x6",
                                    "--left",    left,     "--right",      right};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }
  void take(const std::string& image) const {
    std::filesystem::copy_file(boards_ + "/" + image, folder_.file(image));
  }
  std::string boards_;
  ScratchFolder folder_;
};

TEST_F(CalibrateStereo, MeetsTheGivenPhotographsWithinAFractionOfAPixel) {
  const Called called = stereo(boards_ + "/left??.jpg", boards_ + "/right??.jpg", {"--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_LE(json["stereo_rms_px"], 0.45);
  EXPECT_LE(json["left_rms_px"], 0.45);
  EXPECT_LE(json["right_rms_px"], 0.45);
  EXPECT_LE(json["epipolar_rms_px"], 0.3);
  EXPECT_EQ(json["views_used"], 13);
  EXPECT_EQ(json["views"].size(), 13u);
  EXPECT_EQ(json["verdict"], "pass") << json["reason"];
  // The calibration that comes with the photographs, in squares: 3.34; 536 px.
  EXPECT_NEAR(json["baseline_mm"].get<double>() / 25.0, 3.33, 0.03);
  EXPECT_NEAR(json["left"]["fx_px"], 535, 5);
  EXPECT_LT(json["sigma"]["baseline_mm"], 0.5);
  const Called plain = stereo(boards_ + "/left??.jpg", boards_ + "/right??.jpg");
  EXPECT_THAT(plain.out, HasSubstr("baseline 83."));
  EXPECT_THAT(plain.out, HasSubstr("left14.jpg"));
}

TEST_F(CalibrateStereo, NamesAndSkipsImagesWithoutABoardOrAPartner) {
  for (const char* n : {"01", "02", "03", "04", "05"}) {
    take(std::string("left") + n + ".jpg");
    take(std::string("right") + n + ".jpg");
  }
  take("left06.jpg");
  const std::string grey(640 * 480, 'x');
  for (const char* name : {"left07.pgm", "right07.pgm"}) {
    ASSERT_FALSE(folder_.with(name, "P5\n640 480\n255\n" + grey).empty());
  }
  const std::string out = folder_.file("stereo.json");
  const Called called = stereo(folder_.file("left*"), folder_.file("right*"), {"--json", out});
  ASSERT_EQ(called.code, 0) << called.err;
  for (const char* name : {"left06.jpg", "left07.pgm", "right07.pgm"}) {
    EXPECT_THAT(called.err, HasSubstr(std::string(name) + ": no board of 9x6, or no partner"));
  }
  const auto json = nlohmann::json::parse(content_of(out));
  EXPECT_EQ(json["views_used"], 5);
  EXPECT_EQ(json["skipped"].size(), 3u);
  EXPECT_EQ(json["verdict"], "note");
  EXPECT_THAT(json["reason"].get<std::string>(), HasSubstr("5 views, better 10"));
}

TEST_F(CalibrateStereo, PairsByTheNumbersInTheNames) {
  for (const char* n : {"01", "02", "04", "05", "06", "07"}) {
    take(std::string("left") + n + ".jpg");
  }
  for (const char* n : {"02", "03", "04", "05", "06", "07"}) {
    take(std::string("right") + n + ".jpg");
  }
  const Called called = stereo(folder_.file("left*"), folder_.file("right*"), {"--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["views_used"], 5) << "02 and 04 to 07";
  EXPECT_LE(json["stereo_rms_px"], 0.45) << "paired by order it would be tens";
}

TEST_F(CalibrateStereo, RefusesInOneLineAndWritesNothing) {
  take("left01.jpg");
  take("right01.jpg");
  take("left02.jpg");
  const std::string out = folder_.file("out.json");
  const Called few =
      stereo(folder_.file("left01.jpg"), folder_.file("right01.jpg"), {"--json", out});
  EXPECT_EQ(few.code, 1);
  EXPECT_THAT(few.err, HasSubstr("refused: stereo calibration: the board is seen in 1 pair,"));
  const std::string small = folder_.with("right02.pgm", "P5 40 30 255\n" + std::string(1200, 'x'));
  const std::string text = folder_.with("a.txt", "hello");
  const std::vector<std::pair<Called, std::string>> cases = {
      {stereo(folder_.file("left02.jpg"), small), "is 40 x 30 px, the images before are 640 x 480"},
      {stereo(text, text), "a.txt"},
      {stereo(folder_.file("none*.jpg"), text), "none*.jpg: no file matches"},
      {stereo(text, text, {"--chessboard", "9by6"}), "--chessboard"},
      {stereo(text, text, {"--square-mm", "0"}), "--square-mm"},
      {orthonav({"calibrate", "stereo", "--chessboard", "6x6", "--left", text, "--right", text}),
       "as many rows"},
      {orthonav({"calibrate", "stereo", "--left", text, "--right", text}), "need --chessboard"},
      {orthonav({"calibrate", "stereo"}), "or a RECORDING and --board"},
      {orthonav({"calibrate", "stereo", text}), "a RECORDING needs --board"},
      {orthonav({"calibrate", "stereo", text, "--board", text, "--chessboard", "9x6"}),
       "give --chessboard"}};
  for (const auto& [called, what] : cases) {
    EXPECT_EQ(called.code, 2) << what;
    EXPECT_THAT(called.err, HasSubstr(what));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
  }
  EXPECT_THAT(folder_.names(),
              ElementsAre("a.txt", "left01.jpg", "left02.jpg", "right01.jpg", "right02.pgm"));
}

// The right camera is turned by 2 mrad about the baseline's normal: 0.7 px across the lines.
TEST(CalibrateStereoFromARecording, SaysByHowMuchTheDeviceIsOff) {
  const ScratchFolder folder;
  const std::string board = folder.file("board.json");
  engine::Board printed;
  printed.kind = engine::BoardKind::kTags;
  printed.columns = 3;
  printed.rows = 2;
  printed.size_m = 0.04;
  printed.gap_m = 0.01;
  printed.ids = engine::consecutive_ids(printed.kind, 3, 2, 0);
  ASSERT_TRUE(engine::save_board(board, printed).ok());

  const StereoCalibration device = test_calibration();
  StereoCalibration really = device;
  really.right_from_rig =
      Transform<RightCamera, RightCamera>(rotation_from_vector({0, 0.002, 0}), {}) *
      device.right_from_rig;
  std::vector<std::vector<PlacedTag>> pairs;
  Random random(4);
  for (int i = 0; i < 24; ++i) {
    const Mat3 rotation = rotation_from_vector(
        {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)});
    const Vec3 place{random.uniform(-0.05, 0.1), random.uniform(-0.08, 0.08), -0.45};
    pairs.emplace_back();
    for (std::size_t tag = 0; tag < printed.ids.size(); ++tag) {
      const auto corners = engine::tag_corners_m(printed, tag);
      const Vec2 centre = 0.5 * (corners[0] + corners[2]) - Vec2{0.07, 0.045};
      pairs.back().push_back({"tag36h11",
                              printed.ids[tag],
                              0.04,
                              {rotation, place + rotation * Vec3{centre.x, centre.y, 0}}});
    }
  }
  const auto off_px = [&](const std::string& name, const StereoCalibration& cameras) {
    record(folder.file(name), cameras, device, pairs);
    const Called called =
        orthonav({"calibrate", "stereo", folder.file(name), "--board", board, "--json"});
    EXPECT_EQ(called.code, 0) << called.err;
    const auto json = nlohmann::json::parse(called.out);
    EXPECT_EQ(json["pairs"], 24);
    EXPECT_LT(json["rms_px"], 0.1);
    EXPECT_EQ(json["is_off"], json["off_px"] > 0.1) << json["reason"];
    EXPECT_NEAR(json["size_ratio"], 1.0, 0.02);
    EXPECT_NEAR(json["baseline_mm"], 99.1, 0.3);
    return json["off_px"].get<double>();
  };
  EXPECT_NEAR(off_px("off", really), 0.002 * 360, 0.15);
  EXPECT_LT(off_px("good", device), 0.05);

  const std::string other = folder.with("chess.json", R"({"format": "orthonav board",
    "kind": "chessboard", "columns": 9, "rows": 6, "size_mm": 20})");
  const Called chess = orthonav({"calibrate", "stereo", folder.file("off"), "--board", other});
  EXPECT_EQ(chess.code, 2);
  EXPECT_THAT(chess.err, HasSubstr("is a chessboard, must be a board of tags"));
}

}  // namespace
}  // namespace orthonav::test::calibrate_stereo_test
