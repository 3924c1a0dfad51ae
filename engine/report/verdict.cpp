#include "engine/report/verdict.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/how_many.h"
#include "engine/report/html_text.h"
#include "engine/report/report_limits.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

constexpr const char* kAgainstTruth = ", against the simulation\u2019s truth";

std::string of(std::size_t some, std::size_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

std::string limits_in_words() {
  return html_number(kOnTarget_m * 1e3, 0) + " mm and " + html_number(degrees(kOnTarget_rad), 0) +
         "\u00b0";
}

struct Counts {
  std::size_t screws = 0;
  std::size_t placed = 0;
  std::size_t known = 0;  ///< with a known truth
  std::size_t on_target = 0;
  std::size_t wires = 0;  ///< measured in the bone
  std::size_t wires_within = 0;
};

Counts counts_of(const json& report) {
  Counts n;
  for_each_screw(report, [&n](const json&, const std::string&, const json& screw) {
    const json& wire = object_in(screw, "wire");
    ++n.screws;
    n.placed += is_placed(screw) ? 1 : 0;
    n.known += has_truth(screw) ? 1 : 0;
    n.on_target += is_on_target(screw) ? 1 : 0;
    n.wires += wire.empty() ? 0 : 1;
    n.wires_within += is_true(wire, "within") ? 1 : 0;
  });
  return n;
}

/// How far the screws are from the plan, as far as known.
std::string accuracy_text(const Counts& n) {
  if (n.placed == 0) {
    return "";
  }
  if (n.known > 0) {
    const std::string where = n.known == n.placed ? "" : " measured";
    return "; " + of(n.on_target, n.known) + where + " within " + limits_in_words() +
           " of the plan" + kAgainstTruth;
  }
  const std::string unknown = "; their true distance from the plan is unknown";
  return n.wires == 0
             ? unknown
             : unknown + "; " + of(n.wires_within, n.wires) + " measured within the limits";
}

/// "2 rods templated; their lengths within 0.4 mm, against the simulation's truth".
std::string rods_text(const json& report) {
  std::size_t rods = 0;
  std::size_t known = 0;
  double worst_mm = 0.0;
  for (const json& rod : object_in(report, "rod").value("sides", json::array())) {
    const auto error_mm = value_of(rod, "length_error_mm");
    rods += value_of(rod, "length_mm") ? 1 : 0;
    known += error_mm ? 1 : 0;
    worst_mm = std::max(worst_mm, std::abs(error_mm.value_or(0.0)));
  }
  return how_many(rods, "rod") + " templated" +
         (known == 0 ? ""
                     : "; " + std::string(known == 1 ? "its length" : "their lengths") +
                           " within " + html_number(worst_mm, 1) + " mm" + kAgainstTruth) +
         ", without a registration.";
}

/// What is wrong with a screw according to the truth; empty if nothing is, or there is no truth.
std::string missed_text(const json& screw, const std::string& tool) {
  const auto clearance = value_of(screw, "clearance_mm");
  const auto angle = value_of(screw, "angle_error_deg");
  const auto entry = value_of(screw, "entry_error_mm");
  std::string text;
  if (clearance && *clearance < 0.0) {
    text = "breached the cortex by " + html_number(-*clearance, 1) + " mm (grade " +
           text_in(screw, "grade") + ")";
  }
  if (has_truth(screw) && !is_on_target(screw)) {
    text += std::string(text.empty() ? "" : "; ") +
            (entry ? html_number_beside(*angle, degrees(kOnTarget_rad), 1) + "\u00b0 and " +
                         html_number_beside(*entry, kOnTarget_m * 1e3, 1) + " mm from the plan"
                   : "the " + tool + " missed the bone");
  }
  return text.empty() ? "" : text + kAgainstTruth;
}

std::string wire_warning(const json& screw, const std::string& tool) {
  if (text_in(screw, "wire") == "not measured") {
    return is_placed(screw) ? "the " + tool + " was not measured" : "";
  }
  const json& wire = object_in(screw, "wire");
  const auto angle = value_of(wire, "angle_deg");
  const auto entry = value_of(wire, "entry_mm");
  if (wire.empty() || is_true(wire, "within") || !angle || !entry) {
    return "";
  }
  return "the " + tool + " was measured " + html_number(*angle, 1) + "\u00b0 and " +
         html_number(*entry, 1) + " mm from the plan, beyond a limit" +
         (is_true(wire, "kept") ? ", and kept" : "");
}

std::string planned_warning(const json& screw, const std::string& /*tool*/) {
  const std::string reason = text_in(object_in(screw, "planned"), "accepted_breach");
  return reason.empty() ? "" : "planned to leave the cortex: " + reason;
}

/// One line for all screws, since it says the same of each.
std::vector<std::string> bound_warning(const json& report) {
  std::string names;
  std::string bounds;
  for_each_screw(report, [&](const json&, const std::string& name, const json& screw) {
    const auto bound = value_of(object_in(screw, "tracked"), "clearance_95_mm");
    if (bound && *bound < 0.0) {
      names += (names.empty() ? "" : ", ") + name;
      bounds += (bounds.empty() ? "" : ", ") + html_number(*bound, 1);
    }
  });
  if (names.empty()) {
    return {};
  }
  return {names + ": as tracked, a breach of the cortex cannot be ruled out (95 % bound " + bounds +
          " mm)"};
}

template <class Warning>
void add_of_screws(const json& report, Warning warning, std::vector<std::string>& out) {
  for_each_screw(report, [&](const json&, const std::string& name, const json& screw) {
    if (const std::string text = warning(screw, placed_tool(report)); !text.empty()) {
      out.push_back(name + ": " + text);
    }
  });
}

/// By severity: first from the truth, then from measurements, then from the plan.
std::vector<std::string> warnings_of(const json& report) {
  std::vector<std::string> out;
  add_of_screws(report, missed_text, out);
  add_of_screws(report, wire_warning, out);
  const std::vector<std::string> bound = bound_warning(report);
  out.insert(out.end(), bound.begin(), bound.end());
  add_of_screws(report, planned_warning, out);
  return out;
}

}  // namespace

