#include "tools/calibrate_movement.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/io/atomic_file.h"
#include "tools/arguments.h"

namespace orthonav::tools {

void MovementArguments::add_to(CLI::App& command, const std::string& changed) {
  command.add_option("RECORDING", recording, "Folder of a recording")->required();
  command.add_option("-t,--tools", tools_file, "Tool definitions (JSON)")
      ->required()
      ->type_name("FILE");
  command.add_option("--tool", tool, "Name of the tool")->required()->type_name("NAME");
  add_method_option(command, method, "Tracking");
  command
      .add_option("-o,--out", out,
                  "Writes the tools with " + changed + " there; may be the file of --tools")
      ->check(some_text())
      ->type_name("FILE");
  json.add_to(command);
}

Result<ToolMovement> movement_of(const MovementArguments& arguments) {
  const auto tool = engine::load_tool(arguments.tools_file, arguments.tool);
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
  auto seen = measured_poses(arguments.recording, arguments.method, *tool);
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
  return {{"tool", arguments.tool},
          {"method", arguments.method},
          {"pairs", movement.seen.pairs},
          {"poses", movement.poses.size()}};
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
