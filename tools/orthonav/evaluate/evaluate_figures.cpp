#include "tools/orthonav/evaluate/evaluate_figures.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/io/json_writer.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

using nlohmann::ordered_json;

const char* grade_name(const nav::Clearance& clearance) {
  return nav::name_of(nav::grade_of(clearance.clearance_m));
}

void put_clearance(const engine::ScrewInScan& placed, const nav::ScrewPlan& plan,
                   ordered_json& out) {
  if (placed.clearance) {
    out["clearance_mm"] = placed.clearance->clearance_m * 1e3;
    out["grade"] = grade_name(*placed.clearance);
    for (const nav::PedicleGrade grade : engine::likely_grades(placed)) {
      out["likely_grades"].push_back(nav::name_of(grade));
    }
    out["nearest"] = nav::direction_of(*placed.clearance, plan.side);
    out["nearest_past_entry_mm"] = placed.clearance->arc_length_m * 1e3;
  }
  if (placed.spread) {
    out["clearance_95_mm"] = placed.spread->lower_95_m * 1e3;
    for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
      out["grade_probability"][nav::name_of(static_cast<nav::PedicleGrade>(g))] =
          placed.spread->grade_probability[g];
    }
  }
  if (placed.as_planned_screw) {
    out["planned_diameter_clearance_mm"] = placed.as_planned_screw->clearance_m * 1e3;
    out["planned_diameter_grade"] = grade_name(*placed.as_planned_screw);
  }
}

ordered_json as_json(const std::string& level, const engine::EvaluatedScrew& screw) {
  ordered_json out = {
      {"level", level}, {"side", name_of(screw.plan.side)}, {"found", screw.placed.has_value()}};
  if (!screw.placed) {
    return out;
  }
  const engine::ScrewInScan& placed = *screw.placed;
  const nav::ScrewCylinder& cylinder = placed.cylinder;
  out["angle_error_deg"] = placed.angle_rad * kDegreesPerRadian;
  out["angle_error_95_deg"] = k95 * placed.angle_sd_rad * kDegreesPerRadian;
  out["entry_error_mm"] = placed.entry_m * 1e3;
  out["entry_error_axis_mm"] = placed.entry_axis_m * 1e3;
  out["entry_error_axis_95_mm"] = k95 * placed.entry_axis_sd_m * 1e3;
  if (placed.tip_seen) {
    out["target_error_mm"] = placed.target_m * 1e3;
    out["depth_error_mm"] = placed.depth_m * 1e3;
  }
  out["diameter_mm"] = 2e3 * placed.measured_radius_m;
  out["judged_diameter_mm"] = 2e3 * cylinder.radius_m;
  out["bow_mm"] = placed.bow_m * 1e3;
  out["touches_other_metal"] = placed.touched;
  out["tip_seen"] = placed.tip_seen;
  put_clearance(placed, screw.plan, out);
  out["entry_mm"] = engine::vector_mm(cylinder.entry.v);
  if (placed.tip_seen) {
    out["tip_mm"] = engine::vector_mm((cylinder.entry + cylinder.length_m * cylinder.direction).v);
  }
  return out;
}

ordered_json as_json(const engine::EvaluatedLevel& level) {
  ordered_json out = {{"label", level.label}, {"registered", level.registration.has_value()}};
  if (!level.registration) {
    out["reason"] = level.refusal;
    return out;
  }
  out["residual_mm"] = level.registration->residual_m * 1e3;
  out["coverage"] = level.registration->coverage;
  out["scan_from_model"] = engine::rows_mm(level.registration->scan_from_vertebra.row_major());
  return out;
}

ordered_json as_json(const engine::UnassignedMetal& metal, const engine::Evaluation& evaluation) {
  ordered_json out = {{"kind", metal.shaft ? "shaft" : "other"},
                      {"where", metal.where},
                      {"place_mm", engine::vector_mm(metal.place.v)}};
  if (metal.shaft) {
    const engine::Shaft& shaft = evaluation.shafts[*metal.shaft];
    out["diameter_mm"] = 2e3 * shaft.radius_m;
    out["length_mm"] = shaft.length_m() * 1e3;
  } else {
    out["volume_mm3"] = metal.volume_m3 * 1e9;
  }
  return out;
}

/// A figure in mm that needs the tip.
std::string if_seen(const engine::ScrewInScan& placed, double value_m) {
  return placed.tip_seen ? printed("%.1f", value_m * 1e3) : "-";
}

