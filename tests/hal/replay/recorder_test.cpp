#include "hal/replay/recorder.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <thread>

#include "hal/fake/failing.h"
#include "hal/replay/layout.h"
#include "hal/replay/replay_headset.h"
#include "tests/hal/replay/recorded.h"
#include "tests/support/recorded_session.h"
#include "tests/support/scripted_session.h"
#include "tests/support/stream_recorder_folder.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay::recorder_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::expect_same;
using orthonav::test::play;
using orthonav::test::scripted_session;
using orthonav::test::SessionLog;
using orthonav::test::TemporaryFolder;

TEST(Recorder, PassesEverythingOnUnchanged) {
  const TemporaryFolder folder;
  const auto plain = headset();
  expect_same(record(headset(), folder / "session"), play(*plain));
}

TEST(Recorder, RecordsASessionThatReplaysToTheBit) {
  const TemporaryFolder folder;
  const SessionLog live = record(headset(), folder / "session");
  ASSERT_EQ(live.moments.size(), 11u);
  ASSERT_EQ(live.clicker.size(), 9u);
  ASSERT_EQ(live.voice.size(), 3u);
  auto replayed = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  expect_same((*replayed)->cameras()->calibration(), orthonav::test::scripted_calibration());
  expect_same(play(**replayed), live);
}

TEST(Recorder, RecordsAReplayAsTheSameFiles) {
  const TemporaryFolder folder;
  record(headset(), folder / "first", {"{\"tools\": []}"});
  auto replayed = ReplayHeadset::open(folder / "first");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  const auto tools = std::get<ToolsFile>((*replayed)->described_tools()).text;
  EXPECT_EQ(tools, "{\"tools\": []}");
  record(std::move(*replayed), folder / "second", {tools});
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "first")) {
    const auto name = entry.path().filename();
    ++files;
    EXPECT_TRUE(content_of(entry.path()) == content_of(folder / "second" / name)) << name;
  }
  constexpr int kFilesOfARecording = 15 + 2 * 5 + 1;  // two depth streams, the map of one
  EXPECT_EQ(files, kFilesOfARecording);
}

/// What a device without sensors says of itself is recorded with it; of any other recording, old
/// pictures and poses under new times are refused.
TEST(Recorder, KeepsWhetherItsPairsMayRepeat) {
  fake::Script script = scripted_session();
  script.may_repeat = {true, true};
  StereoFrame* before = nullptr;
  for (fake::CameraStep& step : script.camera) {
    auto* frame = std::get_if<StereoFrame>(&step);
    if (frame && before && frame->sequence == 2) {
      frame->right = before->right;
    }
    if (frame && before && frame->sequence == 10) {
      frame->world_from_rig = before->world_from_rig;
    }
    before = frame ? frame : before;
  }
  const TemporaryFolder folder;
  const SessionLog live = record(headset(script), folder / "session");
  EXPECT_TRUE(live.errors.empty());
  {
    auto replayed = ReplayHeadset::open(folder / "session");
    ASSERT_TRUE(replayed.ok()) << replayed.error().message;
    expect_same(play(**replayed), live);
  }
  const auto device = folder / "session" / kDeviceFile;
  std::string text = content_of(device);
  for (const std::string key : {"pictures_may_repeat,1\n", "head_pose_may_repeat,1\n"}) {
    ASSERT_NE(text.find(key), std::string::npos) << text;
    text.erase(text.find(key), key.size());
  }
  orthonav::test::write_text(device, text);
  auto of_sensors = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(of_sensors.ok()) << of_sensors.error().message;
  const SessionLog log = play(**of_sensors);
  EXPECT_EQ(log.moments.size(), live.moments.size() - 2);
  ASSERT_EQ(log.errors.size(), 2u);
  EXPECT_NE(log.errors[0].find("the right camera repeats its picture"), std::string::npos);
  EXPECT_NE(log.errors[1].find("head tracking repeats its pose"), std::string::npos);
}

