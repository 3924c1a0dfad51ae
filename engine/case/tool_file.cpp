#include "engine/case/tool_file.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/check.h"
#include "base/joined.h"
#include "base/units.h"
#include "embedded/tools_json.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/json_pose.h"

namespace orthonav::engine {

namespace {

std::optional<nav::ToolRole> role_from(const std::string& text) {
  for (std::size_t i = 0; i < nav::kToolRoles; ++i) {
    if (to_text(static_cast<nav::ToolRole>(i)) == text) {
      return static_cast<nav::ToolRole>(i);
    }
  }
  return std::nullopt;
}

/// "pointer, guide, ... or wire".
std::string known_roles() {
  std::string text;
  for (std::size_t i = 0; i < nav::kToolRoles; ++i) {
    const char* const before = i + 1 == nav::kToolRoles ? " or " : ", ";
    text += (i == 0 ? "" : before) + to_text(static_cast<nav::ToolRole>(i));
  }
  return text;
}

std::optional<double> length_from(const JsonNode& node, const char* key) {
  return node.has(key) ? std::optional(node.number(key) * kMetresPerMm) : std::nullopt;
}

nav::MarkerDefinition marker_from(const JsonNode& node) {
  return {node.text("family"), node.integer("id"), node.number("size_mm") * kMetresPerMm};
}

nav::AttachedMarker attached_from(const JsonNode& node) {
  const auto rows = pose_rows(node, "pose", kMetresPerMm);
  return {marker_from(node), rigid_pose<Marker, Tag>(node, "pose", rows)};
}

nav::ToolGeometry tool_from(const JsonNode& node, ToolTags tags) {
  nav::ToolGeometry tool;
  tool.name = node.text("name");
  const std::string role = node.text("role");
  if (const auto known = role_from(role)) {
    tool.role = *known;
  } else {
    node.refuse("role", "is \"" + role + "\", must be " + known_roles());
  }
  if (tags == ToolTags::kOptional && !node.has("marker") && !node.has("markers")) {
    tool.marker.family.clear();
  } else {
    tool.marker = marker_from(node.child("marker"));
  }
  if (node.has("markers")) {
    for (const JsonNode& more : node.list("markers")) {
      tool.more_markers.push_back(attached_from(more));
    }
  }
  // A reference consists only of its marker.
  if (tool.role != nav::ToolRole::kReference || node.has("tip_mm")) {
    tool.tip_in_marker = {node.vec3("tip_mm") * kMetresPerMm};
  }
  if (node.has("level")) {
    tool.level = node.text("level");
    if (tool.role != nav::ToolRole::kReference) {
      node.refuse("level", "is for a reference: no other tool is clamped to a vertebra");
    }
  }
  tool.sleeve_length_m = length_from(node, "sleeve_length_mm");
  tool.stop_m = length_from(node, "stop_mm");
  const Vec3 axis = node.has("axis") ? node.vec3("axis") : Vec3{0, 1, 0};
  if (axis.norm() < 1e-9) {
    node.refuse("axis", "must not be zero");
  } else {
    tool.axis_in_marker = {axis.normalized()};
  }
  return tool;
}

Result<std::vector<nav::ToolGeometry>> tools_from(const JsonDocument& document,
                                                  const std::string& name,
                                                  ToolTags tags = ToolTags::kNeeded) {
  std::vector<nav::ToolGeometry> tools;
  for (const JsonNode& node : document.root().list("tools")) {
    tools.push_back(tool_from(node, tags));
  }
  if (Status status = document.status(); !status) {
    return status.error();
  }
  if (tools.empty()) {
    return Error{name + ": tools is empty"};
  }
  const std::vector<std::string> problems = nav::problems_of(tools);
  if (problems.empty()) {
    return tools;
  }
  return Error{name + ": " + joined(problems)};
}

nlohmann::json list_of(Vec3 v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json json_of(const nav::MarkerDefinition& marker) {
  return {{"family", marker.family}, {"id", marker.id}, {"size_mm", marker.size_m / kMetresPerMm}};
}

nlohmann::ordered_json json_of(const nav::AttachedMarker& more) {
  nlohmann::ordered_json entry = json_of(more.definition);
  std::array<double, 16> a = more.marker_from_tag.row_major();
  for (const std::size_t i : {3u, 7u, 11u}) {
    a[i] /= kMetresPerMm;
  }
  for (std::size_t row = 0; row < 4; ++row) {
    entry["pose"].push_back({a[4 * row], a[4 * row + 1], a[4 * row + 2], a[4 * row + 3]});
  }
  return entry;
}

}  // namespace

std::string to_text(nav::ToolRole role) { return name_of(role); }

Result<std::vector<nav::ToolGeometry>> load_tools(const std::string& path, ToolTags tags) {
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  return tools_from(*document, path, tags);
}

Result<nav::ToolGeometry> load_tool(const std::string& path, const std::string& name,
                                    ToolTags tags) {
  const auto tools = load_tools(path, tags);
  if (!tools) {
    return tools.error();
  }
  auto tool = tool_named(*tools, name);
  if (!tool) {
    return Error{path + ": " + tool.error().message};
  }
  return tool;
}

std::string tools_text(const std::vector<nav::ToolGeometry>& tools) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const nav::ToolGeometry& tool : tools) {
    nlohmann::ordered_json entry;
    entry["name"] = tool.name;
    entry["role"] = to_text(tool.role);
    if (tool.has_tag()) {
      entry["marker"] = json_of(tool.marker);
    }
    for (const nav::AttachedMarker& more : tool.more_markers) {
      entry["markers"].push_back(json_of(more));
    }
    entry["tip_mm"] = list_of(tool.tip_in_marker.v / kMetresPerMm);
    entry["axis"] = list_of(tool.axis_in_marker.v);
    if (!tool.level.empty()) {
      entry["level"] = tool.level;
    }
    if (tool.sleeve_length_m) {
      entry["sleeve_length_mm"] = *tool.sleeve_length_m / kMetresPerMm;
    }
    if (tool.stop_m) {
      entry["stop_mm"] = *tool.stop_m / kMetresPerMm;
    }
    list.push_back(entry);
  }
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  const nlohmann::ordered_json root = {{"tools", list}};
  return root.dump(1, ' ', false, replace) + "\n";
}

