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

/// A bend of the rod in hand, from 1, as stroked.
JournalLine measured_json(const nav::MeasuredBend& found, std::size_t number) {
  return JournalLine{{"bend", number},
                     {"angle_deg", degrees(found.arc.angle_rad)},
                     {"angle_se_deg", degrees(found.angle_se_rad)},
                     {"roll_deg", degrees(found.arc.roll_rad)},
                     {"roll_se_deg", degrees(found.roll_se_rad)},
                     {"rms_mm", found.rms_m * 1e3}};
}

}  // namespace

void Journal::rod_bend_measured(Timestamp time, const RodState& rod) {
  JournalLine line = journal_line(file_ticks(time), time, "rod bend");
  line["side"] = name_of(rod.side);
  line.update(measured_json(rod.measured.back().found, rod.measured.size()));
  put_instructions(line, rod);
  add_line(*log_, line);
}

void Journal::rod_bend_dropped(Timestamp time, const RodState& rod) {
  JournalLine line = journal_line(file_ticks(time), time, "rod bend dropped");
  line["side"] = name_of(rod.side);
  line["bend"] = rod.measured.size() + 1;
  add_line(*log_, line);
}

void Journal::rod_given_up(Timestamp time, const RodState& rod, std::string_view why) {
  JournalLine line = journal_line(file_ticks(time), time, "rod given up");
  line["side"] = name_of(rod.side);
  line["reason"] = why;
  add_line(*log_, line);
}

void Journal::rod_kept(Timestamp time, const RodState& rod) {
  JournalLine line = journal_line(file_ticks(time), time, "rod kept");
  line["side"] = name_of(rod.side);
  add_line(*log_, line);
}

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
  for (std::size_t k = 0; k < rod.measured.size(); ++k) {
    line["measured"].push_back(measured_json(rod.measured[k].found, k + 1));
  }
  add_line(*log_, line, kDurable);
}

}  // namespace orthonav::engine