void print(const std::string& level, const engine::EvaluatedScrew& screw) {
  print_text("%-4s %-5s  ", level.c_str(), name_of(screw.plan.side));
  if (!screw.placed) {
    print_text("%s\n", kNotFound);
    return;
  }
  const engine::ScrewInScan& placed = *screw.placed;
  print_text("%5.1f +- %-4.1f %6.1f %6.1f +- %-4.1f %6s %6s %6.1f  ",
             placed.angle_rad * kDegreesPerRadian, k95 * placed.angle_sd_rad * kDegreesPerRadian,
             placed.entry_m * 1e3, placed.entry_axis_m * 1e3, k95 * placed.entry_axis_sd_m * 1e3,
             if_seen(placed, placed.target_m).c_str(), if_seen(placed, placed.depth_m).c_str(),
             2e3 * placed.measured_radius_m);
  if (placed.clearance) {
    print_text(
        "%6.1f %6.1f  %s  %s", placed.clearance->clearance_m * 1e3,
        placed.spread ? placed.spread->lower_95_m * 1e3 : placed.clearance->clearance_m * 1e3,
        grade_text(placed).c_str(), nav::direction_of(*placed.clearance, screw.plan.side));
  } else {
    print_text("%s", kBarelyIn);
  }
  if (placed.as_planned_screw) {
    print_text("; as a %.1f mm screw %.1f mm, %s", 2e3 * screw.plan.radius_m,
               placed.as_planned_screw->clearance_m * 1e3, grade_name(*placed.as_planned_screw));
  }
  if (placed.touched) {
    print_text("; %s", kTouched);
  }
  if (!placed.tip_seen) {
    print_text("; %s", kTipNotSeen);
  }
  print_text("\n");
}

}  // namespace

std::string grade_text(const engine::ScrewInScan& screw) {
  std::string out;
  for (const nav::PedicleGrade grade : engine::likely_grades(screw)) {
    out += std::string(out.empty() ? "" : " or ") + nav::name_of(grade);
  }
  return out;
}

std::string text_of(const engine::UnassignedMetal& metal, const engine::Evaluation& evaluation) {
  const Vec3 p = metal.place.v * 1e3;
  const std::string place =
      printed("at (%.1f, %.1f, %.1f) mm in the scan: %s", p.x, p.y, p.z, metal.where.c_str());
  if (!metal.shaft) {
    return printed("metal of %.0f mm3 ", metal.volume_m3 * 1e9) + place;
  }
  const engine::Shaft& shaft = evaluation.shafts[*metal.shaft];
  return printed("shaft, %.1f mm thick, %.0f mm long, tip ", 2e3 * shaft.radius_m,
                 shaft.length_m() * 1e3) +
         place;
}

std::string slices_text(const engine::Evaluation& evaluation) {
  constexpr double kMaxMeasured_m = 0.002;  // docs/evaluation.md
  if (evaluation.slices_m <= kMaxMeasured_m + 1e-6) {
    return "";
  }
  const double mm = evaluation.slices_m * 1e3;
  return printed(
      "slices %.1f mm apart, tried up to %.1f mm: across them a tip is known to +-%.1f mm, and a "
      "breach below %.1f mm may not be seen",
      mm, kMaxMeasured_m * 1e3, 0.5 * mm, 0.5 * mm);
}

bool is_complete(const engine::Evaluation& evaluation) {
  return std::all_of(evaluation.levels.begin(), evaluation.levels.end(), [](const auto& level) {
    return level.registration.has_value() &&
           std::all_of(level.screws.begin(), level.screws.end(),
                       [](const auto& screw) { return screw.placed.has_value(); });
  });
}

void print_figures(const engine::Evaluation& evaluation) {
  print_text(
      "             angle        entry  entry (axis)  target  depth   dia-  clear-  95 %%\n");
  print_text(
      "screw        °            mm     mm            mm      mm      meter ance mm above   "
      "grade\n");
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    if (!level.registration) {
      print_text("%-4s not evaluated: %s\n", level.label.c_str(), level.refusal.c_str());
      continue;
    }
    for (const engine::EvaluatedScrew& screw : level.screws) {
      print(level.label, screw);
    }
  }
  for (const engine::UnassignedMetal& metal : evaluation.unassigned) {
    print_text("unassigned: %s\n", text_of(metal, evaluation).c_str());
  }
  if (const std::string slices = slices_text(evaluation); !slices.empty()) {
    print_text("%s\n", slices.c_str());
  }
  print_text("+-: 95 %% of the errors of this measurement are smaller. %s.\n%s\n",
             engine::kEvaluationDefinitions, nav::kPedicleScale);
}

ordered_json as_json(const engine::Evaluation& evaluation) {
  ordered_json out = {{"definitions", engine::kEvaluationDefinitions},
                      {"scale", nav::kPedicleScale},
                      {"levels", ordered_json::array()},
                      {"screws", ordered_json::array()},
                      {"unassigned", ordered_json::array()}};
  out["slices_mm"] = evaluation.slices_m * 1e3;
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    out["levels"].push_back(as_json(level));
    for (const engine::EvaluatedScrew& screw : level.screws) {
      out["screws"].push_back(as_json(level.label, screw));
    }
  }
  for (const engine::UnassignedMetal& metal : evaluation.unassigned) {
    out["unassigned"].push_back(as_json(metal, evaluation));
  }
  return out;
}

}  // namespace orthonav::tools
