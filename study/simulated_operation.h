#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/live/assembled_operation.h"
#include "engine/report/operation_result.h"
#include "hal/sim/sim_headset.h"
#include "study/stated_navigation.h"

namespace orthonav::replay {
class RecordingHeadset;
}

namespace orthonav::engine {

/// The input of tracking.
enum class Measurement {
  kPixels,  ///< images of the room
  kModel    ///< no images: measurements from a model fitted to them (measurement_model.h)
};

struct OperationOptions : AssemblyOptions {
  std::string method = "best";
  Measurement measurement = Measurement::kPixels;
  /// Replaces the method: a published system's navigation, in the measurement model.
  std::optional<StatedNavigation> navigation;
  std::vector<std::string> levels;  ///< empty: the two lowest of the case
  /// Every screw of the case stands in the room, and rods alone are bent.
  bool rods_alone = false;
  std::vector<nav::ToolGeometry> tools;
  /// Absent: as the method is used (`strokes_of`, sim_scenario.h).
  std::optional<sim::Exposure> exposure;
  sim::SimOptions sim;
  /// In the measurement model: poses of `best` use the tag sizes estimated in use.
  bool correct_tag_sizes = true;
  std::vector<std::string> left_out;  ///< steps of the method, by `leave_out` (left_out.h)
  std::string record_folder;          ///< empty: nothing is recorded

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Other participants; all borrowed, all optional.
struct OperationHooks {
  std::vector<SessionObserver*> session;
  LoopObserver* loop = nullptr;
  SnapshotSink* sink = nullptr;
  /// Receives, before the operation runs, a function that ends it early, callable from any thread;
  /// and null once it has ended.
  std::function<void(std::function<void()>)> can_stop;
  /// May replace parts of the method once the room is open.
  std::function<void(const sim::SimHeadset&, Method&)> adapt;
  /// The headset that the engine gets: one that forwards to the room's and is owned by the hook's
  /// owner. Null: the room's own.
  std::function<Result<Headset*>(Headset&)> seen_through;
  /// Called once everything is assembled, before `opened`; an Error ends the run.
  std::function<Status(AssembledOperation&)> assembled;
  /// Called once recording has started; the recorder exists until the run has ended.
  std::function<void(AssembledOperation&, const replay::RecordingHeadset&)> recorded;
  /// Called once the room is open and before the first frame; an Error ends the run.
  std::function<Status(sim::SimHeadset&, const Method&, const Session&)> opened;
};

/// A whole operation in the simulated room, from camera frames to rods, and its evaluation. The
/// same case, options and seed give the same result, regardless of hooks. An Error means bad input;
/// an incomplete operation is a result with `completed` false, and one that a device or a thread
/// ended, which `loop.ended` says.
Result<OperationResult> run_operation(const Case& source, const OperationOptions& options,
                                      const OperationHooks& hooks = {});
/// The same with an operation already planned on this case, with its models prepared.
Result<OperationResult> run_operation(const Case& source, Operation planned,
                                      const OperationOptions& options,
                                      const OperationHooks& hooks = {});

}  // namespace orthonav::engine