bool is_placed(const json& screw) {
  return screw.contains("done") ? is_true(screw, "done") : has_truth(screw);
}

bool has_truth(const json& screw) { return value_of(screw, "angle_error_deg").has_value(); }

bool is_on_target(const json& screw) {
  const auto angle = value_of(screw, "angle_error_deg");
  const auto entry = value_of(screw, "entry_error_mm");
  return angle && entry && *angle <= degrees(kOnTarget_rad) && *entry <= kOnTarget_m * 1e3;
}

Verdict verdict_of(const json& report) {
  Verdict out;
  out.warnings = warnings_of(report);
  const bool completed = is_true(report, "completed");
  const std::string why = text_in(report, "why_not");
  out.kind = !completed             ? Verdict::Kind::kIncomplete
             : out.warnings.empty() ? Verdict::Kind::kDone
                                    : Verdict::Kind::kDoneWithWarnings;
  out.line = completed ? "Operation completed" : "Operation incomplete";
  if (!out.warnings.empty()) {
    out.line += " with " + how_many(out.warnings.size(), "warning");
  }
  const Counts n = counts_of(report);
  if (!completed && !why.empty()) {
    out.line += " (" + why + ")";
  }
  out.counts = std::to_string(n.placed) + " of " + how_many(n.screws, "screw") + " placed" +
               accuracy_text(n) + ".";
  if (is_of_rods_alone(report)) {
    out.counts = rods_text(report);
  }
  out.line += ": " + out.counts;
  return out;
}

const char* style_of(const Verdict& verdict) {
  switch (verdict.kind) {
    case Verdict::Kind::kDone:
      return "done";
    case Verdict::Kind::kDoneWithWarnings:
      return "warned";
    case Verdict::Kind::kIncomplete:
      break;
  }
  return "incomplete";
}

std::string warnings_list(const Verdict& verdict) {
  std::string items;
  for (const std::string& warning : verdict.warnings) {
    items += "<li>" + html_escaped(warning) + "</li>";
  }
  return items.empty() ? "" : "<ul>" + items + "</ul>";
}

std::string verdict_section(const json& report) {
  const Verdict verdict = verdict_of(report);
  return "<section id=verdict class=" + std::string(style_of(verdict)) + "><h2>" +
         html_escaped(verdict.line) + "</h2>" + warnings_list(verdict) + "</section>";
}

}  // namespace orthonav::engine
