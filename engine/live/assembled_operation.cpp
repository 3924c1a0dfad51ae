#include "engine/live/assembled_operation.h"

#include <utility>

#include "base/joined.h"
#include "engine/case/reference_levels.h"
#include "nav/tracking/tools_measured_elsewhere.h"

namespace orthonav::engine {

namespace {

/// Tools are found in the headset's images by the method, or measured by the headset itself.
Result<std::unique_ptr<nav::ToolTracker>> tracker_for(Headset& headset, const Method& method,
                                                      const std::vector<nav::ToolGeometry>& tools,
                                                      const nav::TrackerOptions& options) {
  if (const ToolPoseSource* const source = headset.tool_poses()) {
    return nav::create_tracker_of_poses(source->names(), tools);
  }
  if (headset.cameras() == nullptr) {
    return Error{headset.name() + " has no cameras, and measures no tools itself"};
  }
  return method.create_tracker(headset.cameras()->calibration(), tools, options);
}

}  // namespace

std::vector<std::string> AssemblyOptions::check() const {
  std::vector<std::string> problems;
  const auto add = [&](const char* where, const std::vector<std::string>& found) {
    for (const std::string& problem : found) {
      problems.push_back(where + problem);
    }
  };
  add("session: ", session.check());
  add("loop: ", loop.check());
  add("visibility: ", visibility.grades.check());
  return problems;
}

AssembledOperation::AssembledOperation(Headset& headset, std::unique_ptr<Session> session,
                                       const ErrorsInUse& errors, const VisibilityRules& visibility,
                                       const LoopOptions& loop)
    : session_(std::move(session)),
      errors_(errors),
      builder_(visibility),
      loop_(headset, *session_, builder_, loop) {
  session_->observe(&observers_);
}

void AssembledOperation::draw_into(SnapshotSink* sink) {
  if (sink != nullptr) {
    builder_.prepare(session_->levels());
  }
  loop_.draw_into(sink);
}

Result<std::unique_ptr<AssembledOperation>> assemble_operation(
    Headset& headset, Operation operation, const Method& method,
    const std::vector<nav::ToolGeometry>& tools, const AssemblyOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{joined(problems)};
  }
  auto tracker = tracker_for(headset, method, tools, options.tracker);
  if (!tracker) {
    return tracker.error();
  }
  const ErrorsInUse errors =
      errors_in_use(options.errors, {.measures_tools = headset.tool_poses() != nullptr,
                                     .patient_reference = options.use_reference});
  SessionOptions session_options = options.session;
  session_options.common = errors.common();
  session_options.map_drift_m_per_sqrt_s = errors.map_drift_m_per_sqrt_s.sd;
  if (options.use_reference) {
    if (!method.anchors) {
      return Error{"method '" + method.name + "': uses no patient reference"};
    }
    if (const Status near = check_references(operation, tools); !near) {
      return near.error();
    }
    tracker = nav::create_anchored_tracker(std::move(*tracker), options.tracker.coast,
                                           options.reference_places);
    if (!tracker) {
      return tracker.error();
    }
  }
  auto session =
      Session::create(std::move(operation), std::move(*tracker), method, session_options);
  if (!session) {
    return session.error();
  }
  VisibilityRules visibility = options.visibility;
  visibility.stroke_pattern = visibility.stroke_pattern || method.shows_pattern;
  return std::make_unique<AssembledOperation>(headset, std::move(*session), errors, visibility,
                                              options.loop);
}

}  // namespace orthonav::engine
