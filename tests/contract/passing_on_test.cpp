#include <gtest/gtest.h>

#include <fstream>

#include "hal/fake/failing.h"
#include "hal/open/joined_headset.h"
#include "hal/open/open.h"
#include "hal/openxr/openxr_headset.h"
#include "hal/replay/recorder.h"
#include "tests/support/session_log.h"
#include "tests/support/telling_headset.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::test {
namespace {

TEST(HeadsetsThatWrap, PassOnWhatTheOtherOneTells) {
  TellingHeadset inner;
  inner.measure_tools();
  fake::FailingHeadset failing(inner, {});
  expect_passed_on(inner, failing, false);
  JoinedHeadset joined(inner, {});
  expect_passed_on(inner, joined, true);
  auto cameras = std::make_unique<TellingHeadset>();
  TellingHeadset& borrowed = *cameras;
  const auto openxr = openxr::OpenxrHeadset::around(std::move(cameras), {});
  expect_passed_on(borrowed, *openxr, true);
  const TemporaryFolder folder;
  const auto refused = replay::RecordingHeadset::around(inner, folder / "session");
  ASSERT_FALSE(refused.ok()) << "its poses would be missing in the recording";
  TellingHeadset seeing;
  const auto recorder = replay::RecordingHeadset::around(seeing, folder / "session");
  ASSERT_TRUE(recorder.ok()) << recorder.error().message;
  expect_passed_on(seeing, **recorder, false);
}

TEST(Headset, TellsNothingUnlessItsDeviceDoes) {
  const fake::FakeHeadset headset(scripted_session());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(headset.described_tools()));
  EXPECT_FALSE(headset.connection());
}

TEST(ReplayedTools, AreTheTextThatWasRecorded) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string(), std::string("{}")}) {
    const auto path = folder / ("session" + text);
    auto recorder = replay::RecordingHeadset::create(
        std::make_unique<fake::FakeHeadset>(scripted_session()), path, {text});
    ASSERT_TRUE(recorder.ok()) << recorder.error().message;
    play(**recorder);
    ASSERT_TRUE((*recorder)->close().ok());
    const auto replayed = open_headset("replay:" + path.string());
    ASSERT_TRUE(replayed.ok()) << replayed.error().message;
    const DescribedTools tools = (*replayed)->described_tools();
    ASSERT_EQ(std::holds_alternative<ToolsFile>(tools), !text.empty());
    if (!text.empty()) {
      EXPECT_EQ(std::get<ToolsFile>(tools).text, text);
      EXPECT_EQ(std::get<ToolsFile>(tools).name, "tools.json of the recording");
    }
  }
}

TEST(OpenWithRoom, NamesTheRoomThatTheCamerasSee) {
  for (const char* uri : {"sim:?seed=7", "openxr:", "openxr:+sim:?seed=7"}) {
    const auto opened = open_with_room(uri);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    ASSERT_TRUE(opened->room) << uri;
    EXPECT_EQ(opened->room->options().seed, std::string(uri) == "openxr:" ? 1u : 7u) << uri;
    // The tools of a planning file, through whatever is around the room.
    const DescribedTools tools = opened->headset->described_tools();
    ASSERT_TRUE(std::holds_alternative<std::vector<DescribedTool>>(tools)) << uri;
    EXPECT_EQ(std::get<std::vector<DescribedTool>>(tools).size(), 1u) << uri;
  }
}

TEST(OpenWithRoom, NamesTheCalibrationOfTheRigFile) {
  const TemporaryFolder folder;
  const auto opened_with = [&](const std::string& more) {
    const std::string path = (folder.path() / "rig.json").string();
    std::ofstream(path) << R"({"view_from_rig": [[1,0,0,-50],[0,1,0,10],[0,0,1,-30],[0,0,0,1]])"
                        << more << "}";
    return open_with_room("openxr:?rig=" + path + "+sim:");
  };
  const auto without = opened_with("");
  ASSERT_TRUE(without.ok()) << without.error().message;
  EXPECT_EQ(without->calibration_file, "");
  const auto with = opened_with(R"(, "calibration": "stereo.json")");
  ASSERT_TRUE(with.ok()) << with.error().message;
  EXPECT_EQ(with->calibration_file, (folder.path() / "stereo.json").string());
  for (const char* wrong : {"3", "\"\"", "null"}) {
    const auto refused = opened_with(std::string(", \"calibration\": ") + wrong);
    ASSERT_FALSE(refused.ok()) << wrong;
    EXPECT_NE(refused.error().message.find("calibration must be the path"), std::string::npos);
  }
}

}  // namespace
}  // namespace orthonav::test
