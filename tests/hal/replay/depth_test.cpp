#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal/replay/depth_files.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/depth_scene.h"
#include "tests/support/scripted_session.h"

namespace orthonav::replay::depth_test {
namespace {

using orthonav::test::DepthScene;
using orthonav::test::Hololens1Folder;
using orthonav::test::scripted_calibration;
using orthonav::test::scripted_frame;
using orthonav::test::StreamRecorderFolder;
using ::testing::IsEmpty;

constexpr std::int64_t kFrame = 333'333;
// Half a millimetre of rounding along the ray, and a micrometre for single precision and six digits
// over a metre.
constexpr double kQuantisationM = 0.0005 + 5e-6;

/// By the stamps in the files, whose names the headset then gives to depth too.
std::unique_ptr<ReplayHeadset> opened(const std::filesystem::path& folder) {
  ReplayOptions options;
  options.stamps = RecordedStamps::kExact;
  auto headset = ReplayHeadset::open(folder, options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? std::move(*headset) : nullptr;
}

/// The largest distance of a frame's points from their places in the scene.
struct Deviation {
  double from_place_m = 0.0;
  double from_plane_m = 0.0;
  int points = 0;
};

Deviation deviation(const DepthScene& scene, const DepthScene::Picture& picture,
                    const DepthCalibration& camera, const DepthFrame& frame) {
  Deviation worst;
  if (!frame.world_from_rig) {
    return worst;
  }
  const auto world_from_sensor = *frame.world_from_rig * camera.sensor_from_rig.inverse();
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto point = camera.point_at(x, y, frame.range_mm.at(x, y));
      if (!point) {
        continue;
      }
      const Vec3 in_world = (world_from_sensor * *point).v;
      worst.from_place_m =
          std::max(worst.from_place_m, (in_world - scene.hit(picture, x, y).v).norm());
      worst.from_plane_m =
          std::max(worst.from_plane_m, std::abs(scene.normal.dot(in_world) - scene.offset_m));
      ++worst.points;
    }
  }
  return worst;
}

/// The pixels that have both a ray and a measurement in the files.
int measured_pixels(const DepthScene& scene, const DepthScene::Picture& picture, bool hololens1) {
  int count = 0;
  for (int y = 0; y < scene.height_px; ++y) {
    for (int x = 0; x < scene.width_px; ++x) {
      bool mapped = scene.mapped(x + 0.5, y + 0.5);
      if (hololens1) {  // all four corners of a pixel must be known, and past the last none is
        const int x0 = std::min(x, scene.width_px - 2);
        const int y0 = std::min(y, scene.height_px - 2);
        mapped = scene.mapped(x0, y0) && scene.mapped(x0 + 1, y0) && scene.mapped(x0, y0 + 1) &&
                 scene.mapped(x0 + 1, y0 + 1);
      }
      if (mapped && scene.range_mm(picture, x, y, 0) != 0) {
        ++count;
      }
    }
  }
  return count;
}

void expect_plane(const DepthScene& scene, ReplayHeadset& headset, DepthStream stream,
                  bool hololens1) {
  ASSERT_EQ(headset.depth_cameras().size(), 1u);
  DepthCamera& camera = *headset.depth_cameras().front();
  EXPECT_EQ(camera.calibration().stream, stream);
  StereoFrame pair;
  while (*headset.cameras()->next(pair) == Next::kFrame) {
  }
  DepthFrame frame;
  for (const DepthScene::Picture& picture : scene.pictures) {
    const auto next = camera.next(frame);
    ASSERT_TRUE(next.ok()) << next.error().message;
    ASSERT_EQ(*next, Next::kFrame);
    EXPECT_EQ(headset.file_ticks_100ns(frame.time), StreamRecorderFolder::kStart + picture.ticks);
    EXPECT_EQ(frame.world_from_rig.has_value(), picture.world_from_rig.has_value());
    if (!picture.world_from_rig) {
      continue;
    }
    const Deviation worst = deviation(scene, picture, camera.calibration(), frame);
    EXPECT_LT(worst.from_place_m, kQuantisationM);
    EXPECT_LT(worst.from_plane_m, kQuantisationM);
    EXPECT_EQ(worst.points, measured_pixels(scene, picture, hololens1));
    EXPECT_GT(worst.points, 800);
  }
  EXPECT_EQ(*camera.next(frame), Next::kEnd);
}

TEST(Depth, OfStreamRecorderLiesWhereItWasSeen) {
  for (const auto& [sensor, stream] : {std::pair{"Depth AHaT", DepthStream::kAhat},
                                       std::pair{"Depth Long Throw", DepthStream::kLongThrow}}) {
    SCOPED_TRACE(sensor);
    const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
    DepthScene scene;
    scene.pictures = DepthScene::located({-5, 100'000, 400'000});
    scene.pictures[1].world_from_rig.reset();
    scene.write_stream_recorder(folder.path(), sensor);
    const auto headset = opened(folder.path());
    ASSERT_NE(headset, nullptr);
    expect_plane(scene, *headset, stream, false);
    ASSERT_EQ(headset->summary().depth.size(), 1u);
    const DepthSummary& summary = headset->summary().depth.front();
    EXPECT_EQ(summary.frames, 3);
    EXPECT_EQ(summary.frames_without_pose, 1);
    EXPECT_EQ(summary.width_px, scene.width_px);
    EXPECT_EQ(summary.height_px, scene.height_px);
    EXPECT_EQ(summary.trouble, "");
  }
}

TEST(Depth, OfHololens1LiesWhereItWasSeen) {
  for (const auto& [sensor, stream] : {std::pair{"short_throw_depth", DepthStream::kShortThrow},
                                       std::pair{"long_throw_depth", DepthStream::kLongThrow}}) {
    SCOPED_TRACE(sensor);
    const Hololens1Folder folder(scripted_calibration(), {scripted_frame(0), scripted_frame(1)});
    DepthScene scene;
    scene.pictures = DepthScene::located({10'000'000, 10'500'000, 20'000'000});
    scene.pictures[1].world_from_rig.reset();
    scene.write_hololens1(folder.path(), sensor);
    const auto headset = opened(folder.path());
    ASSERT_NE(headset, nullptr);
    expect_plane(scene, *headset, stream, true);
  }
}

/// Each convention read the other way round would be off by far more than the tolerance.
TEST(Depth, IsToldApartFromItsMirrorsAndTransposes) {
  DepthScene scene;
  scene.pictures = DepthScene::located({0});
  const DepthScene::Picture& picture = scene.pictures.front();
  DepthCalibration camera{
      DepthStream::kAhat, scene.width_px, scene.height_px, {}, scene.sensor_from_rig};
  DepthFrame frame;
  frame.range_mm = DepthImage(scene.width_px, scene.height_px);
  frame.world_from_rig = picture.world_from_rig;
  for (int y = 0; y < scene.height_px; ++y) {
    for (int x = 0; x < scene.width_px; ++x) {
      camera.rays.push_back(DepthCalibration::ray_through(scene.unit_plane(x + 0.5, y + 0.5)));
      frame.range_mm.at(x, y) = scene.range_mm(picture, x, y, 0);
    }
  }
  const auto place = [&](const DepthCalibration& c, const DepthFrame& f) {
    return deviation(scene, picture, c, f).from_place_m;
  };
  EXPECT_LT(place(camera, frame), kQuantisationM);
  constexpr double kPlainM = 0.005;
  DepthFrame swapped = frame;
  for (std::uint16_t& pixel : swapped.range_mm.pixels) {
    pixel = static_cast<std::uint16_t>(pixel << 8U | pixel >> 8U);
  }
  EXPECT_GT(place(camera, swapped), kPlainM);
  DepthCalibration along_z = camera;  // as if the range were z
  for (DepthCalibration::Ray& ray : along_z.rays) {
    const float z = ray[2];
    for (float& part : ray) {
      part /= z;
    }
  }
  EXPECT_GT(place(along_z, frame), kPlainM);
  DepthCalibration upside_down = camera;
  for (DepthCalibration::Ray& ray : upside_down.rays) {
    ray[1] = -ray[1];
  }
  EXPECT_GT(place(upside_down, frame), kPlainM);
  DepthCalibration half_a_pixel = camera;
  for (int y = 0; y < scene.height_px; ++y) {
    for (int x = 0; x < scene.width_px; ++x) {
      half_a_pixel.rays[static_cast<std::size_t>(y * scene.width_px + x)] =
          DepthCalibration::ray_through(scene.unit_plane(x, y));
    }
  }
  EXPECT_GT(place(half_a_pixel, frame), kPlainM);
  DepthCalibration transposed = camera;
  transposed.sensor_from_rig = {camera.sensor_from_rig.rotation().transposed(),
                                camera.sensor_from_rig.translation()};
  EXPECT_GT(place(transposed, frame), kPlainM);
  DepthFrame elsewhere = frame;
  elsewhere.world_from_rig = Transform<World, Rig>(frame.world_from_rig->rotation().transposed(),
                                                   frame.world_from_rig->translation());
  EXPECT_GT(place(camera, elsewhere), kPlainM);
}

/// The first frame of the only depth camera, as the archive alone has it.
DepthFrame first_frame(const std::filesystem::path& folder) {
  RecordedDepths depths = read_depths(folder);
  DepthFrame frame;
  EXPECT_THAT(depths.unreadable, IsEmpty());
  EXPECT_EQ(depths.streams.size(), 1u);
  if (depths.streams.size() == 1) {
    RecordedDepth& depth = depths.streams.front();
    EXPECT_TRUE(depth.read(depth.frames.front(), frame).ok());
  }
  return frame;
}

TEST(Depth, HasOneMarkForWhatWasNotMeasured) {
  DepthScene scene;
  scene.pictures = DepthScene::located({0});
  const auto zeros = [](const DepthFrame& frame) {
    return std::count(frame.range_mm.pixels.begin(), frame.range_mm.pixels.end(), 0);
  };
  const std::ptrdiff_t unmeasured = scene.width_px * scene.height_px / 9;
  for (const std::uint16_t mark : std::initializer_list<std::uint16_t>{0, 4090, 4095, 65535}) {
    const orthonav::test::TemporaryFolder ahat;
    scene.write_stream_recorder(ahat.path(), "Depth AHaT", mark);
    EXPECT_EQ(zeros(first_frame(ahat.path())), unmeasured) << mark;
    const orthonav::test::TemporaryFolder hololens1;
    scene.write_hololens1(hololens1.path(), "short_throw_depth", mark);
    EXPECT_EQ(zeros(first_frame(hololens1.path())), unmeasured) << mark;
  }
  const orthonav::test::TemporaryFolder far;
  scene.write_stream_recorder(far.path(), "Depth Long Throw", 7400);
  EXPECT_EQ(zeros(first_frame(far.path())), 0) << "long throw sees past 4 m";
}

TEST(Depth, HasTheBrightnessOfItsTime) {
  DepthScene scene;
  scene.pictures = DepthScene::located({0, 10});
  const orthonav::test::TemporaryFolder folder;
  scene.write_stream_recorder(folder.path(), "Depth AHaT");
  const DepthFrame frame = first_frame(folder.path());
  ASSERT_EQ(frame.brightness.width_px, scene.width_px);
  EXPECT_EQ(frame.brightness.at(7, 3), DepthScene::brightness(7, 3));
  scene.write_stream_recorder(folder.path(), "Depth AHaT", 0, false);
  EXPECT_TRUE(first_frame(folder.path()).brightness.pixels.empty());
}

TEST(Depth, NeedsNoPairs) {
  DepthScene scene;
  scene.pictures = DepthScene::located({0, 10});
  const orthonav::test::TemporaryFolder folder;
  scene.write_stream_recorder(folder.path(), "Depth Long Throw");
  const RecordedDepths depths = read_depths(folder.path());
  ASSERT_EQ(depths.streams.size(), 1u);
  EXPECT_EQ(depths.streams.front().frames.size(), 2u);
}

TEST(Depth, IsNotMissedWhereThereIsNone) {
  const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
  const auto headset = opened(folder.path());
  ASSERT_NE(headset, nullptr);
  EXPECT_THAT(headset->depth_cameras(), IsEmpty());
  EXPECT_THAT(headset->summary().depth, IsEmpty());
}

TEST(Depth, OfTheRecordedSampleCanBeRead) {
  const std::filesystem::path sample =
      std::filesystem::path(ORTHONAV_SHARED_DIR) / "recordings/streamrecorder-sample";
  if (!std::filesystem::exists(sample)) {
    GTEST_SKIP() << "needs shared/recordings/streamrecorder-sample";
  }
  RecordedDepths depths = read_depths(sample);
  ASSERT_THAT(depths.unreadable, IsEmpty());
  if (depths.streams.empty()) {
    GTEST_SKIP() << "needs depth in shared/recordings/streamrecorder-sample";
  }
  DepthFrame frame;
  for (RecordedDepth& depth : depths.streams) {
    for (const RecordedDepthFrame& recorded : depth.frames) {
      EXPECT_TRUE(depth.read(recorded, frame).ok());
    }
  }
}

}  // namespace
}  // namespace orthonav::replay::depth_test
