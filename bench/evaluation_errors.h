#pragma once

#include <vector>

#include "engine/evaluation/evaluation.h"
#include "tests/support/operated_spine.h"

namespace orthonav {

/// Errors of evaluations against the truth, of all scans with slices of one thickness.
struct Errors {
  std::vector<double> angle_deg, axis_mm, tip_mm, entry_mm, depth_mm, diameter_mm, clearance_mm;
  std::vector<double> bone_mm, bone_deg;
  std::vector<double> angle_sds, clearance_sds;  ///< errors divided by the stated SDs
  int screws = 0, missed = 0, invented = 0, refused_levels = 0, failed_scans = 0;
  int grades = 0, right_grades = 0, firm_grades = 0, right_firm_grades = 0, lower_held = 0,
      angle_held = 0, unassigned = 0, not_placed = 0, touched = 0, unseen_tips = 0;
  double seconds = 0.0;
};

/// Adds the errors of one scan; `each` prints a line for each vertebra, screw and piece of metal.
void compare(const test::OperatedSpine& spine, const engine::Case& subject,
             const engine::Evaluation& found, bool each, Errors& errors);

/// Prints a table.
void print(const Errors& errors, double slice_mm);

}  // namespace orthonav
