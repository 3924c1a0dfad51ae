#include "engine/holograms/visibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/translation.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "engine/session/coach.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {

namespace {

/// The tip of a tool at the screw is this near to the planned screw, anywhere between entry and
/// target.
constexpr double kAtScrew_m = 0.040;

std::optional<PlacedLevel> placed(const LevelState& level) {
  if (!level.registration) {
    return std::nullopt;
  }
  return PlacedLevel{&level, level.registration->world_from_vertebra};
}

/// The level's placement, if it may be guided on.
std::optional<PlacedLevel> usable(const LevelState& level) {
  return level.usable() ? placed(level) : std::nullopt;
}

/// H4 depends on the registration alone, so it stays when the tool is lost.
std::optional<PlacedScrew> selected_screw(const Guidance& g) {
  const auto level = g.level < g.levels.size() ? usable(g.levels[g.level]) : std::nullopt;
  if (!level || g.screw >= level->level->plan.screws.size()) {
    return std::nullopt;
  }
  return PlacedScrew{*level, g.screw};
}

/// The worst first; of what is equally bad, the most urgent.
ToolVerdict judged(const Visibility& visible, const nav::DrillView& drill,
                   const VisibilityRules& rules) {
  const GradeLimits& limits = rules.grades;
  ToolVerdict verdict{Grade::kGood, Worst::kNothing};
  const auto count = [&](Grade grade, Worst of) {
    if (grade > verdict.grade || (grade == verdict.grade && grade != Grade::kGood)) {
      verdict = {grade, of};
    }
  };
  if (visible.measurement != nullptr && !rules.cross_and_depth) {
    count(grade_of(visible.measurement->angle_rad, limits), Worst::kAngle);
    return verdict;
  }
  if (visible.measurement == nullptr || visible.sizes == nullptr) {
    // A merely predicted tool has no number and is never shown as good.
    count(std::max(grade_of(visible.triangle->angle_rad, limits), Grade::kFair), Worst::kCertainty);
    return verdict;
  }
  const auto unsure = [](nav::Certainty certainty) { return certainty != nav::Certainty::kSure; };
  if (unsure(visible.sizes->angle.certainty) || unsure(visible.sizes->offset.certainty) ||
      (visible.depth != nullptr && unsure(visible.depth->certainty))) {
    count(Grade::kFair, Worst::kCertainty);
  }
  count(grade_of(visible.measurement->angle_rad, limits), Worst::kAngle);
  count(grade_of_offset(visible.measurement->tip_off_axis_m, limits), Worst::kOffset);
  if (drill.phase == nav::DrillPhase::kDrilling && drill.alarm == nav::DrillAlarm::kRed) {
    // Its limits may be narrower than those of the colours.
    const bool angle = verdict.worst == Worst::kAngle;
    count(Grade::kPoor, angle ? Worst::kAngle : Worst::kOffset);
  }
  if (visible.clearance != nullptr && visible.clearance->may_break()) {
    count(visible.clearance->least_tenths < 0 ? Grade::kPoor : Grade::kFair, Worst::kClearance);
  }
  const bool past = visible.depth != nullptr && visible.depth->to == nav::DepthTo::kPastTarget;
  if (past || drill.alarm == nav::DrillAlarm::kStop) {
    count(Grade::kPoor, Worst::kDepth);
  }
  return verdict;
}

/// Whether the guide is set, or about to be; before that it is on its way to the entry. As
/// published, only its distance from the screw counts. A drill that runs off the axis keeps its
/// alarm.
bool at_screw(const nav::ScrewGuidance& tool, const nav::DrillView& drill,
              const VisibilityRules& rules) {
  const double along_m = tool.depth_m < 0.0       ? -tool.depth_m
                         : tool.to_target_m < 0.0 ? -tool.to_target_m
                                                  : 0.0;
  const bool beside = tool.tip_off_axis_m > kOffTheScrew_m && rules.cross_and_depth &&
                      drill.phase != nav::DrillPhase::kDrilling;
  return std::hypot(tool.tip_off_axis_m, along_m) <= kAtScrew_m && !beside;
}

/// Step `guide`: what tells the tool from the plan, on a pose younger than the limit at the display
/// time. A frozen triangle is worse than none.
void decide_guide(const Guidance& g, const VisibilityRules& rules, Timestamp display_time,
                  Visibility& out) {
  const ToolGuidance* fresh =
      g.tool && display_time - g.tool->pose_time <= g.stale_after ? &*g.tool : nullptr;
  // A frame shown so late that its pose is too old is as unwatched as a pair without one.
  out.drill = fresh ? g.drill : g.drill.unwatched();
  // H5, H6, H9, H13.
  if (fresh) {
    const nav::ScrewGuidance* measured = fresh->measured ? &*fresh->measured : nullptr;
    const nav::ScrewGuidance& where = measured ? *measured : fresh->shown;
    if (at_screw(where, out.drill, rules)) {
      out.triangle = &fresh->shown;
      out.measurement = measured;
      if (rules.cross_and_depth) {
        out.sizes = measured && fresh->sizes ? &*fresh->sizes : nullptr;
        out.depth = measured && fresh->depth ? &*fresh->depth : nullptr;
        out.clearance = measured && fresh->shown_clearance ? &*fresh->shown_clearance : nullptr;
        out.numbers = g.asked.numbers && measured && fresh->numbers ? &*fresh->numbers : nullptr;
      }
      out.pose_time = fresh->pose_time;
      out.verdict = judged(out, out.drill, rules);
    } else if (measured && rules.cross_and_depth) {
      out.approach = VisibleApproach{fresh->shown.tip, measured->tip_to_entry_m};
      out.pose_time = fresh->pose_time;
    }
  }
  // A lost value is shown as lost in place of the number, never as the last or a predicted number.
  out.angle_lost = !out.measurement && (out.triangle || !fresh);
  // The status line says which screw it is; on the way there its name stands at its entry.
  out.entry_labels = out.approach.has_value() || !rules.cross_and_depth;
  out.only_selected_named = rules.cross_and_depth;
  // H7: while the tool is at the screw, or is lost, once it is known where the eyes are. Its dots
  // are numbers in another shape: they come from one stereo pair, never from a prediction.
  if (g.head && rules.cross_and_depth) {
    out.cross_side = clear_side_of(*out.trajectory, *g.head, out.cross_side);
    if (out.triangle || !fresh) {
      out.cross = VisibleCross{*g.head, out.cross_side, out.measurement, !fresh, std::nullopt};
    }
  }
  // H8: only where the surgeon asked for it, since it takes their eyes off the patient.
  out.twin = g.asked.twin;
}

}  // namespace

