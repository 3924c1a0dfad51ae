#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/mutex.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "engine/session/workflow/workflow.h"
#include "hal/sim/room/room.h"
#include "render/scene.h"

namespace orthonav::preview {

/// A tool's state.
struct ToolSeen {
  std::string name;
  PoseStatus status = PoseStatus::kLost;
  double translation_sigma_m = 0.0;
  // Unless lost:
  std::array<Point<World>, 4> tag_in_world;  ///< its corners
  Point<World> tip_in_world;
};

/// Everything that can be shown of one camera pair; a plain value.
struct Moment {
  std::int64_t pair = 0;      ///< counts from 1: how many pairs had passed
  std::int64_t sequence = 0;  ///< the headset's own number of it
  Timestamp time{};           ///< mid-exposure
  engine::StepOnDisplay at;
  std::string detail;
  std::vector<ToolSeen> tools;
  double camera_ms = 0.0;    ///< wall time: the pair itself
  double tracking_ms = 0.0;  ///< and what was computed from it
  Tracked<Transform<World, Rig>> world_from_rig;
  std::optional<sim::RoomState> room;  ///< where it is a simulated one
  render::Scene scene;
};

/// The moments so far, to look back at: the newest, and earlier ones evenly spread. When there are
/// too many, every other one is dropped, so that bounded memory covers the whole time. Thread-safe.
class Timeline {
 public:
  explicit Timeline(std::size_t most = 4096) : most_(most < 2 ? 2 : most) {}

  /// Adds a moment; replaces the last one if it is of the same pair.
  void push(std::shared_ptr<const Moment> moment);
  void clear();
  [[nodiscard]] std::shared_ptr<const Moment> newest() const;
  /// The last one at or before that pair; before the first: the first. Null when there is none.
  [[nodiscard]] std::shared_ptr<const Moment> at(std::int64_t pair) const;
  /// The first one whose step begins with this; null when there is none.
  [[nodiscard]] std::shared_ptr<const Moment> first_of(std::string_view step) const;
  /// The neighbours of `at(pair)`; at the ends the end itself.
  [[nodiscard]] std::shared_ptr<const Moment> before(std::int64_t pair) const;
  [[nodiscard]] std::shared_ptr<const Moment> after(std::int64_t pair) const;

 private:
  [[nodiscard]] std::size_t index_of(std::int64_t pair) const ORTHONAV_REQUIRES(mutex_);

  /// Whether a moment stays once it is no longer the newest; the first always does.
  [[nodiscard]] static bool keeps(std::int64_t pair, std::int64_t stride) {
    return (pair - 1) % stride == 0;
  }

  std::size_t most_;
  mutable Mutex mutex_;
  std::int64_t stride_ ORTHONAV_GUARDED_BY(mutex_) = 1;
  std::vector<std::shared_ptr<const Moment>> moments_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::preview
