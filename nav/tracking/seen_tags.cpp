#include "nav/tracking/seen_tags.h"

#include <algorithm>

namespace orthonav::nav {
namespace {

std::string name_of_tag(std::string_view family, int id) {
  return std::string(family) + " id " + std::to_string(id);
}

bool is_of(const ToolGeometry& tool, std::string_view family, int id) {
  const auto is = [&](const MarkerDefinition& tag) { return tag.id == id && tag.family == family; };
  return is(tool.marker) || std::any_of(tool.more_markers.begin(), tool.more_markers.end(),
                                        [&](const AttachedMarker& m) { return is(m.definition); });
}

}  // namespace

void SeenTags::add(std::span<const MarkerCorners> found) {
  for (const MarkerCorners& marker : found) {
    const auto known = std::find_if(tags_.begin(), tags_.end(), [&](const Tag& tag) {
      return tag.id == marker.id && tag.family == marker.family;
    });
    if (known != tags_.end()) {
      ++known->times;
    } else if (tags_.size() < kMax) {
      tags_.push_back({marker.family, marker.id, 1});
    }
  }
}

bool SeenTags::has_other_than(std::span<const ToolGeometry> tools) const {
  return std::any_of(tags_.begin(), tags_.end(), [&](const Tag& tag) {
    return std::none_of(tools.begin(), tools.end(),
                        [&](const ToolGeometry& tool) { return is_of(tool, tag.family, tag.id); });
  });
}

std::string SeenTags::text() const {
  constexpr std::size_t kListed = 8;
  std::vector<Tag> sorted = tags_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Tag& a, const Tag& b) { return a.times > b.times; });
  std::string text;
  for (std::size_t i = 0; i < std::min(kListed, sorted.size()); ++i) {
    text += (i == 0 ? "" : ", ") + name_of_tag(sorted[i].family, sorted[i].id);
  }
  return text + (sorted.size() > kListed ? ", ..." : "");
}

std::string SeenTags::never_seen(const MarkerDefinition& tag) const {
  ToolGeometry alone;
  alone.marker = tag;
  return never_seen(alone);
}

std::string SeenTags::never_seen(const ToolGeometry& tool) const {
  const bool seen = std::any_of(tags_.begin(), tags_.end(),
                                [&](const Tag& tag) { return is_of(tool, tag.family, tag.id); });
  if (tags_.empty() || !tool.has_tag() || seen) {
    return {};
  }
  return "tag " + name_of_tag(tool.marker.family, tool.marker.id) +
         (tool.name.empty() ? "" : " of '" + tool.name + "'") + " was never seen, only " + text();
}

}  // namespace orthonav::nav
