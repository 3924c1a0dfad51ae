#include "engine/session/journal.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal_lines.h"

namespace orthonav::engine {

// What was touched: check points, the landmark, screw heads.

void Journal::check_point_recorded(Timestamp time, const LevelState& level) {
  const nav::CheckPoint& point = level.check_points.back();
  JournalLine line = journal_line(file_ticks(time), time, "check point", level);
  line["number"] = level.check_points.size();
  line["in_world_mm"] = millimetres(point.place.v);
  line["distance_mm"] = point.distance_m * 1e3;
  line["within"] = point.within;
  add_line(*log_, line);
}

void Journal::check_point_dropped(Timestamp time, const LevelState& level) {
  JournalLine line = journal_line(file_ticks(time), time, "check point dropped", level);
  line["number"] = level.check_points.size() + 1;
  add_line(*log_, line);
}

void Journal::landmark_touched(Timestamp time, const LevelState& level,
                               const LandmarkTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "landmark", level);
  line["first"] = touch.first;
  if (touch.first) {
    line["in_vertebra_mm"] = millimetres(level.landmark->in_vertebra.v);
  } else {
    line["off_mm"] = touch.off_m * 1e3;
    line["within"] = touch.held();
  }
  line["limit_mm"] = touch.limit_m * 1e3;
  add_line(*log_, line, kDurable);
}

void Journal::tips_compared(Timestamp time, const TipDifference& difference) {
  JournalLine line = journal_line(file_ticks(time), time, "tips");
  line.update({{"apart_mm", difference.apart_m.norm() * 1e3},
               {"limit_mm", difference.limit_m * 1e3},
               {"by_mm", difference.by_m.norm() * 1e3},
               {"corrected", difference.corrected}});
  add_line(*log_, line, kDurable);
}

void Journal::axis_compared(Timestamp time, const AxisDifference& difference) {
  JournalLine line = journal_line(file_ticks(time), time, "axis");
  line.update({{"off_deg", degrees(difference.off_rad)},
               {"sd_deg", degrees(difference.sd_rad)},
               {"by_deg", degrees(difference.by_rad)},
               {"corrected", difference.corrected}});
  add_line(*log_, line, kDurable);
}

void Journal::landmark_dropped(Timestamp time, const LevelState& level) {
  JournalLine line = journal_line(file_ticks(time), time, "landmark dropped", level);
  add_line(*log_, line);
}

void Journal::head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "head");
  line["side"] = name_of(side);
  line["number"] = touch.head + 1;
  line["touches"] = touch.touches;
  line["in_world_mm"] = millimetres(touch.place.v);
  line["sd_mm"] = touch.head_sd_m * 1e3;
  add_line(*log_, line);
}

void Journal::head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "head dropped");
  line["side"] = name_of(side);
  line["number"] = touch.head + 1;
  line["touches"] = touch.touches - 1;
  add_line(*log_, line);
}

}  // namespace orthonav::engine
