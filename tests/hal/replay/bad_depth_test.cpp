#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <limits>

#include "hal/replay/depth_files.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/depth_scene.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"

namespace orthonav::replay {
namespace {

using orthonav::test::content_of;
using orthonav::test::DepthScene;
using orthonav::test::HandmadeTar;
using orthonav::test::play;
using orthonav::test::scripted_session;
using orthonav::test::StreamRecorderFolder;
using orthonav::test::TemporaryFolder;
using orthonav::test::write_text;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::int64_t kFrame = 333'333;
constexpr const char* kTar = "Depth AHaT.tar";

using Folder = std::filesystem::path;

struct Damage {
  std::string name;
  std::function<void(const Folder&)> apply;
  std::vector<std::string> says;  ///< file, field, value, limit
};

DepthScene scene() {
  DepthScene made;
  made.pictures = {{0, DepthScene::pose(0)}, {kFrame, DepthScene::pose(1)}};
  return made;
}

std::string header(const std::string& size, const std::string& maximum) {
  return "P5\n" + size + "\n" + maximum + "\n";
}

/// An archive with one member in place of the camera's.
Damage member_damage(const std::string& name, const std::string& member, const std::string& content,
                     const std::vector<std::string>& says) {
  return {
      name,
      [=](const Folder& f) { write_text(f / kTar, HandmadeTar().add(member, content).finished()); },
      says};
}

Damage file_damage(const std::string& name, const std::string& file, const std::string& text,
                   const std::vector<std::string>& says) {
  return {name, [=](const Folder& f) { write_text(f / file, text); }, says};
}

Damage ray_damage(const std::string& name, float x, float z, const std::vector<std::string>& says) {
  return {name,
          [=](const Folder& f) {
            std::string rays = content_of(f / "Depth AHaT_lut.bin");
            const auto at = static_cast<std::size_t>(17 * 44 + 20) * 12;
            const std::array<float, 3> ray{x, 0.0F, z};
            std::memcpy(rays.data() + at, ray.data(), sizeof(ray));
            write_text(f / "Depth AHaT_lut.bin", rays);
          },
          says};
}

std::vector<Damage> damages() {
  const std::string pixels(44 * 36 * 2, 'x');
  const std::string good = header("44 36", "65535") + pixels;
  std::vector<Damage> all;
  for (const char* file :
       {"Depth AHaT_lut.bin", "Depth AHaT_extrinsics.txt", "Depth AHaT_rig2world.txt"}) {
    all.push_back({std::string("no ") + file,
                   [file](const Folder& f) { std::filesystem::remove(f / file); },
                   {file, "no such file"}});
  }
  all.insert(
      all.end(),
      {{"cut within the first image",
        [](const Folder& f) { write_text(f / kTar, content_of(f / kTar).substr(0, 3000)); },
        {kTar, "holds no whole image", "cut off at byte 3000"}},
       file_damage("no archive", kTar, std::string(5000, 'x'), {kTar}),
       file_damage("no member", kTar, HandmadeTar().finished(), {kTar, "holds no image"}),
       member_damage("brightness alone", "5_ab.pgm", good, {kTar, "holds no image"}),
       member_damage("outside", "../5.pgm", good, {kTar, "../5.pgm", "<ticks>_ab.pgm"}),
       member_damage("outside brightness", "../5_ab.pgm", good, {kTar, "../5_ab.pgm"}),
       member_damage("rooted", "/5.pgm", good, {kTar, "/5.pgm"}),
       member_damage("other suffix", "5_sigma.pgm", good, {kTar, "5_sigma.pgm"}),
       member_damage("huge time", "99999999999999999999.pgm", good, {kTar, "99999999999"}),
       member_damage("time far off", "5.pgm", good, {kTar, "time 5", "285 years"}),
       member_damage("8 bit", "5.pgm", header("44 36", "255") + pixels.substr(44 * 36),
                     {kTar, "maximum grey 255", "must be 65535"}),
       member_damage("12 bit", "5.pgm", header("44 36", "4095") + pixels,
                     {kTar, "maximum grey 4095", "must be 65535"}),
       member_damage("short", "5.pgm", good.substr(0, good.size() - 1),
                     {kTar, "holds 3182 bytes", "must be 3183"}),
       member_damage("long", "5.pgm", good + "x", {kTar, "holds 3184 bytes", "must be 3183"}),
       member_damage("no pixels", "5.pgm", header("44 36", "65535"), {kTar, "holds 15 bytes"}),
       member_damage("absurdly wide", "5.pgm", header("999999999 999999999", "65535") + "x",
                     {kTar, "999999999x999999999 px", "must be 2 to 2048"}),
       member_damage("wider than an integer", "5.pgm", header("99999999999999 2", "65535") + "x",
                     {kTar, "broken PGM header"}),
       member_damage("empty image", "5.pgm", header("0 36", "65535"), {kTar, "0x36 px"}),
       member_damage("a line", "5.pgm", header("1 36", "65535") + pixels.substr(0, 72),
                     {kTar, "1x36 px", "must be 2 to 2048"}),
       member_damage("text", "5.pgm", "P2\n44 36\n65535\n1 2 3", {kTar, "5.pgm", "P5"}),
       {"other size",
        [=](const Folder& f) {
          HandmadeTar tar;
          tar.add(std::to_string(StreamRecorderFolder::kStart) + ".pgm", good);
          tar.add(std::to_string(StreamRecorderFolder::kStart + 9) + ".pgm",
                  header("36 44", "65535") + pixels);
          write_text(f / kTar, tar.finished());
        },
        {kTar, "36x44 px", "must be 44x36"}},
       {"other brightness",
        [=](const Folder& f) {
          HandmadeTar tar;
          tar.add(std::to_string(StreamRecorderFolder::kStart) + ".pgm", good);
          tar.add(std::to_string(StreamRecorderFolder::kStart) + "_ab.pgm",
                  header("36 44", "65535") + pixels);
          write_text(f / kTar, tar.finished());
        },
        {kTar, "_ab.pgm", "must be 44x36"}}});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  all.insert(
      all.end(),
      {ray_damage("nan ray", kNan, 0.9F, {"Depth AHaT_lut.bin", "pixel (20, 17)", "not finite"}),
       ray_damage("nan z", 0.0F, kNan, {"Depth AHaT_lut.bin", "pixel (20, 17)", "not finite"}),
       ray_damage("long ray", 3.0F, 0.9F, {"Depth AHaT_lut.bin", "pixel (20, 17)", "must be 1"}),
       ray_damage("backward ray", 0.0F, -1.0F, {"Depth AHaT_lut.bin", "must point ahead"}),
       file_damage("short table", "Depth AHaT_lut.bin", "short",
                   {"Depth AHaT_lut.bin", "5 bytes", "must be 19008"}),
       file_damage("mirrored camera", "Depth AHaT_extrinsics.txt",
                   "0,1,0,0,1,0,0,0,0,0,1,0,0,0,0,1",
                   {"Depth AHaT_extrinsics.txt", "camera_from_rig", "mirrors"}),
       file_damage("camera far off", "Depth AHaT_extrinsics.txt",
                   "1,0,0,50,0,1,0,0,0,0,1,0,0,0,0,1",
                   {"Depth AHaT_extrinsics.txt", "50.0", "limit 1.0"}),
       file_damage("mirrored pose", "Depth AHaT_rig2world.txt",
                   "5,1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1\n",
                   {"Depth AHaT_rig2world.txt", "line 1", "mirrors"}),
       file_damage("cut pose", "Depth AHaT_rig2world.txt", "5,1,0\n",
                   {"Depth AHaT_rig2world.txt", "line 1", "must be 17"})});
  return all;
}

class BadDepth : public ::testing::TestWithParam<Damage> {};

/// The pairs are a session even without it.
TEST_P(BadDepth, IsLeftOutInOneLineThatSaysWhy) {
  const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
  scene().write_stream_recorder(folder.path(), "Depth AHaT");
  scene().write_stream_recorder(folder.path(), "Depth Long Throw");
  GetParam().apply(folder.path());
  const auto headset = ReplayHeadset::open(folder.path());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EXPECT_EQ((*headset)->summary().pairs, 2);
  ASSERT_EQ((*headset)->depth_cameras().size(), 1u);
  EXPECT_EQ((*headset)->depth_cameras().front()->calibration().stream, DepthStream::kLongThrow);
  ASSERT_EQ((*headset)->summary().depth.size(), 2u);
  const DepthSummary& left_out = (*headset)->summary().depth.front();
  EXPECT_EQ(left_out.stream, DepthStream::kAhat);
  EXPECT_NE(left_out.trouble, "");
  EXPECT_THAT(left_out.trouble, Not(HasSubstr("\n")));
  for (const std::string& part : GetParam().says) {
    EXPECT_THAT(left_out.trouble, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadDepth, ::testing::ValuesIn(damages()), [](const auto& damage) {
  std::string name = damage.param.name;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      c = '_';
    }
  }
  return name;
});

/// The trouble of the only stream in a folder, none when it can be read.
std::string trouble(const Folder& folder) {
  const RecordedDepths depths = read_depths(folder);
  EXPECT_EQ(depths.streams.size() + depths.unreadable.size(), 1u);
  return depths.unreadable.empty() ? "" : depths.unreadable.front().trouble;
}

TEST(WholeDepth, IsRead) {
  const TemporaryFolder folder;
  scene().write_stream_recorder(folder.path(), "Depth AHaT");
  EXPECT_EQ(trouble(folder.path()), "");
}

TEST(BadHololens1Depth, SaysWhy) {
  const TemporaryFolder folder;
  const auto damaged = [&](const std::string& file, const std::string& text) {
    scene().write_hololens1(folder.path(), "short_throw_depth");
    EXPECT_EQ(trouble(folder.path()), "");
    write_text(folder / file, text);
    return trouble(folder.path());
  };
  EXPECT_THAT(damaged("short_throw_depth.csv", "nonsense\n"), HasSubstr("line 1"));
  EXPECT_THAT(damaged("short_throw_depth.csv", "Timestamp\n1,2,3\n"),
              HasSubstr("line 2: holds 3 columns, must be 50"));
  EXPECT_THAT(damaged("short_throw_depth_camera_space_projection.bin", "short"),
              HasSubstr("holds 5 bytes, must be 12672"));
  EXPECT_THAT(damaged("short_throw_depth.tar",
                      HandmadeTar().add("short_throw_depth/5.pgm", "P5").finished()),
              HasSubstr("is not an image named short_throw_depth\\<ticks>.pgm"));
  EXPECT_THAT(damaged("short_throw_depth.tar",
                      HandmadeTar().add("short_throw_depth\\5_ab.pgm", "P5").finished()),
              HasSubstr("is not an image named"));
}

TEST(BadOwnDepth, ContradictsItself) {
  const TemporaryFolder folder;
  fake::FakeHeadset inner(scripted_session(4));
  auto recorder = RecordingHeadset::around(inner, folder / "session");
  ASSERT_TRUE(recorder.ok());
  play(**recorder);
  ASSERT_TRUE((*recorder)->close().ok());
  std::filesystem::remove(folder / "session" / "Depth Long Throw.tar");
  const auto list = folder / "session" / "Depth AHaT_frames.csv";
  const std::string good = content_of(list);
  EXPECT_EQ(trouble(folder / "session"), "");
  write_text(list, good.substr(0, good.rfind('\n', good.size() - 2) + 1));
  EXPECT_THAT(trouble(folder / "session"), HasSubstr("frames, the archive holds"));
  const std::string ticks = "9950000";
  ASSERT_NE(good.find(ticks), std::string::npos) << good;
  std::string other = good;
  write_text(list, other.replace(other.find("," + ticks + ",") + 1, ticks.size(), "9950001"));
  EXPECT_THAT(trouble(folder / "session"), HasSubstr("has ticks 9950001, its image 9950000"));
  other = good;
  const std::size_t time = good.find("995000004");
  ASSERT_NE(time, std::string::npos) << good;
  write_text(list, other.replace(time, 9, "995000104"));
  EXPECT_THAT(trouble(folder / "session"), HasSubstr("time_ns does not belong to its ticks_100ns"));
  // The second frame's clock, that of the pair after it, a millisecond before its time.
  other = good;
  const std::size_t second = other.find("\n12,1017000004,10170000,");
  ASSERT_NE(second, std::string::npos) << good;
  const std::size_t clock = other.find_last_of(',', other.find('\n', second + 1)) + 1;
  write_text(list, other.replace(clock, other.find('\n', clock) - clock, "1016000004"));
  EXPECT_THAT(trouble(folder / "session"), HasSubstr("sequence 12: clock_ns lies before time_ns"));
}

TEST(PartialDepth, IsCountedAndDelivered) {
  const TemporaryFolder folder;
  DepthScene partial = scene();
  partial.pictures.push_back({2 * kFrame, std::nullopt});
  partial.write_stream_recorder(folder.path(), "Depth AHaT");
  const std::string image = partial.pgm(true, DepthScene::brightness);
  HandmadeTar tar;
  constexpr std::int64_t kStart = StreamRecorderFolder::kStart;
  const auto name = [](std::int64_t at, const char* suffix) {
    return std::to_string(kStart + at) + suffix + ".pgm";
  };
  // Out of order, one twice, brightness for another time and for the last alone.
  tar.add(name(kFrame, ""), image).add(name(0, ""), image).add(name(0, ""), image);
  tar.add(name(5, "_ab"), image).add(name(2 * kFrame, "_ab"), image);
  tar.add(name(2 * kFrame, ""), image);
  write_text(folder / kTar, tar.finished());
  RecordedDepths depths = read_depths(folder.path());
  ASSERT_THAT(depths.unreadable, IsEmpty());
  ASSERT_EQ(depths.streams.size(), 1u);
  RecordedDepth& depth = depths.streams.front();
  EXPECT_EQ(depth.summary.frames, 3);
  EXPECT_EQ(depth.summary.repeated, 1);
  EXPECT_EQ(depth.summary.brightness_unpaired, 1);
  EXPECT_EQ(depth.summary.frames_without_pose, 1);
  DepthFrame frame;
  for (const RecordedDepthFrame& recorded : depth.frames) {
    ASSERT_TRUE(depth.read(recorded, frame).ok());
    EXPECT_EQ(frame.brightness.pixels.empty(), recorded.range.ticks != kStart + 2 * kFrame);
  }
}

}  // namespace
}  // namespace orthonav::replay
