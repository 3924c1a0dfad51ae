// Screws and wires in computed post-operative scans, found again: errors against the truth, and
// grades.
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/stopwatch.h"
#include "engine/case/case_file.h"
#include "engine/evaluation/evaluation.h"
#include "tests/support/operated_spine.h"
#include "tests/support/voxelised_scan.h"

namespace {

using namespace orthonav;

struct Arguments {
  int scans = 50;
  std::uint64_t seed = 1;
  std::vector<double> slices_mm{0.6, 1.0, 2.0};
  std::vector<std::string> cases{"visible-human", "shape-mean", "morph-a", "morph-b"};
  double streaks = 1.0;
  double bow_mm = 0.0;
  double missing = 0.0;
  bool wires = false;
  bool rods = false;
  bool each = false;
};

struct Errors {
  std::vector<double> angle_deg, axis_mm, tip_mm, entry_mm, depth_mm, diameter_mm, clearance_mm;
  std::vector<double> bone_mm, bone_deg;
  std::vector<double> angle_sds, clearance_sds;  ///< errors by the SDs that were stated
  int screws = 0, missed = 0, invented = 0, refused_levels = 0, failed_scans = 0;
  int grades = 0, right_grades = 0, lower_held = 0, angle_held = 0, unassigned = 0, not_placed = 0,
      touched = 0;
  double seconds = 0.0;
};

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
  char text[80];
  std::snprintf(text, sizeof text, "%7.3f %7.3f %7.3f", at(0.5), at(0.95), v.back());
  return text;
}

/// Wilson's interval at 95 %.
std::string share(int k, int n) {
  if (n == 0) {
    return "-";
  }
  const double z = 1.96, p = double(k) / n, d = 1.0 + z * z / n;
  const double middle = (p + z * z / (2.0 * n)) / d;
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4.0 * n * n)) / d;
  char text[80];
  std::snprintf(text, sizeof text, "%d of %d = %.1f %% (%.1f to %.1f)", k, n, 1e2 * p,
                1e2 * (middle - half), 1e2 * (middle + half));
  return text;
}

double off_axis_m(Vec3 p, const nav::ScrewCylinder& axis) {
  return (p - axis.entry.v).cross(axis.direction).norm();
}

