#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "hal/fake/scripted.h"

namespace orthonav::test {

/// A stereo camera like a HoloLens 2's, of round numbers.
inline const StereoCalibration& scripted_calibration() {
  static const StereoCalibration calibration = [] {
    BrownConrady left{640, 480, 360.0, 361.0, 323.0, 236.0, -0.04, 0.01, 1e-4, -2e-4, 0.0};
    BrownConrady right = left;
    right.cx_px = 314.0;
    right.fx_px = 358.5;
    StereoCalibration made;
    made.left = *CameraModel::from_brown_conrady(left);
    made.right = *CameraModel::from_brown_conrady(right);
    made.left_from_rig = {rotation_from_vector({0.01, 3.1, -0.02}), {0.001, 0.002, 0.003}};
    made.right_from_rig = {rotation_from_vector({0.02, 3.0, 0.01}), {0.0985, -0.001, 0.007}};
    return made;
  }();
  return calibration;
}

/// Pixels without a pattern: each image differs from every other.
inline GreyImage scripted_image(std::uint64_t seed) {
  GreyImage image(640, 480);
  std::uint64_t state = seed;
  for (std::uint8_t& pixel : image.pixels) {
    pixel = static_cast<std::uint8_t>(splitmix64(state) >> 56U);
  }
  return image;
}

/// Times that are not whole ticks of 100 ns, as a nanosecond clock gives them.
inline Timestamp scripted_time(int index) {
  return Timestamp(Duration(1'000'000'007 + std::int64_t{33'333'333} * index));
}

inline Transform<World, Rig> scripted_pose(int index) {
  const double t = index / 30.0;
  return {rotation_from_vector({0.1 * t + 0.3, -1.0 + 0.05 * t, 0.2 * t}),
          {0.013 * t, 1.7 - 0.01 * t, 0.002 * t + 1.0 / 3.0}};
}

inline StereoFrame scripted_frame(int index) {
  StereoFrame frame;
  frame.sequence = index;
  frame.time = scripted_time(index);
  frame.left = scripted_image(static_cast<std::uint64_t>(2 * index));
  frame.right = scripted_image(static_cast<std::uint64_t>(2 * index + 1));
  frame.world_from_rig = scripted_pose(index);
  return frame;
}

/// A small depth camera whose pixels all differ; the corners of its image have no rays.
inline DepthCalibration scripted_depth_camera(DepthStream stream, int width_px, int height_px) {
  DepthCalibration made;
  made.stream = stream;
  made.width_px = width_px;
  made.height_px = height_px;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const Vec2 p{(x + 0.5 - 0.48 * width_px) / 20.0, (y + 0.5 - 0.53 * height_px) / 21.0};
      const bool corner = p.norm() > 0.55 * width_px / 20.0;
      made.rays.push_back(corner ? DepthCalibration::Ray{} : DepthCalibration::ray_through(p));
    }
  }
  made.sensor_from_rig = {rotation_from_vector({0.2, -0.1, 1.4}), {0.01, -0.02, 0.03}};
  return made;
}

/// A depth camera with its own frame rate beside the pairs of scripted_session, from before the
/// first to after the last: a call without news, a frame without a pose, a map that moves.
inline fake::DepthScript scripted_depth(DepthCalibration camera, bool bright, int frames,
                                        Duration interval) {
  fake::DepthScript script;
  std::uint64_t state = static_cast<std::uint64_t>(camera.width_px);
  const auto noise = [&](DepthImage& image, std::uint16_t below) {
    image = DepthImage(camera.width_px, camera.height_px);
    for (std::uint16_t& pixel : image.pixels) {
      pixel = static_cast<std::uint16_t>(splitmix64(state) % below);
    }
  };
  for (int i = 0; i < frames; ++i) {
    if (i == 2) {
      script.steps.emplace_back(Next::kNone);
    }
    DepthFrame frame;
    frame.sequence = 10 + 2 * i;
    frame.map_epoch = i / 4;
    frame.time = scripted_time(0) - Duration(5'000'003) + interval * i;
    noise(frame.range_mm, 4090);
    if (bright && i != 3) {
      noise(frame.brightness, 65535);
    }
    if (i != 5) {
      frame.world_from_rig = scripted_pose(i);
    }
    script.steps.emplace_back(std::move(frame));
  }
  script.calibration = std::move(camera);
  return script;
}

/// A short session with typical events of a device: a call without news, a missing pair (5), a pair
/// without a pose (7), two depth cameras, presses, clicks, a double click, a hold and phrases.
inline fake::Script scripted_session(int frames = 12) {
  fake::Script script;
  script.calibration = scripted_calibration();
  script.display_latency = std::chrono::microseconds(16'667);
  script.clock_start = scripted_time(-1);
  script.may_repeat = {};
  for (int i = 0; i < frames; ++i) {
    if (i == 3) {
      script.camera.emplace_back(Next::kNone);
    }
    if (i == 5) {
      continue;
    }
    StereoFrame frame = scripted_frame(i);
    if (i == 7) {
      frame.world_from_rig.reset();
    }
    if (frame.world_from_rig) {
      script.head.push_back({frame.time, *frame.world_from_rig});
    }
    script.camera.emplace_back(std::move(frame));
  }
  const auto at = [](int frame, int ms) {
    return scripted_time(frame) + std::chrono::milliseconds(ms) + Duration(3);
  };
  using std::chrono::milliseconds;
  script.depth = {scripted_depth(scripted_depth_camera(DepthStream::kAhat, 24, 24), true,
                                 frames + 4, milliseconds(22)),
                  scripted_depth(scripted_depth_camera(DepthStream::kLongThrow, 20, 18), false, 3,
                                 milliseconds(150))};
  using enum ClickerAction;
  script.clicker = {{kPress, at(0, 5)}, {kRelease, at(1, 0)}, {kClick, at(1, 0)},
                    {kPress, at(2, 1)}, {kRelease, at(3, 2)}, {kDoubleClick, at(3, 2)},
                    {kPress, at(4, 0)}, {kHold, at(6, 0)},    {kRelease, at(8, 30)}};
  script.voice = {{"start", 0.93, at(0, 0)},
                  {"save, \"this\" \\ one\nand that", 1.0 / 3.0, at(4, 0)},
                  {"next", 1.0, at(9, 1)}};
  return script;
}

}  // namespace orthonav::test
