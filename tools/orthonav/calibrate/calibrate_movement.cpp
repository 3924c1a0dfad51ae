#include "tools/orthonav/calibrate/calibrate_movement.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/io/atomic_file.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

/// The tool of the tools file; without one a file of poses suffices for some calibrations.
Result<nav::ToolGeometry> tool_of(const MovementArguments& arguments, bool by_other) {
  const bool needed = arguments.needs_tool || !by_other || !arguments.out.empty();
  if (!needed && arguments.tools_file.empty() && arguments.tool.empty()) {
    nav::ToolGeometry any;
    any.marker.family.clear();
    return any;
  }
  if (arguments.tools_file.empty()) {
    return Error{"--tools is required"};
  }
  if (arguments.tool.empty()) {
    return Error{"--tool is required"};
  }
  return engine::load_tool(arguments.tools_file, arguments.tool,
                           by_other ? engine::ToolTags::kOptional : engine::ToolTags::kNeeded);
}

}  // namespace

void MovementArguments::add_to(CLI::App& command, const std::string& changed) {
  command.add_option("RECORDING", recording, "Folder of a recording, a file of poses, or igtl://")
      ->required();
  command.add_option("-t,--tools", tools_file, "Tool definitions (JSON)")
      ->check(some_text())
      ->type_name("FILE");
  command.add_option("--tool", tool, "Name of the tool")->check(some_text())->type_name("NAME");
  add_method_option(command, method, "Tracking");
  command
      .add_option("-o,--out", out,
                  "Writes the tools with " + changed + " there; may be the file of --tools")
      ->check(some_text())
      ->type_name("FILE");
  other.add_to(command);
  json.add_to(command);
}

Result<ToolMovement> movement_of(const MovementArguments& arguments) {
  const bool by_other = has_other_poses(arguments.recording);
  const auto tool = tool_of(arguments, by_other);
  if (!tool) {
    return tool.error();
  }
  if (const Status s = arguments.json.check(); !s) {
    return s.error();
  }
  if (!arguments.out.empty()) {
    if (const Status s = engine::check_place(arguments.out); !s) {
      return s.error();
    }
  }
  auto seen = by_other ? other_poses(arguments.recording, arguments.other, *tool)
                       : measured_poses(arguments.recording, arguments.method, *tool);
  if (!seen) {
    return seen.error();
  }
  ToolMovement movement{*tool, std::move(*seen), {}};
  for (const nav::TrackedPose& pose : movement.seen.world_from_marker) {
    movement.poses.push_back(pose.value);
  }
  return movement;
}

nlohmann::ordered_json movement_json(const MovementArguments& arguments,
                                     const ToolMovement& movement) {
  const std::string& format = movement.seen.format;
  nlohmann::ordered_json out = {{"tool", arguments.tool}};
  if (format.empty()) {
    out["method"] = arguments.method;
  } else {
    out["format"] = format;
  }
  out["pairs"] = movement.seen.pairs;
  out["poses"] = movement.poses.size();
  return out;
}

Status write_change(const MovementArguments& arguments, const engine::ToolChange& change) {
  if (arguments.out.empty()) {
    return {};
  }
  const auto changed = engine::changed_tools(arguments.tools_file, arguments.tool, change);
  if (!changed) {
    return changed.error();
  }
  return engine::write_file(arguments.out, *changed);
}

}  // namespace orthonav::tools
