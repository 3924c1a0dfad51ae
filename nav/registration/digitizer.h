#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/tracked.h"
#include "base/transform.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// One digitized point. In World, or in the patient reference's frame if one is used; the caller
/// keeps track of which.
struct Sample {
  Point<World> tip_in_world;
  Timestamp time{};
  Vec3 shaft_in_world{};  ///< unit vector from the tip back along the pointer's shaft
  double tip_sd_m = 0.0;  ///< how exactly it was tracked: RMS per axis; 0 where unknown
};

/// Consecutive samples between two saves: one region (lamina, spinous process, a facet).
struct Region {
  std::vector<Sample> samples;
  bool saved = false;
};

/// Collects pointer tips while the button is held, from measured poses only (Liebmann et al. 2019,
/// section 3.2). "save" closes the current region, "delete" drops it; a saved region is removed
/// only by an explicit second command. One thread at a time.
class Digitizer {
 public:
  /// Starts recording into the current region, or into a new one after a save.
  void press(Timestamp time);
  /// Ends recording; the region stays open for another press.
  void release(Timestamp time);
  /// True when the pose became a sample: recording, measured, finite, no older than the press, and
  /// newer than the last sample (the same pose twice is one observation).
  bool add(const TrackedPose& world_from_marker, Point<Marker> tip_in_marker,
           Direction<Marker> axis_in_marker = ToolGeometry{}.axis_in_marker);
  /// Keeps the current region; without samples there is nothing to keep.
  void save();
  /// Drops the region that is not saved yet and returns it; empty if it has no samples. Never
  /// touches a saved one. Recording continues while the button is held.
  std::optional<Region> drop();
  /// Drops the last saved region and returns it; empty if there is none.
  std::optional<Region> drop_saved();
  /// Replaces everything by regions that were saved earlier.
  void restore(std::vector<Region> saved);
  /// Forgets everything and stops recording.
  void clear();
  [[nodiscard]] bool recording() const { return recording_; }
  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  [[nodiscard]] std::vector<Point<World>> saved_points() const;
  [[nodiscard]] std::vector<Vec3> saved_shafts() const;
  [[nodiscard]] std::vector<Timestamp> saved_times() const;
  [[nodiscard]] std::size_t saved_count() const;

 private:
  /// The region that samples go to: the last one, as long as it is not saved.
  Region& current();

  std::vector<Region> regions_;
  bool recording_ = false;
  Timestamp pressed_at_{};
  Timestamp newest_ = Timestamp::min();
};

}  // namespace orthonav::nav