TEST(Recorder, KeepsWhenTheMapMoved) {
  fake::Script script = scripted_session();
  std::int64_t epoch = 0;
  for (fake::CameraStep& step : script.camera) {
    if (auto* frame = std::get_if<StereoFrame>(&step)) {
      frame->map_epoch = epoch++ / 4;
    }
  }
  const TemporaryFolder folder;
  const SessionLog live = record(std::make_unique<fake::FakeHeadset>(script), folder / "session");
  EXPECT_TRUE(std::filesystem::exists(folder / "session" / "map.csv"));
  auto replayed = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  const SessionLog log = play(**replayed);
  ASSERT_EQ(log.moments.size(), live.moments.size());
  for (std::size_t i = 0; i < log.moments.size(); ++i) {
    EXPECT_EQ(log.moments[i].frame.map_epoch, live.moments[i].frame.map_epoch) << i;
  }
  EXPECT_GT(log.moments.back().frame.map_epoch, 0);
}

/// The map jumps at the sixth pair, and the recorded device knows of it or does not.
TEST(Recorder, KeepsWhatTheDeviceSaysOfAJumpAndAddsWhatItDoesNot) {
  for (const std::int64_t known : {3, 0}) {
    fake::Script script = scripted_session();
    int pair = 0;
    for (fake::CameraStep& step : script.camera) {
      if (auto* frame = std::get_if<StereoFrame>(&step); frame != nullptr && ++pair >= 6) {
        frame->map_epoch = known;
        if (frame->world_from_rig) {
          frame->world_from_rig =
              Transform<World, World>(Mat3::identity(), {0.423, 0, 0}) * *frame->world_from_rig;
        }
      }
    }
    const TemporaryFolder folder;
    const SessionLog live = record(std::make_unique<fake::FakeHeadset>(script), folder / "session");
    auto replayed = ReplayHeadset::open(folder / "session");
    ASSERT_TRUE(replayed.ok()) << replayed.error().message;
    const SessionLog log = play(**replayed);
    if (known != 0) {
      expect_same(live, log);
      continue;
    }
    ASSERT_EQ(log.moments.size(), live.moments.size());
    EXPECT_EQ(log.moments.front().frame.map_epoch, 0);
    EXPECT_EQ(log.moments.back().frame.map_epoch, 1);
    const Timestamp first = log.moments.front().frame.time;
    EXPECT_EQ((*replayed)->head().world_from_rig(first).status, PoseStatus::kLost);
  }
}

TEST(Recorder, WritesTheLayoutThatOtherReadersKnow) {
  const TemporaryFolder folder;
  record(headset(), folder / "session");
  // Ustar by its fixed offsets: name, size in octal, magic; then the image, which another library
  // reads.
  const std::string tar = content_of(folder / "session" / "VLC LF.tar");
  EXPECT_EQ(std::string(tar.c_str()), "10000000.png");
  const auto bytes = static_cast<std::size_t>(std::stol(tar.substr(124, 12), nullptr, 8));
  EXPECT_EQ(tar.substr(257, 5), "ustar");
  EXPECT_EQ(tar.substr(512, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(tar.substr(tar.size() - 1024), std::string(1024, '\0'));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, tar.data() + 512, bytes), 0);
  EXPECT_EQ(image.width, 640u);
  EXPECT_EQ(image.height, 480u);
  EXPECT_EQ(image.format, PNG_FORMAT_GRAY);
  png_image_free(&image);
  EXPECT_EQ(std::filesystem::file_size(folder / "session" / "VLC RF_lut.bin"), 3'686'400u);
  const std::string poses = content_of(folder / "session" / "VLC LF_rig2world.txt");
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 10);  // one pair has no pose
  EXPECT_EQ(poses.substr(0, 9), "10000000,");
}

TEST(Recorder, KeepsWhatItHasWithoutItsOwnFiles) {
  const TemporaryFolder folder;
  const SessionLog live = record(headset(), folder / "session");
  for (const char* name : {"frames.csv", "events.csv", "head.csv", "device.csv", "VLC LF_lut64.bin",
                           "VLC RF_lut64.bin"}) {
    ASSERT_TRUE(std::filesystem::remove(folder / "session" / name)) << name;
  }
  ReplayOptions options;  // nothing tells it from StreamRecorder's any more
  options.stamps = RecordedStamps::kExact;
  auto replayed = ReplayHeadset::open(folder / "session", options);
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  const SessionLog log = play(**replayed);
  ASSERT_EQ(log.moments.size(), live.moments.size());
  for (std::size_t i = 0; i < log.moments.size(); ++i) {
    const StereoFrame& frame = log.moments[i].frame;
    EXPECT_TRUE(frame.left == live.moments[i].frame.left);
    EXPECT_EQ(frame.world_from_rig, live.moments[i].frame.world_from_rig);
    const Duration lost = live.moments[i].frame.time - frame.time;
    EXPECT_GE(lost, Duration(0));
    EXPECT_LT(lost, Duration(100));  // a tick
  }
}

