#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/case/operation.h"
#include "engine/session/workflow/workflow.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// What is to be registered.
struct RegistrationRequest {
  const nav::VertebraModel& model;
  std::span<const Point<World>> points_in_world;  ///< in order of time
  std::span<const nav::ScrewPlan> screws;         ///< where the pose must be precise; may be empty
  std::span<const NeighbouringLevel> neighbours;
  nav::CommonErrors common{};  ///< as far as known
  /// The pointer's shaft at each point, from the tip back, unit vectors; empty if unknown.
  std::span<const Vec3> shafts{};
  std::span<const Timestamp> times{};  ///< of each point; empty if unknown
  double tip_radius_m = 0.0;           ///< of a ball at the pointer's end; `paper` assumes a point
  /// SD over the bone by which the model differs from it, at least; `paper` asks for none.
  double least_model_sd_m = 0.0;
};
/// The request as options of a search over all poses, which borrow the neighbours' models.
[[nodiscard]] nav::PoseSearchRegistrationOptions options_of(const RegistrationRequest& request);

using Registrar = std::function<Result<nav::Registration>(const RegistrationRequest& request)>;

/// One way of tracking and registering, under its name in reports.
struct Method {
  std::string name;
  std::function<Result<std::unique_ptr<nav::ToolTracker>>(const StereoCalibration& calibration,
                                                          std::vector<nav::ToolGeometry> tools,
                                                          const nav::TrackerOptions& options)>
      create_tracker;
  Registrar registrar;
  Verification verification = Verification::kByTouch;
  /// Trial registrations of the strokes so far tell what to expect and what to stroke.
  bool coaching = false;
  /// Step `digitize` shows a picture of the strokes that the registration needs.
  bool shows_pattern = false;
  /// Its tracker gives the poses of single pairs, so World can be attached to a patient reference.
  bool anchors = false;
};

/// `paper`: the published method (Liebmann et al. 2019). `best`: tools by the photometric pose of
/// their tags (docs/tracking.md), and a search over all poses of the bone, which are judged
/// (docs/registration.md). Any other name is refused in one line that lists the valid ones.
Result<Method> method_named(const std::string& name);
/// Only the method's registration.
Result<Registrar> registrar_named(const std::string& name);

}  // namespace orthonav::engine
