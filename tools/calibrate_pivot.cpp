#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "nav/tracking/pivot.h"
#include "tools/arguments.h"
#include "tools/calibrate.h"
#include "tools/json_output.h"
#include "tools/print_text.h"
#include "tools/recorded_pairs.h"

namespace orthonav::tools {
namespace {

struct PivotArguments {
  std::string recording;
  std::string tools_file;
  std::string tool;
  std::string method = default_method();
  std::string out;
  double inlier_mm = 1e3 * nav::PivotOptions{}.inlier_m;
  JsonOutput json;
};

nlohmann::ordered_json vector_mm(Vec3 v_m) { return {v_m.x * 1e3, v_m.y * 1e3, v_m.z * 1e3}; }

nlohmann::ordered_json pivot_json(const PivotArguments& arguments, const MeasuredPoses& seen,
                                  const Result<nav::PivotCalibration>& found) {
  nlohmann::ordered_json out = {{"tool", arguments.tool},
                                {"method", arguments.method},
                                {"pairs", seen.pairs},
                                {"poses", seen.world_from_marker.size()}};
  if (found) {
    out["inliers"] = found->inliers;
    out["tip_mm"] = vector_mm(found->tip_in_marker.v);
    out["tip_sigma_mm"] = found->tip_sigma_m * 1e3;
    out["leave_out_mm"] = found->leave_out_m * 1e3;
    out["rmse_mm"] = found->rmse_m * 1e3;
    out["spread_deg"] = found->spread_rad * kDegreesPerRadian;
    add_judgement(found->judgement, out);
  } else {
    add_judgement({nav::Verdict::kFail, found.error().message}, out);
  }
  return out;
}

void print(const PivotArguments& arguments, const nav::PivotCalibration& found) {
  const Vec3 tip_mm = found.tip_in_marker.v * 1e3;
  print_text("%s: tip %.3f %.3f %.3f mm, known to %.3f mm\n", arguments.tool.c_str(), tip_mm.x,
             tip_mm.y, tip_mm.z, found.tip_sigma_m * 1e3);
  print_text("%zu of %zu poses agree, residual %.3f mm RMS, turned by %.1f° RMS\n", found.inliers,
             found.poses, found.rmse_m * 1e3, found.spread_rad * kDegreesPerRadian);
  print_judgement(found.judgement);
}

/// The tool's description, after making sure that the results can be written: that must be known
/// before the work.
Result<nav::ToolGeometry> checked_tool(const PivotArguments& arguments) {
  const auto tools = engine::load_tools(arguments.tools_file);
  if (!tools) {
    return tools.error();
  }
  const auto tool = engine::tool_named(*tools, arguments.tool);
  if (!tool) {
    return Error{arguments.tools_file + ": " + tool.error().message};
  }
  if (const Status s = arguments.json.check(); !s) {
    return s.error();
  }
  if (!arguments.out.empty()) {
    if (auto place = engine::AtomicFile::create(arguments.out); !place) {
      return place.error();
    }
  }
  return *tool;
}

Status write_tip(const PivotArguments& arguments, Point<Marker> tip_in_marker) {
  const auto changed =
      engine::changed_tools(arguments.tools_file, arguments.tool, {.tip_in_marker = tip_in_marker});
  if (!changed) {
    return changed.error();
  }
  return engine::write_file(arguments.out, *changed);
}

int run_pivot(const PivotArguments& arguments) {
  const auto tool = checked_tool(arguments);
  if (!tool) {
    return bad_input(tool.error().message);
  }
  const auto seen = measured_poses(arguments.recording, arguments.method, *tool);
  if (!seen) {
    return bad_input(seen.error().message);
  }
  std::vector<Transform<World, Marker>> poses;
  for (const nav::TrackedPose& pose : seen->world_from_marker) {
    poses.push_back(pose.value);
  }

  nav::PivotOptions options;
  options.inlier_m = arguments.inlier_mm * 1e-3;
  const auto found = nav::pivot_calibration(poses, options);
  if (found && !arguments.out.empty()) {
    if (const Status s = write_tip(arguments, found->tip_in_marker); !s) {
      return bad_input(s.error().message);
    }
  }
  if (const Status s = arguments.json.write(pivot_json(arguments, *seen, found)); !s) {
    return bad_input(s.error().message);
  }
  if (!found) {
    return refused(found.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(arguments, *found);
  }
  return kDone;
}

constexpr const char* kPivotFooter =
    "\nSet the tip into a small hollow, record, and lean the tool all around the tip, 15° and "
    "more\n"
    "to every side, for half a minute. tip_sigma_mm: 3-D SD of the tip, from residual and "
    "geometry\n"
    "or from leaving out each tenth of the poses, whichever is larger. spread_deg: RMS turning in\n"
    "the direction that fixes the tip worst. Exit code 1: refused, nothing written.";

}  // namespace

void add_calibrate_pivot(CLI::App& calibrate, Action& action) {
  auto arguments = std::make_shared<PivotArguments>();
  CLI::App* command =
      calibrate.add_subcommand("pivot", "The tip of a tool from a recording of it pivoting");
  command->add_option("RECORDING", arguments->recording, "Folder of a recording")->required();
  command->add_option("--tools", arguments->tools_file, "Tool definitions (JSON)")
      ->required()
      ->type_name("FILE");
  command->add_option("--tool", arguments->tool, "Name of the tool")->required()->type_name("NAME");
  command->add_option("--method", arguments->method, "Tracking")
      ->type_name("NAME")
      ->capture_default_str();
  command
      ->add_option("--inlier-mm", arguments->inlier_mm,
                   "A pose whose tip misses the pivot by more is left out; where poses scatter "
                   "less, the limit follows them")
      ->check(finite_number(0.1, 50))
      ->capture_default_str();
  command
      ->add_option("--out", arguments->out,
                   "Writes the tools with the new tip there; may be the file of --tools")
      ->check(some_text())
      ->type_name("FILE");
  arguments->json.add_to(*command);
  command->footer(kPivotFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_pivot(*arguments); }; });
}

}  // namespace orthonav::tools