void add(const test::TrueScrew& truth, const engine::EvaluatedScrew& found,
         const nav::SurfaceIndex& bone, const Arguments& arguments, Errors& errors) {
  if (!truth.placed) {
    ++errors.not_placed;
    errors.invented += found.placed ? 1 : 0;
    return;
  }
  ++errors.screws;
  if (!found.placed) {
    ++errors.missed;
    if (arguments.each) {
      const Vec3 planned = found.plan.target - found.plan.entry;
      const Vec3 way = truth.tip_m - truth.entry_m;
      std::printf("    %zu/%zu missed: truly %.1f deg and %.1f mm off, %.1f mm deep\n", truth.level,
                  truth.screw, angle_between_rad(planned, way) * kDegreesPerRadian,
                  1e3 * (truth.entry_m - found.plan.entry.v).norm(), 1e3 * way.norm());
    }
    return;
  }
  const engine::ScrewInScan& placed = *found.placed;
  errors.touched += placed.touched ? 1 : 0;
  const Vec3 direction = (truth.tip_m - truth.entry_m).normalized();
  const double angle = angle_between_rad(direction, placed.cylinder.direction);
  errors.angle_deg.push_back(angle * kDegreesPerRadian);
  errors.axis_mm.push_back(1e3 * off_axis_m(truth.entry_m, placed.cylinder));
  errors.tip_mm.push_back(1e3 * off_axis_m(truth.tip_m, placed.cylinder));
  errors.entry_mm.push_back(1e3 * (truth.entry_m - placed.cylinder.entry.v).norm());
  errors.depth_mm.push_back(1e3 *
                            (placed.cylinder.length_m - (truth.tip_m - truth.entry_m).norm()));
  errors.diameter_mm.push_back(2e3 * (placed.measured_radius_m - truth.radius_m));
  const double true_plan_angle = angle_between_rad(direction, found.plan.target - found.plan.entry);
  errors.angle_held +=
      std::abs(true_plan_angle - placed.angle_rad) <= 1.96 * placed.angle_sd_rad ? 1 : 0;
  if (placed.angle_sd_rad > 0.0) {
    errors.angle_sds.push_back((true_plan_angle - placed.angle_rad) / placed.angle_sd_rad);
  }
  const auto clearance = nav::least_clearance(
      bone, {{truth.entry_m}, direction, (truth.tip_m - truth.entry_m).norm(), truth.radius_m});
  if (clearance && placed.clearance) {
    errors.clearance_mm.push_back(1e3 * (placed.clearance->clearance_m - clearance->clearance_m));
    if (placed.spread) {
      errors.clearance_sds.push_back(1.645 *
                                     (clearance->clearance_m - placed.clearance->clearance_m) /
                                     (placed.clearance->clearance_m - placed.spread->lower_95_m));
    }
    ++errors.grades;
    errors.right_grades +=
        nav::grade_of(placed.clearance->clearance_m) == nav::grade_of(clearance->clearance_m) ? 1
                                                                                              : 0;
    errors.lower_held +=
        placed.spread && clearance->clearance_m >= placed.spread->lower_95_m ? 1 : 0;
  }
  if (arguments.each) {
    std::printf(
        "    %zu/%zu angle %.2f deg axis %.2f tip %.2f entry %.2f depth %+.2f dia %+.2f "
        "clr %+.2f (true %+.2f)%s\n",
        truth.level, truth.screw, errors.angle_deg.back(), errors.axis_mm.back(),
        errors.tip_mm.back(), errors.entry_mm.back(), errors.depth_mm.back(),
        errors.diameter_mm.back(), errors.clearance_mm.empty() ? 0.0 : errors.clearance_mm.back(),
        clearance ? 1e3 * clearance->clearance_m : 0.0, placed.touched ? " touched" : "");
  }
}

