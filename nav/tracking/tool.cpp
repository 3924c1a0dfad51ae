#include "nav/tracking/tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "base/printed.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::nav {
namespace {

constexpr double kSmallestMarkerM = 0.005;
constexpr double kLargestMarkerM = 0.2;
constexpr double kFarthestM = 1.0;
constexpr double kUnitTolerance = 1e-3;

std::string number(double value) { return printed("%.6g", value); }

void check_marker(const MarkerDefinition& marker, const std::string& name,
                  std::vector<std::string>& problems) {
  if (!is_known_family(marker.family)) {
    problems.push_back(name + ": unknown tag family '" + marker.family + "', known are " +
                       known_families_text());
  }
  const int ids = family_size(marker.family);
  if (marker.id < 0 || (ids > 0 && marker.id >= ids)) {
    problems.push_back(name + ": tag id " + std::to_string(marker.id) + ", must be 0-" +
                       std::to_string(std::max(ids, 1) - 1));
  }
  if (!(marker.size_m >= kSmallestMarkerM && marker.size_m <= kLargestMarkerM)) {
    problems.push_back(name + ": tag size " + number(marker.size_m * 1e3) +
                       " mm, must be 5-200 mm");
  }
}

void check_geometry(const ToolGeometry& tool, const std::string& name,
                    std::vector<std::string>& problems) {
  const double reach_m = tool.tip_in_marker.v.norm();
  if (!(reach_m <= kFarthestM)) {
    problems.push_back(name + ": tip " + number(reach_m * 1e3) +
                       " mm from its marker, limit 1000 mm");
  }
  const double length = tool.axis_in_marker.v.norm();
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
    problems.push_back(name + ": axis has length " + number(length) + ", must be 1");
  }
  for (const AttachedMarker& more : tool.more_markers) {
    check_marker(more.definition, name, problems);
    const double distance_m = more.marker_from_tag.translation().norm();
    if (!(distance_m <= kFarthestM)) {
      problems.push_back(name + ": tag id " + std::to_string(more.definition.id) + " lies " +
                         number(distance_m * 1e3) + " mm from its marker, limit 1000 mm");
    }
  }
}

void check_guide(const ToolGeometry& tool, const std::string& name,
                 std::vector<std::string>& problems) {
  const auto check_length = [&](const std::optional<double>& length_m, const char* what,
                                double least_mm, double most_mm) {
    if (length_m && tool.role != ToolRole::kGuide) {
      problems.push_back(name + ": " + what + " is for a guide");
    } else if (length_m && !(*length_m * 1e3 >= least_mm && *length_m * 1e3 <= most_mm)) {
      problems.push_back(name + ": " + what + " " + number(*length_m * 1e3) + " mm, must be " +
                         number(least_mm) + "-" + number(most_mm) + " mm");
    }
  };
  check_length(tool.sleeve_length_m, "sleeve length", 10.0, 300.0);
  check_length(tool.stop_m, "stop", 1.0, 150.0);
}

std::string title_of(const std::vector<ToolGeometry>& tools, std::size_t i) {
  return tools[i].name.empty() ? "tool " + std::to_string(i + 1) : "tool '" + tools[i].name + "'";
}

/// One tag cannot be in two places; `tags` are those of the tools before.
void check_given_once(const MarkerDefinition& marker, const std::string& name,
                      std::map<std::pair<std::string, int>, std::string>& tags,
                      std::vector<std::string>& problems) {
  const auto [given, is_new] = tags.try_emplace({marker.family, marker.id}, name);
  if (!is_new) {
    problems.push_back(name + ": tag " + marker.family + " id " + std::to_string(marker.id) +
                       " is already on " + given->second);
  }
}

}  // namespace

const char* name_of(ToolRole role) {
  constexpr std::array<const char*, kToolRoles> kRoleNames = {
      "pointer", "guide", "reference", "awl", "drill", "tap", "screwdriver", "wire"};
  return kRoleNames[static_cast<std::size_t>(role)];
}

std::vector<std::string> problems_of(const std::vector<ToolGeometry>& tools) {
  std::vector<std::string> problems;
  std::map<std::pair<std::string, int>, std::string> tags;
  if (tools.empty()) {
    problems.push_back("no tools given");
  }
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const ToolGeometry& tool = tools[i];
    const std::string name = title_of(tools, i);
    if (tool.name.empty()) {
      problems.push_back(name + ": name is empty");
    }
    if (tool.has_tag()) {
      check_marker(tool.marker, name, problems);
      check_given_once(tool.marker, name, tags, problems);
    }
    check_geometry(tool, name, problems);
    check_guide(tool, name, problems);
    for (std::size_t j = 0; j < i; ++j) {
      if (!tool.name.empty() && tools[j].name == tool.name) {
        problems.push_back(name + ": the name is given twice");
      }
    }
    for (const AttachedMarker& more : tool.more_markers) {
      check_given_once(more.definition, name, tags, problems);
    }
  }
  return problems;
}

std::vector<std::string> families_of(const std::vector<MarkerDefinition>& tags) {
  std::vector<std::string> families;
  for (const MarkerDefinition& tag : tags) {
    if (std::find(families.begin(), families.end(), tag.family) == families.end()) {
      families.push_back(tag.family);
    }
  }
  return families;
}

std::vector<std::string> families_of(const std::vector<ToolGeometry>& tools) {
  std::vector<MarkerDefinition> tags;
  for (const ToolGeometry& tool : tools) {
    tags.push_back(tool.marker);
    for (const AttachedMarker& more : tool.more_markers) {
      tags.push_back(more.definition);
    }
  }
  return families_of(tags);
}

}  // namespace orthonav::nav
