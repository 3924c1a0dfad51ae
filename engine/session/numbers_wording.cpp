#include "engine/session/numbers_wording.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/findings_wording.h"

namespace orthonav::engine {
namespace {

bool is_angle(NumberRow row) {
  return row == NumberRow::kAimCranial || row == NumberRow::kAimMedial;
}

std::string_view direction_of(NumberRow row, int tenths) {
  const bool along_spine = row == NumberRow::kTipCranial || row == NumberRow::kAimCranial;
  if (along_spine) {
    return tenths > 0 ? translated("cranial") : translated("caudal");
  }
  return tenths > 0 ? translated("medial") : translated("lateral");
}

void append_tenths(std::string& out, int tenths) { append_printed(out, "%.1f", 0.1 * tenths); }

/// Nothing for a number that is sure.
void append_sd(std::string& out, bool sure, std::optional<int> sd_tenths) {
  if (sure) {
    return;
  }
  out += " ± ";
  if (sd_tenths) {
    append_tenths(out, *sd_tenths);
  } else {
    out += "--";
  }
}

void append_single(std::string& out, int tenths, nav::Certainty certainty, const char* bound,
                   const char* unit) {
  out += certainty == nav::Certainty::kBound ? bound : "";
  append_tenths(out, tenths);
  out += unit;
  out += certainty == nav::Certainty::kUnknown ? "?" : "";
}

/// Where a screw breaks through, by nav::direction_of.
const char* adverb_of(std::string_view towards) {
  constexpr std::array<std::array<const char*, 2>, 7> kAdverbs = {
      {{"tip", translatable("at its tip")},
       {"medial", translatable("medially")},
       {"lateral", translatable("laterally")},
       {"cranial", translatable("cranially")},
       {"caudal", translatable("caudally")},
       {translatable("anterior"), translatable("anteriorly")},
       {translatable("posterior"), translatable("posteriorly")}}};
  for (const auto& [direction, adverb] : kAdverbs) {
    if (towards == direction) {
      return translated(adverb);
    }
  }
  return "--";
}

}  // namespace

const nav::ShownNumber& number_of(const nav::ScrewNumbers& numbers, NumberRow row) {
  const std::array<const nav::ShownNumber*, kNumberRows> all = {
      &numbers.tip_cranial, &numbers.tip_medial, &numbers.aim_cranial, &numbers.aim_medial};
  return *all[static_cast<std::size_t>(row)];
}

void append_number(std::string& out, const nav::ScrewNumbers& numbers, NumberRow row) {
  const nav::ShownNumber& number = number_of(numbers, row);
  append_tenths(out, std::abs(number.tenths));
  append_sd(out, number.sure, number.sd_tenths);
  out += is_angle(row) ? "°" : " mm";
  if (number.tenths != 0) {
    out.append(" ").append(direction_of(row, number.tenths));
  }
}

void append_depth(std::string& out, const nav::ShownDepth& depth) {
  constexpr std::array<const char*, 3> kTo = {words::kToEntry, words::kToTarget,
                                              words::kPastTarget};
  const bool past = depth.to == nav::DepthTo::kPastTarget;
  append_single(out, depth.tenths, depth.certainty, past ? "≤ " : "≥ ", " mm");
  out.append(" ").append(translated(kTo[static_cast<std::size_t>(depth.to)]));
}

void append_angle(std::string& out, const nav::ShownSize& angle) {
  append_single(out, angle.tenths, angle.certainty, "≤ ", "°");
}

void append_offset(std::string& out, const nav::ShownSize& offset) {
  out.append(translated(words::kTip)).append(" ");
  append_single(out, offset.tenths, offset.certainty, "≤ ", " mm");
}

void append_rounded_mm(std::string& out, double length_m) {
  append_printed(out, "%.0f mm", length_m * 1e3);
}

void append_clearance(std::string& out, int tenths) {
  out += tenths < 0 ? "−" : "";
  append_tenths(out, std::abs(tenths));
  out += " mm";
}

void append_breach(std::string& out, const nav::ShownClearance& clearance) {
  append_printed(out,
                 clearance.least_tenths < 0 ? translated("breaks through %s")
                                            : translated("may break through %s"),
                 adverb_of(clearance.towards));
}

void append_clearance_line(std::string& out, const nav::ShownClearance& clearance,
                           bool registration_only) {
  out.append(translated(words::kClearance)).append(" ");
  append_clearance(out, clearance.least_tenths);
  if (clearance.may_break()) {
    out += ": ";
    append_breach(out, clearance);
    // A breach follows from the measured clearance; "may" refers to the bound.
    registration_only = registration_only && clearance.least_tenths >= 0;
  } else if (clearance.lower_95_tenths) {
    out.append(", ").append(translated(words::kAtLeast)).append(" ");
    append_clearance(out, *clearance.lower_95_tenths);
  }
  if (registration_only && clearance.lower_95_tenths) {
    append_registration_only(out);
  }
}

bool stop_too_deep(const nav::DrillView& drill) {
  constexpr double kLeastPast_m = 0.0001;
  return drill.stop_past_target_m && *drill.stop_past_target_m >= kLeastPast_m;
}

void append_stop_too_deep(std::string& out, double past_target_m) {
  append_printed(out, translated("stop lets the drill %.0f mm past the target"),
                 std::ceil(past_target_m * 1e3));
}

void append_drill(std::string& out, const nav::DrillView& drill) {
  out += drill.alarm == nav::DrillAlarm::kStop ? translated("stop") : translated("drilling");
  if (!drill.watched) {
    out.append(", ").append(translated("tool not seen"));
  }
}

bool all_sure(const nav::ScrewNumbers& numbers) {
  return numbers.tip_cranial.sure && numbers.tip_medial.sure && numbers.aim_cranial.sure &&
         numbers.aim_medial.sure;
}

}  // namespace orthonav::engine
