#include "study/simulated_operation.h"

#include "base/joined.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/known_tools.h"
#include "hal/replay/recorder.h"
#include "study/evaluation.h"
#include "study/guide_truth.h"
#include "study/modelled_tracker.h"
#include "study/sim_scenario.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"

namespace orthonav::engine {

namespace {

/// Null if nothing is to be recorded.
Result<std::unique_ptr<replay::RecordingHeadset>> recorder_of(
    Headset& room, const std::string& folder, const std::vector<nav::ToolGeometry>& tools) {
  if (folder.empty()) {
    return std::unique_ptr<replay::RecordingHeadset>();
  }
  return replay::RecordingHeadset::around(room, folder, {tools_text(tools)});
}

/// The observers of an operation: the surgeon sees what is shown, and the truth in the room and the
/// last status line are recorded.
class Watchers {
 public:
  /// Room, headset (the room's as the engine sees it) and operation must outlive them; the hooks
  /// hear everything after them.
  Watchers(const sim::SimHeadset& room, Headset& headset, AssembledOperation& live,
           const OperationHooks& hooks)
      : to_surgeon_(headset),
        ground_truth_(room, live.session()),
        guide_truth_(room, live.session()) {
    live.observe(&to_surgeon_);
    live.observe(&ground_truth_);
    live.observe(&end_note_);
    for (SessionObserver* hook : hooks.session) {
      live.observe(hook);
    }
    live.observe(&guide_truth_);
    live.observe(hooks.loop);
    live.draw_into(hooks.sink);
  }
  Watchers(const Watchers&) = delete;
  Watchers& operator=(const Watchers&) = delete;

  /// Adds their results.
  void evaluate(OperationResult& result) const {
    ground_truth_.evaluate(result);
    guide_truth_.evaluate(result);
    end_note_.explain(result);
  }

