// How reliably a landmark that is touched before each screw shows that something moved: simulated
// operations of one level in the measurement model, up to the touch before the second screw. With
// the first wire in, the patient reference is bumped, or the patient slips, or nothing happens.
//   bench_landmark --operations 200 --reference --bump-mm 2 > touches.csv
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "base/angle.h"
#include "bench/wilson.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

struct Outcome {
  std::uint64_t seed = 0;
  std::optional<engine::LandmarkTouch> touch;  ///< before the second screw
  double apart_s = 0.0;                        ///< the two touches
  double moved_m = 0.0;                        ///< truly, of the landmark in the session's World
  double entry_moved_m = 0.0;                  ///< and of the second screw's entry
  double rotation_rad = 0.0;
  bool guided = false;  ///< the second screw was, after that touch
};

/// Listens until the second screw is guided, or refused.
class Listener : public engine::SessionObserver {
 public:
  void listen(const sim::SimHeadset& room, std::function<void()> stop) {
    room_ = &room;
    stop_ = std::move(stop);
  }
  void use_reference(bool use) { use_reference_ = use; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

  void landmark_touched(Timestamp time, const engine::LevelState& level,
                        const engine::LandmarkTouch& touch) override {
    const Transform<World, Vertebra> now = world_from_bone(level);
    if (touch.first || !at_record_) {
      at_record_ = now;
      recorded_ = time;
      return;
    }
    if (outcome_.touch) {
      return;
    }
    outcome_.touch = touch;
    outcome_.apart_s = seconds(time - recorded_);
    const auto moved = [&](Point<Vertebra> place) {
      return (now * place - *at_record_ * place).norm();
    };
    outcome_.moved_m = moved(level.landmark->in_vertebra);
    outcome_.entry_moved_m = moved(level.plan.screws.back().entry);
    outcome_.rotation_rad = rotation_angle_rad(now.rotation(), at_record_->rotation());
  }
  void happened(Timestamp /*time*/, engine::Step /*from*/, engine::Event /*event*/,
                engine::Cell answer) override {
    if (outcome_.touch && answer.next != engine::Step::kTouchLandmark) {
      outcome_.guided = outcome_.guided || answer.next == engine::Step::kGuide;
      stop_();
    }
  }

 private:
  /// The true pose of the bone in the session's World.
  [[nodiscard]] Transform<World, Vertebra> world_from_bone(const engine::LevelState& level) const {
    const sim::RoomState state = room_->state();
    const auto& levels = room_->room().levels;
    const auto bone = std::find_if(levels.begin(), levels.end(), [&](const sim::RoomLevel& l) {
      return l.label == level.plan.label;
    });
    const auto room_from_bone = state.room_from_spine * bone->spine_from_vertebra;
    if (!use_reference_) {
      return room_->world_from_room() * room_from_bone;
    }
    const auto& tools = room_->room().tools;
    const auto reference = std::find_if(tools.begin(), tools.end(), [](const sim::RoomTool& tool) {
      return tool.kind == sim::ToolKind::kReference;
    });
    const auto& room_from_marker =
        state.room_from_marker[static_cast<std::size_t>(reference - tools.begin())];
    return Transform<World, Marker>() * room_from_marker.inverse() * room_from_bone;
  }

  const sim::SimHeadset* room_ = nullptr;
  std::function<void()> stop_;
  bool use_reference_ = false;
  std::optional<Transform<World, Vertebra>> at_record_;
  Timestamp recorded_{};
  Outcome outcome_;
};

/// The true pose in the session's World: what is measured here does not depend on how the bone was
/// registered, and searching for it would take most of the time.
Result<nav::Registration> true_registration(const sim::SimHeadset& room,
                                            const engine::Session& session,
                                            const std::string& label) {
  const auto& levels = room.room().levels;
  const auto bone = std::find_if(levels.begin(), levels.end(),
                                 [&](const sim::RoomLevel& l) { return l.label == label; });
  const nav::Anchor* anchor = session.tracker().anchor();
  const auto session_from_map =
      anchor != nullptr ? anchor->world_from_anchored.inverse() : Transform<World, World>();
  nav::Registration found;
  found.accepted = true;
  found.world_from_vertebra = found.runner_up = session_from_map * room.world_from_room() *
                                                room.state().room_from_spine *
                                                bone->spine_from_vertebra;
  found.points = 1000;
  return found;
}

Result<Outcome> run(const engine::OperationOptions& options, const engine::Operation& planned) {
  Listener listener;
  listener.use_reference(options.use_reference);
  const sim::SimHeadset* open = nullptr;
  const engine::Session* opened = nullptr;
  engine::OperationHooks hooks;
  hooks.session = {&listener};
  hooks.adapt = [&](const sim::SimHeadset& room, engine::Method& method) {
    method.registrar = [&](const engine::RegistrationRequest&) {
      return true_registration(room, *opened, planned.levels[0].label);
    };
  };
  hooks.opened = [&](sim::SimHeadset& room, const engine::Method&, const engine::Session& session) {
    open = &room;
    opened = &session;
    return Status();
  };
  hooks.can_stop = [&](std::function<void()> stop) {
    if (stop) {
      listener.listen(*open, std::move(stop));
    }
  };
  const auto result = engine::run_operation(engine::phantom(), planned, options, hooks);
  if (!result) {
    return result.error();
  }
  Outcome outcome = listener.outcome();
  outcome.seed = options.sim.seed;
  return outcome;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_fraction(const char* name, std::size_t k, std::size_t n) {
  const FractionInterval interval = wilson(static_cast<double>(k), n);
  std::fprintf(stderr, "%-42s %zu of %zu = %.1f %% (95 %%: %.1f to %.1f)\n", name, k, n,
               100.0 * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(n, 1)),
               100.0 * interval.low, 100.0 * interval.high);
}

void summarize(const std::vector<Outcome>& outcomes) {
  std::vector<double> off;
  std::vector<double> limit;
  std::size_t alarms = 0;
  std::size_t guided_against = 0;
  std::size_t guided = 0;
  double squares = 0.0;
  Outcome worst;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.touch) {
      continue;
    }
    off.push_back(outcome.touch->off_m);
    limit.push_back(outcome.touch->limit_m);
    squares += outcome.touch->off_m * outcome.touch->off_m;
    const bool alarm = !outcome.touch->held();
    alarms += alarm ? 1 : 0;
    guided_against += alarm && outcome.guided ? 1 : 0;
    guided += outcome.guided ? 1 : 0;
    if (outcome.guided && outcome.entry_moved_m > worst.entry_moved_m) {
      worst = outcome;
    }
  }
  const std::size_t n = off.size();
  std::fprintf(stderr, "operations %zu, with a second touch %zu\n", outcomes.size(), n);
  print_fraction("noticed before the second screw", alarms, n);
  print_fraction("guided on", guided, n);
  std::fprintf(stderr, "guided on although noticed: %zu\n", guided_against);
  std::fprintf(stderr,
               "off mm: SD along an axis %.3f, median %.2f, 99.5 %% %.2f; limit mm: median %.2f, "
               "least %.2f, most %.2f\n",
               1e3 * std::sqrt(squares / (3.0 * static_cast<double>(std::max<std::size_t>(n, 1)))),
               1e3 * quantile(off, 0.5), 1e3 * quantile(off, 0.995), 1e3 * quantile(limit, 0.5),
               1e3 * quantile(limit, 0.0), 1e3 * quantile(limit, 1.0));
  std::fprintf(
      stderr,
      "worst that was guided on: entry %.2f mm, landmark %.2f mm, turned %.2f deg, seed %llu\n",
      1e3 * worst.entry_moved_m, 1e3 * worst.moved_m, degrees(worst.rotation_rad),
      static_cast<unsigned long long>(worst.seed));
}

