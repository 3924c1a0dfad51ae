#include "tools/orthonav/shared/plan_figures.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/case/screw_breach.h"
#include "engine/io/json_writer.h"
#include "nav/guidance/changed_screw.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

nlohmann::ordered_json as_json(const JudgedScrew& screw) {
  nlohmann::ordered_json out = {{"side", name_of(screw.plan.side)},
                                {"length_mm", nav::screw_length_m(screw.plan) * 1e3},
                                {"entry_mm", engine::vector_mm(screw.plan.entry.v)},
                                {"target_mm", engine::vector_mm(screw.plan.target.v)},
                                {"listed", screw.listed}};
  if (screw.plan.radius_m > 0.0) {
    out["diameter_mm"] = 2e3 * screw.plan.radius_m;
  }
  if (screw.clearance) {
    out["clearance_mm"] = screw.clearance->clearance_m * 1e3;
    out["grade"] = nav::name_of(nav::grade_of(screw.clearance->clearance_m));
    out["nearest"] = nav::direction_of(*screw.clearance, screw.plan.side);
    out["nearest_past_entry_mm"] = screw.clearance->arc_length_m * 1e3;
  }
  if (screw.found) {
    out["room_mm"] = screw.found->room_m * 1e3;
    out["convergence_deg"] = screw.found->convergence_rad * kDegreesPerRadian;
    out["cranial_deg"] = screw.found->cranial_rad * kDegreesPerRadian;
    out["before_far_cortex_mm"] = screw.found->before_front_m * 1e3;
  }
  if (!screw.plan.accepted_breach.empty()) {
    out["accept_breach"] = screw.plan.accepted_breach;
  }
  return out;
}

void print(const std::string& label, const JudgedScrew& screw) {
  const double length_mm = nav::screw_length_m(screw.plan) * 1e3;
  print_text("%s %-5s  ", label.c_str(), name_of(screw.plan.side));
  if (!screw.clearance) {
    print_text("length %.1f mm, no diameter stated: clearance not measured\n", length_mm);
    return;
  }
  const nav::Clearance& least = *screw.clearance;
  print_text("%.1f x %.1f mm  clearance %s mm (%s, %.0f mm past the entry)  grade %s",
             2e3 * screw.plan.radius_m, length_mm,
             engine::clearance_text(least.clearance_m).c_str(),
             nav::direction_of(least, screw.plan.side), least.arc_length_m * 1e3,
             nav::name_of(nav::grade_of(least.clearance_m)));
  if (screw.found) {
    const double cranial_deg = screw.found->cranial_rad * kDegreesPerRadian;
    print_text("  converges %.0f°, %s %.0f°, tip %.0f mm before the far cortex",
               screw.found->convergence_rad * kDegreesPerRadian,
               cranial_deg < 0.0 ? "caudal" : "cranial", std::abs(cranial_deg),
               screw.found->before_front_m * 1e3);
  }
  print_text("%s%s\n", screw.listed ? "" : "  (size not in the list)",
             screw.plan.accepted_breach.empty()
                 ? ""
                 : ("  accepted: " + screw.plan.accepted_breach).c_str());
}

}  // namespace

bool JudgedScrew::breaks_through() const {
  return clearance && clearance->clearance_m < 0.0 && plan.accepted_breach.empty();
}

std::string breach_text(const std::string& label, const JudgedScrew& screw) {
  return label + " " + name_of(screw.plan.side) + ": breaks through the cortex: clearance " +
         beside_limit("%.1f mm, limit %.1f mm", screw.clearance->clearance_m * 1e3, 0.0);
}

JudgedScrew judged(const nav::SurfaceIndex& bone, const nav::ScrewPlan& screw,
                   const engine::ScrewSizes& sizes) {
  const double length_m = nav::screw_length_m(screw);
  JudgedScrew out;
  out.plan = screw;
  if (const auto cylinder = nav::cylinder_of(screw)) {
    out.clearance = nav::least_clearance(bone, *cylinder);
  }
  out.listed =
      screw.radius_m > 0.0 ? sizes.has(2.0 * screw.radius_m, length_m) : sizes.has_length(length_m);
  return out;
}

JudgedLevel judged(const engine::CaseLevel& level, const engine::ScrewSizes& sizes) {
  const nav::SurfaceIndex bone(level.mesh);
  JudgedLevel out{level.label, {}, {}};
  for (const nav::ScrewPlan& screw : level.screws) {
    out.screws.push_back(judged(bone, screw, sizes));
  }
  return out;
}

void print(const std::vector<JudgedLevel>& levels) {
  for (const JudgedLevel& level : levels) {
    for (const JudgedScrew& screw : level.screws) {
      print(level.label, screw);
    }
  }
  print_text("%s\n", nav::kPedicleScale);
}

void print_written(const std::string& folder, const engine::Case& subject,
                   const engine::ScrewSizes& sizes) {
  print_text("wrote %s\n", folder.c_str());
  std::vector<JudgedLevel> levels;
  for (const engine::CaseLevel& level : subject.levels) {
    levels.push_back(judged(level, sizes));
  }
  print(levels);
}

nlohmann::ordered_json as_json(const std::vector<JudgedLevel>& levels) {
  nlohmann::ordered_json out = {{"scale", nav::kPedicleScale},
                                {"levels", nlohmann::ordered_json::array()}};
  for (const JudgedLevel& level : levels) {
    nlohmann::ordered_json entry = {{"label", level.label},
                                    {"screws", nlohmann::ordered_json::array()}};
    for (const JudgedScrew& screw : level.screws) {
      entry["screws"].push_back(as_json(screw));
    }
    for (const RefusedSide& refused : level.refused) {
      entry["refused"].push_back({{"side", name_of(refused.side)}, {"reason", refused.reason}});
    }
    out["levels"].push_back(std::move(entry));
  }
  return out;
}

}  // namespace orthonav::tools