void decide_visibility(const Guidance& g, const VisibilityRules& rules, Timestamp display_time,
                       Visibility& out) {
  std::vector<PlacedLevel> entries = std::move(out.entries_of);  // keeps its buffer
  entries.clear();
  const LabelSide cross_side = out.cross_side;
  out = {};
  out.entries_of = std::move(entries);
  out.cross_side = cross_side;
  if (g.blank || (g.anchor != nullptr && g.anchor->stale(display_time, g.stale_after))) {
    return;
  }
  const LevelState* level = g.level < g.levels.size() ? &g.levels[g.level] : nullptr;
  if (g.step != Step::kDone) {
    out.level = level;
  }
  // H3: entry points of everything that may be guided on, never faded by distance, until the rod
  // takes their place. An unaccepted registration shows none: an entry point on display reads as
  // "drill here".
  if (g.step != Step::kRod) {
    for (const LevelState& each : g.levels) {
      if (const auto there = usable(each)) {
        out.entries_of.push_back(*there);
      }
    }
  }
  switch (g.step) {
    case Step::kDigitize:
      out.paths = true;
      out.stroke_pattern = rules.stroke_pattern && g.head && level != nullptr;
      if (const auto* strokes = std::get_if<StrokesSoFar>(&g.status.state);
          strokes != nullptr && strokes->coaching != nullptr && !strokes->coaching->enough) {
        out.stroke_next = strokes->coaching->stroke_at;
      }
      break;
    case Step::kRegistering:
      out.paths = true;
      break;
    case Step::kVerify:
      // H1: the surgeon still compares the paths with the hologram; after acceptance they would
      // only cover the bone.
      out.paths = true;
      // H2, H12: only the level that is to be verified; gone with a rejected registration.
      out.vertebra = level != nullptr ? placed(*level) : std::nullopt;
      break;
    case Step::kTouchLandmark:
      out.entry_labels = true;
      if (const auto there = level != nullptr ? usable(*level) : std::nullopt;
          there && level->landmark) {
        out.landmark = there->world_from_vertebra * level->landmark->in_vertebra;
      }
      break;
    case Step::kGuide:
      out.trajectory = selected_screw(g);
      if (out.trajectory) {
        decide_guide(g, rules, display_time, out);
      }
      break;
    case Step::kMeasureWire:
      out.trajectory = selected_screw(g);
      // The measurement of a wire in the bone is as old as its registration, not as a pose.
      out.wire = out.trajectory ? g.wire : nullptr;
      break;
    case Step::kRod:
      out.rods = true;
      break;
    case Step::kDone:
      out.entry_labels = true;
      out.rods = true;
      break;
    default:
      break;
  }
}

}  // namespace orthonav::engine