int run_all(engine::OperationOptions options, std::uint64_t first, int operations,
            const std::string& level) {
  std::vector<Outcome> outcomes;
  std::puts("seed,touched,off_mm,limit_mm,held,apart_s,moved_mm,entry_moved_mm,turned_deg,guided");
  options.levels = {level};
  const engine::Case source = engine::phantom();
  const auto planned = engine::plan_operation(source, options.levels);
  if (!planned) {
    std::fprintf(stderr, "%s\n", planned.error().message.c_str());
    return 2;
  }
  for (int i = 0; i < operations; ++i) {
    options.sim.seed = first + static_cast<std::uint64_t>(i);
    const auto outcome = run(options, *planned);
    if (!outcome) {
      std::fprintf(stderr, "%s\n", outcome.error().message.c_str());
      return 2;
    }
    outcomes.push_back(*outcome);
    const engine::LandmarkTouch touch = outcome->touch.value_or(engine::LandmarkTouch{});
    std::printf("%llu,%d,%.4f,%.4f,%d,%.2f,%.4f,%.4f,%.4f,%d\n",
                static_cast<unsigned long long>(outcome->seed), outcome->touch ? 1 : 0,
                touch.off_m * 1e3, touch.limit_m * 1e3, touch.held() ? 1 : 0, outcome->apart_s,
                outcome->moved_m * 1e3, outcome->entry_moved_m * 1e3,
                degrees(outcome->rotation_rad), outcome->guided ? 1 : 0);
    std::fflush(stdout);
  }
  summarize(outcomes);
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  CLI::App app("What a landmark touched before each screw notices, as CSV");
  orthonav::engine::OperationOptions options;
  std::uint64_t first = 1;
  int operations = 200;
  std::string level = "L4";
  double bump_mm = 0.0;
  double turn_deg = 0.0;
  double shift_mm = 0.0;
  bool still = false;
  app.add_option("--operations", operations, "how many");
  app.add_option("--seed", first, "of the first; those that follow count up");
  app.add_option("--level", level, "to operate");
  app.add_flag("--reference", options.use_reference,
               "positions are relative to a patient reference");
  app.add_option("--bump-mm", bump_mm, "the reference is shifted by so much");
  app.add_option("--turn-deg", turn_deg, "and turned by so much about its tag");
  app.add_option("--shift-mm", shift_mm, "the patient slips by so much");
  app.add_option("--pace", options.sim.error_model.pace, "of the surgeon");
  app.add_flag("--still", still, "the headset's map neither drifts nor jumps");
  CLI11_PARSE(app, argc, argv);
  options.tools = orthonav::engine::built_in_tools();
  options.measurement = orthonav::engine::Measurement::kModel;
  options.loop.draw_every = 0;
  options.sim.guidance = orthonav::sim::GuidanceProfile::kClosedLoop;
  options.sim.reference_bump = {bump_mm * 1e-3, turn_deg * orthonav::kRadiansPerDegree, 1};
  options.sim.patient_shift = {shift_mm * 1e-3, 1};
  if (still) {
    options.sim.error_model.map_drift_m_per_sqrt_s = 0.0;
    options.sim.error_model.map_drift_rad_per_sqrt_s = 0.0;
    options.sim.error_model.map_steps_per_min = 0.0;
  }
  return orthonav::run_all(options, first, operations, level);
}