 private:
  sim::ShownToWearer to_surgeon_;
  GroundTruthRecorder ground_truth_;
  GuideTruth guide_truth_;
  EndNote end_note_;
};

Status tell_opened(const OperationHooks& hooks, sim::SimHeadset& room, const Method& method,
                   const Session& session) {
  return hooks.opened ? hooks.opened(room, method, session) : Status();
}

/// Runs the operation, which can be stopped from outside meanwhile.
LoopReport run_until_done(const OperationHooks& hooks, AssembledOperation& live) {
  if (hooks.can_stop) {
    hooks.can_stop([&live] { live.stop(); });
  }
  const LoopReport report = live.run();
  if (hooks.can_stop) {
    hooks.can_stop(nullptr);
  }
  return report;
}

/// Assembles the operation around the room's headset as the engine sees it.
Result<std::unique_ptr<AssembledOperation>> assembled_on(
    Headset& headset, const Method& method, Operation operation,
    const std::vector<nav::ToolGeometry>& tools, const OperationOptions& options,
    const OperationHooks& hooks) {
  AssemblyOptions assembly = options;
  assembly.errors = errors_in(options.sim, options.correct_tag_sizes);
  tell_instruments(options.sim, assembly.session);
  assembly.visibility.cross_and_depth = options.sim.guidance != sim::GuidanceProfile::kPublished;
  auto live = assemble_operation(headset, std::move(operation), method, tools, assembly);
  const Status taken = live && hooks.assembled ? hooks.assembled(**live) : Status();
  return taken ? std::move(live) : taken.error();
}

Result<OperationResult> operate(sim::SimHeadset& room, const Method& method, Operation operation,
                                const OperationOptions& options, const OperationHooks& hooks) {
  // The engine gets the tools as a planning file describes them, not as they really are.
  const auto tools = tools_known_to(room);
  if (!tools) {
    return tools.error();
  }
  const auto headset = hooks.seen_through ? hooks.seen_through(room) : Result<Headset*>(&room);
  if (!headset) {
    return headset.error();
  }
  auto assembled = assembled_on(**headset, method, std::move(operation), *tools, options, hooks);
  if (!assembled) {
    return assembled.error();
  }
  AssembledOperation& live = **assembled;
  Watchers watchers(room, **headset, live, hooks);
  auto recorder = recorder_of(room, options.record_folder, *tools);
  if (!recorder) {
    return recorder.error();
  }
  if (*recorder) {
    live.go_through(**recorder);
    if (hooks.recorded) {
      hooks.recorded(live, **recorder);
    }
  }
  if (const Status opened = tell_opened(hooks, room, method, live.session()); !opened) {
    return opened.error();
  }
  LoopReport loop = run_until_done(hooks, live);
  OperationResult result = result_of(live.session().operation(), std::move(loop));
  result.errors = live.errors();
  result.calibration = calibration_in_use(live.session().tracker());
  // A recording that failed must not cost the operation its result.
  if (*recorder) {
    result.recording = (*recorder)->close();
  }
  watchers.evaluate(result);
  return result;
}

sim::SimOptions sim_options(const OperationOptions& options) {
  sim::SimOptions sim = options.sim;
  sim.surgeon = sim::ScriptedSurgeon::bring;
  sim.relies_on_reference = options.use_reference;
  sim.render = sim.render && options.measurement == Measurement::kPixels && !options.navigation;
  return sim;
}

/// The method as it works in this room.
Result<Method> method_in(const sim::SimHeadset& room, const Operation& operation,
                         const OperationOptions& options) {
  if (options.navigation) {
    return method_of(*options.navigation, room, operation);
  }
  auto method = method_named(options.method);
  if (method && options.measurement == Measurement::kModel) {
    method->create_tracker = [name = method->name, sizes = options.correct_tag_sizes,
                              &room](const auto&... given) {
      return create_modelled_tracker(name, room, given..., sizes);
    };
    method->coaching = false;  // the simulated surgeon does not read it, and it costs time
  }
  return method;
}

}  // namespace

std::vector<std::string> OperationOptions::check() const {
  std::vector<std::string> problems;
  if (const auto known = method_named(method); !known) {
    problems.push_back(known.error().message);
  }
  if (!correct_tag_sizes && measurement != Measurement::kModel) {
    problems.push_back("tag sizes are left out in the measurement model alone");
  }
  for (const std::string& problem : nav::problems_of(tools)) {
    problems.push_back("tools: " + problem);
  }
  if (const Status room = sim.check(); !room) {
    problems.push_back(room.error().message);
  }
  for (std::string& problem : AssemblyOptions::check()) {
    problems.push_back(std::move(problem));
  }
  return problems;
}

Result<OperationResult> run_operation(const Case& source, const OperationOptions& options,
                                      const OperationHooks& hooks) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  if (options.rods_alone) {
    return run_operation(source, plan_rods_alone(source), options, hooks);
  }
  auto operation = plan_operation(source, options.levels);
  if (!operation) {
    return operation.error();
  }
  return run_operation(source, std::move(*operation), options, hooks);
}

Result<OperationResult> run_operation(const Case& source, Operation planned,
                                      const OperationOptions& options,
                                      const OperationHooks& hooks) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  sim::RoomDescription description = room_of(source, planned, options.tools);
  description.exposure = options.exposure.value_or(strokes_of(options.method));
  if (const Status standing = check_standing_screws(planned, description); !standing) {
    return standing.error();
  }
  auto room = sim::SimHeadset::open(std::move(description), sim_options(options));
  if (!room) {
    return room.error();
  }
  auto method = method_in(**room, planned, options);
  if (!method) {
    return method.error();
  }
  if (hooks.adapt) {
    hooks.adapt(**room, *method);
  }
  auto result = operate(**room, *method, std::move(planned), options, hooks);
  if (!result) {
    return result.error();
  }
  result->method = method->name;
  result->seed = options.sim.seed;
  result->case_name = source.name;
  result->patient_reference = options.use_reference;
  return result;
}

}  // namespace orthonav::engine
