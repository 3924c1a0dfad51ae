#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/live/known_tools.h"
#include "engine/phantom/phantom.h"
#include "hal/sim/sim_headset.h"
#include "study/modelled_tracker.h"
#include "study/sim_scenario.h"
#include "study/simulated_operation.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"
#include "tests/hal/openxr/drawn_frames.h"

namespace orthonav::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Key;

// Slower than any headset: at its rate the software rasteriser would take half of two cores.
constexpr std::int64_t kPeriodNs = 50'000'000;

/// A brisk surgeon's operation of one level, without errors and in the measurement model, on the
/// headset under test.
class OperationOnOpenxr : public RuntimeTest {
 protected:
  void SetUp() override {
    RuntimeTraits traits;
    traits.stepped = false;
    traits.period_ns = kPeriodNs;
    traits.frames_kept = 8;
    runtime().reset(traits);
    const engine::Case spine = engine::phantom();
    auto operation = engine::plan_operation(spine, {"L5"});
    ASSERT_TRUE(operation.ok()) << operation.error().message;
    sim::SimOptions options;
    options.error_model = sim::ErrorModel::perfect();
    options.error_model.pace = 4.0;
    options.render = false;
    options.surgeon = sim::ScriptedSurgeon::bring;
    auto room = sim::SimHeadset::open(engine::room_of(spine, *operation, engine::built_in_tools()),
                                      options);
    ASSERT_TRUE(room.ok()) << room.error().message;
    const sim::SimHeadset& measured = **room;
    headset_ = openxr::OpenxrHeadset::around(std::move(*room), {});
    auto method = engine::method_named("best");
    ASSERT_TRUE(method.ok());
    method->create_tracker = [&measured](const auto&... given) {
      return engine::create_modelled_tracker("best", measured, given...);
    };
    engine::AssemblyOptions assembly;
    assembly.loop.real_time = true;
    auto assembled =
        engine::assemble_operation(*headset_, std::move(*operation), *method,
                                   engine::tools_known_to(*headset_).value(), assembly);
    ASSERT_TRUE(assembled.ok()) << assembled.error().message;
    operation_ = std::move(*assembled);
    operation_->observe(&to_wearer_.emplace(*headset_));
  }

  engine::LoopReport run(engine::LoopObserver* observer = nullptr) {
    EXPECT_TRUE(present().ok());
    operation_->draw_into(presenter_.get());
    operation_->observe(observer);
    auto report = operation_->run();
    EXPECT_TRUE(report.ended.ok()) << report.ended.error().message;
    return report;
  }

  std::optional<sim::ShownToWearer> to_wearer_;
  std::unique_ptr<engine::AssembledOperation> operation_;
};

/// Some way into each step: what was submitted last.
class Watch : public engine::LoopObserver {
 public:
  explicit Watch(RuntimeDouble& runtime) : runtime_(runtime) {}
  void stepped(const FrameHeader&, const engine::Inputs&, const engine::Guidance& now) override {
    if (now.step != step_) {
      step_ = now.step;
      pairs_in_step_ = 0;
    }
    // So many, so that the step's holograms have come up; the display is slower than this room.
    if (++pairs_in_step_ != 10 || frames_.contains(step_)) {
      return;
    }
    const std::int64_t drawn = runtime_.ended_frames() + 4;
    EXPECT_TRUE(wait_until(
        [&] { return runtime_.ended_frames() >= drawn && runtime_.frames().back().has_eyes; }));
    frames_[step_] = runtime_.frames().back();
  }
  [[nodiscard]] const std::map<engine::Step, SubmittedFrame>& frames() const { return frames_; }

 private:
  RuntimeDouble& runtime_;
  std::map<engine::Step, SubmittedFrame> frames_;
  engine::Step step_ = engine::Step::kSetup;
  int pairs_in_step_ = 0;
};

