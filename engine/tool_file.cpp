#include "engine/tool_file.h"

#include <cassert>
#include <nlohmann/json.hpp>
#include <optional>

#include "embedded/tools_json.h"
#include "engine/atomic_file.h"
#include "engine/json_document.h"

namespace orthonav::engine {

namespace {

constexpr double kMetresPerMm = 1e-3;

std::optional<nav::ToolRole> role_from(const std::string& text) {
  for (const nav::ToolRole role :
       {nav::ToolRole::kPointer, nav::ToolRole::kGuide, nav::ToolRole::kReference})
    if (to_text(role) == text) return role;
  return std::nullopt;
}

nav::ToolGeometry tool_from(const JsonNode& node) {
  nav::ToolGeometry tool;
  tool.name = node.text("name");
  const std::string role = node.text("role");
  if (const auto known = role_from(role))
    tool.role = *known;
  else
    node.refuse("role", "is \"" + role + "\", must be pointer, guide or reference");
  const JsonNode marker = node.child("marker");
  tool.marker.family = marker.text("family");
  tool.marker.id = marker.integer("id");
  tool.marker.size_m = marker.number("size_mm") * kMetresPerMm;
  // A reference is nothing but its marker.
  if (tool.role != nav::ToolRole::kReference || node.has("tip_mm"))
    tool.tip_in_marker = {node.vec3("tip_mm") * kMetresPerMm};
  const Vec3 axis = node.has("axis") ? node.vec3("axis") : Vec3{0, 1, 0};
  if (axis.norm() < 1e-9)
    node.refuse("axis", "must not be zero");
  else
    tool.axis_in_marker = {axis.normalized()};
  return tool;
}

Result<std::vector<nav::ToolGeometry>> tools_from(const JsonDocument& document,
                                                  const std::string& name) {
  std::vector<nav::ToolGeometry> tools;
  for (const JsonNode& node : document.root().list("tools")) tools.push_back(tool_from(node));
  if (Status status = document.status(); !status) return status.error();
  if (tools.empty()) return Error{name + ": tools is empty"};
  const std::vector<std::string> problems = nav::problems_of(tools);
  if (problems.empty()) return tools;
  std::string line = name + ": ";
  for (const std::string& problem : problems)
    line += (&problem == &problems.front() ? "" : "; ") + problem;
  return Error{line};
}

nlohmann::json list_of(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

std::string to_text(nav::ToolRole role) {
  switch (role) {
    case nav::ToolRole::kPointer:
      return "pointer";
    case nav::ToolRole::kGuide:
      return "guide";
    case nav::ToolRole::kReference:
      return "reference";
  }
  return {};
}

Result<std::vector<nav::ToolGeometry>> load_tools(const std::string& path) {
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) return document.error();
  return tools_from(*document, path);
}

std::string tools_text(const std::vector<nav::ToolGeometry>& tools) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const nav::ToolGeometry& tool : tools) {
    nlohmann::ordered_json entry;
    entry["name"] = tool.name;
    entry["role"] = to_text(tool.role);
    entry["marker"] = {{"family", tool.marker.family},
                       {"id", tool.marker.id},
                       {"size_mm", tool.marker.size_m / kMetresPerMm}};
    entry["tip_mm"] = list_of(tool.tip_in_marker.v / kMetresPerMm);
    entry["axis"] = list_of(tool.axis_in_marker.v);
    list.push_back(entry);
  }
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  const nlohmann::ordered_json root = {{"tools", list}};
  return root.dump(1, ' ', false, replace) + "\n";
}

Status save_tools(const std::string& path, const std::vector<nav::ToolGeometry>& tools) {
  return write_file(path, tools_text(tools));
}

Result<std::vector<nav::ToolGeometry>> parse_tools(const std::string& text,
                                                   const std::string& name) {
  const auto document = JsonDocument::parse(text, name);
  if (!document) return document.error();
  return tools_from(*document, name);
}

std::vector<nav::ToolGeometry> built_in_tools() {
  const Result<JsonDocument> document =
      JsonDocument::parse(embedded::tools_json(), "data/tools.json");
  assert(document.ok());
  Result<std::vector<nav::ToolGeometry>> tools = tools_from(*document, "data/tools.json");
  assert(tools.ok());
  return std::move(tools).value();
}

}  // namespace orthonav::engine
