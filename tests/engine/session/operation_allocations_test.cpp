#include <gtest/gtest.h>

#include <bitset>
#include <initializer_list>
#include <string>

#include "base/angle.h"
#include "engine/session/session.h"
#include "tests/support/allocation_count.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::operation_allocations_test {
namespace {

using test::guide_at;
using test::pointer_at;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using enum ClickerAction;

/// A message and the echo of a phrase disappear after this time.
constexpr Duration kStays = std::chrono::milliseconds(300);
/// As many pairs take longer than that, at 30 pairs a second.
constexpr int kWhile = 12;
constexpr Vec3 kLandmark = ScriptedOperation::kLandmark;

using Actions = std::bitset<kActionCount>;

constexpr std::size_t index_of(Action action) { return static_cast<std::size_t>(action); }

/// These actions produce data to keep: strokes, a registration and its checks, touches of a new
/// screw, a changed plan, a wire, a rod. No other action allocates, and neither does a pair without
/// an event: not while samples are taken or a tool is guided, and not on voice commands or when a
/// tool comes and goes.
Actions that_may_allocate() {
  using enum Action;
  Actions actions;
  for (const Action action : {kStartSampling, kRegister, kShowRegistration, kRecordCheck,
                              kDropCheck, kAccept, kClearLevel, kExpectLandmark, kReplan,
                              kExpectWire, kRecordWire, kJudgeRedo, kRecordHead, kForgetMap}) {
    actions.set(index_of(action));
  }
  return actions;
}

SessionOptions with_short_messages() {
  SessionOptions options = test::three_places();
  options.message_for = options.heard_for = kStays;
  return options;
}

/// Records what the table asked for in the newest pair. Does not allocate.
class AskedActions : public SessionObserver {
 public:
  void happened(Timestamp /*time*/, Step /*from*/, Event /*event*/, Cell answer) override {
    actions.set(index_of(answer.action));
  }
  Actions actions;
};

std::string names_of(const Actions& actions) {
  std::string names;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    names += actions[i] ? std::string(name_of(static_cast<Action>(i))) + ", " : "";
  }
  return names.empty() ? "nothing" : names;
}

/// An operation in which each pair from the second on is checked for forbidden allocations.
class CountedOperation {
 public:
  explicit CountedOperation(bool reference)
      : s({"L4", "L5"}, with_short_messages(), Verification::kByTouch, true, reference),
        now_(s.now()) {
    s.registers_within(0.0003);
    s.session().observe(&asked_);
    step({}, {});
    warm_ = true;
  }

  const Guidance& pairs(int n) {
    for (int i = 1; i < n; ++i) {
      step({}, {});
    }
    return step({}, {});
  }
  /// Says a phrase, then waits until it was answered and its echo has left the status line.
  const Guidance& says(const std::string& phrase) {
    const Phrase phrases[] = {{phrase, 1.0, now_ + std::chrono::milliseconds(1)}};
    step({}, phrases);
    return pairs(kWhile);
  }
  const Guidance& does(std::initializer_list<ClickerAction> actions) {
    std::vector<ClickerEvent> clicks;
    for (const ClickerAction action : actions) {
      clicks.push_back({action, now_ + std::chrono::milliseconds(1)});
    }
    return step(clicks, {});
  }
  const Guidance& clicks() {
    does({kPress});
    pairs(3);
    does({kRelease, kClick});
    return pairs(kWhile);
  }
  const Guidance& touches(Vec3 tip) {
    s.tracker().pointer = pointer_at(tip);
    return clicks();
  }
  const Guidance& strokes(int n) {
    does({kPress});
    pairs(n);
    return does({kRelease});
  }
  /// The tool is hidden for longer than guidance may stay, and comes back.
  void loses(std::optional<Transform<World, Marker>>& tool) {
    const auto seen = std::exchange(tool, std::nullopt);
    pairs(10);
    tool = seen;
    pairs(10);
  }

  /// Moves the map, or the references against each other.
  void moves_world() {
    ++s.map_epoch;
    ++s.tracker().reference.moves;
    pairs(kWhile);
  }

  /// The actions of the pairs that allocated.
  [[nodiscard]] const Actions& allocated() const { return allocated_; }
  ScriptedOperation s;

 private:
  const Guidance& step(std::span<const ClickerEvent> clicks, std::span<const Phrase> phrases) {
    now_ += std::chrono::microseconds(33333);
    StereoFrame frame;
    frame.time = now_;
    frame.world_from_rig = Transform<World, Rig>{};
    frame.map_epoch = s.map_epoch;
    Inputs inputs{clicks, phrases, now_ + std::chrono::milliseconds(16), std::nullopt};
    asked_.actions.reset();
    const std::size_t before = test::allocations_of_this_thread();
    const Guidance& guidance = s.session().step(frame, inputs);
    const std::size_t made = test::allocations_of_this_thread() - before;
    if (warm_ && made > 0) {
      allocated_ |= asked_.actions;
      EXPECT_TRUE((asked_.actions & that_may_allocate()).any())
          << made << " in " << step_of(guidance) << ": " << names_of(asked_.actions);
    }
    return guidance;
  }

