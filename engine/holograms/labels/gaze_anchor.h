#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/holograms/visibility.h"
#include "hal/api/gaze.h"

namespace orthonav::engine {

/// The place that H7 hangs beside: the site, or, if it is known where the eyes look, the place near
/// the site that they rest on. It does not move for a glance, while the eyes look at the cross, or
/// if the cross would then cover an entry point. Without a gaze it stays where it is.
class GazeAnchor {
 public:
  static constexpr double kNear_m = 0.040;     ///< of the site; a gaze farther away is ignored
  static constexpr double kResting_m = 0.010;  ///< eyes that stay this close to a place rest on it
  static constexpr double kMoves_m = 0.020;    ///< the cross never moves by less
  static constexpr Duration kRests = std::chrono::milliseconds(500);
  static constexpr Duration kOldest = std::chrono::milliseconds(300);

  /// Where the cross hangs beside the site, facing the eyes.
  struct Hanging {
    Point<World> site;
    Transform<World, Vertebra> world_from_vertebra;
    Transform<World, Rig> world_from_head;
    LabelSide side = LabelSide::kLeft;
    std::span<const PlacedLevel> entries_of;  ///< their entry points must not be covered
  };
  /// The offset from the site to the place that the cross hangs beside; absent: none. All poses and
  /// the gaze are in the guidance's World.
  [[nodiscard]] std::optional<Direction<Vertebra>> follow(const Hanging& hanging,
                                                          const std::optional<Gaze>& gaze,
                                                          Timestamp now);
  /// Goes back to the site, when another screw is guided.
  void reset() { *this = {}; }

 private:
  using Across = std::array<double, 2>;  ///< as the eyes see it: right, up

  struct Axes {
    Vec3 right;
    Vec3 up;
    Vec3 towards;
    [[nodiscard]] Across of(const Vec3& v) const { return {right.dot(v), up.dot(v)}; }
  };
  /// Absent if the site lies along the head's up direction.
  [[nodiscard]] static std::optional<Axes> axes_of(const Hanging& hanging);
  /// Where the gaze meets the plane of the site; absent if it does not.
  [[nodiscard]] static std::optional<Across> looked_at(const Hanging& hanging, const Axes& axes,
                                                       const Gaze& gaze);
  /// Whether the cross that hangs beside `anchor`, or its numbers, would cover the place.
  [[nodiscard]] static bool covered(const Across& place, const Across& anchor, LabelSide side);
  [[nodiscard]] static bool covers_entry(const Hanging& hanging, const Axes& axes,
                                         const Across& anchor);
  void rest_on(const Across& place, const Gaze& gaze);

  std::optional<Direction<Vertebra>> offset_;
  std::optional<Across> resting_on_;
  Timestamp resting_since_{};
  Timestamp seen_{};
};

}  // namespace orthonav::engine
