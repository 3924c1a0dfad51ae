#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/model_cache.h"
#include "engine/live/assembled_operation.h"
#include "engine/report/operation_result.h"
#include "engine/study/stated_navigation.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::replay {
class RecordingHeadset;
}

namespace orthonav::engine {

/// What the tools are tracked in.
enum class Measurement {
  kPixels,  ///< images of the room
  kModel    ///< no images: what they would tell, by a model fitted to them (measurement_model.h)
};

struct OperationOptions : AssemblyOptions {
  std::string method = "best";
  Measurement measurement = Measurement::kPixels;
  /// In place of the method: a published system's, in the measurement model.
  std::optional<StatedNavigation> navigation;
  std::vector<std::string> levels;  ///< empty: the two lowest of the case
  std::vector<nav::ToolGeometry> tools;
  sim::Exposure exposure = sim::Exposure::kLaminae;
  sim::SimOptions sim;
  /// In the measurement model: poses of `best` use the sizes of tags that were found in use.
  bool correct_tag_sizes = true;
  std::vector<std::string> left_out;  ///< by `leave_out` (left_out.h): of the method
  std::string record_folder;          ///< empty: nothing is recorded

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Who else takes part; all borrowed, all optional.
struct OperationHooks {
  std::vector<SessionObserver*> session;
  LoopObserver* loop = nullptr;
  SnapshotSink* sink = nullptr;
  ModelCache* models = nullptr;  ///< asked for prepared models; not told to keep any
  /// Receives, before the operation runs, a function that ends it early, from any thread; and null
  /// once it has ended.
  std::function<void(std::function<void()>)> can_stop;
  /// May replace parts of the method once the room is open.
  std::function<void(const sim::SimHeadset&, Method&)> adapt;
  /// The headset that the engine gets: one that forwards to the room's and is owned by whoever set
  /// this hook. Null: the room's own.
  std::function<Result<Headset*>(Headset&)> seen_through;
  /// Called once everything is put together, before `opened`; an Error ends the run.
  std::function<Status(AssembledOperation&)> assembled;
  /// Called once it is being recorded; the recorder lives until the run has ended.
  std::function<void(AssembledOperation&, const replay::RecordingHeadset&)> recorded;
  /// Called once the room is open and before the first frame; an Error ends the run.
  std::function<Status(sim::SimHeadset&, const Method&, const Session&)> opened;
};

/// A whole operation in the simulated room, from camera frames to rods, and its evaluation. The
/// same case, options and seed give the same result, whoever takes part. An Error means bad input;
/// an operation that did not reach its end is a result with `completed` false.
Result<OperationResult> run_operation(const Case& source, const OperationOptions& options,
                                      const OperationHooks& hooks = {});
/// The same with an operation that was planned on this case before, with its models prepared.
Result<OperationResult> run_operation(const Case& source, Operation planned,
                                      const OperationOptions& options,
                                      const OperationHooks& hooks = {});

}  // namespace orthonav::engine
