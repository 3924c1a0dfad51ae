#include "engine/live/assembled_operation.h"

#include <gmock/gmock.h>

#include "engine/case/tool_file.h"
#include "engine/live/known_tools.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/failing.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/scripted_pairs.h"
#include "tests/support/shown_frames.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;

/// A method whose tracker sees nothing and keeps its options.
Method blind(nav::TrackerOptions& asked) {
  Method method;
  method.name = "blind";
  method.create_tracker =
      [&asked](const StereoCalibration&, std::vector<nav::ToolGeometry> tools,
               const nav::TrackerOptions& options) -> Result<std::unique_ptr<nav::ToolTracker>> {
    asked = options;
    if (tools.empty()) {
      return Error{"no tools"};
    }
    return std::unique_ptr<nav::ToolTracker>(std::make_unique<test::ScriptedTracker>());
  };
  method.registrar = [](const RegistrationRequest&) -> Result<nav::Registration> {
    return Error{"none"};
  };
  return method;
}

class CountingObserver : public LoopObserver {
 public:
  void stepped(const FrameHeader&, const Inputs&, const Guidance&) override { ++pairs; }
  void pair_came(const StereoFrame&) override { ++pictures; }
  int pairs = 0;
  int pictures = 0;
};

class HearingObserver : public SessionObserver {
 public:
  void not_understood(const Phrase& phrase) override { heard.push_back(phrase.text); }
  std::vector<std::string> heard;
};

class AssembledOperationTest : public ::testing::Test {
 protected:
  Result<std::unique_ptr<AssembledOperation>> assembled(Headset& headset) {
    return assemble_operation(headset, test::operation_of({"L5"}), blind(asked_), tools_, options_);
  }
  nav::TrackerOptions asked_;
  std::vector<nav::ToolGeometry> tools_ = built_in_tools();
  AssemblyOptions options_;
};

TEST_F(AssembledOperationTest, RunsFromPairsToWhatIsShown) {
  fake::Script script = test::pairs(5);
  script.voice = {{"abracadabra", 1.0, test::kStart + 2 * test::kPair}};
  fake::FakeHeadset headset(script);
  const auto operation = assembled(headset);
  ASSERT_TRUE(operation.ok()) << operation.error().message;
  CountingObserver counting;
  HearingObserver first;
  HearingObserver second;
  test::ShownFrames shown;
  (*operation)->observe(&shown);
  (*operation)->observe(&counting);
  (*operation)->observe(&first);
  (*operation)->observe(&second);
  const auto report = (*operation)->run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 5);
  EXPECT_EQ(counting.pairs, 5);
  EXPECT_THAT(first.heard, ::testing::ElementsAre("abracadabra"));
  EXPECT_EQ(second.heard, first.heard);
  EXPECT_EQ(shown.frames().size(), 6u) << "and one that takes all back";
  EXPECT_EQ(asked_.full_search_interval, 10);
}

TEST_F(AssembledOperationTest, GoesThroughAWrapperPutAroundTheHeadsetLater) {
  fake::FakeHeadset headset(test::pairs(5));
  const auto operation = assembled(headset);
  ASSERT_TRUE(operation.ok()) << operation.error().message;
  fake::FailingHeadset losing(headset, {.camera = {{1, fake::CameraFault::kDrop}}});
  (*operation)->go_through(losing);
  const auto report = (*operation)->run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 4);
}

TEST_F(AssembledOperationTest, AStopBeforeItRunsIsNotForgotten) {
  fake::FakeHeadset headset(test::pairs(5));
  const auto operation = assembled(headset);
  ASSERT_TRUE(operation.ok()) << operation.error().message;
  (*operation)->stop();
  const auto report = (*operation)->run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 0);
}

TEST_F(AssembledOperationTest, NamesEveryProblemOfItsOptions) {
  fake::FakeHeadset headset(test::pairs(1));
  options_.session.stale_after = Duration::zero();
  options_.loop.draw_every = -1;
  options_.visibility.grades = {0.2, 0.1};
  EXPECT_EQ(options_.check().size(), 3u);
  const auto refused = assembled(headset);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("loop: draw_every must not be negative"));
}

