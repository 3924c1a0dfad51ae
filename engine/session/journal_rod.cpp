// The journal's lines about rods.

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal.h"
#include "engine/session/journal_lines.h"

namespace orthonav::engine {
namespace {

/// The instructions to bend the rod, or why there are none.
void put_instructions(JournalLine& line, const RodState& rod) {
  if (!rod.no_instructions.empty()) {
    line["no_instructions"] = rod.no_instructions;
  }
  if (!rod.instructions) {
    return;
  }
  line["cut_length_mm"] = rod.instructions->cut_length_m() * 1e3;
  if (rod.seat_by_pointer_m) {
    line["seat_by_pointer_mm"] = *rod.seat_by_pointer_m * 1e3;
  }
  JournalLine instructions = JournalLine::array();
  for (const nav::RodInstruction& bend : rod.instructions->bends) {
    instructions.push_back(JournalLine{{"arc_length_mm", bend.arc.centre_m * 1e3},
                                       {"roll_deg", degrees(bend.arc.roll_rad)},
                                       {"angle_deg", degrees(bend.arc.angle_rad)},
                                       {"set_deg", degrees(bend.set_rad)}});
  }
  line["instructions"] = instructions;
}

/// How sure the touched heads are, and what is expected of the rod.
void put_certainty(JournalLine& line, const RodState& rod) {
  JournalLine touched = JournalLine::array();
  for (std::size_t head = 0; head < rod.touched.heads(); ++head) {
    touched.push_back(JournalLine{{"touches", rod.touched.touches_of(head)},
                                  {"sd_mm", rod.touched.sd_m(head) * 1e3}});
  }
  line["touched"] = touched;
  if (rod.expected) {
    line["expected_within_share"] = rod.expected->within;
  }
}

}  // namespace

void Journal::rod_done(Timestamp time, const RodState& rod) {
  JournalLine line = journal_line(file_ticks(time), time, "rod");
  line["side"] = name_of(rod.side);
  line["heads"] = rod.heads.size();
  if (rod.rod) {
    line["length_mm"] = rod.rod->length_m * 1e3;
    JournalLine bends = JournalLine::array();
    for (const nav::RodBend& bend : rod.rod->bends) {
      bends.push_back(JournalLine{{"arc_length_mm", bend.arc_length_m * 1e3},
                                  {"angle_deg", degrees(bend.angle_rad)}});
    }
    line["bends"] = bends;
  }
  if (rod.took_s) {
    line["time_s"] = *rod.took_s;
  }
  put_instructions(line, rod);
  put_certainty(line, rod);
  add_line(*log_, line, kDurable);
}

}  // namespace orthonav::engine
