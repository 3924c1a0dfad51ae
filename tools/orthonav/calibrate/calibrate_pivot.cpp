#include <memory>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/io/json_writer.h"
#include "nav/tracking/pivot.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/calibrate/calibrate_movement.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

struct PivotArguments {
  MovementArguments movement;
  double inlier_mm = 1e3 * nav::PivotOptions{}.inlier_m;
};

void add_pivot(const Result<nav::PivotCalibration>& found, nlohmann::ordered_json& out) {
  if (!found) {
    return add_judgement({nav::Verdict::kFail, found.error().message}, out);
  }
  out["inliers"] = found->inliers;
  out["tip_mm"] = engine::vector_mm(found->tip_in_marker.v);
  out["tip_sigma_mm"] = found->tip_sigma_m * 1e3;
  out["leave_out_mm"] = found->leave_out_m * 1e3;
  out["independent_poses"] = found->independent_poses;
  out["rmse_mm"] = found->rmse_m * 1e3;
  out["spread_deg"] = found->spread_rad * kDegreesPerRadian;
  add_judgement(found->judgement, out);
}

void print(const std::string& tool, const nav::PivotCalibration& found) {
  const Vec3 tip_mm = found.tip_in_marker.v * 1e3;
  print_text("%s%stip %.3f %.3f %.3f mm, known to %.3f mm\n", tool.c_str(),
             tool.empty() ? "" : ": ", tip_mm.x, tip_mm.y, tip_mm.z, found.tip_sigma_m * 1e3);
  print_text(
      "%zu of %zu poses agree, like %.0f uncorrelated ones, residual %.3f mm RMS, turned by %.1f° "
      "RMS\n",
      found.inliers, found.poses, found.independent_poses, found.rmse_m * 1e3,
      found.spread_rad * kDegreesPerRadian);
  print_judgement(found.judgement);
}

int run_pivot(const PivotArguments& arguments) {
  const auto movement = movement_of(arguments.movement);
  if (!movement) {
    return bad_input(movement.error().message);
  }
  nav::PivotOptions options;
  options.inlier_m = arguments.inlier_mm * 1e-3;
  const auto found = nav::pivot_calibration(movement->poses, options);
  if (found) {
    const Status written =
        write_change(arguments.movement, {.tip_in_marker = found->tip_in_marker});
    if (!written) {
      return bad_input(written.error().message);
    }
  }
  nlohmann::ordered_json json = movement_json(arguments.movement, *movement);
  add_pivot(found, json);
  if (const Status s = arguments.movement.json.write(json); !s) {
    return bad_input(s.error().message);
  }
  if (!found) {
    return refused(found.error().message);
  }
  if (!arguments.movement.json.on_stdout()) {
    print(arguments.movement.tool, *found);
  }
  return kDone;
}

constexpr const char* kPivotFooter =
    "\nSet the tip into a small hollow, record, and lean the tool all around the tip, 15° and "
    "more\n"
    "to every side, for half a minute. tip_sigma_mm: 3-D SD of the tip, from residuals, their\n"
    "correlation over time and the turning, or from leaving out each tenth of the poses, "
    "whichever\n"
    "is larger. independent_poses: so many uncorrelated poses would locate the pivot as well.\n"
    "spread_deg: RMS turning in the direction that fixes the tip worst. Exit code 1: refused,\n"
    "nothing written.";

}  // namespace

void add_calibrate_pivot(CLI::App& calibrate, Action& action) {
  auto arguments = std::make_shared<PivotArguments>();
  CLI::App* command =
      calibrate.add_subcommand("pivot", "The tip of a tool from a recording of it pivoting");
  arguments->movement.needs_tool = false;
  arguments->movement.add_to(*command, "the new tip");
  command
      ->add_option("--inlier-mm", arguments->inlier_mm,
                   "A pose whose tip misses the pivot by more is left out; where poses scatter "
                   "less, the limit follows them")
      ->check(finite_number(0.1, 50))
      ->capture_default_str();
  command->footer(std::string(kPivotFooter) + kOtherPosesFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_pivot(*arguments); }; });
}

}  // namespace orthonav::tools
