// A whole operation whose tools another program tracks: their poses come as messages over TCP, and
// no image is used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "base/stopwatch.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/live/known_tools.h"
#include "hal/api/forwarding_headset.h"
#include "hal/igtl/tracker_headset.h"
#include "study/evaluation.h"
#include "study/sim_scenario.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"
#include "tests/e2e/planned.h"
#include "tests/support/pose_server.h"

namespace orthonav::engine::igtl_operation_test {
namespace {

/// The errors due to the tracker's noise in an otherwise perfect world, with a perfect surgeon.
constexpr double kEntry_m = 0.0010;
constexpr double kAngle_rad = 0.0175;  // 1 degree
/// SD of the tracker's noise along (about) each axis.
constexpr double kNoise_m = 0.0001;
constexpr double kNoise_rad = 0.001;
/// The pose of the tracker's own frame in the room.
const Transform<World, Rig> kStand(rotation_from_vector({0.3, -1.2, 0.4}), {0.7, 1.1, -0.9});

std::size_t measured(const ToolPoses& poses) {
  return static_cast<std::size_t>(
      std::count_if(poses.tools.begin(), poses.tools.end(),
                    [](const auto& tool) { return tool.status == PoseStatus::kMeasured; }));
}

/// The tracker's own World is the frame of its stand in the room.
Transform<Rig, Marker> rigged(const Transform<World, Marker>& pose) {
  return {pose.rotation(), pose.translation()};
}

/// The simulated room, whose tools an optical tracker sees and whose images are not used.
class TrackedRoom : public ForwardingHeadset, private ToolPoseSource {
 public:
  TrackedRoom(sim::SimHeadset& room, const std::vector<nav::ToolGeometry>& tools)
      : ForwardingHeadset(room), room_(room) {
    std::string keys = "rms_mm=0.18&rms_deg=0.1";
    for (const nav::ToolGeometry& tool : tools) {
      names_.push_back(tool.name);
      keys += "&" + tool.name + "=" + tool.name + "ToTracker";
    }
    const auto options = igtl::tracker_options_of(server_.uri(keys)).value();
    std::thread first([this] {
      if (server_.wait_for_client()) {
        send();
      }
    });
    tracker_ = igtl::open_tracker(options).value();
    first.join();
  }
  [[nodiscard]] ToolPoseSource* tool_poses() override { return this; }
  /// Whether none was measured in the newest poses.
  [[nodiscard]] bool sees_none() const { return sees_none_; }
  /// Whether the tracker sees no tools from now on.
  void hide(bool hidden) { hidden_ = hidden; }

 private:
  [[nodiscard]] std::span<const std::string> do_names() const override {
    return tracker_->tool_poses()->names();
  }
  /// One frame of the room; its tools come back from the tracker, on the room's clock and in its
  /// World.
  Result<Next> do_next(ToolPoses& poses) override {
    auto answer = room_.cameras()->next(pair_);
    if (!answer || *answer != Next::kFrame) {
      return answer;
    }
    // Sends again, as a tracker would: a message that comes too late on a busy machine is dropped.
    std::size_t sent = send();
    Stopwatch since_sent;
    const bool came = test::wait_until([&] {
      if (since_sent.elapsed_ms() > kAgain_ms) {
        sent = send();
        since_sent = Stopwatch();
      }
      const auto next = tracker_->tool_poses()->next(poses);
      return next && *next == Next::kFrame && measured(poses) == sent;
    });
    if (!came) {
      return Error{"no poses came"};
    }
    poses.time = pair_.time;
    poses.sequence = pair_.sequence;
    poses.world_from_rig = kStand;
    for (auto& tool : poses.tools) {
      tool.time = pair_.time;
      tool.value = kStand * rigged(tool.value);
    }
    sees_none_ = measured(poses) == 0;
    return Next::kFrame;
  }

  /// Returns how many tools are seen. An identity is sent for the others, as PlusServer does.
  std::size_t send() {
    const sim::RoomState state = room_.state();
    // Further apart than what belongs to one moment, and never slower than real time: whoever
    // receives stamps that have run ahead and then slow down takes all later ones for old.
    stamp_s_ += std::max(0.005, 1e-3 * since_stamp_.elapsed_ms());
    since_stamp_ = Stopwatch();
    std::size_t seen = 0;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      Transform<World, Marker> pose;
      if (state.tool_present[i] && !hidden_) {
        const auto seen_from_stand =
            kStand.inverse() * room_.world_from_room() * state.room_from_marker[i];
        const auto noise = [this](double sd) {
          return Vec3{random_.normal(0, sd), random_.normal(0, sd), random_.normal(0, sd)};
        };
        pose = {rotation_from_vector(noise(kNoise_rad)) * seen_from_stand.rotation(),
                seen_from_stand.translation() + noise(kNoise_m)};
        ++seen;
      }
      server_.add(names_[i] + "ToTracker", pose, stamp_s_);
    }
    server_.send();
    return seen;
  }

