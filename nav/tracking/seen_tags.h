#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// Which tags were found in images, whether or not anything has them, to say so where one that is
/// looked for was never seen.
class SeenTags {
 public:
  SeenTags() { tags_.reserve(kMax); }
  /// Allocates nothing; beyond `kMax` different tags new ones are left out.
  void add(std::span<const MarkerCorners> found);
  /// "tag tag36h11 id 7 of 'pointer' was never seen, only tag36h11 id 3, tag36h11 id 4" (the most
  /// frequent first); empty if one of its tags was, if it has none, and if no tag was seen at all.
  [[nodiscard]] std::string never_seen(const ToolGeometry& tool) const;
  /// The same for the tag alone.
  [[nodiscard]] std::string never_seen(const MarkerDefinition& tag) const;
  /// Whether one was seen that none of these tools has.
  [[nodiscard]] bool has_other_than(std::span<const ToolGeometry> tools) const;

 private:
  [[nodiscard]] std::string text() const;

  static constexpr std::size_t kMax = 64;
  struct Tag {
    std::string_view family;
    int id = 0;
    std::int64_t times = 0;
  };
  std::vector<Tag> tags_;
};

}  // namespace orthonav::nav
