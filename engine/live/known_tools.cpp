#include "engine/live/known_tools.h"

#include "engine/case/tool_file.h"

namespace orthonav::engine {
namespace {

nav::ToolRole role_of(ToolKind kind) {
  if (kind == ToolKind::kPointer) {
    return nav::ToolRole::kPointer;
  }
  if (kind == ToolKind::kGuide) {
    return nav::ToolRole::kGuide;
  }
  return nav::ToolRole::kReference;
}

}  // namespace

Result<std::vector<nav::ToolGeometry>> tools_known_to(Headset& headset) {
  const DescribedTools known = headset.described_tools();
  if (const auto* file = std::get_if<ToolsFile>(&known)) {
    return parse_tools(file->text, file->name);
  }
  const auto* described = std::get_if<std::vector<DescribedTool>>(&known);
  if (!described && headset.tool_poses() != nullptr) {
    return Error{headset.name() +
                 " measures tools itself: a file of tools must say where their tips lie (--tools)"};
  }
  if (!described) {
    return built_in_tools();
  }
  std::vector<nav::ToolGeometry> tools;
  for (const DescribedTool& tool : *described) {
    tools.push_back({tool.name,
                     role_of(tool.kind),
                     {tool.family, tool.id, tool.size_m},
                     tool.tip_in_marker,
                     {tool.axis_in_marker}});
  }
  return tools;
}

}  // namespace orthonav::engine
