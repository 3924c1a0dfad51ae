#include "nav/tracking/tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "nav/tracking/marker_detector.h"

namespace orthonav::nav {
namespace {

constexpr double kSmallestMarkerM = 0.005;
constexpr double kLargestMarkerM = 0.2;
constexpr double kFarthestTipM = 1.0;
constexpr double kUnitTolerance = 1e-3;

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

void check_marker(const ToolGeometry& tool, const std::string& name,
                  std::vector<std::string>& problems) {
  if (!is_known_family(tool.marker.family))
    problems.push_back(name + ": unknown tag family '" + tool.marker.family + "', known are " +
                       known_families_text());
  const int ids = family_size(tool.marker.family);
  if (tool.marker.id < 0 || (ids > 0 && tool.marker.id >= ids))
    problems.push_back(name + ": tag id " + std::to_string(tool.marker.id) + ", must be 0-" +
                       std::to_string(std::max(ids, 1) - 1));
  if (!(tool.marker.size_m >= kSmallestMarkerM && tool.marker.size_m <= kLargestMarkerM))
    problems.push_back(name + ": tag size " + number(tool.marker.size_m * 1e3) +
                       " mm, must be 5-200 mm");
}

void check_geometry(const ToolGeometry& tool, const std::string& name,
                    std::vector<std::string>& problems) {
  const double reach_m = tool.tip_in_marker.v.norm();
  if (!(reach_m <= kFarthestTipM))
    problems.push_back(name + ": tip " + number(reach_m * 1e3) +
                       " mm from its marker, limit 1000 mm");
  const double length = tool.axis_in_marker.v.norm();
  if (!(std::abs(length - 1.0) <= kUnitTolerance))
    problems.push_back(name + ": axis has length " + number(length) + ", must be 1");
}

}  // namespace

std::vector<std::string> problems_of(const std::vector<ToolGeometry>& tools) {
  std::vector<std::string> problems;
  if (tools.empty()) problems.push_back("no tools given");
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const ToolGeometry& tool = tools[i];
    const std::string name =
        tool.name.empty() ? "tool " + std::to_string(i + 1) : "tool '" + tool.name + "'";
    if (tool.name.empty()) problems.push_back(name + ": name is empty");
    check_marker(tool, name, problems);
    check_geometry(tool, name, problems);
    for (std::size_t j = 0; j < i; ++j) {
      if (!tool.name.empty() && tools[j].name == tool.name)
        problems.push_back(name + ": the name is given twice");
      if (tools[j].marker.family == tool.marker.family && tools[j].marker.id == tool.marker.id)
        problems.push_back(name + ": tag " + tool.marker.family + " id " +
                           std::to_string(tool.marker.id) + " is already on '" + tools[j].name +
                           "'");
    }
  }
  return problems;
}

}  // namespace orthonav::nav
