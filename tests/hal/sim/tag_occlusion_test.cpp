// What hides a tag, against the pixels of the same room.
#include "hal/sim/cameras/tag_occlusion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/random.h"
#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/room_renderer.h"

namespace orthonav::sim {
namespace {

constexpr double kTag_m = 0.040;
constexpr std::array<Vec2, 8> kBorder = {
    {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};

/// A tag that faces the left camera half a metre away, and another tool in a hand.
class TwoTools {
 public:
  TwoTools() {
    room_.tools = {
        {"reference", ToolKind::kReference, "tag36h11", 17, kTag_m, {{0, -0.060, 0}}, {0, 1, 0}},
        {"guide", ToolKind::kGuide, "tag36h11", 16, kTag_m, {{0, -0.150, 0}}, {0, 1, 0}}};
    room_.tag_flaws.resize(2);
    state_.room_from_rig = {Mat3::identity(), {0.0, 0.6, 0.0}};
    state_.tool_present = {true, true};
    state_.room_from_marker = {room_from({0.01, -0.02, 0.5}, {}), room_from({}, {})};
    ErrorModel plain;
    plain.blur_sigma_px = 0.0;
    plain.shot_noise = 0.0;
    plain.read_noise_grey = 0.0;
    renderer_ = RoomRenderer::create(room_, plain);
  }
  /// Where the other tool is held, in the left camera (x right, y down, z forward).
  void hold(Vec3 at_m, Vec3 rotation_rad) {
    state_.room_from_marker[1] = room_from(at_m, rotation_rad);
    const Transform<Room, Marker>& held = state_.room_from_marker[1];
    state_.hand = held * Point<Marker>{{0, -0.050, 0}};
    state_.hand_axis = (held * Direction<Marker>{Vec3{1.0, 0.2, -0.3}.normalized()}).v;
  }
  [[nodiscard]] bool says_hidden(std::size_t tool) const {
    TagOcclusion occlusion(room_);
    occlusion.look(state_, camera_from_room());
    return occlusion.hides(tool);
  }
  /// Whether the picture of the reference's border is another one without guide and hand.
  [[nodiscard]] bool is_hidden() const {
    RoomState alone = state_;
    alone.tool_present[1] = false;
    alone.hand.reset();
    const GreyImage with = picture(state_);
    const GreyImage without = picture(alone);
    const auto camera_from_marker = camera_from_room() * state_.room_from_marker[0];
    bool differs = false;
    for (const Vec2 to : kBorder) {
      const Vec2 at = 0.5 * kTag_m * to;
      const auto pixel = hololens2_calibration().left.project(
          (camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}}).v);
      const int x = static_cast<int>(pixel->x);
      const int y = static_cast<int>(pixel->y);
      differs = differs || std::abs(int{with.at(x, y)} - int{without.at(x, y)}) > 3;
    }
    return differs;
  }

 private:
  [[nodiscard]] Transform<LeftCamera, Room> camera_from_room() const {
    return hololens2_calibration().left_from_rig * state_.room_from_rig.inverse();
  }
  [[nodiscard]] Transform<Room, Marker> room_from(Vec3 at_m, Vec3 rotation_rad) const {
    // A tag's face, its z, is turned to the camera.
    const Mat3 facing = Mat3::from_columns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    return camera_from_room().inverse() *
           Transform<LeftCamera, Marker>{facing * rotation_from_vector(rotation_rad), at_m};
  }
  [[nodiscard]] GreyImage picture(const RoomState& state) const {
    GreyImage image;
    renderer_->render(std::vector<RoomState>{state}, hololens2_calibration().left,
                      hololens2_calibration().left_from_rig, 1, image);
    return image;
  }

  RoomDescription room_;
  RoomState state_;
  std::unique_ptr<RoomRenderer> renderer_;
};

TEST(TagOcclusion, IsWhatThePixelsShow) {
  TwoTools tools;
  Random random(7);
  int hidden = 0;
  int clear = 0;
  int otherwise = 0;
  for (int i = 0; i < 120; ++i) {
    tools.hold(
        {random.uniform(-0.12, 0.12), random.uniform(-0.12, 0.12), random.uniform(0.28, 0.42)},
        {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1.5, 1.5)});
    const bool is = tools.is_hidden();
    ++(is ? hidden : clear);
    otherwise += is != tools.says_hidden(0) ? 1 : 0;
  }
  EXPECT_GT(hidden, 25);
  EXPECT_GT(clear, 25);
  // Outlines of rods and fingers are drawn to a pixel or two.
  EXPECT_LE(otherwise, 4) << hidden << " hidden, " << clear << " clear";
}

TEST(TagOcclusion, IsOnlyByWhatIsInFront) {
  TwoTools tools;
  tools.hold({0.01, -0.02, 0.35}, {});
  EXPECT_TRUE(tools.says_hidden(0));
  EXPECT_FALSE(tools.says_hidden(1)) << "the one in front";
  tools.hold({0.01, -0.02, 0.65}, {});
  EXPECT_FALSE(tools.says_hidden(0));
  EXPECT_TRUE(tools.says_hidden(1));
}

}  // namespace
}  // namespace orthonav::sim
