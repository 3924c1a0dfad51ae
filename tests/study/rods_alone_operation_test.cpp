// Rods alone in the simulated room: screws stand in the bones, and nothing is registered.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "nav/guidance/rod_cut.h"
#include "study/sim_scenario.h"
#include "study/simulated_operation.h"

namespace orthonav::engine::rods_alone_operation_test {
namespace {

/// In the measurement model, with a brisk surgeon.
OperationOptions rods_alone() {
  OperationOptions options;
  options.rods_alone = true;
  options.measurement = Measurement::kModel;
  options.tools = built_in_tools();
  options.sim.error_model.pace = 4.0;
  options.loop.draw_every = 0;
  return options;
}

/// By the screws themselves, as planned.
double true_cut_length_m(const Case& spine, nav::Side side) {
  std::vector<Vec3> heads;
  std::vector<std::pair<Vec3, Vec3>> screws;
  for (const sim::StandingScrew& screw :
       room_of(spine, plan_rods_alone(spine), built_in_tools()).screws) {
    if (screw.side == side) {
      const auto& spine_from_vertebra = spine.find(screw.level)->spine_from_vertebra;
      screws.push_back({(spine_from_vertebra * screw.head()).v,
                        (spine_from_vertebra * Direction<Vertebra>{screw.direction}).v});
      heads.push_back(screws.back().first);
    }
  }
  const nav::RodTemplate rod = nav::rod_template(heads).value();
  std::vector<Vec3> directions;
  for (const Vec3& head : rod.heads_m) {
    directions.push_back(std::find_if(screws.begin(), screws.end(), [&head](const auto& screw) {
                           return screw.first == head;
                         })->second);
  }
  return nav::rod_cut(rod, directions, {0.006, 0.005, {}})->cut_length_m;
}

TEST(RodsAloneOperation, TouchesTheHeadsThatStandInTheRoomAndMeasuresBothRods) {
  OperationOptions options = rods_alone();
  options.use_reference = true;
  std::erase_if(options.tools,
                [](const nav::ToolGeometry& tool) { return tool.role == nav::ToolRole::kGuide; });
  const auto result = run_operation(phantom(), options);
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_TRUE(result->completed) << result->why_not;
  EXPECT_TRUE(result->state.levels.empty());
  for (std::size_t i = 0; i < result->state.rods.size(); ++i) {
    const RodState& rod = result->state.rods[i];
    const RodTruth& truth = result->truth.rods[i];
    SCOPED_TRACE(name_of(rod.side));
    EXPECT_EQ(rod.heads.size(), 5u);
    // Of a touch in this room: the pick, the tip, tracking (docs/accuracy.md), three times over.
    ASSERT_TRUE(truth.head_error_m);
    EXPECT_GT(*truth.head_error_m, 1e-5) << "control: the room errs";
    EXPECT_LT(*truth.head_error_m, 0.005);
    ASSERT_TRUE(truth.length_error_m);
    EXPECT_LT(std::abs(*truth.length_error_m), 0.005);
    EXPECT_NE(rod.instructions.has_value(), !rod.no_instructions.empty());
    EXPECT_EQ(rod.seat_by_pointer_m, 0.006);
    EXPECT_GT(rod.took_s.value_or(0.0), 1.0);
  }
}

TEST(RodsAloneOperation, FindsTheHeadsExactlyInARoomWithoutErrors) {
  OperationOptions options = rods_alone();
  options.sim.error_model = sim::ErrorModel::perfect();
  options.sim.error_model.pace = 4.0;
  const Case spine = phantom();
  const auto result = run_operation(spine, options);
  ASSERT_TRUE(result.ok()) << result.error().message;
  for (std::size_t i = 0; i < result->state.rods.size(); ++i) {
    const RodState& rod = result->state.rods[i];
    const RodTruth& truth = result->truth.rods[i];
    SCOPED_TRACE(name_of(rod.side));
    EXPECT_LT(truth.head_error_m.value_or(1.0), 1e-4);
    EXPECT_LT(std::abs(truth.length_error_m.value_or(1.0)), 1e-4);
    ASSERT_TRUE(rod.instructions) << rod.no_instructions;
    // By every screw's own direction the rod is longer still: planned screws fan out by more than
    // the rod curves.
    const double true_m = true_cut_length_m(spine, rod.side);
    EXPECT_NEAR(rod.instructions->cut_length_m(), true_m, 0.002);
    EXPECT_LT(rod.rod->length_m + 0.010, true_m - 0.003) << "control: where the heads were touched";
  }
}

TEST(RodsAloneOperation, NeedsScrewsThatStandInTheRoom) {
  Case bare = phantom();
  for (CaseLevel& level : bare.levels) {
    level.screws.clear();
  }
  const auto result = run_operation(bare, rods_alone());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(
      result.error().message,
      "case 'phantom' has no screws, so none stands in the simulated room: name a case with a "
      "plan");
}

TEST(RodsAloneOperation, HasTheHeadsOfThePlanInTheRoomAndNoLevelInTheSession) {
  const Case spine = phantom();
  const Operation alone = plan_rods_alone(spine);
  EXPECT_TRUE(alone.levels.empty());
  EXPECT_EQ(alone.spine.size(), spine.levels.size());
  EXPECT_EQ(room_of(spine, alone, built_in_tools()).screws.size(), 10u);
  const Case lowest = phantom({"L5"});
  EXPECT_TRUE(room_of(lowest, plan_operation(lowest).value(), built_in_tools()).screws.empty())
      << "elsewhere they are placed by the surgeon";
}

}  // namespace
}  // namespace orthonav::engine::rods_alone_operation_test
