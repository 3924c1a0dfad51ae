#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "hal/replay/image_tar.h"
#include "tests/support/tag_scene.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::recording_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Four pairs of an empty room, cut off within the third, under their temporary name.
class CutRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string whole = folder_.file("walk");
    record(whole, test_calibration(), std::vector<std::vector<PlacedTag>>(4));
    std::filesystem::rename(whole, cut_);
    const auto right = replay::ImageTar::open(cut_ + "/VLC RF.tar");
    ASSERT_TRUE(right.ok());
    std::filesystem::resize_file(cut_ + "/VLC RF.tar",
                                 right->end_of(right->members().at(1)) + 20'000);
  }
  ScratchFolder folder_;
  std::string cut_ = folder_.file("walk.part");
};

TEST_F(CutRecording, IsReadWithAWarningAndClosedByRepair) {
  const Called seen = orthonav({"doctor", "--headset", "replay:" + cut_});
  EXPECT_THAT(seen.out, AllOf(HasSubstr("2 pairs"), HasSubstr("Recording: cut off"),
                              HasSubstr("VLC RF.tar is cut off at byte ")));
  const Called run = orthonav(
      {"run", "--levels", "L5", "--headset", "replay:" + cut_, "--out", folder_.file("out")});
  EXPECT_THAT(run.err, HasSubstr("warning: the recording was cut off and is read to its last whole "
                                 "pair, 2 in all (VLC RF.tar is cut off"));
  const Called repaired = orthonav({"recording", "repair", cut_, "--json"});
  ASSERT_EQ(repaired.code, 0) << repaired.err;
  const auto json = nlohmann::json::parse(repaired.out);
  EXPECT_EQ(json["recording"], folder_.file("walk"));
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_FALSE(std::filesystem::exists(cut_));
  const Called again = orthonav({"doctor", "--headset", "replay:" + folder_.file("walk")});
  EXPECT_THAT(again.out, AllOf(HasSubstr("2 pairs"), Not(HasSubstr("cut off"))));
  const Called whole = orthonav({"recording", "repair", folder_.file("walk")});
  EXPECT_EQ(whole.code, 0);
  EXPECT_THAT(whole.out, HasSubstr("walk: 2 pairs; was whole"));
}

TEST(RecordingRepair, NamesWhatItCannotRepair) {
  const Called called = orthonav({"recording", "repair", "/nowhere/at/all"});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("/nowhere/at/all: no such recording"));
}

}  // namespace
}  // namespace orthonav::test::recording_test
