#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/time.h"
#include "engine/session/landmark.h"
#include "engine/session/method_steps.h"
#include "engine/session/placed_wire.h"
#include "engine/session/replan_limits.h"
#include "engine/session/tip_check.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/rod_bends.h"
#include "nav/registration/check_points.h"

namespace orthonav::engine {

struct SessionOptions {
  /// Guidance on a pose older than this is hidden, never frozen.
  Duration stale_after = std::chrono::milliseconds(100);
  /// A phrase understood less surely than this is not acted upon: a wrong "accept" is worse than
  /// one said twice.
  double min_voice_confidence = 0.5;
  double rod_diameter_m = 0.0055;
  double head_to_seat_m = nav::RodSeating{}.head_to_seat_m;
  /// Its own diameter is `rod_diameter_m`.
  nav::RodBending rod_bending;
  /// A screw head or a check point whose tips scatter more than this over one click (root mean
  /// square about their mean) was not touched at rest. Noise and tremor at the end of a 130 mm
  /// lever already make up to 2.5 mm over three pairs in the simulated room; a moving tip makes 5
  /// mm and more.
  double max_touch_spread_m = 0.003;
  MethodSteps steps;  ///< where the eye alone verifies: none
  nav::CheckPointRules check_points;
  LandmarkRules landmark;
  TipCheckRules tips;
  nav::DrillLimits drill;
  PlacedWireRules placed;
  ReplanLimits replan;
  /// What is known of errors that all strokes share; without, the errors that are expected are
  /// those of the registration alone, and called so.
  nav::CommonErrors common;
  /// Random walk of World against the patient, SD along an axis after one second, m/√s; what it
  /// makes of the time that passes is added to the errors in common. 0: not known.
  double map_drift_m_per_sqrt_s = 0.0;
  /// The clearance to the cortex along the tool is computed in every pair in which it is guided:
  /// about a millisecond. Without, only of what was measured at depth.
  bool live_clearance = true;
  /// A message to the surgeon goes by itself after so long.
  Duration message_for = std::chrono::seconds(3);
  /// What was heard stays on the status line for so long.
  Duration heard_for = std::chrono::seconds(2);
  /// A deleted path fades for so long.
  Duration fade = std::chrono::milliseconds(300);

  /// SD along an axis by which the map moved against the mean of places that were spread evenly
  /// over so long, until now.
  [[nodiscard]] double drift_since_m(Duration spread) const;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
