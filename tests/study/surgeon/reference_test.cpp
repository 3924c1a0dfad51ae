#include <gmock/gmock.h>

#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {
namespace {

TEST(Reference, StaysOnThePatientAllTheOperation) {
  TestCase test_case = synthetic_case();
  test_case.room.tools.push_back(
      {"reference", ToolKind::kReference, "tag36h11", 17, 0.040, {{0, -0.060, 0}}, {0, 1, 0}});
  SimOptions options;
  options.surgeon = ScriptedSurgeon::bring;
  options.render = false;
  auto headset = SimHeadset::open(test_case.room, options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  FakeEngine engine(**headset, test_case);
  std::optional<Transform<Spine, Marker>> first;
  double head_rotation_rad = 0.0;
  std::optional<Mat3> first_head;
  engine.on_frame = [&](const StereoFrame&, const StepOnDisplay&) {
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
    head_rotation_rad = std::max(head_rotation_rad,
                                 rotation_angle_rad(state.room_from_rig.rotation(), *first_head));
  };
  ASSERT_GT(engine.run(), 0);
  EXPECT_GT(head_rotation_rad, 0.3) << "the head must have moved, or this shows nothing";
}

/// The tip of the wires' truth in the bone, and where reference and bone came to lie.
struct Ends {
  Transform<Room, Spine> spine;
  Transform<Spine, Marker> reference;
  std::size_t wires = 0;
};

Ends ends_with(const SimOptions& with) {
  TestCase test_case = synthetic_case();
  test_case.room.tools.push_back(
      {"reference", ToolKind::kReference, "tag36h11", 17, 0.040, {{0, -0.060, 0}}, {0, 1, 0}});
  SimOptions options = with;
  options.surgeon = ScriptedSurgeon::bring;
  options.render = false;
  options.error_model = ErrorModel::perfect();
  auto headset = SimHeadset::open(test_case.room, options);
  EXPECT_TRUE(headset.ok());
  FakeEngine engine(**headset, test_case);
  EXPECT_GT(engine.run(), 0);
  const RoomState state = (*headset)->state();
  return {state.room_from_spine, state.room_from_spine.inverse() * state.room_from_marker[2],
          (*headset)->truth().wires.size()};
}

TEST(Reference, ABumpMovesItAgainstTheBoneAndAShiftTakesItAlong) {
  SimOptions options;
  const Ends rest = ends_with(options);
  options.reference_bump = {0.002, 0.0, 1};
  const Ends bumped = ends_with(options);
  options.reference_bump = {};
  options.patient_shift = {0.003, 1};
  const Ends shifted = ends_with(options);
  ASSERT_EQ(shifted.wires, rest.wires);
  constexpr double kExact_m = 1e-9;
  EXPECT_NEAR((bumped.reference.translation() - rest.reference.translation()).norm(), 0.002,
              kExact_m);
  EXPECT_NEAR((bumped.spine.translation() - rest.spine.translation()).norm(), 0.0, kExact_m);
  EXPECT_NEAR((shifted.reference.translation() - rest.reference.translation()).norm(), 0.0,
              kExact_m);
  EXPECT_NEAR((shifted.spine.translation() - rest.spine.translation()).norm(), 0.003, kExact_m);
}

TEST(Reference, AShiftThatNoPatientMakesIsRefused) {
  SimOptions options;
  options.patient_shift.shift_m = 0.06;
  EXPECT_FALSE(options.check().ok());
  options.patient_shift.shift_m = 0.05;
  EXPECT_TRUE(options.check().ok());
}

}  // namespace
}  // namespace orthonav::sim