TEST_F(AssembledOperationTest, TheMapsDriftIsNoErrorBesideAPatientReference) {
  fake::FakeHeadset headset(test::pairs(1));
  options_.errors.map_drift_m_per_sqrt_s = ErrorSd{0.0003, ErrorSource::kGiven};
  Method method = blind(asked_);
  method.anchors = true;
  method.create_tracker = [](const auto&...) -> Result<std::unique_ptr<nav::ToolTracker>> {
    auto tracker = std::make_unique<test::ScriptedTracker>();
    tracker->hang_on_reference();
    return std::unique_ptr<nav::ToolTracker>(std::move(tracker));
  };
  for (const bool reference : {false, true}) {
    options_.use_reference = reference;
    const auto operation =
        assemble_operation(headset, test::operation_of({"L5"}), method, tools_, options_);
    ASSERT_TRUE(operation.ok()) << operation.error().message;
    EXPECT_EQ((*operation)->session().options().map_drift_m_per_sqrt_s, reference ? 0.0 : 0.0003);
  }
}

TEST_F(AssembledOperationTest, SaysWhyThereIsNoTracker) {
  fake::FakeHeadset headset(test::pairs(1));
  tools_.clear();
  const auto refused = assembled(headset);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "no tools");
}

/// Describes the tools that it was given.
class TalkativeHeadset : public fake::FakeHeadset {
 public:
  explicit TalkativeHeadset(DescribedTools tools)
      : FakeHeadset(test::pairs(1)), tools_(std::move(tools)) {}
  [[nodiscard]] DescribedTools described_tools() const override { return tools_; }

 private:
  DescribedTools tools_;
};

TEST(ToolsKnownTo, AHeadsetThatTellsNothingAreTheBuiltInOnes) {
  TalkativeHeadset headset{DescribedTools()};
  const auto tools = tools_known_to(headset);
  ASSERT_TRUE(tools.ok());
  EXPECT_EQ(tools_text(*tools), tools_text(built_in_tools()));
}

TEST(ToolsKnownTo, AHeadsetAreTheValuesThatItTells) {
  DescribedTool guide{"sleeve", ToolKind::kGuide, "tag36h11", 8, 0.06, {{0.0, -0.1, 0.0}}, {}};
  guide.axis_in_marker = {0.0, 0.0, 1.0};
  TalkativeHeadset headset(std::vector{guide});
  const auto tools = tools_known_to(headset);
  ASSERT_TRUE(tools.ok());
  ASSERT_EQ(tools->size(), 1u);
  const nav::ToolGeometry& tool = tools->front();
  EXPECT_EQ(tool.name, "sleeve");
  EXPECT_EQ(tool.role, nav::ToolRole::kGuide);
  EXPECT_EQ(tool.marker.id, 8);
  EXPECT_EQ(tool.marker.size_m, 0.06);
  EXPECT_EQ(tool.tip_in_marker.v, (Vec3{0.0, -0.1, 0.0}));
  EXPECT_EQ(tool.axis_in_marker.v, (Vec3{0.0, 0.0, 1.0}));
}

/// For a headset that measures its tools itself, for `n` moments, without describing them.
fake::Script measured(int n) {
  fake::Script script = test::pairs(0);
  script.tools = {"pointer", "guide", "reference"};
  for (int i = 0; i < n; ++i) {
    ToolPoses poses;
    poses.sequence = i;
    poses.time = test::kStart + (i + 1) * test::kPair;
    poses.world_from_rig = Transform<World, Rig>{};
    poses.tools.assign(3, {{}, poses.time, PoseStatus::kMeasured, {}});
    poses.tools[1] = {};
    script.tool_poses.emplace_back(poses);
  }
  return script;
}

