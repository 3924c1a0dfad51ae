#include "bench/evaluation_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/angle.h"
#include "base/printed.h"
#include "bench/wilson.h"

namespace orthonav {
namespace {

/// Median, 95 % and largest of the magnitudes.
std::string quantiles(std::vector<double> v) {
  if (v.empty()) {
    return "-";
  }
  for (double& x : v) {
    x = std::abs(x);
  }
  std::sort(v.begin(), v.end());
  const auto at = [&](double p) {
    return v[std::min(v.size() - 1, static_cast<std::size_t>(p * static_cast<double>(v.size())))];
  };
  return printed("%7.3f %7.3f %7.3f", at(0.5), at(0.95), v.back());
}

/// With Wilson's interval.
std::string fraction(int k, int n) {
  if (n == 0) {
    return "-";
  }
  const FractionInterval interval = wilson(k, static_cast<std::size_t>(n));
  return printed("%d of %d = %.1f %% (%.1f to %.1f)", k, n, 1e2 * (double(k) / n),
                 1e2 * interval.low, 1e2 * interval.high);
}

double off_axis_m(Vec3 p, const nav::ScrewCylinder& axis) {
  return (p - axis.entry.v).cross(axis.direction).norm();
}

void print_missed(const test::TrueScrew& truth, const nav::ScrewPlan& plan) {
  const Vec3 way = truth.tip_m - truth.entry_m;
  std::printf("    %zu/%zu missed: truly %.1f deg and %.1f mm off, %.1f mm deep\n", truth.level,
              truth.screw, angle_between_rad(plan.target - plan.entry, way) * kDegreesPerRadian,
              1e3 * (truth.entry_m - plan.entry.v).norm(), 1e3 * way.norm());
}

void add_axis(const test::TrueScrew& truth, const nav::ScrewPlan& plan,
              const engine::ScrewInScan& placed, Errors& errors) {
  const Vec3 way = truth.tip_m - truth.entry_m;
  errors.angle_deg.push_back(angle_between_rad(way.normalized(), placed.cylinder.direction) *
                             kDegreesPerRadian);
  errors.axis_mm.push_back(1e3 * off_axis_m(truth.entry_m, placed.cylinder));
  errors.tip_mm.push_back(1e3 * off_axis_m(truth.tip_m, placed.cylinder));
  errors.entry_mm.push_back(1e3 * (truth.entry_m - placed.cylinder.entry.v).norm());
  if (placed.tip_seen) {
    errors.depth_mm.push_back(1e3 * (placed.cylinder.length_m - way.norm()));
  }
  errors.diameter_mm.push_back(2e3 * (placed.measured_radius_m - truth.radius_m));
  const double angle_rad = angle_between_rad(way.normalized(), plan.target - plan.entry);
  errors.angle_held += std::abs(angle_rad - placed.angle_rad) <= 1.96 * placed.angle_sd_rad ? 1 : 0;
  if (placed.angle_sd_rad > 0.0) {
    errors.angle_sds.push_back((angle_rad - placed.angle_rad) / placed.angle_sd_rad);
  }
}

void add_clearance(double true_m, const engine::ScrewInScan& placed, Errors& errors) {
  const double clearance_m = placed.clearance->clearance_m;
  errors.clearance_mm.push_back(1e3 * (clearance_m - true_m));
  ++errors.grades;
  const bool right = nav::grade_of(clearance_m) == nav::grade_of(true_m);
  const bool firm = engine::likely_grades(placed).size() == 1;
  errors.right_grades += right ? 1 : 0;
  errors.firm_grades += firm ? 1 : 0;
  errors.right_firm_grades += firm && right ? 1 : 0;
  if (placed.spread) {
    const double lower_m = placed.spread->lower_95_m;
    errors.clearance_sds.push_back(1.645 * (true_m - clearance_m) / (clearance_m - lower_m));
    errors.lower_held += true_m >= lower_m ? 1 : 0;
  }
}

void add(const test::TrueScrew& truth, const engine::EvaluatedScrew& found,
         const nav::SurfaceIndex& bone, bool each, Errors& errors) {
  if (!truth.placed) {
    ++errors.not_placed;
    errors.invented += found.placed ? 1 : 0;
    return;
  }
  ++errors.screws;
  if (!found.placed) {
    ++errors.missed;
    if (each) {
      print_missed(truth, found.plan);
    }
    return;
  }
  errors.touched += found.placed->touched ? 1 : 0;
  errors.unseen_tips += found.placed->tip_seen ? 0 : 1;
  add_axis(truth, found.plan, *found.placed, errors);
  const Vec3 way = truth.tip_m - truth.entry_m;
  const auto clearance =
      nav::least_clearance(bone, {{truth.entry_m}, way.normalized(), way.norm(), truth.radius_m});
  if (clearance && found.placed->clearance) {
    add_clearance(clearance->clearance_m, *found.placed, errors);
  }
  if (each) {
    std::printf(
        "    %zu/%zu angle %.2f deg axis %.2f tip %.2f entry %.2f depth %+.2f dia %+.2f "
        "clr %+.2f (true %+.2f)%s%s\n",
        truth.level, truth.screw, errors.angle_deg.back(), errors.axis_mm.back(),
        errors.tip_mm.back(), errors.entry_mm.back(),
        1e3 * (found.placed->cylinder.length_m - way.norm()), errors.diameter_mm.back(),
        errors.clearance_mm.empty() ? 0.0 : errors.clearance_mm.back(),
        clearance ? 1e3 * clearance->clearance_m : 0.0, found.placed->touched ? " touched" : "",
        found.placed->tip_seen ? "" : " tip not seen");
  }
}

void add_bone(const test::Motion& truth, const engine::EvaluatedLevel& level, bool each,
              Errors& errors) {
  if (!level.registration) {
    ++errors.refused_levels;
    std::printf("  %s refused: %s\n", level.label.c_str(), level.refusal.c_str());
    return;
  }
  const auto& pose = level.registration->scan_from_vertebra;
  errors.bone_mm.push_back(1e3 * (pose.translation() - truth.translation_m).norm());
  errors.bone_deg.push_back(rotation_angle_rad(pose.rotation(), truth.rotation) *
                            kDegreesPerRadian);
  if (each) {
    std::printf("  %s bone %.3f mm %.3f deg, residual %.2f mm, coverage %.2f\n",
                level.label.c_str(), errors.bone_mm.back(), errors.bone_deg.back(),
                level.registration->residual_m * 1e3, level.registration->coverage);
  }
}

}  // namespace

void compare(const test::OperatedSpine& spine, const engine::Case& subject,
             const engine::Evaluation& found, bool each, Errors& errors) {
  for (std::size_t l = 0; l < found.levels.size(); ++l) {
    const engine::EvaluatedLevel& level = found.levels[l];
    add_bone(spine.bones[l].scanner_from_model, level, each, errors);
    const nav::SurfaceIndex bone(subject.levels[l].mesh);
    for (const test::TrueScrew& truth : spine.screws) {
      if (truth.level == l) {
        add(truth, level.screws[truth.screw], bone, each, errors);
      }
    }
  }
  for (const engine::UnassignedMetal& metal : found.unassigned) {
    if (each) {
      const engine::Shaft* const shaft = metal.shaft ? &found.shafts[*metal.shaft] : nullptr;
      std::printf("  unassigned %s, %.1f mm thick, %.1f mm long, %.0f mm3\n", metal.where.c_str(),
                  shaft != nullptr ? 2e3 * shaft->radius_m : 0.0,
                  shaft != nullptr ? 1e3 * shaft->length_m() : 0.0, metal.volume_m3 * 1e9);
    }
  }
  errors.unassigned += static_cast<int>(found.unassigned.size());
}

void print(const Errors& e, double slice_mm) {
  std::printf(
      "slices of %.1f mm: %d screws, %d not found, %d levels and %d scans refused, "
      "%d of %d missing ones invented, %d pieces unassigned, %d touch others, %d tips not seen, "
      "%.2f s a scan\n",
      slice_mm, e.screws, e.missed, e.refused_levels, e.failed_scans, e.invented, e.not_placed,
      e.unassigned, e.touched, e.unseen_tips, e.seconds);
  std::printf("                       median    95 %%    most   (n = %zu)\n", e.angle_deg.size());
  std::printf("  axis angle, deg     %s\n", quantiles(e.angle_deg).c_str());
  std::printf("  axis at entry, mm   %s\n", quantiles(e.axis_mm).c_str());
  std::printf("  axis at tip, mm     %s\n", quantiles(e.tip_mm).c_str());
  std::printf("  entry on bone, mm   %s\n", quantiles(e.entry_mm).c_str());
  std::printf("  depth, mm           %s\n", quantiles(e.depth_mm).c_str());
  std::printf("  diameter, mm        %s\n", quantiles(e.diameter_mm).c_str());
  std::printf("  clearance, mm       %s\n", quantiles(e.clearance_mm).c_str());
  std::printf("  bone, mm            %s\n", quantiles(e.bone_mm).c_str());
  std::printf("  bone, deg           %s\n", quantiles(e.bone_deg).c_str());
  std::printf("  angle, stated SDs   %s\n", quantiles(e.angle_sds).c_str());
  std::printf("  clearance, SDs      %s\n", quantiles(e.clearance_sds).c_str());
  std::printf("  grades right        %s\n", fraction(e.right_grades, e.grades).c_str());
  std::printf("  firm grades right   %s\n", fraction(e.right_firm_grades, e.firm_grades).c_str());
  std::printf("  above lower 95      %s\n", fraction(e.lower_held, e.grades).c_str());
  std::printf("  angle within 95     %s\n",
              fraction(e.angle_held, static_cast<int>(e.angle_deg.size())).c_str());
}

}  // namespace orthonav