  sim::SimHeadset& room_;
  test::PoseServer server_;
  std::unique_ptr<Headset> tracker_;
  std::vector<std::string> names_;
  StereoFrame pair_;
  Random random_{7};
  static constexpr double kAgain_ms = 200.0;
  Stopwatch since_stamp_;
  double stamp_s_ = 1.7e9;
  bool hidden_ = false;
  bool sees_none_ = true;
};

struct Operated {
  OperationResult result;
  std::vector<Event> events;
};

/// Hides the tools for a second as soon as a screw is guided.
class Hider : public SessionObserver, public LoopObserver {
 public:
  Hider(TrackedRoom& room, std::vector<Event>& events) : room_(room), events_(events) {}
  void happened(Timestamp time, Step /*from*/, Event event, Cell answer) override {
    events_.push_back(event);
    if (answer.next == Step::kGuide && !until_) {
      until_ = time + std::chrono::seconds(1);
    }
  }
  void stepped(const FrameHeader& frame, const Inputs& /*inputs*/,
               const Guidance& guidance) override {
    room_.hide(until_ && frame.time < *until_);
    if (room_.sees_none()) {
      EXPECT_FALSE(guidance.tool.has_value()) << "guidance on a tool that was not measured";
    }
  }

 private:
  TrackedRoom& room_;
  std::vector<Event>& events_;
  std::optional<Timestamp> until_;
};

Operated operate(bool reference) {
  Operated out;
  Operation operation = planned({"L5"});
  sim::SimOptions sim;
  sim.error_model = sim::ErrorModel::perfect();
  sim.error_model.pace = 10.0;
  sim.render = false;
  sim.surgeon = sim::ScriptedSurgeon::bring;
  const auto room =
      sim::SimHeadset::open(room_of(lumbar_spine(), operation, built_in_tools()), sim).value();
  auto tools = tools_known_to(*room).value();
  for (nav::ToolGeometry& tool : tools) {
    tool.marker = {"", 0, 0.0};
  }
  TrackedRoom headset(*room, tools);
  AssemblyOptions options;
  options.use_reference = reference;
  const auto live = assemble_operation(headset, std::move(operation), method_named("best").value(),
                                       tools, options);
  EXPECT_TRUE(live.ok()) << live.error().message;
  if (!live) {
    return out;
  }
  sim::ShownToWearer to_wearer(headset);
  GroundTruthRecorder truth(*room, (*live)->session());
  EndNote end;
  Hider hider(headset, out.events);
  (*live)->observe(&to_wearer);
  (*live)->observe(&truth);
  (*live)->observe(&end);
  (*live)->observe(static_cast<SessionObserver*>(&hider));
  (*live)->observe(static_cast<LoopObserver*>(&hider));
  const auto report = (*live)->run();
  EXPECT_TRUE(report.ended.ok()) << report.ended.error().message;
  if (!report.ended) {
    return out;
  }
  out.result = result_of((*live)->session().operation(), report);
  end.explain(out.result);
  truth.evaluate(out.result);
  return out;
}

void expect_done(const Operated& done) {
  ASSERT_TRUE(done.result.loop.done) << done.result.why_not;
  EXPECT_THAT(done.events, ::testing::Contains(Event::kTrackingLost)) << "it was hidden";
  const auto& screws = done.result.truth.levels.at(0).screws;
  ASSERT_EQ(screws.size(), 2u);
  for (std::size_t s = 0; s < screws.size(); ++s) {
    SCOPED_TRACE(name_of(done.result.state.levels[0].plan.screws[s].side));
    ASSERT_TRUE(screws[s].known && screws[s].entry_error_m);
    EXPECT_LT(*screws[s].entry_error_m, kEntry_m);
    EXPECT_LT(screws[s].angle_error_rad, kAngle_rad);
  }
}

TEST(TrackedElsewhere, AWholeOperationNeedsNoImages) { expect_done(operate(false)); }

TEST(TrackedElsewhere, AWholeOperationHangsOnAPatientReference) { expect_done(operate(true)); }

}  // namespace
}  // namespace orthonav::engine::igtl_operation_test