TEST(Recorder, ReplaysLateEventsAsLate) {
  // A phrase is understood half a second after it was spoken.
  const TemporaryFolder folder;
  fake::Faults faults;
  faults.voice = {{0, fake::EventFault::kDelay}};
  fake::FakeHeadset inner(scripted_session());
  fake::FailingHeadset late(inner, faults);
  auto recorder = RecordingHeadset::around(late, folder / "session");
  ASSERT_TRUE(recorder.ok());
  const auto phrases_at = [](Headset& h, int frame) {
    std::vector<Phrase> phrases;
    EXPECT_TRUE(h.voice().poll(orthonav::test::scripted_time(frame), phrases).ok());
    return phrases.size();
  };
  StereoFrame frame;
  ASSERT_TRUE((*recorder)->cameras()->next(frame).ok());
  EXPECT_EQ(phrases_at(**recorder, 1), 0u);
  EXPECT_EQ(phrases_at(**recorder, 2), 1u);
  ASSERT_TRUE((*recorder)->close().ok());
  auto replayed = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  EXPECT_EQ(phrases_at(**replayed, 1), 0u);
  EXPECT_EQ(phrases_at(**replayed, 2), 1u);
}

TEST(Recorder, RecordsOddLookUpTablesToTheBit) {
  const TemporaryFolder folder;
  fake::Script script = scripted_session(1);
  const auto table = script.calibration.left.lookup();
  std::vector<Vec2> holes(table.begin(), table.end());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < 640 * 3; ++i) {
    holes[i] = {kNan, kNan};
  }
  auto camera = CameraModel::from_lookup(640, 480, holes);
  ASSERT_TRUE(camera.ok());
  script.calibration.left = std::move(*camera);
  const StereoCalibration expected = script.calibration;
  record(headset(script), folder / "session");
  auto replayed = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  expect_same((*replayed)->cameras()->calibration(), expected);
}

TEST(Recorder, TakesQuestionsFromOtherThreads) {
  const TemporaryFolder folder;
  auto recorder = RecordingHeadset::create(headset(), folder / "session");
  ASSERT_TRUE(recorder.ok());
  std::atomic<bool> done{false};
  std::atomic<int> asked{0};
  std::thread display([&] {
    while (!done.load()) {
      const Timestamp now = (*recorder)->clock().now();
      EXPECT_EQ((*recorder)->head().world_from_rig(now).time, now);
      ++asked;
      std::this_thread::sleep_for(std::chrono::microseconds(200));  // leaves a processor to others
    }
  });
  const SessionLog log = play(**recorder);
  while (asked.load() == 0) {
    std::this_thread::yield();
  }
  EXPECT_TRUE((*recorder)->close().ok());
  done = true;
  display.join();
  EXPECT_EQ(log.moments.size(), 11u);
  EXPECT_TRUE((*recorder)->recording_status().ok());
  EXPECT_TRUE(ReplayHeadset::open(folder / "session").ok());
}

TEST(Recorder, KeepsFiletimeTicks) {
  const TemporaryFolder folder;
  fake::Script script = scripted_session(2);
  script.epoch_ticks_100ns = 116444736000000000;
  record(headset(script), folder / "session");
  auto replayed = ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  StereoFrame frame;
  ASSERT_TRUE((*replayed)->cameras()->next(frame).ok());
  EXPECT_EQ(frame.time, orthonav::test::scripted_time(0));
  EXPECT_EQ((*replayed)->file_ticks_100ns(frame.time), 116444736010000000);
}

}  // namespace
}  // namespace orthonav::replay::recorder_test