/// The drawn scene that belongs to a frame: the one that was drawn for its eyes.
const DrawnScene* scene_of(const SubmittedFrame& frame, const std::vector<DrawnScene>& drawn,
                           std::int64_t first_drawn) {
  const std::int64_t index = frame.number - first_drawn;
  return index >= 0 && index < static_cast<std::int64_t>(drawn.size())
             ? &drawn[static_cast<std::size_t>(index)]
             : nullptr;
}

TEST_F(OperationOnOpenxr, GoesThroughWithEachStepsFramesAsTheRendererDrawsThem) {
  Watch watch(runtime());
  const engine::LoopReport report = run(&watch);
  EXPECT_TRUE(report.done);
  EXPECT_EQ(report.draw_failures, 0) << report.last_failure;
  const auto presented = presenter_->stop();
  EXPECT_EQ(presented.losses, 0);
  EXPECT_GE(presented.drawn, 12) << "four in each of the steps below";
  EXPECT_THAT(watch.frames(),
              AllOf(Contains(Key(engine::Step::kDigitize)), Contains(Key(engine::Step::kVerify)),
                    Contains(Key(engine::Step::kGuide))));
  // Once the first snapshot is there and the runtime wants pixels, every frame has some.
  const std::vector<DrawnScene> all = drawn();
  const auto last = runtime().frames();
  std::int64_t first_drawn = -1;
  for (const auto& frame : last) {
    if (frame.has_eyes) {
      first_drawn = frame.number + 1 - static_cast<std::int64_t>(all.size());
    }
  }
  FrameComparison comparison(160, 120, render::Blend::kAdditive);
  for (const auto& [step, frame] : watch.frames()) {
    const DrawnScene* scene = scene_of(frame, all, first_drawn);
    ASSERT_NE(scene, nullptr) << engine::name_of(step);
    const auto difference = comparison.compare(*scene, frame);
    EXPECT_EQ(difference.most, 0) << engine::name_of(step);
    EXPECT_GT(difference.lit_px + difference.lit_on_panel_px, 20u) << engine::name_of(step);
  }
}

/// The session is lost, then the runtime; a recentring takes the registration back, and it is made
/// anew.
TEST_F(OperationOnOpenxr, ComesToItsEndThroughLossesAndARecentring) {
  runtime().at_frame(5, [] { runtime_double().lose_session(true); });
  runtime().at_frame(15, [] { runtime_double().lose_instance(false); });
  class Recentre : public engine::LoopObserver {
   public:
    void stepped(const FrameHeader& frame, const engine::Inputs&,
                 const engine::Guidance& now) override {
      if (now.step == engine::Step::kGuide && !told_) {
        told_ = true;
        EXPECT_TRUE(eventually([] { return runtime().sessions() == 3; })) << "after both losses";
        EXPECT_TRUE(frames_pass(2));
        epoch_before_ = frame.map_epoch;
        runtime_double().recentre({{0, 0, 0, 1}, {0.4f, 0, 0}}, true, 1);
        EXPECT_TRUE(frames_pass(2));
      }
      if (told_ && frame.map_epoch != epoch_before_ && !answered_) {
        answered_ = true;
        step_then_ = now.step;
        registered_then_ = now.levels[now.level].registration.has_value();
      }
    }
    bool told_ = false;
    decltype(StereoFrame::map_epoch) epoch_before_{};
    bool answered_ = false;
    bool registered_then_ = true;
    engine::Step step_then_ = engine::Step::kDone;
  } recentre;
  const engine::LoopReport report = run(&recentre);
  ASSERT_TRUE(recentre.answered_);
  EXPECT_EQ(recentre.step_then_, engine::Step::kDigitize);
  EXPECT_FALSE(recentre.registered_then_);
  EXPECT_TRUE(report.done) << "the surgeon digitizes again";
  const auto presented = presenter_->stop();
  EXPECT_EQ(presented.losses, 2);
  EXPECT_EQ(runtime().sessions(), 3);
  EXPECT_THAT(presented.problems, Contains(HasSubstr("XR_ERROR_INSTANCE_LOST")));
}

}  // namespace
}  // namespace orthonav::test
