// A screw that is changed in the middle of a simulated operation: everything follows the plan in
// use, from the display to the drilled wire.
#include <gtest/gtest.h>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/live/known_tools.h"
#include "engine/phantom/phantom.h"
#include "hal/api/forwarding_headset.h"
#include "study/evaluation.h"
#include "study/modelled_tracker.h"
#include "study/sim_scenario.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"

namespace orthonav::engine::replanned_operation_test {
namespace {

/// In a perfect world the wire lies on its plan to a few tenths of a millimetre.
constexpr double kOnItsPlan_m = 0.0007;
constexpr double kMoved_m = 0.003;

/// The simulated surgeon's voice, and once a phrase of another one's.
class SecondVoice : public Voice {
 public:
  explicit SecondVoice(Voice& first) : first_(first) {}
  void say(std::string phrase) { waiting_ = std::move(phrase); }

 private:
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    const Status polled = first_.poll(until, phrases);
    if (polled && !waiting_.empty()) {
      phrases.push_back({std::exchange(waiting_, {}), 1.0, until});
    }
    return polled;
  }
  Voice& first_;
  std::string waiting_;
};

/// Says it as soon as the first screw is guided.
class Assistant : public ForwardingHeadset, public SessionObserver {
 public:
  explicit Assistant(Headset& inner) : ForwardingHeadset(inner), voice_(inner.voice()) {}
  [[nodiscard]] Voice& voice() override { return voice_; }
  void happened(Timestamp /*time*/, Step /*from*/, Event /*event*/, Cell answer) override {
    if (answer.next == Step::kGuide && !said_) {
      said_ = true;
      voice_.say("move cranial three");
    }
  }

 private:
  SecondVoice voice_;
  bool said_ = false;
};

TEST(ReplannedOperation, TheWireFollowsThePlanInUse) {
  const Case source = phantom({"L4"});
  Operation operation = plan_operation(source, {"L4"}).value();
  sim::SimOptions sim;
  sim.error_model = sim::ErrorModel::perfect();
  sim.error_model.pace = 10.0;
  sim.render = false;
  sim.surgeon = sim::ScriptedSurgeon::bring;
  const auto room =
      sim::SimHeadset::open(room_of(source, operation, built_in_tools()), sim).value();
  Method method = method_named("best").value();
  method.create_tracker = [&room](const auto&... given) {
    return create_modelled_tracker("best", *room, given...);
  };
  method.coaching = false;
  Assistant headset(*room);
  const auto live =
      assemble_operation(headset, std::move(operation), method, tools_known_to(*room).value())
          .value();
  sim::ShownToWearer to_wearer(headset);
  GroundTruthRecorder truth(*room, live->session());
  EndNote end;
  live->observe(&to_wearer);
  live->observe(&truth);
  live->observe(&end);
  live->observe(static_cast<SessionObserver*>(&headset));
  const auto report = live->run();
  ASSERT_TRUE(report.ended) << report.ended.error().message;
  OperationResult result = result_of(live->session().operation(), report);
  end.explain(result);
  ASSERT_TRUE(report.done) << result.why_not;
  truth.evaluate(result);
  const LevelState& level = result.state.levels[0];
  ASSERT_EQ(level.screws.size(), 2u);
  ASSERT_TRUE(level.screws[0].replanned());
  const auto moved = nav::difference_of(level.screws[0].preoperative, level.plan.screws[0]);
  EXPECT_NEAR(moved.entry_cranial_m, kMoved_m, 1e-6);
  EXPECT_FALSE(level.screws[1].replanned());
  for (std::size_t s = 0; s < level.screws.size(); ++s) {
    const ScrewTruth& screw = result.truth.levels[0].screws[s];
    ASSERT_TRUE(screw.entry_error_m);
    EXPECT_LT(*screw.entry_error_m, kOnItsPlan_m) << name_of(level.plan.screws[s].side);
  }
}

}  // namespace
}  // namespace orthonav::engine::replanned_operation_test
