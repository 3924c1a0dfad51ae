#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/time.h"
#include "engine/session/placed_wire.h"
#include "engine/session/replan.h"
#include "engine/session/workflow/workflow.h"
#include "nav/guidance/rod_bends.h"
#include "nav/registration/check_points.h"

namespace orthonav::engine {

/// How far a drill or wire goes astray from the tool that guides it: SD of its direction about each
/// direction across, from its own bending and from the hand that turns while it drills, and SD
/// along each direction across of where it starts.
struct DrillSkiving {
  double direction_rad = 0.016;  ///< a drill in a sleeve 0.008, a corrected hand 0.014
  double start_m = 0.0004;       ///< it skives

  [[nodiscard]] std::vector<std::string> check() const;
};

struct SessionOptions {
  /// Guidance on a pose older than this is hidden, never frozen.
  Duration stale_after = std::chrono::milliseconds(100);
  double rod_diameter_m = 0.0055;
  double head_to_seat_m = nav::RodSeating{}.head_to_seat_m;
  /// If the tips scatter more than this over one click (root mean square about their mean), a screw
  /// head or check point was not touched at rest. Noise and tremor at the end of a 130 mm lever
  /// already cause up to 2.5 mm over three pairs in the simulated room; a moving tip causes 5 mm
  /// and more.
  double max_touch_spread_m = 0.003;
  MethodSteps steps;  ///< none if verification is by eye alone
  nav::CheckPointRules check_points;
  PlacedWireRules placed;
  ReplanLimits replan;
  /// What is known of the errors common to all strokes; without it, expected errors are those of
  /// the registration alone, and labelled so.
  nav::CommonErrors common;
  /// Random walk of World against the patient, SD along an axis after one second, m/√s; its growth
  /// over time is added to the common errors. 0: not known.
  double map_drift_m_per_sqrt_s = 0.0;
  /// Counts in the bounds of clearance.
  DrillSkiving astray;
  /// The clearance to the cortex along the tool is computed in every pair in which the tool is
  /// guided, which takes about a millisecond. Otherwise, only for the measurement at depth.
  bool live_clearance = true;
  /// A message to the surgeon disappears after this time.
  Duration message_for = std::chrono::seconds(3);
  /// The phrase heard stays on the status line for this time.
  Duration heard_for = std::chrono::seconds(2);
  /// A deleted path fades over this time.
  Duration fade = std::chrono::milliseconds(300);

  /// Of a rod of `rod_diameter_m`.
  [[nodiscard]] nav::RodBending bending() const;
  /// SD along an axis of the map's movement until now relative to the mean of places that were
  /// spread evenly over this time.
  [[nodiscard]] double drift_since_m(Duration spread) const;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
