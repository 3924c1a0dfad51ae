#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "engine/case/tool_file.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/other_poses.h"

namespace orthonav::tools {

/// The common part of calibrations of a tool from a recording of its movement: `calibrate pivot`
/// and `calibrate axis`.
struct MovementArguments {
  std::string recording;
  std::string tools_file;
  std::string tool;
  std::string method = default_method();
  std::string out;
  OtherPosesArguments other;
  JsonOutput json;
  bool needs_tool = true;  ///< even if the poses are another tracker's

  /// RECORDING, --tools, --tool, --method and --out, which writes `changed` there, and those of
  /// poses by another tracker.
  void add_to(CLI::App& command, const std::string& changed);
};

/// The tool as described, and how it moved.
struct ToolMovement {
  nav::ToolGeometry tool;
  MeasuredPoses seen;
  std::vector<Transform<World, Marker>> poses;
};
/// First checks that the results can be written, before the work is done.
Result<ToolMovement> movement_of(const MovementArguments& arguments);

/// The common beginning of their JSON.
[[nodiscard]] nlohmann::ordered_json movement_json(const MovementArguments& arguments,
                                                   const ToolMovement& movement);

/// Writes the changed tools to --out, if given.
Status write_change(const MovementArguments& arguments, const engine::ToolChange& change);

}  // namespace orthonav::tools
