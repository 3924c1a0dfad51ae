#include "tools/preview/recorded_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "hal/replay/recorder.h"
#include "hal/sim/cameras/room_renderer.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::preview::recorded_images_test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 240;

/// A pointer with a large tag over the bare table.
sim::RoomDescription table() {
  sim::RoomTool pointer;
  pointer.name = "pointer";
  pointer.id = 3;
  pointer.size_m = 0.07;
  pointer.tip_in_marker = {{0.0, -0.13, 0.0}};
  sim::RoomDescription room;
  room.tools.push_back(pointer);
  return room;
}

RgbaImage dark() {
  RgbaImage picture{kWidth_px, kHeight_px, {}};
  picture.pixels.resize(4u * kWidth_px * kHeight_px);
  return picture;
}

/// Pearson's, of the red channels, the second one shifted to the right.
double correlation(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                   int offset_px) {
  double n = 0, sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = offset_px; x < kWidth_px; ++x) {
      const double va = a[static_cast<std::size_t>(4 * (y * kWidth_px + x))];
      const double vb = b[static_cast<std::size_t>(4 * (y * kWidth_px + x - offset_px))];
      n += 1;
      sum_a += va;
      sum_b += vb;
      sum_aa += va * va;
      sum_bb += vb * vb;
      sum_ab += va * vb;
    }
  }
  return (n * sum_ab - sum_a * sum_b) /
         std::sqrt((n * sum_aa - sum_a * sum_a) * (n * sum_bb - sum_b * sum_b));
}

TEST(RecordedImages, AreWhatAnEyeInTheCamerasPlaceSees) {
  const fs::path folder = fs::path(::testing::TempDir()) / "preview-recorded-images";
  fs::remove_all(folder);
  sim::SimOptions options;
  options.error_model = sim::ErrorModel::perfect();
  auto headset = sim::SimHeadset::open(table(), options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  auto recorder = replay::RecordingHeadset::around(**headset, folder);
  ASSERT_TRUE(recorder.ok()) << recorder.error().message;
  StereoFrame frame;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(*(*recorder)->cameras()->next(frame), Next::kFrame);
  }
  const sim::RoomState state = (*headset)->state();
  ASSERT_TRUE((*recorder)->close().ok());

  auto images = RecordedImages::open(folder);
  ASSERT_TRUE(images.ok()) << images.error().message;
  EXPECT_EQ(images->pairs(), 3);
  render::View view;
  view.tan_left = view.tan_right = 0.48f;
  view.tan_up = view.tan_down = 0.36f;
  RgbaImage straightened = dark();
  images->draw(frame.sequence, view, straightened);
  RgbaImage untouched = dark();
  images->draw(frame.sequence + 7, view, untouched);
  EXPECT_TRUE(untouched == dark());
  fs::remove_all(folder);

  RgbaImage seen{kWidth_px, kHeight_px, dark().pixels};
  const sim::PinholeView eye{
      state.room_from_rig * Transform<Rig, Eye>{Mat3::identity(), images->eye_in_rig()}, 0.48, 0.48,
      0.36, 0.36};
  sim::RoomRenderer::create((*headset)->room(), options.error_model)->picture(state, eye, seen);
  // Never quite one, because colour is compared with grey and a soft lens with none. Less if
  // shifted by two pixels.
  const double there = correlation(straightened.pixels, seen.pixels, 0);
  EXPECT_GT(there, 0.85);
  EXPECT_LT(correlation(straightened.pixels, seen.pixels, 2), there - 0.005);
  EXPECT_LT(correlation(seen.pixels, straightened.pixels, 2), there - 0.005);
}

}  // namespace
}  // namespace orthonav::preview::recorded_images_test
