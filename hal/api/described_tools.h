#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/transform.h"

namespace orthonav {

enum class ToolKind { kPointer, kGuide, kReference };

/// A tool with one tag, in plain values.
struct DescribedTool {
  std::string name;
  ToolKind kind = ToolKind::kPointer;
  std::string family = "tag36h11";
  int id = 0;
  double size_m = 0.04;  ///< outer edge of the tag's black border
  Point<Marker> tip_in_marker;
  Vec3 axis_in_marker{0, 1, 0};  ///< from the tip back along the shaft
};

/// The text of a file of tools. A device does not interpret it: the engine does.
struct ToolsFile {
  std::string name;  ///< stands for the file in messages
  std::string text;
};

/// How a device describes the tools in front of its cameras: not at all, by values, or by a file's
/// text.
using DescribedTools = std::variant<std::monostate, std::vector<DescribedTool>, ToolsFile>;

}  // namespace orthonav
