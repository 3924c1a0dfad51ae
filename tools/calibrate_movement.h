#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "engine/case/tool_file.h"
#include "tools/json_output.h"
#include "tools/recorded_pairs.h"

namespace orthonav::tools {

/// What the calibrations of a tool from a recording of it moving have in common: `calibrate pivot`
/// and `calibrate axis`.
struct MovementArguments {
  std::string recording;
  std::string tools_file;
  std::string tool;
  std::string method = default_method();
  std::string out;
  JsonOutput json;

  /// RECORDING, --tools, --tool, --method and --out, which writes `changed` there.
  void add_to(CLI::App& command, const std::string& changed);
};

/// The tool as described, and how it moved.
struct ToolMovement {
  nav::ToolGeometry tool;
  MeasuredPoses seen;
  std::vector<Transform<World, Marker>> poses;
};
/// Makes sure first that the results can be written: that must be known before the work.
Result<ToolMovement> movement_of(const MovementArguments& arguments);

/// What every such JSON begins with.
[[nodiscard]] nlohmann::ordered_json movement_json(const MovementArguments& arguments,
                                                   const ToolMovement& movement);

/// Writes the tools with that change to --out, where it was asked for.
Status write_change(const MovementArguments& arguments, const engine::ToolChange& change);

}  // namespace orthonav::tools
