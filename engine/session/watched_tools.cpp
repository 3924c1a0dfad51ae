#include "engine/session/watched_tools.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/check.h"

namespace orthonav::engine {

void ToolWatch::update(const nav::TrackedPose& world_from_marker) {
  newest_ = world_from_marker;
  if (newest_.status != PoseStatus::kMeasured) {
    return;
  }
  older_ = newer_;
  newer_ = newest_;
}

std::optional<Timestamp> ToolWatch::last_measured() const {
  if (newer_.status != PoseStatus::kMeasured) {
    return std::nullopt;
  }
  return newer_.time;
}

bool ToolWatch::fresh(Timestamp now, Duration within) const {
  return newer_.status == PoseStatus::kMeasured && newer_.age(now) <= within;
}

nav::TrackedPose ToolWatch::at(Timestamp time, Duration coast) const {
  return nav::predicted(older_, newer_, time, coast);
}

namespace {

Result<std::size_t> only_tool(std::span<const nav::ToolGeometry> tools, nav::ToolRole role,
                              const char* name) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (tools[i].role != role) {
      continue;
    }
    if (found) {
      return Error{std::string("tools: more than one ") + name + ", exactly 1 needed"};
    }
    found = i;
  }
  if (!found) {
    return Error{std::string("tools: no ") + name + ", exactly 1 needed"};
  }
  return *found;
}

/// Half the width of a printed tag's paper in tag sizes: a quiet zone of one of eight cells, and a
/// margin left by cutting it out.
constexpr double kHalfPaper = 0.5 + 0.125 + 0.025;

template <class Frame>
std::array<Point<World>, 4> paper_of(const Transform<World, Frame>& world_from_tag, double size_m) {
  const double half_m = kHalfPaper * size_m;
  const auto corner = [&](double x, double y) {
    return world_from_tag * Point<Frame>{{x * half_m, y * half_m, 0.0}};
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

void note_papers(const nav::TrackedPose& pose, const nav::ToolGeometry& tool, ToolSight& sight) {
  sight.papers.clear();
  if (pose.status == PoseStatus::kLost || !tool.has_tag()) {
    return;
  }
  sight.papers.push_back(paper_of(pose.value, tool.marker.size_m));
  for (const nav::AttachedMarker& more : tool.more_markers) {
    sight.papers.push_back(paper_of(pose.value * more.marker_from_tag, more.definition.size_m));
  }
}

}  // namespace

Result<WatchedTools> WatchedTools::create(std::unique_ptr<nav::ToolTracker> tracker,
                                          bool rods_alone) {
  const auto pointer = only_tool(tracker->tools(), nav::ToolRole::kPointer, "pointer");
  if (!pointer) {
    return pointer.error();
  }
  const auto guide = only_tool(tracker->tools(), nav::ToolRole::kGuide, "guide");
  if (!guide && !rods_alone) {
    return guide.error();
  }
  return WatchedTools(std::move(tracker), *pointer, guide ? std::optional(*guide) : std::nullopt);
}

std::size_t WatchedTools::guide() const {
  ORTHONAV_CHECK(guide_.has_value());
  return *guide_;
}

WatchedTools::WatchedTools(std::unique_ptr<nav::ToolTracker> tracker, std::size_t pointer,
                           std::optional<std::size_t> guide)
    : tracker_(std::move(tracker)), pointer_(pointer), guide_(guide) {
  watches_.resize(tracker_->tools().size());
  for (const nav::ToolGeometry& tool : tracker_->tools()) {
    ToolSight& sight = sights_.emplace_back();
    sight.name = tool.name;
    sight.role = tool.role;
    // Seeing a tool for the first time does not allocate.
    sight.papers.reserve(1 + tool.more_markers.size());
  }
}

void WatchedTools::note(std::span<const nav::ToolState> states) {
  states_ = states;
  for (std::size_t i = 0; i < watches_.size() && i < states_.size(); ++i) {
    watches_[i].update(states_[i].world_from_marker);
    sights_[i].status = states_[i].world_from_marker.status;
    note_papers(states_[i].world_from_marker, geometry(i), sights_[i]);
  }
}

void WatchedTools::forget_poses() {
  for (ToolWatch& watch : watches_) {
    watch = {};
  }
}

void WatchedTools::lose_sight() {
  for (ToolSight& sight : sights_) {
    sight.status = PoseStatus::kLost;
    sight.papers.clear();
  }
}

std::optional<std::size_t> WatchedTools::first_reference() const {
  const auto tools = tracker_->tools();
  const auto found = std::find_if(tools.begin(), tools.end(), [](const nav::ToolGeometry& tool) {
    return tool.role == nav::ToolRole::kReference;
  });
  return found == tools.end() ? std::nullopt
                              : std::optional(static_cast<std::size_t>(found - tools.begin()));
}

std::vector<ReferencePost> WatchedTools::reference_posts() const {
  std::vector<ReferencePost> posts;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    const nav::TrackedPose& pose = watches_[i].last_measured_pose();
    if (geometry(i).role == nav::ToolRole::kReference && pose.status == PoseStatus::kMeasured) {
      posts.push_back({pose.value * Point<Marker>{}, pose.value * geometry(i).tip_in_marker});
    }
  }
  return posts;
}

std::optional<Point<World>> WatchedTools::pointer_tip(Timestamp now, Duration within) const {
  const ToolWatch& watch = watches_[pointer_];
  if (!watch.fresh(now, within)) {
    return std::nullopt;
  }
  return watch.last_measured_pose().value * geometry(pointer_).tip_in_marker;
}

std::optional<double> WatchedTools::tag_size_off(std::size_t tool) const {
  const auto size = tracker_->tag_size(tool);
  return size && size->disagrees ? std::optional(size->fraction) : std::nullopt;
}

bool WatchedTools::pictures_apart() const {
  // The time for which poses are predicted: from then on it shows.
  constexpr std::int64_t kPairsUntilTold = 3;
  return tracker_->picture_agreement().refused_in_a_row > kPairsUntilTold;
}

double WatchedTools::tag_size_difference_sd() const {
  return tracker_->tag_size_difference_sd(pointer_, guide());
}

}  // namespace orthonav::engine
