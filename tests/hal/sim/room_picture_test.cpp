#include <gtest/gtest.h>

#include <cstdlib>

#include "hal/sim/cameras/room_renderer.h"
#include "tests/support/camera_scene.h"

namespace orthonav::sim {
namespace {

/// The room with the hand over the wound, or without it.
RgbaImage seen(bool with_hand, double hand_opacity) {
  const RoomDescription room = scene::operating_room(16);
  RoomState state = scene::operating_state(room);
  PinholeView view{{state.room_from_rig.rotation(), state.room_from_rig.translation()},
                   0.42,
                   0.42,
                   0.236,
                   0.236};
  view.hand_opacity = hand_opacity;
  if (!with_hand) {
    state.hand.reset();
  }
  RgbaImage image;
  RoomRenderer::create(room, ErrorModel{})->picture(state, view, image);
  return image;
}

/// The sum of all differences of channels.
long difference(const RgbaImage& a, const RgbaImage& b) {
  long sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
  }
  return sum;
}

TEST(RoomPicture, AHandOfGlassHidesSoMuchLess) {
  const RgbaImage bare = seen(false, 1.0);
  EXPECT_EQ(difference(seen(true, 0.0), bare), 0);
  const long whole = difference(seen(true, 0.999), bare);
  const long glass = difference(seen(true, 0.35), bare);
  EXPECT_GT(whole, 100000);
  EXPECT_NEAR(static_cast<double>(glass) / static_cast<double>(whole), 0.35, 0.03);
}

TEST(RoomPicture, AHandOfGlassDoesNotHideTheTool) {
  const RgbaImage with = seen(true, 0.35);
  const RgbaImage bare = seen(false, 1.0);
  // The pointer's handle, nearly black, where the fist closes round it.
  int dark = 0;
  int kept = 0;
  for (std::size_t i = 0; i < bare.pixels.size(); i += 4) {
    if (bare.pixels[i] < 60 && bare.pixels[i + 1] < 60 && bare.pixels[i + 2] < 60) {
      ++dark;
      kept += with.pixels[i] < 60 && with.pixels[i + 2] < 60 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(kept, dark - dark / 1000);  // all but edges
}

}  // namespace
}  // namespace orthonav::sim