  Timestamp now_;
  bool warm_ = false;
  AskedActions asked_;
  Actions allocated_;
};

void digitizes(CountedOperation& o) {
  o.s.tracker().pointer = pointer_at({0, 0.02, 0});
  o.strokes(static_cast<int>(Coach::kFewestSamples + Coach::kNewSamples));
  EXPECT_NE(state<StrokesSoFar>(o.pairs(Coach::kPairsToAnswer + 1))->coaching, nullptr)
      << "a trial ran beside it";
  o.loses(o.s.tracker().pointer);
  o.says("save");
  o.strokes(10);
  o.says("delete");
  o.strokes(100);
  o.says("save");
  o.does({kPress, kRelease, kClick, kPress, kRelease, kClick, kDoubleClick});
  EXPECT_EQ(o.pairs(kWhile).step, Step::kVerify);
}

void verifies(CountedOperation& o) {
  o.touches({-0.015, 0.020, -0.010});
  o.says("accept");
  o.touches({0.015, 0.020, -0.010});
  o.says("delete");
  o.touches({0.015, 0.020, -0.010});
  o.does({kPress});
  o.pairs(15);
  o.does({kHold});
  o.does({kRelease});
  o.touches({0.000, 0.020, 0.012});
  o.loses(o.s.tracker().pointer);
  EXPECT_EQ(o.says("accept").step, Step::kTouchLandmark);
}

/// From `landmark` to the measured wire of the screw with that entry, tilted by that angle.
void drives(CountedOperation& o, Vec3 entry, double angle_rad) {
  o.says("next");
  o.touches(kLandmark);
  o.touches(kLandmark);
  o.s.tracker().pointer.reset();
  o.s.tracker().guide = guide_at(kLandmark, 0.0);
  o.clicks();
  EXPECT_EQ(o.says("next").step, Step::kGuide);
  o.s.tracker().guide = guide_at(entry, angle_rad);
  EXPECT_TRUE(o.pairs(kWhile).tool.has_value());
  o.says("twin");
  o.says("drill");
  o.s.tracker().guide = guide_at(entry - Vec3{0, 0.010, 0}, angle_rad);
  EXPECT_EQ(o.pairs(kWhile).drill.phase, nav::DrillPhase::kDrilling);
  o.loses(o.s.tracker().guide);
  EXPECT_EQ(o.says("next").step, Step::kMeasureWire);
  o.s.tracker().guide = guide_at(entry + Vec3{0, 0.004, 0}, angle_rad);
  o.pairs(kWhile);
  EXPECT_NE(o.clicks().wire, nullptr);
}

void operates(CountedOperation& o) {
  constexpr double kTooFar_rad = 5.0 * kRadiansPerDegree;
  digitizes(o);
  EXPECT_EQ(o.says("reject").step, Step::kDigitize);
  digitizes(o);
  verifies(o);
  o.says("move cranial one");
  o.says("undo");
  drives(o, {0.015, 0.020, 0.0}, kTooFar_rad);
  o.says("next");
  EXPECT_EQ(o.says("delete").step, Step::kTouchLandmark) << "the screw is redone";
  drives(o, {0.015, 0.020, 0.0}, kTooFar_rad);
  o.says("accept");
  EXPECT_EQ(o.says("next").step, Step::kTouchLandmark);
  drives(o, {-0.015, 0.020, 0.0}, 0.0);
  o.s.tracker().guide.reset();
  o.says("next");
}

class OperationAllocations : public ::testing::TestWithParam<bool> {};

TEST_P(OperationAllocations, AreOfWhatIsMadeAndNoneInAPairWithoutAnEvent) {
  CountedOperation o(GetParam());
  o.says("start");
  for (const char* level : {"L4", "L5"}) {
    SCOPED_TRACE(level);
    operates(o);
  }
  EXPECT_EQ(step_of(o.pairs(kWhile)), "rod left");
  for (const double x_m : {0.02, -0.02}) {
    o.touches({x_m, 0.03, 0.00});
    o.touches({x_m, 0.03, 0.02});
    o.says("delete");
    o.touches({x_m, 0.03, 0.04});
    o.says("move rod");
    o.says("done");
  }
  EXPECT_EQ(o.pairs(kWhile).step, Step::kDone);
  o.moves_world();
  EXPECT_EQ(names_of(that_may_allocate() & ~o.allocated()), "nothing") << "each may for a reason";
}

INSTANTIATE_TEST_SUITE_P(Every, OperationAllocations, ::testing::Bool(),
                         [](const auto& made) { return made.param ? "Reference" : "Map"; });

}  // namespace
}  // namespace orthonav::engine::operation_allocations_test
