#include "engine/study/simulated_operation.h"

#include "base/joined.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/session/observer_list.h"
#include "engine/study/evaluation.h"
#include "engine/study/sim_scenario.h"
#include "hal/replay/recorder.h"

namespace orthonav::engine {

std::vector<std::string> OperationOptions::check() const {
  std::vector<std::string> problems;
  const auto add = [&](const char* where, const std::vector<std::string>& found) {
    for (const std::string& problem : found) {
      problems.push_back(where + problem);
    }
  };
  if (const auto known = method_named(method); !known) {
    problems.push_back(known.error().message);
  }
  add("tools: ", nav::problems_of(tools));
  if (const Status room = sim.check(); !room) {
    problems.push_back(room.error().message);
  }
  add("session: ", session.check());
  add("loop: ", loop.check());
  add("visibility: ", visibility.check());
  return problems;
}

Result<OperationResult> run_operation(const Case& source, const OperationOptions& options,
                                      const OperationHooks& hooks) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  const auto method = method_named(options.method);
  if (!method) {
    return method.error();
  }
  ModelCache none;
  auto operation = plan_operation(source, options.levels, hooks.models ? *hooks.models : none);
  if (!operation) {
    return operation.error();
  }
  auto headset = sim::SimHeadset::open(room_of(source, *operation, options.tools), options.sim);
  if (!headset) {
    return headset.error();
  }
  sim::SimHeadset& room = **headset;
  // The engine gets the tools as a planning file describes them, not as they are.
  const std::vector<nav::ToolGeometry> tools = described_tools(room);
  auto tracker = method->create_tracker(room.cameras().calibration(), tools, options.tracker);
  if (!tracker) {
    return tracker.error();
  }
  auto session =
      Session::create(std::move(*operation), std::move(*tracker), *method, options.session);
  if (!session) {
    return session.error();
  }
  GroundTruthRecorder ground_truth(room);
  EndNote end_note;
  ObserverList observers({&ground_truth, &end_note});
  for (SessionObserver* hook : hooks.session) {
    observers.add(hook);
  }
  (*session)->observe(&observers);

  std::unique_ptr<replay::RecordingHeadset> recorder;
  if (!options.record_folder.empty()) {
    auto made = replay::RecordingHeadset::around(room, options.record_folder, {tools_text(tools)});
    if (!made) {
      return made.error();
    }
    recorder = std::move(*made);
  }
  if (hooks.opened) {
    if (const Status opened = hooks.opened(room, *method, **session); !opened) {
      return opened.error();
    }
  }
  SceneBuilder builder(options.visibility);
  FrameLoop loop(recorder ? static_cast<Headset&>(*recorder) : room, **session, builder,
                 options.loop);
  loop.observe(hooks.loop);
  loop.draw_into(hooks.sink);
  auto report = loop.run();
  if (!report) {
    return report.error();
  }
  OperationResult result = outcome_of((*session)->levels(), (*session)->rods(), std::move(*report));
  result.method = method->name;
  result.seed = options.sim.seed;
  result.case_name = source.name;
  // A recording that came to nothing takes nothing from what was measured.
  if (recorder) {
    result.recording = recorder->close();
  }
  ground_truth.evaluate((*session)->levels(), result);
  end_note.explain(result);
  return result;
}

}  // namespace orthonav::engine
