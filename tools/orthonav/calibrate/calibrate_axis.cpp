#include <memory>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/io/json_writer.h"
#include "nav/calibration/spin.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/calibrate/calibrate_movement.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

void add_spin(const Result<nav::SpinCalibration>& found, nlohmann::ordered_json& out) {
  if (!found) {
    return add_judgement({nav::Verdict::kFail, found.error().message}, out);
  }
  const Vec3 axis = found->axis_in_marker.v;
  out["inliers"] = found->inliers;
  out["axis"] = {axis.x, axis.y, axis.z};
  out["off_deg"] = degrees(found->off_rad);
  out["axis_sigma_deg"] = degrees(found->axis_sigma_rad);
  out["leave_out_deg"] = degrees(found->leave_out_rad);
  out["wobble_deg"] = degrees(found->wobble_rad);
  out["spread"] = found->spread;
  out["tip_beside_mm"] = engine::vector_mm(found->tip_beside_m);
  add_judgement(found->judgement, out);
}

void print(const std::string& tool, const nav::SpinCalibration& found) {
  const Vec3 axis = found.axis_in_marker.v;
  print_text("%s: axis %.5f %.5f %.5f, known to %.2f°, %.2f° from the one in the file\n",
             tool.c_str(), axis.x, axis.y, axis.z, degrees(found.axis_sigma_rad),
             degrees(found.off_rad));
  print_text("%zu of %zu poses agree, wobble %.2f° RMS, tip %.2f mm beside the axis\n",
             found.inliers, found.poses, degrees(found.wobble_rad),
             found.tip_beside_m.norm() * 1e3);
  print_judgement(found.judgement);
}

int run_axis(const MovementArguments& arguments) {
  const auto movement = movement_of(arguments);
  if (!movement) {
    return bad_input(movement.error().message);
  }
  const auto found = nav::spin_calibration(movement->poses, movement->tool.tip_in_marker,
                                           movement->tool.axis_in_marker);
  if (found) {
    if (const Status s = write_change(arguments, {.axis_in_marker = found->axis_in_marker}); !s) {
      return bad_input(s.error().message);
    }
  }
  nlohmann::ordered_json json = movement_json(arguments, *movement);
  add_spin(found, json);
  if (const Status s = arguments.json.write(json); !s) {
    return bad_input(s.error().message);
  }
  if (!found) {
    return refused(found.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(arguments.tool, *found);
  }
  return kDone;
}

constexpr const char* kAxisFooter =
    "\nTurn the tool about its own axis, by 90° and more, for half a minute, with its shaft in a\n"
    "sleeve or a hole that fits it. Wobble is part of the uncertainty. axis_sigma_deg: SD of the\n"
    "axis, from wobble and turning or from leaving out each tenth of the poses, whichever is "
    "larger.\n"
    "Exit code 1: refused, nothing written.";

}  // namespace

void add_calibrate_axis(CLI::App& calibrate, Action& action) {
  auto arguments = std::make_shared<MovementArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "axis", "The axis of a tool from a recording of it turning about it");
  arguments->add_to(*command, "the new axis");
  command->footer(std::string(kAxisFooter) + kOtherPosesFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_axis(*arguments); }; });
}

}  // namespace orthonav::tools
