#include <gmock/gmock.h>

#include "tests/hal/sim/fake_engine.h"

namespace orthonav::sim {
namespace {

TEST(Reference, StaysOnThePatientAllTheOperation) {
  TestCase test_case = synthetic_case();
  test_case.room.tools.push_back(
      {"reference", ToolKind::kReference, "tag36h11", 17, 0.040, {{0, -0.060, 0}}, {0, 1, 0}});
  SimOptions options;
  options.render = false;
  auto headset = SimHeadset::open(test_case.room, options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  FakeEngine engine(**headset, test_case);
  std::optional<Transform<Spine, Marker>> first;
  double head_turned_rad = 0.0;
  std::optional<Mat3> first_head;
  engine.on_frame = [&](const StereoFrame&, const std::string&) {
    const RoomState state = (*headset)->state();
    ASSERT_TRUE(state.tool_present[2]);
    const auto spine_from_marker = state.room_from_spine.inverse() * state.room_from_marker[2];
    if (!first) {
      first = spine_from_marker;
      first_head = state.room_from_rig.rotation();
      const Vec3 view =
          (state.room_from_rig.translation() - state.room_from_marker[2].translation())
              .normalized();
      EXPECT_GT((state.room_from_marker[2] * Direction<Marker>{{0, 0, 1}}).v.dot(view), 0.5)
          << "it is turned to the surgeon at the start";
    }
    EXPECT_LT((spine_from_marker.translation() - first->translation()).norm(), 1e-12);
    EXPECT_LT(rotation_angle_rad(spine_from_marker.rotation(), first->rotation()), 1e-7);
    head_turned_rad =
        std::max(head_turned_rad, rotation_angle_rad(state.room_from_rig.rotation(), *first_head));
  };
  ASSERT_GT(engine.run(), 0);
  EXPECT_GT(head_turned_rad, 0.3) << "the head must have moved, or this shows nothing";
}

}  // namespace
}  // namespace orthonav::sim
