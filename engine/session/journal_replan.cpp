#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal.h"
#include "engine/session/journal_lines.h"
#include "engine/session/replan_wording.h"

namespace orthonav::engine {
namespace {

JournalLine plan_in_mm(const nav::ScrewPlan& screw) {
  JournalLine out{{"entry_mm", millimetres(screw.entry.v)},
                  {"target_mm", millimetres(screw.target.v)},
                  {"diameter_mm", 2.0 * screw.radius_m * 1e3}};
  if (!screw.accepted_breach.empty()) {
    out["accepted_breach"] = screw.accepted_breach;
  }
  return out;
}

}  // namespace

/// The plan made in surgery, and how it differs from the preoperative one.
void Journal::replanned(Timestamp time, const LevelState& level, const Replan& asked,
                        const ScrewReplanned& done) {
  JournalLine line = journal_line(file_ticks(time), time, "replanned", level);
  line["side"] = name_of(done.to.side);
  line["asked"] = text_of(asked);
  line["undone"] = done.undone;
  line["from"] = plan_in_mm(done.from);
  line["to"] = plan_in_mm(done.to);
  if (done.clearance_m) {
    line["clearance_mm"] = *done.clearance_m * 1e3;
  }
  if (!done.as_before_surgery) {
    line["planned_in_surgery"] = difference_line(done.difference);
  }
  add_line(*log_, line, kDurable);
}

JournalLine difference_line(const nav::ScrewDifference& d) {
  return JournalLine{{"entry_cranial_mm", d.entry_cranial_m * 1e3},
                     {"entry_medial_mm", d.entry_medial_m * 1e3},
                     {"entry_inward_mm", d.entry_inward_m * 1e3},
                     {"aim_cranial_deg", degrees(d.aim_cranial_rad)},
                     {"aim_medial_deg", degrees(d.aim_medial_rad)},
                     {"diameter_from_mm", d.diameter_from_m * 1e3},
                     {"diameter_to_mm", d.diameter_to_m * 1e3},
                     {"length_from_mm", d.length_from_m * 1e3},
                     {"length_to_mm", d.length_to_m * 1e3}};
}

}  // namespace orthonav::engine
