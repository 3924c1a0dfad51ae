#include "tests/tools/tag_recording.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "hal/fake/scripted.h"
#include "hal/replay/recorder.h"

namespace orthonav::test {
namespace {

constexpr double kNoiseSd = 2.0;

// Where the tags are: in noise all over an image AprilTag looks for edges for most of a test's
// time, and finds none.
void add_noise(GreyImage& image, Random& random) {
  for (std::uint8_t& pixel : image.pixels) {
    if (pixel != kSceneGrey) {
      pixel = static_cast<std::uint8_t>(
          std::clamp(pixel + random.normal(0, kNoiseSd) + 0.5, 0.0, 255.0));
    }
  }
}

}  // namespace

void record(const std::string& folder, const StereoCalibration& calibration,
            const std::vector<std::vector<PlacedTag>>& pairs, int rate_hz) {
  record(folder, calibration, calibration, pairs, rate_hz);
}

void record(const std::string& folder, const StereoCalibration& really,
            const StereoCalibration& device, const std::vector<std::vector<PlacedTag>>& pairs,
            int rate_hz) {
  fake::Script script;
  script.calibration = device;
  Random random(21);
  for (const auto& tags : pairs) {
    const auto index = static_cast<std::int64_t>(script.camera.size());
    StereoFrame frame = stereo_frame(
        really, tags, Timestamp(Duration(1'000'000'000 + 999'999'000 / rate_hz * index)));
    frame.sequence = index;
    add_noise(frame.left, random);
    add_noise(frame.right, random);
    script.head.push_back({frame.time, *frame.world_from_rig});
    script.camera.emplace_back(std::move(frame));
  }
  fake::FakeHeadset headset(std::move(script));
  auto recorder = replay::RecordingHeadset::around(headset, folder);
  ASSERT_TRUE(recorder.ok()) << recorder.error().message;
  StereoFrame frame;
  for (auto next = (*recorder)->cameras()->next(frame); next && *next != Next::kEnd;
       next = (*recorder)->cameras()->next(frame)) {
  }
  const Status closed = (*recorder)->close();
  ASSERT_TRUE(closed.ok()) << closed.error().message;
}

}  // namespace orthonav::test
