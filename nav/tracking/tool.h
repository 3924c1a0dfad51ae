#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/transform.h"

namespace orthonav::nav {

enum class ToolRole : std::uint8_t {
  kPointer,
  kGuide,  ///< the only tool that is guided
  kReference,
  kAwl,
  kDrill,
  kTap,
  kScrewdriver,
  kWire,
};
inline constexpr std::size_t kToolRoles = 8;
/// As in files: "pointer", "screwdriver".
[[nodiscard]] const char* name_of(ToolRole role);

struct MarkerDefinition {
  std::string family = "tag36h11";  ///< empty: no tag; the tool is measured by the device itself
  int id = 0;
  double size_m = 0.0;  ///< outer edge of the black border
};

/// A further tag of a rigid tool, and its pose.
struct AttachedMarker {
  MarkerDefinition definition;
  Transform<Marker, Tag> marker_from_tag;
};

/// A rigid tool: where its tip and axis lie relative to its marker. For a tool without a tag,
/// Marker is the frame that the device measures.
struct ToolGeometry {
  std::string name;
  ToolRole role = ToolRole::kPointer;
  MarkerDefinition marker;
  Point<Marker> tip_in_marker;
  /// Unit vector from the tip back along the shaft, away from the patient.
  Direction<Marker> axis_in_marker{{0, 1, 0}};
  /// Other tags of the same rigid body. A tracker may use them or `marker` alone; poses are always
  /// those of `marker`.
  std::vector<AttachedMarker> more_markers;
  std::string level = {};  ///< for a reference: the vertebra it is clamped to; empty: not stated
  /// For a guide with a sleeve, whose end is the tip: the length of the sleeve. Absent: not stated.
  std::optional<double> sleeve_length_m = {};
  /// For a guide with a depth stop: how far the drill advances past where the tip was set on the
  /// bone before it meets the stop. Absent: no stop, or unknown.
  std::optional<double> stop_m = {};

  [[nodiscard]] bool has_tag() const { return !marker.family.empty(); }
};

/// Every problem at once: empty names, unknown families, duplicate names, a tag given twice on any
/// tool, sizes outside 5-200 mm, tips or further tags farther than 1 m, axes that are not unit
/// vectors, sleeves outside 10-300 mm, stops outside 1-150 mm, a sleeve or stop on a tool that is
/// not a guide. Empty when all is well.
[[nodiscard]] std::vector<std::string> problems_of(const std::vector<ToolGeometry>& tools);
/// Families of the tags, each once.
[[nodiscard]] std::vector<std::string> families_of(const std::vector<MarkerDefinition>& tags);
/// The same for all tags of the tools.
[[nodiscard]] std::vector<std::string> families_of(const std::vector<ToolGeometry>& tools);
/// Tag families that can be detected.
[[nodiscard]] bool is_known_family(const std::string& family);

}  // namespace orthonav::nav
