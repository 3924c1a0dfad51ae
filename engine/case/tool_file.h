#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// Whether each tool needs a tag, which cameras need to find it.
enum class ToolTags { kNeeded, kOptional };

/// Reads tool definitions:
/// ```
/// {"tools": [{"name", "role": "pointer"|"guide"|"reference"|"awl"|...,
///   "marker": {"family", "id", "size_mm"}, "tip_mm": [x,y,z], "axis": [x,y,z],
///   "markers": [...], "level": "L4"}]}
/// ```
/// The axis may have any length but zero and defaults to +y; a reference needs no tip and may state
/// the level that it is clamped to. `markers` lists further tags of the body, each as `marker` with
/// a `pose`: marker_from_tag, 4×4 by rows, mm. A guide may have `sleeve_length_mm` and `stop_mm`
/// (nav/tracking/tool.h). Refuses, naming file and field, anything missing or of the wrong type, an
/// invalid pose, and any problem in the sense of `nav::problems_of`. A tool without `marker`, if
/// allowed, is one that the headset measures itself.
Result<std::vector<nav::ToolGeometry>> load_tools(const std::string& path,
                                                  ToolTags tags = ToolTags::kNeeded);

/// One tool of such a file, by its name.
Result<nav::ToolGeometry> load_tool(const std::string& path, const std::string& name,
                                    ToolTags tags = ToolTags::kNeeded);

/// Writes a file that `load_tools` reads back to the same numbers.
Status save_tools(const std::string& path, const std::vector<nav::ToolGeometry>& tools);

/// The same without a file; `name` stands for it in messages.
[[nodiscard]] std::string tools_text(const std::vector<nav::ToolGeometry>& tools);
Result<std::vector<nav::ToolGeometry>> parse_tools(const std::string& text, const std::string& name,
                                                   ToolTags tags = ToolTags::kNeeded);

/// The result of a calibration of a tool.
struct ToolChange {
  std::optional<Point<Marker>> tip_in_marker;
  std::optional<Direction<Marker>> axis_in_marker;
  std::optional<std::vector<nav::AttachedMarker>> more_markers;
};

/// The text of a tools file in which one tool is changed; every other field, known here or not,
/// stays as it is. Refuses what `load_tools` refuses, before and after, and a name that no tool
/// has; tags are optional.
Result<std::string> changed_tools(const std::string& path, const std::string& tool,
                                  const ToolChange& change);

/// The tool of this name; if there is none, the Error lists the names.
Result<nav::ToolGeometry> tool_named(const std::vector<nav::ToolGeometry>& tools,
                                     const std::string& name);

/// The pointer, the drill guide and the patient reference of data/tools.json.
[[nodiscard]] std::vector<nav::ToolGeometry> built_in_tools();

/// "pointer", "guide", "reference" and so on (nav::name_of).
[[nodiscard]] std::string to_text(nav::ToolRole role);

}  // namespace orthonav::engine
