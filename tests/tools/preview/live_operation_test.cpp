#include "tools/preview/live_operation.h"

#include <gtest/gtest.h>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "hal/fake/scripted.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::preview::live_operation_test {
namespace {

/// Shared by all tests, because preparing the models takes longest.
const OperationSource& source() {
  static const OperationSource made = [] {
    OperationSource source;
    source.source = engine::phantom();
    source.method = engine::method_named("best").value();
    source.operation = engine::plan_operation(source.source, {"L5"}).value();
    return source;
  }();
  return made;
}

sim::SimOptions perfect_room() {
  sim::SimOptions options;
  options.error_model = sim::ErrorModel::perfect();
  return options;
}

struct Stage {
  fake::ManualClock wall;
  Gate gate{wall};
  Keyboard keyboard;
  Timeline timeline;

  std::unique_ptr<LiveOperation> open() {
    timeline.clear();
    gate.restart();
    gate.pause(true);
    auto live = LiveOperation::open(source(), perfect_room(), gate, keyboard, timeline);
    EXPECT_TRUE(live.ok()) << live.error().message;
    (*live)->start();
    return std::move(*live);
  }
  /// Waits until the pair is there and nothing more arrives. A hang ends at the test's time limit.
  std::shared_ptr<const Moment> run_to(std::int64_t pair) {
    gate.run_to(pair);
    while (true) {
      const auto newest = timeline.newest();
      if (newest && newest->pair >= pair && gate.at_rest()) {
        return newest;
      }
      std::this_thread::yield();
    }
  }
};

TEST(LiveOperation, GoesNoFurtherThanItsGate) {
  Stage stage;
  const auto live = stage.open();
  const auto third = stage.run_to(3);
  EXPECT_EQ(third->pair, 3);
  ASSERT_TRUE(third->room.has_value());
  // The simulated clock follows its pairs: it stands still while wall-clock time passes.
  stage.wall.advance(std::chrono::hours(1));
  stage.gate.step();
  const auto fourth = stage.run_to(4);
  EXPECT_EQ(fourth->pair, 4);
  EXPECT_NEAR(seconds(fourth->time - third->time), 1.0 / 30.0, 1e-6);
  EXPECT_FALSE(live->ended());
}

TEST(LiveOperation, IsTheSameWhenStartedAgain) {
  Stage stage;
  auto live = stage.open();
  const auto once = stage.run_to(40);
  live.reset();
  live = stage.open();
  const auto again = stage.run_to(40);
  EXPECT_NE(once, again);
  EXPECT_EQ(once->at, again->at);
  EXPECT_EQ(once->time, again->time);
  EXPECT_EQ(once->room->room_from_rig, again->room->room_from_rig);
  ASSERT_EQ(once->scene.texts.size(), again->scene.texts.size());
  ASSERT_FALSE(once->tools.empty());
  for (std::size_t i = 0; i < once->tools.size(); ++i) {
    EXPECT_EQ(once->tools[i].tip_in_world, again->tools[i].tip_in_world);
  }
}

TEST(LiveOperation, HearsTheKeyboardAtTheNextPair) {
  Stage stage;
  stage.keyboard.mute(true);
  const auto live = stage.open();
  EXPECT_EQ(stage.run_to(2)->at.step, engine::Step::kSetup);
  stage.keyboard.say("start");
  EXPECT_EQ(stage.timeline.newest()->at.step, engine::Step::kSetup);
  EXPECT_EQ(stage.run_to(3)->at.step, engine::Step::kDigitize);
}

TEST(LiveOperation, TakesTheBuiltInGuideWhereToolsHaveNone) {
  Stage stage;
  const test::TemporaryFolder folder;
  OperationSource pointer = source();
  pointer.tools_file = folder.with("tools.json", R"({"tools": [{"name": "pointer",
      "role": "pointer", "marker": {"family": "tag36h11", "id": 3, "size_mm": 70},
      "tip_mm": [0, -130, 0], "axis": [0, 1, 0]}]})");
  stage.gate.pause(true);
  const auto live =
      LiveOperation::open(pointer, perfect_room(), stage.gate, stage.keyboard, stage.timeline);
  ASSERT_TRUE(live.ok()) << live.error().message;
  (*live)->start();
  const auto third = stage.run_to(3);
  ASSERT_EQ(third->tools.size(), 2u);
  EXPECT_EQ(third->tools[0].name, "pointer");
  EXPECT_EQ(third->tools[1].name, "guide");
}

TEST(LiveOperation, RefusesAHeadsetThatHasADisplay) {
  Stage stage;
  OperationSource shown = source();
  shown.headset = "openxr:+sim:";
  const auto live =
      LiveOperation::open(shown, perfect_room(), stage.gate, stage.keyboard, stage.timeline);
  ASSERT_FALSE(live.ok());
  EXPECT_NE(live.error().message.find("\"openxr:+sim:\": it has a display"), std::string::npos)
      << live.error().message;
}

TEST(LiveOperation, RefusesAHeadsetThatThereIsNot) {
  Stage stage;
  OperationSource bad = source();
  bad.headset = "replay:/nowhere";
  EXPECT_FALSE(
      LiveOperation::open(bad, perfect_room(), stage.gate, stage.keyboard, stage.timeline).ok());
}

}  // namespace
}  // namespace orthonav::preview::live_operation_test