TEST_F(AssembledOperationTest, TakesPosesWhereTheHeadsetMeasuresToolsItself) {
  fake::Script script = measured(4);
  script.tool_poses[2] = Error{"out of order"};
  fake::FakeHeadset headset(script);
  const auto operation = assembled(headset);
  ASSERT_TRUE(operation.ok()) << operation.error().message;
  CountingObserver counting;
  (*operation)->observe(&counting);
  const auto report = (*operation)->run();
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, 3);
  EXPECT_EQ(report.failures, 1);
  EXPECT_EQ(report.last_frame, test::kStart + 4 * test::kPair);
  EXPECT_EQ(counting.pairs, 3);
  EXPECT_EQ(counting.pictures, 0);
  std::vector<PoseStatus> seen;
  for (const nav::ToolState& state : (*operation)->session().tool_states()) {
    seen.push_back(state.world_from_marker.status);
  }
  EXPECT_THAT(seen, ::testing::ElementsAre(PoseStatus::kMeasured, PoseStatus::kLost,
                                           PoseStatus::kMeasured));
}

TEST_F(AssembledOperationTest, NeedsToolsFromSomewhere) {
  class Blind : public ForwardingHeadset {
   public:
    using ForwardingHeadset::ForwardingHeadset;
    [[nodiscard]] StereoCamera* cameras() override { return nullptr; }
  };
  fake::FakeHeadset inner(test::pairs(1));
  Blind headset(inner);
  const auto refused = assembled(headset);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "fake has no cameras, and measures no tools itself");
}

TEST_F(AssembledOperationTest, CountsWithWhatSuchDevicesUsuallyAreOffWhereNobodySays) {
  fake::FakeHeadset headset(test::pairs(1));
  const auto of = [&](Headset& any) {
    const auto operation = assembled(any);
    EXPECT_TRUE(operation.ok());
    if (operation) {
      const SessionOptions& counts = (*operation)->session().options();
      EXPECT_EQ(counts.common.sd_m(), (*operation)->errors().common().sd_m());
    }
    return operation ? (*operation)->errors() : ErrorsInUse{};
  };
  const ErrorsInUse assumed = of(headset);
  EXPECT_NEAR(assumed.common().sd_m(), 0.00061, 1e-5);
  EXPECT_EQ(assumed.tip_m.source, ErrorSource::kAssumed);
  EXPECT_GT(assumed.map_drift_m_per_sqrt_s.sd, 0.0);
  fake::FakeHeadset tracker(measured(1));
  EXPECT_LT(of(tracker).cameras_m.sd, assumed.cameras_m.sd);
  EXPECT_EQ(of(tracker).map_drift_m_per_sqrt_s.source, ErrorSource::kNone) << "it stands still";
  options_.errors.tip_m = ErrorSd{0.001, ErrorSource::kGiven};
  options_.errors.map_m = ErrorSd{0.0, ErrorSource::kGiven};
  EXPECT_EQ(of(headset).tip_m.sd, 0.001);
  EXPECT_EQ(of(headset).cameras_m.sd, assumed.cameras_m.sd);
  EXPECT_EQ(of(headset).map_drift_m_per_sqrt_s.sd, 0.0);
  EXPECT_EQ(errors_in_use({}, {.patient_reference = true}).map_drift_m_per_sqrt_s.sd, 0.0);
}

TEST(ToolsKnownTo, AHeadsetThatMeasuresToolsItselfAreNotGuessed) {
  fake::FakeHeadset headset(measured(1));
  const auto tools = tools_known_to(headset);
  ASSERT_FALSE(tools.ok());
  EXPECT_THAT(tools.error().message, HasSubstr("--tools"));
}

TEST(ToolsKnownTo, AHeadsetWithAFileAreReadAndRefusedByItsName) {
  const auto text = tools_text(built_in_tools());
  TalkativeHeadset headset(ToolsFile{"its file", text});
  const auto tools = tools_known_to(headset);
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  EXPECT_EQ(tools_text(*tools), text);
  TalkativeHeadset bad(ToolsFile{"its file", "{"});
  const auto refused = tools_known_to(bad);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("its file"));
}

}  // namespace
}  // namespace orthonav::engine
