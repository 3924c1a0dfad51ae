#pragma once

#include <span>
#include <vector>

#include "hal/api/tracked.h"
#include "hal/api/transform.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// One digitized point. World, or the patient reference's frame where one is used; the caller keeps
/// that apart.
struct Sample {
  Point<World> tip_in_world;
  Timestamp time{};
};

/// Consecutive samples between two saves: one region (lamina, spinous process, a facet).
struct Region {
  std::vector<Sample> samples;
  bool saved = false;
};

/// Collects pointer tips while the button is held, only from measured poses (Liebmann et al. 2019,
/// section 3.2). "save" closes the current region, "delete" drops it (or, when it is empty, the last
/// saved one).
class Digitizer {
 public:
  void press(Timestamp time);
  void release(Timestamp time);
  /// True when the pose became a sample.
  bool add(const TrackedPose& world_from_marker, Point<Marker> tip_in_marker);
  void save();
  void drop();
  void clear();
  [[nodiscard]] bool recording() const { return recording_; }
  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  [[nodiscard]] std::vector<Point<World>> saved_points() const;
  [[nodiscard]] std::size_t saved_count() const;

 private:
  std::vector<Region> regions_;
  bool recording_ = false;
};

}  // namespace orthonav::nav