void compare(const test::OperatedSpine& spine, const engine::Case& subject,
             const engine::Evaluation& found, const Arguments& arguments, Errors& errors) {
  for (std::size_t l = 0; l < found.levels.size(); ++l) {
    const engine::EvaluatedLevel& level = found.levels[l];
    if (!level.registration) {
      ++errors.refused_levels;
      std::printf("  %s refused: %s\n", level.label.c_str(), level.refusal.c_str());
    } else {
      const test::Motion& truth = spine.bones[l].scanner_from_model;
      const auto& pose = level.registration->scan_from_vertebra;
      errors.bone_mm.push_back(1e3 * (pose.translation() - truth.translation_m).norm());
      errors.bone_deg.push_back(rotation_angle_rad(pose.rotation(), truth.rotation) *
                                kDegreesPerRadian);
      if (arguments.each) {
        std::printf("  %s bone %.3f mm %.3f deg, residual %.2f mm, coverage %.2f\n",
                    level.label.c_str(), errors.bone_mm.back(), errors.bone_deg.back(),
                    level.registration->residual_m * 1e3, level.registration->coverage);
      }
    }
    const nav::SurfaceIndex bone(subject.levels[l].mesh);
    for (const test::TrueScrew& truth : spine.screws) {
      if (truth.level == l) {
        add(truth, level.screws[truth.screw], bone, arguments, errors);
      }
    }
  }
  for (const engine::UnassignedMetal& metal : found.unassigned) {
    if (arguments.each) {
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
      "%d of %d missing ones invented, %d pieces unassigned, %d touched by others, %.2f s a "
      "scan\n",
      slice_mm, e.screws, e.missed, e.refused_levels, e.failed_scans, e.invented, e.not_placed,
      e.unassigned, e.touched, e.seconds);
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
  std::printf("  grades right        %s\n", share(e.right_grades, e.grades).c_str());
  std::printf("  above lower 95      %s\n", share(e.lower_held, e.grades).c_str());
  std::printf("  angle within 95     %s\n",
              share(e.angle_held, static_cast<int>(e.angle_deg.size())).c_str());
}

/// Two levels one above the other of one of the cases.
engine::Case two_levels(const std::vector<engine::Case>& cases, Random& random) {
  const engine::Case& from =
      cases[static_cast<std::size_t>(random.uniform() * static_cast<double>(cases.size()))];
  const auto first =
      static_cast<std::size_t>(random.uniform() * static_cast<double>(from.levels.size() - 1));
  return {from.name, from.folder, {from.levels[first], from.levels[first + 1]}};
}

std::vector<test::PlannedVertebra> vertebrae_of(const engine::Case& subject) {
  std::vector<test::PlannedVertebra> out;
  for (const engine::CaseLevel& level : subject.levels) {
    out.push_back(
        {level.label,
         level.mesh,
         level.screws,
         {level.spine_from_vertebra.rotation(), level.spine_from_vertebra.translation()}});
  }
  return out;
}

int run(const Arguments& arguments) {
  std::vector<engine::Case> cases;
  for (const std::string& name : arguments.cases) {
    auto loaded = engine::load_case(std::string(ORTHONAV_SHARED_DIR) + "/anatomy/" + name);
    if (!loaded) {
      std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
      return 2;
    }
    cases.push_back(std::move(*loaded));
  }
  test::OperationSettings settings;
  settings.wires = arguments.wires;
  settings.bow_m = arguments.bow_mm * 1e-3;
  settings.rods = arguments.rods;
  settings.missing = arguments.missing;
  std::vector<Errors> all(arguments.slices_mm.size());
  for (int n = 0; n < arguments.scans; ++n) {
    Random random(arguments.seed + static_cast<std::uint64_t>(n));
    const engine::Case subject = two_levels(cases, random);
    const auto spine = test::operated(vertebrae_of(subject), settings, random.fork("operation"));
    test::BodySettings body_settings;
    body_settings.seed = random.next();
    const test::FineBody body = test::fine_body(spine.bones, spine.metal, body_settings);
    for (std::size_t i = 0; i < all.size(); ++i) {
      test::ScannerSettings scanner;
      scanner.spacing_m.z = arguments.slices_mm[i] * 1e-3;
      scanner.streaks = arguments.streaks;
      scanner.seed = random.next();
      const engine::Volume scan = test::scanned(body, scanner);
      const Stopwatch watch;
      const auto found = engine::evaluate(subject, scan);
      all[i].seconds += watch.elapsed_ms() * 1e-3 / arguments.scans;
      if (arguments.each) {
        std::printf("seed %llu, %s %s, %.1f mm\n",
                    static_cast<unsigned long long>(arguments.seed) + static_cast<unsigned>(n),
                    subject.name.c_str(), subject.levels[0].label.c_str(), arguments.slices_mm[i]);
      }
      if (!found) {
        std::printf("seed %d refused: %s\n", n, found.error().message.c_str());
        ++all[i].failed_scans;
        for (const test::TrueScrew& screw : spine.screws) {
          all[i].screws += screw.placed ? 1 : 0;
          all[i].missed += screw.placed ? 1 : 0;
        }
        continue;
      }
      compare(spine, subject, *found, arguments, all[i]);
      std::fflush(stdout);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    print(all[i], arguments.slices_mm[i]);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Errors of orthonav evaluate on computed scans of the shared anatomy");
  app.add_option("--scans", arguments.scans, "operations, two vertebrae and four screws each");
  app.add_option("--seed", arguments.seed, "of the first");
  app.add_option("--slices-mm", arguments.slices_mm)->delimiter(',');
  app.add_option("--cases", arguments.cases)->delimiter(',');
  app.add_option("--streaks", arguments.streaks);
  app.add_option("--bow-mm", arguments.bow_mm, "of wires");
  app.add_option("--missing", arguments.missing, "share of screws that are not there");
  app.add_flag("--wires", arguments.wires);
  app.add_flag("--rods", arguments.rods);
  app.add_flag("--each", arguments.each, "a line for each screw");
  CLI11_PARSE(app, argc, argv);
  return run(arguments);
}