Status save_tools(const std::string& path, const std::vector<nav::ToolGeometry>& tools) {
  return write_file(path, tools_text(tools));
}

Result<std::vector<nav::ToolGeometry>> parse_tools(const std::string& text, const std::string& name,
                                                   ToolTags tags) {
  const auto document = JsonDocument::parse(text, name);
  if (!document) {
    return document.error();
  }
  return tools_from(*document, name, tags);
}

Result<nav::ToolGeometry> tool_named(const std::vector<nav::ToolGeometry>& tools,
                                     const std::string& name) {
  std::string names;
  for (const nav::ToolGeometry& tool : tools) {
    if (tool.name == name) {
      return tool;
    }
    names += (names.empty() ? "" : ", ") + tool.name;
  }
  return Error{"no tool is named '" + name + "' (there are: " + names + ")"};
}

Result<std::string> changed_tools(const std::string& path, const std::string& tool,
                                  const ToolChange& change) {
  const Result<std::string> text = read_text(path);
  if (!text) {
    return text.error();
  }
  const auto tools = parse_tools(*text, path, ToolTags::kOptional);
  if (!tools) {
    return tools.error();
  }
  if (const auto known = tool_named(*tools, tool); !known) {
    return Error{path + ": " + known.error().message};
  }
  auto root = nlohmann::ordered_json::parse(*text, nullptr, false);
  if (root.is_discarded()) {
    return Error{path + ": is not JSON"};
  }
  for (auto& entry : root["tools"]) {
    if (entry["name"] != tool) {
      continue;
    }
    if (change.tip_in_marker) {
      entry["tip_mm"] = list_of(change.tip_in_marker->v / kMetresPerMm);
    }
    if (change.axis_in_marker) {
      entry["axis"] = list_of(change.axis_in_marker->v);
    }
    if (!change.more_markers) {
      continue;
    }
    entry["markers"] = nlohmann::ordered_json::array();
    for (const nav::AttachedMarker& more : *change.more_markers) {
      entry["markers"].push_back(json_of(more));
    }
  }
  std::string changed =
      root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (const auto after = parse_tools(changed, path + " as changed", ToolTags::kOptional); !after) {
    return after.error();
  }
  return changed;
}

std::vector<nav::ToolGeometry> built_in_tools() {
  const Result<JsonDocument> document =
      JsonDocument::parse(embedded::tools_json(), "data/tools.json");
  ORTHONAV_CHECK(document.ok());
  Result<std::vector<nav::ToolGeometry>> tools = tools_from(*document, "data/tools.json");
  ORTHONAV_CHECK(tools.ok());
  return std::move(tools).value();
}

}  // namespace orthonav::engine
