#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/holograms/visibility.h"
#include "hal/api/gaze.h"

namespace orthonav::engine {

/// What H7 hangs beside, where it is known where the eyes look: what they rest on near the site, in
/// place of the site itself. It stays for every glance, for eyes that look at the cross, and where
/// the cross would cover an entry point. Without a gaze nothing changes.
class GazeAnchor {
 public:
  static constexpr double kNear_m = 0.040;     ///< of the site: what eyes rest on
  static constexpr double kResting_m = 0.010;  ///< eyes that stay so close together rest
  static constexpr double kMoves_m = 0.020;    ///< nearer to the place until now, it stays there
  static constexpr Duration kRests = std::chrono::milliseconds(500);
  static constexpr Duration kOldest = std::chrono::milliseconds(300);

  /// The cross as it hangs beside the site, which faces the eyes.
  struct Hanging {
    Point<World> site;
    Transform<World, Vertebra> world_from_vertebra;
    Transform<World, Rig> world_from_head;
    LabelSide side = LabelSide::kLeft;
    std::span<const PlacedLevel> entries_of;  ///< what it must not cover
  };
  /// From the site to where it hangs beside; absent: beside the site. All in the guidance's World.
  [[nodiscard]] std::optional<Direction<Vertebra>> follow(const Hanging& hanging,
                                                          const std::optional<Gaze>& gaze,
                                                          Timestamp now);
  /// Back to the site: another screw is guided.
  void reset() { *this = {}; }

 private:
  using Across = std::array<double, 2>;  ///< as the eyes see it: right, up

  struct Axes {
    Vec3 right;
    Vec3 up;
    Vec3 towards;
    [[nodiscard]] Across of(const Vec3& v) const { return {right.dot(v), up.dot(v)}; }
  };
  /// Absent where the eyes look along the head's own upright.
  [[nodiscard]] static std::optional<Axes> axes_of(const Hanging& hanging);
  /// Where the eyes look in the plane of the site; absent where they look past it.
  [[nodiscard]] static std::optional<Across> looked_at(const Hanging& hanging, const Axes& axes,
                                                       const Gaze& gaze);
  /// Whether a place lies where the cross or its numbers are that hang beside `anchor`.
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
